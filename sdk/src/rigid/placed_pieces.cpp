#include "rigid/placed_pieces.h"

#include <algorithm>

#include "collide/plane_motion.h"
#include "collide/saturation.h"

namespace lks {

using fixed::Direction;
using fixed::Vec3;

Piece piece_of_body(const Body& body, const BodyShape& shape, const Vec3& reference) {
    Piece piece{};
    piece.kind = shape.kind;
    piece.radius = shape.radius;
    piece.half_length = shape.half_length;
    piece.half_extents = shape.half_extents;
    piece.centre = (body.position - reference) + fixed::rotate(body.rotation, shape.position);
    piece.axes = shape_axes(body.rotation, shape);
    return piece;
}

Piece piece_of_collider(const Body& body, const ColliderState& collider, const Vec3& reference) {
    Piece piece{};
    const Shape shape = world_shape(collider.shape);
    piece.kind = shape.kind;
    piece.radius = shape.radius;
    piece.half_length = shape.half_length;
    piece.half_extents = shape.half_extents;
    piece.axes = body.rotation;
    if (collider.shape.kind == LKS_SHAPE_PLANE) {
        // The point of the plane that is nearest to the reference: the plane's own may be anywhere.
        const Direction up = plane_normal(body.rotation);
        const std::int64_t lift = world_height_above_plane(up, body.position, reference);
        constexpr std::int64_t limit = std::int64_t{16384} << world_fraction_bits; // beyond any way of a tick
        piece.centre = -fixed::scale(up, std::clamp(lift, -limit, limit));
    } else {
        piece.centre = saturating_subtract(body.position, reference);
    }
    return piece;
}

} // namespace lks
