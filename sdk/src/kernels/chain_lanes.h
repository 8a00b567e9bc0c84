// The geometry of a rope's segments over lanes: kernels/chain_scalar.cpp, which measures groups in which a
// segment is not from 0.2 µm to 16 m long, or ends within rounding of a power of two.
#pragma once

#include "fixed/reciprocal_sqrt.h"
#include "kernels/chain_scalar.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

// fixed::reciprocal_sqrt_seeds as 32-bit lanes take them: entries 0 .. 7 and 8 .. 15.
struct ChainSeeds {
    std::uint32_t c0_c1[2][8]; // c0 low
    std::uint32_t c2[2][8];    // high
};

constexpr ChainSeeds make_chain_seeds() {
    ChainSeeds seeds{};
    for (int i = 0; i < 16; ++i) {
        const fixed::SeedSegment& segment = fixed::reciprocal_sqrt_seeds.segment[i];
        seeds.c0_c1[i / 8][i % 8] =
            segment.c0 | (std::uint32_t{static_cast<std::uint16_t>(segment.c1)} << 16);
        seeds.c2[i / 8][i % 8] = std::uint32_t{static_cast<std::uint16_t>(segment.c2)} << 16;
    }
    return seeds;
}

constexpr ChainSeeds chain_seeds = make_chain_seeds();

template <typename L>
class ChainLanes {
    using R = typename L::Register;

public:
    // Segments first .. first + L::half − 1. False: one has to be measured in plain integers, and nothing was
    // written.
    LKS_FORCE_INLINE static bool measure(ChainSegments& segments, std::uint32_t first) {
        R d[3];
        R size = L::set(0); // in the high halves
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t* const x = segments.points[axis] + first;
            d[axis] = L::subtract(L::load(x + 1), L::load(x));
            size = L::bit_or(size, L::exclusive_or(d[axis], L::template shift_right_32_signed<31>(d[axis])));
        }
        // The high half from 1 to 2^28 − 1.
        R outside = L::bit_and(L::add_32(size, L::set_32(-1)),
                               L::set(static_cast<std::int64_t>(std::uint64_t{0xf0000000} << 32)));
        const R shift = L::subtract(L::set(33), L::template shift_right<32>(L::leading_zeros_32(size)));
        const R half = L::shift_left_each(L::set(1), L::subtract(shift, L::set(1)));
        R squared = L::set(0);
        for (R& v : d) {
            v = L::shift_right_each(L::add(v, half), shift);
            // 2^31 would be read as −2^31; so would 2^31 of y.
            outside = L::bit_or(outside, L::equal_32(L::template shift_left<32>(v), L::set(INT64_MIN)));
            squared = L::add(squared, L::multiply_signed(v, v));
        }
        // 1 where the upper two bits are clear, or else 0.
        const R up = L::bit_and(L::equal(L::template shift_right<62>(squared), L::set(0)), L::set(1));
        const R m = L::shift_left_each(squared, L::add(up, up));
        const R y = reciprocal_sqrt(L::template shift_right<32>(m));
        outside = L::bit_or(outside, L::bit_and(L::template shift_left<32>(y), L::set(INT64_MIN)));
        if (L::any(L::bit_and(outside, L::set(high_halves)))) {
            return false;
        }
        const R down = L::subtract(L::set(32), up);
        const R direction_half = L::shift_left_each(L::set(1), L::subtract(L::set(31), up));
        for (int axis = 0; axis < 3; ++axis) {
            L::store(segments.directions[axis] + first,
                     L::shift_right_each(L::add(L::multiply_signed(d[axis], y), direction_half), down));
        }
        // m·y / 2^32
        const R root = L::add(L::multiply_unsigned(L::template shift_right<32>(m), y),
                              L::template shift_right<32>(L::multiply_unsigned(m, y)));
        const R length_shift = L::subtract(L::add(L::set(30), up), shift);
        const R length_half = L::shift_left_each(L::set(1), L::subtract(length_shift, L::set(1)));
        L::store(segments.lengths + first, L::shift_right_each(L::add(root, length_half), length_shift));
        return true;
    }

    // False: one of them is folded back, and nothing was written.
    LKS_FORCE_INLINE static bool turn(ChainSegments& segments, std::uint32_t first) {
        R squared = L::set(0);
        for (const auto& axis : segments.directions) {
            const R difference = L::subtract(L::load(axis + first), L::load(axis + first + 1));
            squared = L::add(squared, L::multiply_signed(difference, difference));
        }
        const R versine = L::template shift_right<1>(squared);
        // A difference of 2^31 + 1, as rounding makes it, is read as one of 2^31 − 1: nearly two even so.
        const R two = L::set((std::int64_t{2} << cosine_fraction_bits) - (std::int64_t{1} << 32));
        if (L::any(L::bit_and(L::subtract(two, versine), L::set(INT64_MIN)))) {
            return false;
        }
        L::store(segments.versines + first, versine);
        return true;
    }

private:
    static constexpr std::int64_t high_halves = -(std::int64_t{1} << 32);

    // fixed::reciprocal_sqrt_mantissa; m in the low halves, with zeros above.
    LKS_FORCE_INLINE static R reciprocal_sqrt(R m) {
        const R index = L::template shift_right<28>(m);
        const R c0_c1 = L::select_by_sign_32(L::lookup(chain_seeds.c0_c1[0], index),
                                             L::lookup(chain_seeds.c0_c1[1], index), m);
        const R c2 =
            L::select_by_sign_32(L::lookup(chain_seeds.c2[0], index), L::lookup(chain_seeds.c2[1], index), m);
        // In the high 16 bits of 32.
        const R t = L::exclusive_or(L::template shift_left<4>(m), L::set_32(INT32_MIN));
        const R slope = L::add_16(c0_c1, L::rounding_multiply_16(t, c2));
        const R correction = L::template shift_right_32<16>(L::rounding_multiply_16(t, slope));
        const R y0 = L::bit_and(L::add_16(c0_c1, correction), L::set(0xffff));
        const R y0_squared = L::multiply_unsigned(y0, y0);
        const R e = L::template shift_right<20>(
            L::subtract(L::set(std::int64_t{1} << 62), L::multiply_unsigned(m, y0_squared)));
        const R e_squared = L::template shift_right<42>(L::multiply_signed(e, e));
        const R p = L::add_32(L::template shift_right_32_signed<1>(e),
                              L::template shift_right<3>(L::add(L::add(e_squared, e_squared), e_squared)));
        const R y = L::add(L::template shift_left<42>(y0), L::multiply_signed(y0, p));
        return L::template shift_right<27>(L::add(y, L::set(std::int64_t{1} << 26)));
    }
};

template <typename L>
inline void measure_chain_lanes(ChainSegments& segments) {
    const std::uint32_t count = segments.count;
    if (count < L::half) {
        measure_chain_scalar(segments);
        return;
    }
    // The last group begins early enough to be whole.
    for (std::uint32_t i = 0; i < count; i += L::half) {
        const std::uint32_t first = i < count - L::half ? i : count - L::half;
        if (!ChainLanes<L>::measure(segments, first)) {
            measure_segments_scalar(segments, first, L::half);
        }
    }
    for (std::uint32_t i = 0; i < count; i += L::half) {
        const std::uint32_t first = i < count - L::half ? i : count - L::half;
        if (!ChainLanes<L>::turn(segments, first)) {
            measure_turns_scalar(segments, first, L::half);
        }
    }
}

} // namespace
} // namespace lks
