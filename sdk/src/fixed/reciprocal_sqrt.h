// 1/sqrt(m) and 1/m of 32-bit mantissas: the heart of every projection.
//
// Both take a seed from a quadratic in one of a few segments, chosen by the top four bits of m, in 16-bit
// arithmetic, and refine it by one third-order step (Householder; the series of (1 - e)^-1/2 and (1 - e)^-1)
// in three 32x32->64 multiplications. Each operation exists for 32-bit lanes on AVX2 and NEON: segment
// coefficients by an in-register permute, rounding_multiply as pmulhrsw / vqrdmulh, and right shifts of
// 64-bit lanes that are logical, or arithmetic ones of which only the low half is kept, where both agree.
//
// Worst relative errors, checked over all mantissas:
//     reciprocal_sqrt_mantissa   2^-30.99    seed 2^-12.9
//     reciprocal_mantissa        2^-30.99    seed 2^-13.8
//     reciprocal_length          2^-30.4     m is cut to 32 bits; by samples and around all powers of two
// The limit is 2^-31: half a unit of a result near one half.
#pragma once

#include "fixed/int128.h"

namespace lks::fixed {

// y = c0 + t * (c1 + t * c2), t in [-1, 1) across the segment; y and c in Q0.16, t in Q1.15.
struct SeedSegment {
    std::uint16_t c0;
    std::int16_t c1;
    std::int16_t c2;
};

namespace detail {

// The quadratic through f at the Chebyshev nodes t = -sqrt(3)/2, 0, sqrt(3)/2; f in Q32. Its error, c3 *
// (4t^3 - 3t) with c3 < 0 for both functions, lies below f at t = -1, so that the seed of m = 1 stays below
// one.
constexpr SeedSegment seed_through(std::int64_t below, std::int64_t middle, std::int64_t above) {
    // 1/sqrt(3) in Q32: (above - below) / (2 * sqrt(3)/2).
    constexpr std::int64_t inverse_root3 = 2479700525;
    const std::int64_t c1 = ((above - below) >> 8) * (inverse_root3 >> 8) >> 16;
    const std::int64_t c2 = ((above + below) / 2 - middle) * 4 / 3;
    return {static_cast<std::uint16_t>(shift_right_rounded(middle, 16)),
            static_cast<std::int16_t>(shift_right_rounded(c1, 16)),
            static_cast<std::int16_t>(shift_right_rounded(c2, 16))};
}

// sqrt(3)/2 of half a segment's width, for widths 1/4 and 1/8, in Q32.
inline constexpr std::int64_t node_offset_quarter = 464943848;
inline constexpr std::int64_t node_offset_eighth = 232471924;

// m in Q32 from 1 to 4; sqrt(2^96 / m) = 2^32 / sqrt(m / 2^32).
constexpr std::int64_t exact_reciprocal_sqrt(std::int64_t m) {
    const UInt128 one{std::uint64_t{1} << 32, 0};
    return static_cast<std::int64_t>(square_root(divide(one, static_cast<std::uint64_t>(m)).quotient));
}

constexpr std::int64_t exact_reciprocal(std::int64_t m) {
    return static_cast<std::int64_t>(divide(UInt128{1, 0}, static_cast<std::uint64_t>(m)).quotient.lo);
}

struct SeedTable {
    SeedSegment segment[16];
};

// Segment s is m in [s, s + 1) / 4, s from 4.
constexpr SeedTable make_reciprocal_sqrt_seeds() {
    SeedTable table{};
    for (int s = 4; s < 16; ++s) {
        const std::int64_t centre = (std::int64_t{2 * s + 1} << 32) / 8;
        table.segment[s] =
            seed_through(exact_reciprocal_sqrt(centre - node_offset_quarter), exact_reciprocal_sqrt(centre),
                         exact_reciprocal_sqrt(centre + node_offset_quarter));
    }
    return table;
}

// Segment s is m in [s, s + 1) / 8, s from 8.
constexpr SeedTable make_reciprocal_seeds() {
    SeedTable table{};
    for (int s = 8; s < 16; ++s) {
        const std::int64_t centre = (std::int64_t{2 * s + 1} << 32) / 16;
        table.segment[s] =
            seed_through(exact_reciprocal(centre - node_offset_eighth), exact_reciprocal(centre),
                         exact_reciprocal(centre + node_offset_eighth));
    }
    return table;
}

} // namespace detail

// Indexed by m >> 28; the first four (eight) entries are never used.
inline constexpr detail::SeedTable reciprocal_sqrt_seeds = detail::make_reciprocal_sqrt_seeds();
inline constexpr detail::SeedTable reciprocal_seeds = detail::make_reciprocal_seeds();

// (a * b + 2^14) >> 15, what pmulhrsw does to 16-bit lanes.
static constexpr std::int32_t rounding_multiply(std::int32_t a, std::int32_t b) {
    return (a * b + 0x4000) >> 15;
}

// Q0.16, in (0.5, 1). The position in the segment is the 16 bits below the four that choose it.
constexpr std::uint32_t seed(const detail::SeedTable& table, std::uint32_t m) {
    const SeedSegment c = table.segment[m >> 28];
    const std::int32_t t = static_cast<std::int32_t>((m >> 12) & 0xffffu) - 0x8000;
    return static_cast<std::uint32_t>(c.c0 + rounding_multiply(t, c.c1 + rounding_multiply(t, c.c2)));
}

// m: Q2.30 in [1, 4), that is from 2^30 to 2^32 - 1. Returns 1/sqrt(m) as Q1.31, from 2^30 to 2^31.
constexpr std::uint32_t reciprocal_sqrt_mantissa(std::uint32_t m) {
    const std::uint32_t y0 = seed(reciprocal_sqrt_seeds, m);
    const std::uint32_t y0_squared = y0 * y0; // Q0.32
    // e = 1 - m * y0^2 in Q62, exact; then Q42, in which |e| < 2^-11 fits 32 bits.
    const std::uint64_t e62 = (std::uint64_t{1} << 62) - std::uint64_t{m} * y0_squared;
    const std::int32_t e = static_cast<std::int32_t>(static_cast<std::uint32_t>(e62 >> 20));
    // y = y0 * (1 + e/2 + 3/8 e^2), the series' next term being 5/16 e^3 < 2^-36.
    const std::int32_t e_squared = static_cast<std::int32_t>((std::int64_t{e} * e) >> 42);
    const std::int32_t p = (e >> 1) + ((3 * e_squared) >> 3);
    const std::int64_t y = (std::int64_t{y0} << 42) + std::int64_t{static_cast<std::int32_t>(y0)} * p; // Q58
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(y + (1 << 26)) >> 27);
}

// m: Q1.31 in [1, 2), that is from 2^31 to 2^32 - 1. Returns 1/m as Q1.31, from 2^30 to 2^31.
constexpr std::uint32_t reciprocal_mantissa(std::uint32_t m) {
    const std::uint32_t y0 = seed(reciprocal_seeds, m);
    // e = 1 - m * y0 in Q47, exact; then Q43.
    const std::uint64_t e47 = (std::uint64_t{1} << 47) - std::uint64_t{m} * y0;
    const std::int32_t e = static_cast<std::int32_t>(static_cast<std::uint32_t>(e47 >> 4));
    // y = y0 * (1 + e + e^2), the next term being e^3 < 2^-38.
    const std::int32_t e_squared = static_cast<std::int32_t>((std::int64_t{e} * e) >> 43);
    const std::int32_t p = e + e_squared;
    const std::int64_t y = (std::int64_t{y0} << 43) + std::int64_t{static_cast<std::int32_t>(y0)} * p; // Q59
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(y + (1 << 27)) >> 28);
}

// 1/sqrt(u) = mantissa * 2^(shift - 62). u << (2 * shift) has its top bit or the one below it set.
struct ReciprocalLength {
    std::uint32_t mantissa; // Q1.31, in (0.5, 1]
    std::int32_t shift;     // 0 to 31
};

// u: a squared length, greater than zero.
constexpr ReciprocalLength reciprocal_length(std::uint64_t u) {
    const int shift = std::countl_zero(u) >> 1;
    const std::uint32_t m = static_cast<std::uint32_t>((u << (2 * shift)) >> 32);
    return {reciprocal_sqrt_mantissa(m), shift};
}

} // namespace lks::fixed
