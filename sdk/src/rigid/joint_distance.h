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
// After the velocities: what was kept.
void undo_distance(const Joint& joint, Body& a, Body& b);

} // namespace lks
