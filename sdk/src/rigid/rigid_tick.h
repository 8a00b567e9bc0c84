// One tick of all rigid bodies.
#pragma once

struct lks_world;

namespace lks {

// Contacts are found, then the substeps: prediction, joints and contacts in the order of their keys,
// velocities, impacts, old overlaps. Allocates nothing.
void run_rigid_tick(lks_world& world);

} // namespace lks
