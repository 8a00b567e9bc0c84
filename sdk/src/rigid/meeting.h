// Where two shapes touch that move towards each other.
//
// What a contact keeps for a tick or a substep is one normal, and the one that they have before they touch
// may be another than they touch with, or that of an edge which they pass: a wall where there is none. So
// they are looked at where they first touch, or, where they only pass, where they come closest. The distance
// of convex shapes that do not turn is a convex function along their way: Newton's method finds the first
// (conservative advancement; van den Bergen, "Ray Casting against General Convex Objects with Application to
// Continuous Collision Detection", 2004), halving the second.
#pragma once

#include "collide/manifold.h"

namespace lks {

// As collide(), of shapes of which b goes `way` against a without turning; its points are where they are now.
// What would overlap by less than a millimetre counts as passed: a floor of boxes side by side has no edges.
void collide_on_way(const Piece& a, const Piece& b, const fixed::Vec3& way, std::int64_t margin,
                    const fixed::Direction& side, Manifold& out);

} // namespace lks
