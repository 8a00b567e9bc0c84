// Trees of joints that are pulled straight between two things that do not move.
#pragma once

#include "rigid/rigid_scene.h"

namespace lks {

// Of the tree whose joints in tree_joints begin there, to the last one: joints to what does not move that
// will be further from the first such joint than the tree reaches are left to the sweeps. Pulled straight it
// has nothing left along the line between them, and what the solve asks for along that has no end.
void leave_out_taut_anchors(RigidScene& scene, std::size_t begin);

} // namespace lks
