// What a motor aims at: its target, or, where rigid limits do not let it there, what is next to it within
// them, the swing at the edge of the cone or ellipse and the twist at the end of its range. Aiming beyond
// them it would push against them in each substep with all of its torque, a light bone by degrees to and fro,
// and figures in flight began to spin of it. Into soft limits a motor may push.
#pragma once

#include "rigid/joint.h"

namespace lks {

// Before a tick.
void find_motor_aim(Joint& joint);

} // namespace lks
