// A piece of work for a prediction kernel: a range of particles, of one object or of several alike side by
// side. Plain data, as distance_task.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lks {

struct PredictionTask {
    std::int64_t* x;         // along x, of the first particle of the first object
    std::size_t axis_stride; // from there to y, to z, and to where the substep before began for x, y and z
    std::size_t count;       // particles of each object
    // Where each object's are, from the first one's on; null: there is one object.
    const std::ptrdiff_t* objects;
    std::uint32_t object_count;
    std::uint32_t kept;            // of a motion, Unit; unit_one: no damping
    std::int64_t accelerations[3]; // added to each motion along x, y, z; within the limit
    std::int64_t motion_limit;
};

// How often something was clamped.
struct PredictionClamps {
    std::uint64_t positions = 0;
    std::uint64_t speeds = 0;
};

} // namespace lks
