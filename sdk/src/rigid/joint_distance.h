// The points of a distance joint: a row along the way between them. A rod (distance_min == distance_max)
// holds both ways, a rope only pulls, a strut only pushes. It begins each substep from nothing, as XPBD has
// it.
//
// What a rigid one is off by when a substep begins it makes up for with speed as far as it pushed in the one
// before: that much is what the sweeps may have left of the load that it bears. What is beyond, as of a joint
// that was made, or a body that was put, beyond its limit, is kept in the substep, and undone at its end
// without giving speed.
#pragma once

#include "rigid/joint.h"

namespace lks {

constexpr bool is_distance(const Joint& joint) {
    return joint.description.kind == LKS_JOINT_DISTANCE;
}

// Before the prediction: what of its error is to be kept.
void begin_distance(Joint& joint, const Body& a, const Body& b);
void project_distance(Joint& joint, Body& a, Body& b);
// What a solve of several at once (rigid/closures.h) is to bring to zero along the way from a's point to b's.
struct DistanceError {
    fixed::Direction way;
    std::int64_t left;   // World
    std::int64_t pushed; // along the way, by now
    int side;            // 0: a rod; −1: a rope, which pushes less than zero or nothing; 1: a strut
};
// In a substep.
DistanceError left_of_distance(const Joint& joint, const Body& a, const Body& b);
// At its end, without giving speed; a soft one keeps the length that hold_spring found.
DistanceError distance_beyond(const Joint& joint, const Body& a, const Body& b);
// Of any soft joint: what is undone leaves its points where they are.
void hold_spring(Joint& joint, const Body& a, const Body& b);
// After the velocities: what was kept.
void undo_distance(const Joint& joint, Body& a, Body& b);

} // namespace lks
