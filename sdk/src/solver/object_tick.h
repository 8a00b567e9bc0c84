// One object, or several alike, through one tick.
#pragma once

#include "solver/tick_scratch.h"
#include "threads/team.h"

struct lks_world;

namespace lks {

// team: null, or who helps with the blocks of each phase. The bits are the same.
void run_object_tick(const lks_world& world, Object& object, TickScratch& scratch, Team* team);

// One, or several that may go side by side (solver/side_by_side.h): the same bits.
void run_objects_tick(const lks_world& world, Object* const* objects, std::uint32_t count,
                      TickScratch& scratch);

// The parts of a tick, for objects that go through it together with others and with bodies: the same bits.
void begin_object_tick(const lks_world& world, Object& object, TickScratch& scratch);
// 1 .. substeps: the prediction, and pins.
void begin_object_substep(const lks_world& world, Object& object, TickScratch& scratch,
                          std::uint32_t substep);
// Then, in each iteration: the distance constraints, and the colliders.
void project_object(const lks_world& world, Object& object, TickScratch& scratch);
void collide_object(const lks_world& world, Object& object, TickScratch& scratch, std::uint32_t substep);

} // namespace lks
