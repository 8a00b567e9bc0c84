// How the two frames of a joint are turned against each other, and what holds that: a hinge's and a fixed
// joint's axes, the limits of swing and twist, and friction.
#pragma once

#include "rigid/joint.h"

namespace lks {

// One sweep over all of them. Friction takes part in forward ones only.
void project_turns(Joint& joint, Body& a, Body& b, bool forward);

} // namespace lks
