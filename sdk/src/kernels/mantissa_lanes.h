// 1/√m and 1/m of mantissas over lanes: fixed/reciprocal_sqrt.h.
#pragma once

#include "fixed/reciprocal_sqrt.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

// Seeds of fixed/reciprocal_sqrt.h as 32-bit lanes take them: entries 0 .. 7 and 8 .. 15.
struct LaneSeeds {
    std::uint32_t c0_c1[2][8]; // c0 low
    std::uint32_t c2[2][8];    // high
};

constexpr LaneSeeds make_lane_seeds(const fixed::detail::SeedTable& table) {
    LaneSeeds seeds{};
    for (int i = 0; i < 16; ++i) {
        const fixed::SeedSegment& segment = table.segment[i];
        seeds.c0_c1[i / 8][i % 8] =
            segment.c0 | (std::uint32_t{static_cast<std::uint16_t>(segment.c1)} << 16);
        seeds.c2[i / 8][i % 8] = std::uint32_t{static_cast<std::uint16_t>(segment.c2)} << 16;
    }
    return seeds;
}

constexpr LaneSeeds reciprocal_sqrt_lane_seeds = make_lane_seeds(fixed::reciprocal_sqrt_seeds);
constexpr LaneSeeds reciprocal_lane_seeds = make_lane_seeds(fixed::reciprocal_seeds);

template <typename L>
class MantissaLanes {
    using R = typename L::Register;

public:
    // fixed::reciprocal_mantissa; m in the low halves, with zeros above.
    LKS_FORCE_INLINE static R reciprocal(R m) {
        const R index = L::template shift_right<28>(m);
        const R y0 = seed(L::lookup(reciprocal_lane_seeds.c0_c1[1], index),
                          L::lookup(reciprocal_lane_seeds.c2[1], index), m);
        const R e = L::template shift_right<4>(
            L::subtract(L::set(std::int64_t{1} << 47), L::multiply_unsigned(m, y0)));
        const R p = L::add_32(e, L::template shift_right<43>(L::multiply_signed(e, e)));
        const R y = L::add(L::template shift_left<43>(y0), L::multiply_signed(y0, p));
        return L::template shift_right<28>(L::add(y, L::set(std::int64_t{1} << 27)));
    }

    // fixed::reciprocal_sqrt_mantissa; the same.
    LKS_FORCE_INLINE static R reciprocal_sqrt(R m) {
        const R index = L::template shift_right<28>(m);
        const LaneSeeds& seeds = reciprocal_sqrt_lane_seeds;
        const R y0 =
            seed(L::select_by_sign_32(L::lookup(seeds.c0_c1[0], index), L::lookup(seeds.c0_c1[1], index), m),
                 L::select_by_sign_32(L::lookup(seeds.c2[0], index), L::lookup(seeds.c2[1], index), m), m);
        const R y0_squared = L::multiply_unsigned(y0, y0);
        const R e = L::template shift_right<20>(
            L::subtract(L::set(std::int64_t{1} << 62), L::multiply_unsigned(m, y0_squared)));
        const R e_squared = L::template shift_right<42>(L::multiply_signed(e, e));
        const R p = L::add_32(L::template shift_right_32_signed<1>(e),
                              L::template shift_right<3>(L::add(L::add(e_squared, e_squared), e_squared)));
        const R y = L::add(L::template shift_left<42>(y0), L::multiply_signed(y0, p));
        return L::template shift_right<27>(L::add(y, L::set(std::int64_t{1} << 26)));
    }

private:
    // fixed::seed; the same.
    LKS_FORCE_INLINE static R seed(R c0_c1, R c2, R m) {
        // In the high 16 bits of 32.
        const R t = L::exclusive_or(L::template shift_left<4>(m), L::set_32(INT32_MIN));
        const R slope = L::add_16(c0_c1, L::rounding_multiply_16(t, c2));
        const R correction = L::template shift_right_32<16>(L::rounding_multiply_16(t, slope));
        return L::bit_and(L::add_16(c0_c1, correction), L::set(0xffff));
    }
};

} // namespace
} // namespace lks
