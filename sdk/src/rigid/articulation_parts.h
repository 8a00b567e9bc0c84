// What the solver of rigid/articulation.h keeps of bodies and joints.
#pragma once

#include "fixed/int128.h"
#include "fixed/vector.h"

namespace lks {

// a·b of 32 fraction bits and any, in the other's format; wraps.
constexpr std::int64_t multiply_32(std::int64_t a, std::int64_t b) {
    return fixed::multiply_shift_32(a, b);
}

// Of a symmetric 6 × 6 matrix: shift by shift, shift by turn (row by row), turn by turn.
struct ArticulatedInverse {
    std::int64_t shift[6]; // xx, xy, xz, yy, yz, zz
    std::int64_t mixed[9];
    std::int64_t turn[6];
};

// The mass of the heaviest body (rigid/heavy_sides.h): of it and what hangs on it away from the root, behind
// the two of its joints that lead away to the heaviest, and of all others.
struct HeavySides {
    std::int64_t beyond;
    std::int64_t behind_first;
    std::int64_t behind_second;
    std::int64_t before;
};

struct ArticulatedBody {
    std::int64_t share;      // of the tree's greatest inverse mass
    std::int64_t fine_share; // the same with 40 fraction bits: of uneven trees, and of those with loops
    std::uint32_t pins;      // particles that do not move and that it is attached to (rigid/closures.h)
    bool pinned;             // at some that can't be solved with its tree
    bool has_points;         // joints that hold points of it, while closures are found
    bool touches;            // what bears it, while light feet are found
    bool bears_feet;         // alone, of a tree that stands
    bool tree_has_anchor;    // of the root: a joint of its solve holds it on what does not move
    std::uint32_t incoming;  // the joint of tree_joints by which it hangs on its parent; of the root none
    HeavySides heavy;        // while trees are found
    bool loads_rope;         // by its attachments, which then leave the tree as it is (rigid/rope_loads.h)
    std::uint32_t tree;      // or none
    std::uint32_t rope_load; // its first, or none
    std::int64_t load; // (hω)² of its swing under what pulls at it, World: as heavily as that it turns
    std::int64_t found_load;
    int lowered; // of uneven trees: what its inverse inertia's exponent is less by meanwhile
    ArticulatedInverse inverse;
    // What the joints beyond it have done to it, and what those towards the root push it.
    fixed::Vec3 shift;
    fixed::Vec3 turn;
    fixed::Vec3 force;
    fixed::Vec3 torque;
    // What the next solve begins with, in the tree's unit and the body's: torques of held trees, and what
    // light feet bear.
    fixed::Vec3 carried_force;
    fixed::Vec3 carried_torque;
};

// Of a 3 × 3 matrix: xx, xy, xz, yy, yz, zz.
struct SymmetricInverse {
    std::int64_t entries[6];
};

struct ArticulatedJoint {
    std::uint32_t joint;
    std::uint32_t child;
    std::uint32_t parent;
    bool child_is_a;
    bool child_moves;
    std::int64_t pair_share; // the pair's greater inverse mass in the tree's greatest
    fixed::Vec3 child_lever;
    fixed::Vec3 parent_lever;
    // W_p L_pᵀ: what a push along each axis does to the parent.
    fixed::Vec3 column_shift[3];
    fixed::Vec3 column_turn[3];
    SymmetricInverse inverse; // D⁻¹
    fixed::Vec3 push;         // World, in the tree's unit; on the child
};

inline constexpr std::uint32_t no_tree = UINT32_MAX;
inline constexpr std::uint32_t no_joint = UINT32_MAX;
inline constexpr std::uint32_t no_rope_load = UINT32_MAX;

// Which of the scene's tree_bodies and tree_joints are one tree's.
struct ArticulatedTree {
    std::uint32_t first_body;
    std::uint32_t body_end;
    std::uint32_t first_joint;
    std::uint32_t joint_end;
    // By a joint to what does not move, by a rope that such a thing holds, or a light body by heavy ones on
    // both sides: what joints turn is solved with their points (rigid/held_tree.h).
    bool is_held;
    bool is_loaded;     // it hangs on ropes that bear it
    bool has_springs;   // in the points of a joint
    bool is_uneven;     // one of its bodies has a hundred times the mass of another, and more
    bool is_pinned;     // by what may be solved with it (rigid/closures.h)
    std::uint32_t pins; // that are
    bool stands;        // on light feet (rigid/light_feet.h)
    // How often its longest lever is twice as long as those of most trees at most: what pushes there turns by
    // as much more.
    int lever_doublings;
    std::uint32_t lightest; // body
    // What closes loops in its figure (rigid/closures.h), and the inverse mass of its lightest body in that
    // of the figure's, 32 fraction bits.
    std::uint32_t first_closure;
    std::uint32_t closure_end;
    std::int64_t figure_share;

    bool has_closures() const { return first_closure != closure_end; }
};

} // namespace lks
