// A figure that is held gains nothing of its own.
//
// Where an arm whips straight between a hand that is held and a body of 78 kg, light bones swing by half a
// radian in a substep and more. What is found for straight lines then pushes in the wrong direction, and in
// one substep a figure of 7 kJ gained up to 2.3. But what holds it does no work in a frame that moves with
// it, and neither does what joints and limits push within the figure: there
//
//     Σ m·(v − u)²
//
// over all of its bodies, in six dimensions and with u how the holder would move them, is no more at the end
// of a substep than where bodies had been predicted (with gravity, before anything pushed), but for what
// motors have done. If it is more by one part in 256, all velocities are brought nearer to the holder's by
// the factor that leaves as much. Joints notice nothing of it: what keeps together with v and with u does so
// with each mean of them. (Velocities scaled back to an energy: Dinev, Liu, Kavan 2018, Stabilizing
// Integrators for Real-Time Physics; there for systems that nothing holds.)
#pragma once

#include "rigid/body_motion.h"
#include "rigid/rigid_scene.h"

struct lks_world;

namespace lks {

// Once velocities are known, of a figure that is held, or that something outside pushes. Where it has gained
// it is looked at what has pushed it. Where that may have given it energy it is left alone: what moves
// otherwise than its holder, particles, several holders that move differently. Springs may give what they do
// by their pushes times the motion.
void take_out_gain(RigidScene& scene, const FigureRange& figure, const MotionRate& rate);

// The same of a figure that hangs on ropes which bear it (rigid/rope_loads.h), where these are held by what
// does not move, do not stretch and bear nothing else: they and the figure gain nothing together.
void take_out_gain_on_ropes(lks_world& world, const FigureRange& figure, const MotionRate& rate);
// After the prediction: the energy of such a rope.
void measure_predicted(lks_world& world, std::uint32_t object);

} // namespace lks
