// Motors, friction and angular damping of joints.
//
// Friction and a motor are one constraint: within a substep b turns against a by as much as the motor aims
// at, or not at all, as far as the greatest torque allows. It begins with the push of the substep before, so
// an arm that is held up stays where it is.
#pragma once

#include "rigid/joint.h"

namespace lks {

// Before the prediction: what the motor is to turn in this substep.
void aim_motor(Joint& joint, const Body& a, const Body& b);
// After it.
void warm_start_drive(Joint& joint, Body& a, Body& b);
void project_drive(Joint& joint, Body& a, Body& b);

} // namespace lks
