// One object through one tick.
#pragma once

#include "solver/tick_scratch.h"
#include "threads/team.h"

struct lks_world;

namespace lks {

// team: null, or who helps with the blocks of each phase. The bits are the same.
void run_object_tick(const lks_world& world, Object& object, TickScratch& scratch, Team* team);

} // namespace lks
