// What one worker needs for itself while it moves objects. No state.
#pragma once

#include <lockstitch/world.h>

#include "memory/array.h"
#include "solver/chain.h"
#include "solver/distance.h"
#include "solver/object.h"
#include "solver/tethers.h"

namespace lks {

struct TickScratch {
    Array<std::uint32_t> candidates; // room for all colliders, for each of the objects side by side
    DistanceWork distances;          // of the object at work, or of the first one of several
    Array<std::int64_t> rows;        // room for those of the object that has most
    Array<std::int64_t> chain;       // room for the longest rope that is solved directly
    Array<TetherAnchor> anchors;     // room for those of the asset that has most
    Array<std::uint64_t> far_pushed; // room for a bit for each particle of the object that has most
    lks_world_counters counters{};   // of this tick
};

} // namespace lks
