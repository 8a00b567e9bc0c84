// The same elimination as in rigid/articulation.h for trees with a hundred times the mass of one body in
// another, and more, with more bits.
//
// Where a heavy body hangs on a light one, folding it in leaves of what the light one gives way along the
// joint no more than the heavy one's share: 1 − 1/(1 + s) with s a millionth, of which 32 fraction bits have
// ten right, and each link further loses as many again. And what such a body pulls with counts as the length
// that it would move the lightest one by: of a million times the mass at 10 Hz 98 km in free fall alone. So
// here inverse masses have 40 fraction bits, D is kept as L·diag·Lᵀ with pivots' reciprocals of 62 bits, as
// its inverse would need both a millionth and a million, and pushes go up to greatest_uneven_push, or to as
// much less as levers are longer.
#pragma once

#include "rigid/push_limits.h"
#include "rigid/rigid_scene.h"

namespace lks {

inline constexpr int uneven_fraction_bits = 40;

// At its longest lever it turns by less than 2^62.
constexpr std::int64_t greatest_push_of(const ArticulatedTree& tree) {
    return greatest_uneven_push >> tree.lever_doublings;
}

void factor_uneven(RigidScene& scene, const ArticulatedTree& tree, bool springs_give);
// From the leaves on, with how far the child's point is from the parent's, World: what its push would be if
// nothing pushed the parent.
void fold_uneven(RigidScene& scene, const ArticulatedTree& tree, ArticulatedJoint& part,
                 const fixed::Vec3& apart);
// From the root on: its push with what the joints towards the root push the parent; hands it on to both.
fixed::Vec3 push_uneven(RigidScene& scene, const ArticulatedTree& tree, const ArticulatedJoint& part);
// What all pushes do to a body.
Move move_uneven(const Body& body, const ArticulatedBody& part);

} // namespace lks
