// coordinate_range.h over lanes: four registers at a time, as each waits for what it was before.
#pragma once

#include <type_traits>

#include "kernels/coordinate_range.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

template <typename L>
class RangeLanes {
    using R = typename L::Register;

public:
    explicit RangeLanes(R values) : low_(values), high_(values) {}

    LKS_FORCE_INLINE void include(R values) {
        low_ = L::minimum_signed(low_, values);
        high_ = L::maximum_signed(high_, values);
    }
    LKS_FORCE_INLINE void include(const RangeLanes& other) {
        low_ = L::minimum_signed(low_, other.low_);
        high_ = L::maximum_signed(high_, other.high_);
    }
    CoordinateRange range() const {
        std::int64_t low[L::half], high[L::half];
        L::store(low, low_);
        L::store(high, high_);
        return {range_scalar(low, L::half).low, range_scalar(high, L::half).high};
    }

private:
    R low_, high_;
};

// count ≥ four registers
template <typename L>
LKS_FORCE_INLINE CoordinateRange range_lanes(const std::int64_t* values, std::size_t count) {
    constexpr std::size_t step = 4 * L::half;
    RangeLanes<L> a(L::load(values)), b(L::load(values + L::half));
    RangeLanes<L> c(L::load(values + 2 * L::half)), d(L::load(values + 3 * L::half));
    // The last step may look at some again.
    for (std::size_t i = step; i < count; i += step) {
        const std::int64_t* const at = values + std::min(i, count - step);
        a.include(L::load(at));
        b.include(L::load(at + L::half));
        c.include(L::load(at + 2 * L::half));
        d.include(L::load(at + 3 * L::half));
    }
    a.include(b);
    c.include(d);
    a.include(c);
    return a.range();
}

// `Narrow`: the lanes for what is less than four registers.
template <typename L, typename Narrow = L>
inline CoordinateRanges ranges_lanes(const std::int64_t* x, std::size_t axis_stride, std::size_t count) {
    if (count < 4 * L::half) {
        if constexpr (std::is_same_v<L, Narrow>) {
            return ranges_scalar(x, axis_stride, count);
        } else {
            return ranges_lanes<Narrow>(x, axis_stride, count);
        }
    }
    return {{range_lanes<L>(x, count), range_lanes<L>(x + axis_stride, count),
             range_lanes<L>(x + 2 * axis_stride, count)}};
}

template <typename L>
inline std::uint64_t greatest_gap_lanes(const std::int64_t* a, const std::int64_t* b, std::size_t count) {
    using R = typename L::Register;
    constexpr std::size_t step = 2 * L::half;
    if (count < step) {
        return greatest_gap_scalar(a, b, count);
    }
    // Less 2^63, so that they have signs.
    R greatest[2] = {L::set(INT64_MIN), L::set(INT64_MIN)};
    for (std::size_t i = 0; i < count; i += step) {
        const std::size_t at = std::min(i, count - step);
        for (std::size_t k = 0; k < 2; ++k) {
            const R x = L::load(a + at + k * L::half);
            const R y = L::load(b + at + k * L::half);
            const R gap = L::subtract(L::maximum_signed(x, y), L::minimum_signed(x, y));
            greatest[k] = L::maximum_signed(greatest[k], L::exclusive_or(gap, L::set(INT64_MIN)));
        }
    }
    const std::int64_t most = RangeLanes<L>(L::maximum_signed(greatest[0], greatest[1])).range().high;
    return static_cast<std::uint64_t>(most) ^ (std::uint64_t{1} << 63);
}

} // namespace
} // namespace lks
