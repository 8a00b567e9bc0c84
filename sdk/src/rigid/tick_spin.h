// How fast what turns evenly from one orientation to another in a tick turns.
#pragma once

#include "rigid/body.h"
#include "solver/step_rate.h"

namespace lks {

// World, rad/s; up to 126 degrees.
fixed::Vec3 tick_spin(const Quaternion& from, const Quaternion& to, const StepRate& rate);

} // namespace lks
