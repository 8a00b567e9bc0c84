#include "rigid/piece_bounds.h"

#include <algorithm>

#include <lockstitch/lockstitch.h>

#include "collide/saturation.h"

namespace lks {

using fixed::Vec3;

std::int64_t reach(const Piece& piece) {
    if (piece.kind == LKS_SHAPE_BOX) {
        return piece.half_extents.x + piece.half_extents.y + piece.half_extents.z;
    }
    return piece.radius + piece.half_length;
}

Vec3 extent(const Piece& piece) {
    const auto share = [](std::int32_t c, std::int64_t length) {
        return fixed::scale_component(c < 0 ? -c : c, length) + 1;
    };
    const auto along = [&](int row) {
        const std::int32_t(&c)[3] = piece.axes.m[row];
        if (piece.kind == LKS_SHAPE_BOX) {
            return share(c[0], piece.half_extents.x) + share(c[1], piece.half_extents.y) +
                   share(c[2], piece.half_extents.z);
        }
        return piece.radius + (piece.half_length == 0 ? 0 : share(c[1], piece.half_length));
    };
    return {along(0), along(1), along(2)};
}

bool passes_by(const Vec3& between, const Vec3& way, const Vec3& room) {
    const auto outside = [](std::int64_t d, std::int64_t change, std::int64_t half) {
        const std::int64_t end = fixed::saturating_add(d, change);
        return static_cast<int>(std::min(d, end) > half) | static_cast<int>(std::max(d, end) < -half);
    };
    // Without branches: along which axis can't be foretold.
    return (outside(between.x, way.x, room.x) | outside(between.y, way.y, room.y) |
            outside(between.z, way.z, room.z)) != 0;
}

} // namespace lks
