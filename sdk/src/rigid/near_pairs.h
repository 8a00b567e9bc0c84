// Which bodies, and bodies and colliders, may come near each other in a tick.
#pragma once

#include "solver/world.h"

namespace lks {

// Fills the scene's pairs, in ascending order, and what the search for contacts uses of each body: its pieces
// around its centre of mass with their extents, and how far it goes.
void find_near_pairs(lks_world& world);

} // namespace lks
