// The least and the greatest of some numbers: what bounds of objects are made of. In plain integers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lks {

struct CoordinateRange {
    std::int64_t low;
    std::int64_t high;
};

namespace {

inline CoordinateRange joined(const CoordinateRange& a, const CoordinateRange& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

// count ≥ 1
inline CoordinateRange range_scalar(const std::int64_t* values, std::size_t count) {
    CoordinateRange range{values[0], values[0]};
    for (std::size_t i = 1; i < count; ++i) {
        range = joined(range, {values[i], values[i]});
    }
    return range;
}

} // namespace
} // namespace lks
