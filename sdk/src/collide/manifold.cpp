#include "collide/manifold.h"

#include <lockstitch/collider.h>

#include <algorithm>
#include <utility>

namespace lks {

using fixed::Direction;
using fixed::Vec3;

namespace manifold_detail {

void add_point(Manifold& out, const Vec3& core_a, const Vec3& core_b, std::int64_t radii, std::int64_t margin,
               std::uint32_t feature) {
    const std::int64_t separation = fixed::dot(out.normal, core_b - core_a) - radii;
    out.gap = std::min(out.gap, separation);
    if (separation <= margin && out.count < greatest_point_count) {
        out.points[out.count++] = {core_a, core_b, separation, feature};
    }
}

// Half its length: a sphere is a segment without any.
void collide_plane(const Piece& a, const Piece& plane, std::int64_t margin, Manifold& out) {
    const Direction up = axis(plane.axes, 1);
    out.normal = -up;
    const auto add = [&](const Vec3& point, std::uint32_t feature) {
        const std::int64_t height = fixed::dot(up, point - plane.centre);
        add_point(out, point, point - fixed::scale(up, height), a.radius, margin, feature);
    };
    if (a.kind != LKS_SHAPE_BOX) {
        const Vec3 arm = fixed::scale(axis(a.axes, 1), a.half_length);
        add(a.centre + arm, 0);
        if (a.half_length != 0) {
            add(a.centre - arm, 1);
        }
        return;
    }
    // The four corners of the face that looks most against the plane's normal.
    const Direction local = fixed::rotate_transposed(a.axes, up);
    const std::int32_t parts[3] = {local.x, local.y, local.z};
    const std::int64_t extents[3] = {a.half_extents.x, a.half_extents.y, a.half_extents.z};
    int face = 0;
    for (int i = 1; i < 3; ++i) {
        face = fixed::magnitude(parts[i]) > fixed::magnitude(parts[face]) ? i : face;
    }
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        std::int64_t place[3];
        std::uint32_t feature = 0;
        for (int i = 0; i < 3; ++i) {
            const int turn = (i + 3 - face) % 3; // 0: the face's own axis, then the two along it
            const bool positive = turn == 0 ? parts[face] < 0 : ((corner >> (turn - 1)) & 1u) != 0;
            place[i] = positive ? extents[i] : -extents[i];
            feature |= positive ? 1u << i : 0u;
        }
        add(a.centre + fixed::rotate(a.axes, Vec3{place[0], place[1], place[2]}), feature);
    }
}

} // namespace manifold_detail

void collide(const Piece& a, const Piece& b, std::int64_t margin, const Direction& side, Manifold& out) {
    using namespace manifold_detail;
    out.count = 0;
    out.gap = INT64_MAX;
    if (b.kind == LKS_SHAPE_PLANE) {
        collide_plane(a, b, margin, out);
    } else if (a.kind == LKS_SHAPE_BOX && b.kind == LKS_SHAPE_BOX) {
        collide_boxes(a, b, margin, side, out);
    } else if (b.kind == LKS_SHAPE_BOX) {
        collide_segment_box(a, b, margin, side, out);
    } else if (a.kind == LKS_SHAPE_BOX) {
        collide_segment_box(b, a, margin, -side, out);
        out.normal = -out.normal;
        for (std::uint32_t i = 0; i < out.count; ++i) {
            std::swap(out.points[i].core_a, out.points[i].core_b);
        }
    } else {
        collide_segments(a, b, margin, out);
    }
}

} // namespace lks
