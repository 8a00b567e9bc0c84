// Overlaps of figures, that is of bodies that joints hold together, undone by moving the figures as wholes.
//
// What is jammed is mostly small: a foot of a kilogram under somebody's chest. Whatever a contact pushes it
// by, the other side, its own joints or a limit push it back, and as it gives way to everybody in turn no
// push grows until it lifts what it carries. Figures are of one size: moved as wholes, without speed, they
// need a few sweeps to come apart, and no joint notices. Nothing that touches is pressed together by it.
#pragma once

#include "rigid/rigid_scene.h"
#include "solver/step_rate.h"

namespace lks {

// At the end of a tick: by the contacts of its last substep.
void part_figures(RigidScene& scene, const StepRate& rate);

} // namespace lks
