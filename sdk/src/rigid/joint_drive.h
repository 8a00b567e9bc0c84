// Motors, friction and angular damping of joints.
//
// Friction and a motor are one constraint: within a substep b turns against a by as much as the motor aims
// at, or not at all, as far as the greatest torque allows. It begins with the push of the substep before, so
// an arm that is held up stays where it is.
//
// A motor's push loses a share on the way, twice the share of its error that it makes up for in a substep. A
// row knows its two bones only, not what hangs on them: it turns less than it means to, and with the whole
// push carried on it answers late, as an undamped spring, which swings when a target is followed faster than
// its own damping (a spider's legs threw it 50 m up). With the loss such swings die out, whatever hangs
// there; what it leaves of a load M is a sag of 2·M·h²·w, w being the joint's inverse inertia about that
// axis.
#pragma once

#include "rigid/held_row.h"
#include "rigid/joint.h"

namespace lks {

inline bool has_motor(const Joint& joint) {
    return joint.description.motor_torque != 0 && joint.constants.grip != 0;
}

// It turned with all it is capable of, or nearly, in the substep before.
bool is_exhausted(const Joint& joint);

// Before the prediction: what the motor is to turn in this substep.
void aim_motor(Joint& joint, const Body& a, const Body& b);
// After it: what is carried on, and how that is pushed.
void prepare_drive(Joint& joint, const Body& a);
void carry_drive_on(const Joint& joint, Body& a, Body& b);
// Adds a share of it, which is to be pushed.
fixed::Vec3 add_to_drive(Joint& joint, std::int32_t share);
void project_drive(Joint& joint, Body& a, Body& b);

// What the motor turns, as rows of its tree, up to what rows has room for: about which axes, and how far b
// has turned about each beyond what it is to. How many.
std::uint32_t drive_rows(const Joint& joint, const Body& a, const Body& b, HeldRow* rows);
// All of them in one, in the world: an angle, World.
fixed::Vec3 drive_error(const Joint& joint, const Body& a, const Body& b);
// Whether turning so much more is beyond it.
bool is_beyond_drive(const Joint& joint, const fixed::Vec3& more);

// What a push that turns b against a, an angle, has done in this substep, as motions of the joint's lighter
// body count (rigid/substep_motion.h): 52 fraction bits.
std::int64_t work_of_turning(const Joint& joint, const Body& a, const Body& b, const fixed::Vec3& turned);

} // namespace lks
