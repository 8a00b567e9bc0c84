// Figures that stand on light feet: bones that joints hold stiffly, and that bear a multiple of their own
// mass on what does not move, or on a body by itself.
//
// A contact knows its two bodies, and not what stands on them. Each iteration gives a foot of a kilogram what
// stops a kilogram, and the sixty that stand on it go on: statues shook, and figures that their motors hold
// upright fell over, whatever their torque. So the contacts of such feet are solved with the trees, as one of
// the rows that push one way only (rigid/closures.h), and what motors turn as part of the trees.
#pragma once

#include "rigid/rigid_scene.h"

namespace lks {

// Into scene.foot_contacts. Once contacts and trees are found. True: figures have been joined with bodies
// that bear them, until join_figures() is called again. Gravity: World, m/s².
bool find_light_feet(RigidScene& scene, const fixed::Vec3& gravity);

} // namespace lks
