// How the solver finds the ends of its constraints. Plain data, shared with the kernels.
#pragma once

#include <cstdint>

namespace lks {

// Kernels take up to this many constraints at once, and may read the coefficients of as many less one behind
// the last one.
inline constexpr std::uint32_t widest_group = 16;

// `count` constraints from constraint `first`, between particles a + i and b + i.
struct Run {
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t a;
    std::uint32_t b;
    // How many particles behind a + count, and behind b + count, nothing else in the batch touches: a group
    // may run over into them, if it leaves them as they are. At most as many as fill the widest group.
    std::uint32_t spare;
};

struct Constraint {
    std::uint32_t a; // particles, a < b
    std::uint32_t b;
};

} // namespace lks
