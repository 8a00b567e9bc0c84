// The limits of swing and twist. What is beyond a limit must not turn further within a substep; like a
// contact's, its push only turns back, and the next substep begins with it. What is beyond is undone without
// giving speed.
//
// Soft limits are XPBD's (Macklin et al. 2016, eq. 26), as soft joints are: from zero in each substep, with
// what is beyond as the error, and its change within the substep damped.
#pragma once

#include "rigid/held_row.h"
#include "rigid/joint.h"

namespace lks {

// Before the prediction: how far they let turn.
void begin_limits(Joint& joint, const Body& a, const Body& b);
// What a motor is to turn in the substep, half turns, Turn: on its way to where limits let it, it may meet
// them in between. Then it goes along them, and does not push.
fixed::Vec3 along_limits(const Joint& joint, const Body& a, const Body& b, const fixed::Vec3& aim);
// After it: what is carried on, and how that is pushed.
void prepare_limits(Joint& joint);
void carry_limits_on(const Joint& joint, Body& a, Body& b);
void carry_more_limits(Joint& joint, Body& a, Body& b, std::int32_t share);
// The same without a push.
void add_to_limits(Joint& joint, std::int32_t share);
void project_limits(Joint& joint, Body& a, Body& b);
// How they have pushed in this substep.
fixed::Vec3 limit_push(const Joint& joint, const Body& a, const Body& b);
// By how much limits without compliance are exceeded, in this substep or at all: World, radians; or nothing
// above zero.
std::int64_t exceeded_limits(const Joint& joint, const Body& a, const Body& b, bool in_substep);
// After the velocities: what is left. True: it was more than half a degree.
bool undo_limits(const Joint& joint, Body& a, Body& b);

// Limits without compliance as rows behind `count` others, of a twist the nearer one: in this substep, or at
// all. How many there are then.
std::uint32_t limit_rows(const Joint& joint, const Body& a, const Body& b, bool in_substep,
                         HeldRow (&rows)[most_held_rows], std::uint32_t count);
// What such a row has pushed now; not less than zero.
void set_limit_push(Joint& joint, const HeldRow& row, std::int64_t push);

} // namespace lks
