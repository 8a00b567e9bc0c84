// One tick of the world.
#pragma once

struct lks_world;

namespace lks {

// Exactly one tick: the hook's inputs, then each object's substeps. Objects don't meet each other, so each
// runs through its whole tick while its particles are in the cache. Allocates nothing.
void run_tick(lks_world& world);

} // namespace lks
