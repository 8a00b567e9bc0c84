// How much of what was pushed in the last substep is carried into the next one.
//
// Sweeps spread an impact slowly through a figure, that is the bodies that joints hold together: every row
// knows the masses of its own two bodies only. While a figure is being stopped its pushes grow from substep
// to substep, and when it has stopped they would throw it back like a spring; where they turn with the bodies
// they may even feed on themselves. So, when everything has been pushed as in the last substep, the pushes of
// each figure — of its joints, limits, motors and contacts — are multiplied by the factor that leaves the
// least kinetic energy:
//
//     G = Σ m·Δ·v    Q = Σ m·Δ·Δ    factor = 1 − G/Q, from 0 to 2
//
// with Δ what these pushes do to each body, and v how it moves now (both in six dimensions, m the mass
// matrix); for what a kinematic body or a collider pushes, v is the motion beside it: on a lift that rises at
// a constant speed things lie as on the ground. This is the coarse level of a two-level method whose fine
// level are the sweeps. Where next to nothing is to be gained the pushes stay as they are, so that what rests
// stays as it is, to the bit.
#pragma once

#include "rigid/body_motion.h"
#include "rigid/rigid_scene.h"

namespace lks {

// How a figure's bodies move in this substep, once joints and contacts have pushed again; into
// scene.substep_motions.
void measure_motions(RigidScene& scene, const FigureRange& figure);
// Once that is known of all. `least_speed`: World m/s, what is slower is left alone. How much of its pushes a
// figure is to get more of, 30 fraction bits; into scene.figure_shares.
std::int32_t share_to_add(RigidScene& scene, const FigureRange& figure, const MotionRate& rate,
                          std::int64_t least_speed);
// Adds these shares, figure by figure. Where one has changed what its neighbours know, theirs are found anew.
// False: nothing was changed.
bool scale_carried_pushes(RigidScene& scene, const MotionRate& rate, std::int64_t least_speed);

} // namespace lks
