// Limits that are seldom reached: one comparison that is foretold is cheaper than two and two choices.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lks {

// −limit ≤ value ≤ limit.
static inline bool within(std::int64_t value, std::int64_t limit) {
    return static_cast<std::uint64_t>(value) + static_cast<std::uint64_t>(limit) <=
           2 * static_cast<std::uint64_t>(limit);
}

static inline std::int64_t bounded(std::int64_t value, std::int64_t limit) {
    return within(value, limit) ? value : std::clamp(value, -limit, limit);
}

} // namespace lks
