// Where two solid shapes touch, or are about to.
//
// Spheres and capsules are a core (a point, a segment) with everything within a radius; boxes have no radius.
// A contact point is a pair of core points; the surfaces are a radius further along the normal. So a round
// shape that turns under its contact point stays where it is.
#pragma once

#include <cstdint>

#include "fixed/formats.h"
#include "fixed/rotation.h"

namespace lks {

inline constexpr std::uint32_t greatest_point_count = 4;

// A shape in its place, World format, relative to any point that both of a pair share; all within 128 m.
struct Piece {
    std::uint32_t kind; // lks_shape_kind
    std::int64_t radius;
    std::int64_t half_length;
    fixed::Vec3 half_extents;
    fixed::Vec3 centre;
    fixed::Matrix3 axes; // local to world
};

struct ManifoldPoint {
    fixed::Vec3 core_a; // relative to the same point as the pieces
    fixed::Vec3 core_b;
    std::int64_t separation; // of the surfaces along the normal, negative where they overlap
    std::uint32_t feature;   // the same one for the same corner or edge
};

struct Manifold {
    fixed::Direction normal; // from a to b
    std::uint32_t count;
    std::int64_t gap; // of the shapes along the normal, no more than their distance; also without any points
    ManifoldPoint points[greatest_point_count];
};

// The normal of those that have not touched before.
inline constexpr fixed::Direction no_side{0, 0, 0};

// Whether a normal is clearly against the one before: within 60° of its opposite.
inline bool against(const fixed::Direction& normal, const fixed::Direction& side) {
    return fixed::dot(normal, side) < -direction_one / 2;
}

// Points with a separation of at most `margin`. Any kinds, but a plane only as b. An exact tie goes to the
// first of the features in their canonical order, so that the result depends on the arguments only. `side`
// is the normal that they touched with before: what has been pressed past the middle of a box, or through it,
// is still kept on the side that it came from.
void collide(const Piece& a, const Piece& b, std::int64_t margin, const fixed::Direction& side,
             Manifold& out);

namespace manifold_detail {

void add_point(Manifold& out, const fixed::Vec3& core_a, const fixed::Vec3& core_b, std::int64_t radii,
               std::int64_t margin, std::uint32_t feature);
void collide_boxes(const Piece& a, const Piece& b, std::int64_t margin, const fixed::Direction& side,
                   Manifold& out);
void collide_segment_box(const Piece& segment, const Piece& box, std::int64_t margin,
                         const fixed::Direction& side, Manifold& out);
void collide_segments(const Piece& a, const Piece& b, std::int64_t margin, Manifold& out);
void collide_plane(const Piece& a, const Piece& plane, std::int64_t margin, Manifold& out);

constexpr fixed::Direction axis(const fixed::Matrix3& axes, int i) {
    return {axes.m[0][i], axes.m[1][i], axes.m[2][i]};
}

} // namespace manifold_detail

} // namespace lks
