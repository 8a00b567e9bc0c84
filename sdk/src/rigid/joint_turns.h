// What of turning hinges and fixed joints don't allow. Like points, the motion within a substep is held,
// beginning with the push of the one before.
#pragma once

#include "rigid/joint.h"

namespace lks {

// Before the prediction.
void begin_turn(Joint& joint, const Body& a, const Body& b);
// After it.
void warm_start_turn(Joint& joint, Body& a, Body& b);
void carry_more_turn(Joint& joint, Body& a, Body& b, std::int32_t share);
void project_turn(Joint& joint, Body& a, Body& b);
// After the velocities: what is left.
void undo_turn(const Joint& joint, Body& a, Body& b);

} // namespace lks
