// What of turning hinges and fixed joints don't allow. Like points, the motion within a substep is held,
// beginning with the push of the one before.
#pragma once

#include "rigid/held_row.h"
#include "rigid/joint.h"

namespace lks {

// Before the prediction.
void begin_turn(Joint& joint, const Body& a, const Body& b);
// After it: what is carried on, and how that is pushed.
void prepare_turn(Joint& joint, const Body& a, const Body& b);
void carry_turn_on(const Joint& joint, Body& a, Body& b);
// Adds a share of it, which is to be pushed.
fixed::Vec3 add_to_turn(Joint& joint, std::int32_t share);
void project_turn(Joint& joint, Body& a, Body& b);
// After the velocities: what is left.
void undo_turn(const Joint& joint, Body& a, Body& b);

// What is not to turn, as rows, of joints without compliance: in this substep, or at all. How many.
std::uint32_t turn_rows(const Joint& joint, const Body& a, const Body& b, bool in_substep,
                        HeldRow (&rows)[most_held_rows]);
// All of them in one, in the world.
fixed::Vec3 turn_error(const Joint& joint, const Body& a, const Body& b, bool in_substep);
// Of them, the most it has turned by: World, radians.
std::int64_t turned_away(const Joint& joint, const Body& a, const Body& b, bool in_substep);

} // namespace lks
