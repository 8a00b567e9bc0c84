// One tick of all rigid bodies.
#pragma once

#include "threads/team.h"

struct lks_world;

namespace lks {

// Whether so much is awake that it is worth waking others.
bool bodies_need_team(const lks_world& world);

// Contacts, trees and figures are found, then the substeps (rigid/rigid_substep.h); at last what bears too
// much breaks, and islands fall asleep. Allocates nothing. `team`: null, or who helps; the bits are the same.
void run_rigid_tick(lks_world& world, Team* team);

} // namespace lks
