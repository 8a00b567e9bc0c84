// The two passes of a tree's solve joint by joint, whatever fraction bits it has (rigid/articulation.h).
#pragma once

#include "rigid/articulation_joint.h"
#include "rigid/body_motion.h"
#include "rigid/uneven_tree.h"

namespace lks::tree_detail {

// From the leaves on, with how far the child's point is from the parent's: its push if nothing pushed the
// parent.
inline void fold_error(RigidScene& scene, const ArticulatedTree& tree, ArticulatedJoint& part,
                       const fixed::Vec3& apart) {
    if (tree.is_uneven) {
        fold_uneven(scene, tree, part, apart);
        return;
    }
    ArticulatedBody& parent = scene.articulated[part.parent];
    part.push = -symmetric(part.inverse.entries, left_apart(scene, part, apart));
    clamp_vector(part.push, greatest_push);
    const std::int64_t pushes[3] = {part.push.x, part.push.y, part.push.z};
    for (int axis = 0; axis < 3; ++axis) {
        parent.shift = parent.shift - multiply_32(pushes[axis], part.column_shift[axis]);
        parent.turn = parent.turn - multiply_32(pushes[axis], part.column_turn[axis]);
    }
}

// From the root on: with what the joints towards the root push the parent; hands it on to both.
inline fixed::Vec3 push_down(RigidScene& scene, const ArticulatedTree& tree, const ArticulatedJoint& part) {
    if (tree.is_uneven) {
        return push_uneven(scene, tree, part);
    }
    const ArticulatedBody& parent = scene.articulated[part.parent];
    const auto along = [&](int axis) {
        return dot_32(part.column_shift[axis], parent.force) + dot_32(part.column_turn[axis], parent.torque);
    };
    fixed::Vec3 push = part.push + symmetric(part.inverse.entries, {along(0), along(1), along(2)});
    clamp_vector(push, greatest_push);
    push_at_joint(scene, part, push);
    return push;
}

// What a torque does to a body by itself.
inline fixed::Vec3 own_turn_in_tree(const Body& body, const ArticulatedTree& tree,
                                    const ArticulatedBody& part, const fixed::Vec3& torque) {
    return tree.is_uneven ? own_turn<uneven_fraction_bits>(body, part.fine_share, torque)
                          : own_turn(body, part.share, torque);
}

// What all pushes do to it.
inline Move move_in_tree(const Body& body, const ArticulatedTree& tree, const ArticulatedBody& part) {
    return tree.is_uneven ? move_uneven(body, part) : move_of(body, part.share, part);
}

} // namespace lks::tree_detail
