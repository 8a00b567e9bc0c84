// A piece of work for a prediction kernel: one axis of a range of particles. Plain data, as distance_task.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lks {

struct PredictionTask {
    std::int64_t* x;
    std::int64_t* start; // where the particles were at the start of the substep before
    std::size_t count;
    std::int64_t acceleration_motion; // added to each motion, within the limit
    std::uint32_t kept;               // of a motion, Unit; unit_one: no damping
    std::int64_t motion_limit;
};

// How often something was clamped.
struct PredictionClamps {
    std::uint64_t positions = 0;
    std::uint64_t speeds = 0;
};

} // namespace lks
