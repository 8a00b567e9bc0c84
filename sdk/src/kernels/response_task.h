// Contacts of particles with one collider, for kernels that take several at a time: collide/contact.h in
// plain data, as distance_task.h.
#pragma once

#include <cstdint>

namespace lks {

struct ResponseTask {
    // Coordinate, now and at the start of the substep.
    std::int64_t* positions[3];
    std::int64_t* starts[3];
    std::int64_t radius; // of the shape and the particles together
    std::int64_t half_length;
    std::int64_t half_extents[3];
    bool turned;                       // false: both rotations are none
    std::int64_t start_rotation[3][3]; // Direction, local to object space
    std::int64_t end_rotation[3][3];
    std::int64_t start_centre[3]; // within ±response_centre_limit
    std::int64_t end_centre[3];
    std::uint32_t static_friction; // friction_fraction_bits
    std::uint32_t dynamic_friction;
    std::int64_t greatest_recovery;
    std::int64_t tolerance;
    std::int64_t greatest_new_depth; // what is pushed further, old overlaps aside, is left
};

inline constexpr std::int64_t response_centre_limit = std::int64_t{1} << 62;

// Of particles first .. first + count - 1, count <= 64, those of which the bits of `near` are set are moved
// out of the shape. Returns the bits of those that are to be looked at one by one: nothing was done with
// them.
using Respond = std::uint64_t (*)(const ResponseTask& task, std::uint32_t first, std::uint32_t count,
                                  std::uint64_t near);

// Null: one by one.
struct ResponseKernels {
    Respond plane;
    Respond sphere;
    Respond capsule;
    Respond box;
};

inline constexpr ResponseKernels no_response_kernels{nullptr, nullptr, nullptr, nullptr};

} // namespace lks
