// What the solves of trees do at a joint whatever fraction bits they have: rigid/articulation.h,
// rigid/uneven_tree.h.
#pragma once

#include "rigid/articulation_algebra.h"
#include "rigid/rigid_scene.h"

namespace lks::tree_detail {

// The greater inverse mass of its bodies in the tree's greatest.
inline std::int64_t pair_share_of(const RigidScene& scene, const ArticulatedJoint& part) {
    const std::int64_t share = scene.articulated[part.parent].share;
    return part.child_moves ? std::max(share, scene.articulated[part.child].share) : share;
}

// Where it is between its bodies; and how its points part by a push along each axis (D: xx, xy, xz, yy, yz,
// zz), and what that does to the parent.
inline void place_joint(RigidScene& scene, ArticulatedJoint& part, fixed::Vec3 (&column_shift)[3],
                        fixed::Vec3 (&column_turn)[3], std::int64_t (&d)[6]) {
    const Joint& joint = scene.joints[part.joint];
    const ArticulatedBody& parent = scene.articulated[part.parent];
    part.pair_share = pair_share_of(scene, part);
    if (part.child_moves) {
        const ArticulatedBody& child = scene.articulated[part.child];
        part.child_lever = lever_in_units(scene.bodies[part.child], point_of(joint, part.child_is_a));
        fixed::Vec3 shift[3];
        fixed::Vec3 turn[3];
        push_columns(child.inverse, part.child_lever, shift, turn);
        add_point_motion(part.child_lever, shift, turn, d);
    }
    part.parent_lever = lever_in_units(scene.bodies[part.parent], point_of(joint, !part.child_is_a));
    push_columns(parent.inverse, part.parent_lever, column_shift, column_turn);
    add_point_motion(part.parent_lever, column_shift, column_turn, d);
}

// What points give way by, in fraction bits and unit of `greater_share`, the pair's greater inverse mass.
inline std::int64_t points_give(const Softness& points, std::int64_t greater_share) {
    return fixed::multiply_shift(points.softness, greater_share, 30);
}
inline std::int64_t points_give(const Joint& joint, std::int64_t greater_share) {
    return points_give(joint.constants.points, greater_share);
}

// It counts in D, too.
inline void soften_points(const Joint& joint, std::int64_t greater_share, std::int64_t (&d)[6]) {
    if (has_soft_points(joint.constants)) {
        const std::int64_t more = points_give(joint, greater_share);
        d[0] = plus(d[0], more);
        d[3] = plus(d[3], more);
        d[5] = plus(d[5], more);
    }
}

// By what of a parent's six directions its joint's pushes move.
inline void rows_of(const fixed::Vec3 (&column_shift)[3], const fixed::Vec3 (&column_turn)[3],
                    fixed::Vec3 (&rows)[6]) {
    for (int i = 0; i < 3; ++i) {
        rows[i] = {component(column_shift[0], i), component(column_shift[1], i),
                   component(column_shift[2], i)};
        rows[3 + i] = {component(column_turn[0], i), component(column_turn[1], i),
                       component(column_turn[2], i)};
    }
}

// W −= S·Rᵀ, where that is symmetric.
template <typename Dot>
void take_out_rows(ArticulatedInverse& w, const fixed::Vec3 (&shares)[6], const fixed::Vec3 (&rows)[6],
                   const Dot& dot) {
    int entry = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            w.shift[entry] = minus(w.shift[entry], dot(shares[i], rows[j]));
            w.turn[entry] = minus(w.turn[entry], dot(shares[3 + i], rows[3 + j]));
            ++entry;
        }
        for (int j = 0; j < 3; ++j) {
            w.mixed[3 * i + j] = minus(w.mixed[3 * i + j], dot(shares[i], rows[3 + j]));
        }
    }
}

// What is left of how far the child's point is from the parent's, after what is beyond has moved them.
inline fixed::Vec3 left_apart(const RigidScene& scene, const ArticulatedJoint& part,
                              const fixed::Vec3& apart) {
    const fixed::Vec3 left = apart - point_motion(scene.articulated[part.parent], part.parent_lever);
    return part.child_moves ? left + point_motion(scene.articulated[part.child], part.child_lever) : left;
}

inline void push_at_joint(RigidScene& scene, const ArticulatedJoint& part, const fixed::Vec3& push) {
    add_force(scene.articulated[part.parent], part.parent_lever, -push);
    if (part.child_moves) {
        add_force(scene.articulated[part.child], part.child_lever, push);
    }
}

} // namespace lks::tree_detail
