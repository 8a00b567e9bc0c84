// The least and the greatest of some numbers, and how far two of a pair are apart at most: what bounds of
// objects are made of. In plain integers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lks {

struct CoordinateRange {
    std::int64_t low;
    std::int64_t high;
};

// Along x, y and z.
struct CoordinateRanges {
    CoordinateRange axes[3];
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

inline CoordinateRanges ranges_scalar(const std::int64_t* x, std::size_t axis_stride, std::size_t count) {
    return {{range_scalar(x, count), range_scalar(x + axis_stride, count),
             range_scalar(x + 2 * axis_stride, count)}};
}

// Of a[i] and b[i].
inline std::uint64_t greatest_gap_scalar(const std::int64_t* a, const std::int64_t* b, std::size_t count) {
    std::uint64_t greatest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto [low, high] = std::minmax(a[i], b[i]);
        greatest = std::max(greatest, static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low));
    }
    return greatest;
}

} // namespace
} // namespace lks
