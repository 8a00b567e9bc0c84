// coordinate_range.h over lanes: four registers at a time, as each waits for what it was before.
#pragma once

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

template <typename L>
inline CoordinateRange range_lanes(const std::int64_t* values, std::size_t count) {
    constexpr std::size_t step = 4 * L::half;
    if (count < step) {
        return range_scalar(values, count);
    }
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

} // namespace
} // namespace lks
