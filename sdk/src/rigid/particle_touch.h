// Cloth and ropes that sleeping bodies rest on. The state does not remember which particles have pushed, and
// some of a cloth at rest tremble as fast as others leave: what counts is whether any of them is there.
#pragma once

#include "solver/world.h"

namespace lks {

// Those asleep that particles of the object touch: before it goes.
void wake_who_touches(lks_world& world, const Object& object);

// Who sleeps and is left by all particles of an object in a tick wakes at its end; in between: which pairs
// touched at its beginning.
void note_particle_touches(lks_world& world);
void wake_who_was_left(lks_world& world);

} // namespace lks
