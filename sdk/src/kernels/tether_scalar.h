// The question of tether_task.h in plain integers.
#pragma once

#include "kernels/tether_task.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

inline bool may_be_beyond(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t length) {
    const std::int64_t dx = x >> 32;
    const std::int64_t dy = y >> 32;
    const std::int64_t dz = z >> 32;
    // At most 3·2^62.
    const std::uint64_t square = static_cast<std::uint64_t>(dx * dx) + static_cast<std::uint64_t>(dy * dy) +
                                 static_cast<std::uint64_t>(dz * dz);
    const std::uint64_t shorter = length - std::uint64_t{2};
    return (shorter * shorter) >> 1 < square >> 1;
}

// Bit i: particle first + i; count ≤ 64.
inline std::uint64_t beyond_tether_scalar(const TetherTask& task, std::uint32_t first, std::uint32_t count) {
    std::uint64_t beyond = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t p = first + i;
        const bool may =
            may_be_beyond(wrapping_subtract(task.positions[0][p], task.anchor[0]),
                          wrapping_subtract(task.positions[1][p], task.anchor[1]),
                          wrapping_subtract(task.positions[2][p], task.anchor[2]), task.lengths[p]);
        beyond |= static_cast<std::uint64_t>(may) << i;
    }
    return beyond;
}

} // namespace
} // namespace lks
