// Trees of joints that are built alike, lane by lane, for kernels that solve them side by side. Plain data.
// What is done with it is said in rigid/articulation.h.
#pragma once

#include <cstdint>

namespace lks {

inline constexpr std::uint32_t tree_lanes = 8;
// Fewer are solved faster one by one.
inline constexpr std::uint32_t least_trees_in_lanes = 3;
// The same number of each tree.
using TreeLanes = std::int64_t[tree_lanes];

struct WideTreeBody {
    // What the body's unit and its inverse inertia are shifted by.
    int turn_shift;    // turns to half turns
    int inverse_shift; // the inverse inertia to 32 fraction bits
    int lever_shift;   // World to levers
    // Bit i: lane i is turned by so much that the caller has to do it, by the half turn in `turn`.
    std::uint32_t turns_far;
    TreeLanes share;
    TreeLanes world_inverse[6];
    TreeLanes position[3];
    TreeLanes orientation[4];
    TreeLanes rotation[9]; // the low halves count
    // Of the factors: the inverse mass with what its joints carry, as ArticulatedInverse has it.
    TreeLanes shift_inverse[6];
    TreeLanes mixed_inverse[9];
    TreeLanes turn_inverse[6];
    // Of the solve.
    TreeLanes shift[3];
    TreeLanes turn[3];
    TreeLanes force[3];
    TreeLanes torque[3];
};

// From body `parent` to the body behind this joint's index: bodies stand in the order of the joints that lead
// to them.
struct WideTreeJoint {
    std::uint32_t parent;
    bool child_is_a;
    TreeLanes parent_point[3];
    TreeLanes child_point[3];
    TreeLanes start[3];
    // The factors.
    TreeLanes pair_share;
    TreeLanes parent_lever[3];
    TreeLanes child_lever[3];
    TreeLanes column_shift[3][3];
    TreeLanes column_turn[3][3];
    TreeLanes inverse[6];
    TreeLanes push[3]; // what b is pushed
};

struct TreeTask {
    WideTreeBody* bodies; // one more than joints
    WideTreeJoint* joints;
    std::uint32_t joint_count;
    std::uint32_t trees; // up to tree_lanes
    bool keeps_start;    // the points are to be as far apart as at the start, or not at all
    // How joints' points move by pushes, inverted for the lanes first .. first + count − 1.
    void (*invert)(const TreeLanes (&motion)[6], std::uint32_t first, std::uint32_t count,
                   TreeLanes (&inverse)[6]);
};

// Null where lanes would bring nothing.
struct TreeKernels {
    void (*factor)(const TreeTask& task);
    void (*solve)(const TreeTask& task);
};
inline constexpr TreeKernels no_tree_kernels{nullptr, nullptr};

} // namespace lks
