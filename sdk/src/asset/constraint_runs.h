// How the solver finds the ends of its constraints. Plain data, shared with the kernels.
#pragma once

#include <cstdint>

namespace lks {

// `count` constraints from constraint `first`, between particles a + i and b + i.
struct Run {
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t a;
    std::uint32_t b;
};

struct Constraint {
    std::uint32_t a; // particles, a < b
    std::uint32_t b;
};

} // namespace lks
