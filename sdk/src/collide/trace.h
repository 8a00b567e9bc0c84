// A straight way against one shape, in the shape's own frame. Shape and way in any one format.
#pragma once

#include "collide/shape.h"
#include "kernels/way_share.h"

namespace lks {

// rest · (distance / closing), rounded towards zero; 0 <= distance < closing.
constexpr fixed::Vec3 advance(const fixed::Vec3& rest, std::int64_t distance, std::int64_t closing) {
    return fixed::scaled(way_share(static_cast<std::uint64_t>(distance), static_cast<std::uint64_t>(closing)),
                         rest);
}

// Follows the way from an outside start until it meets the shape. Sphere tracing (Hart 1996) would go on by
// the distance, which near a grazing surface takes any number of steps; the plane through the nearest surface
// point has the whole convex shape behind it, so that the way is free up to there. On the distance along the
// way, a convex function, this is Newton's method: from outside it never passes the root, and it doubles the
// digits with each step (at a tangent, the distance falls to a quarter). Some 25 steps reach the tolerance
// from anywhere.
inline constexpr int greatest_trace_steps = 64;

struct Trace {
    SurfacePoint start;   // nearest to where the way begins
    SurfacePoint hit;     // nearest to where it enters
    fixed::Vec3 rest;     // of the way from there on
    std::int64_t closing; // how far the rest goes behind the plane through `hit`, and through its start
};

// False: the way never gets behind such a plane.
template <typename Nearest>
constexpr bool trace(const Nearest& nearest_to, const fixed::Vec3& start, const fixed::Vec3& end,
                     std::int64_t tolerance, Trace& out) {
    SurfacePoint nearest = nearest_to(start);
    out.start = nearest;
    fixed::Vec3 rest = end - start;
    std::int64_t closing = -fixed::dot(nearest.normal, rest);
    for (int step = 0; step < greatest_trace_steps; ++step) {
        if (closing <= nearest.distance) {
            return false;
        }
        if (nearest.distance <= tolerance) {
            break;
        }
        rest = rest - advance(rest, nearest.distance, closing);
        nearest = nearest_to(end - rest);
        closing = -fixed::dot(nearest.normal, rest);
    }
    out.hit = nearest;
    out.rest = rest;
    out.closing = closing;
    return true;
}

} // namespace lks
