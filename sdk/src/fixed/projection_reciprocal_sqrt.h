// 1/sqrt(m) for projections: made for 32-bit lanes, and as accurate as a projection can use.
//
// A seed from a cubic in one of eight segments, in 16-bit arithmetic (2^-15.4), and one Newton step:
//     y = y0 · (1 - e/2),  e = m·y0² - 1
// Every step is an instruction of 32-bit lanes: the segment's coefficients by a permute of eight entries,
// rounding_multiply (pmulhrsw, vqrdmulh), low halves of 32-bit products, and one 32×32→64 product whose high
// half is e. Worst relative error 2^-29.42, checked over all mantissas; the gain of a correction, to which it
// goes, has at most 30 bits. Where more is wanted there is fixed/reciprocal_sqrt.h.
//
// Functions have internal linkage, as kernels/distance_scalar.h says.
#pragma once

#include <bit>
#include <cstdint>

#include "fixed/reciprocal_sqrt.h"

namespace lks::fixed {

// y0 = c0 + t·(c1 + t·(c2 + t·c3)) / 8, t in [-1, 1) across the segment; c0 in Q0.16, the others in Q0.19.
struct CubicCoefficients {
    std::uint16_t c0[8];
    std::int16_t c1[8];
    std::int16_t c2[8];
    std::int16_t c3[8];
};

// Four segments of a quarter in [1, 2), then four in [2, 4). Rounded from the polynomial through the
// Chebyshev nodes and searched around it for the least worst error; the seed of m = 1 stays below one.
inline constexpr CubicCoefficients projection_coefficients{
    {61788, 55890, 51411, 47861, 43691, 39520, 36353, 33843},
    {-27465, -20323, -15818, -12763, -19418, -14371, -11186, -9024},
    {2308, 1389, 917, 642, 1631, 986, 651, 453},
    {-210, -105, -60, -36, -150, -75, -41, -26}};

// The same as two 32-bit words a segment: c0 below c1, and c2 below c3.
struct CubicSeeds {
    std::uint32_t c0_c1[8];
    std::uint32_t c2_c3[8];
};

namespace detail {

constexpr CubicSeeds seeds_of(const CubicCoefficients& c) {
    const auto word = [](std::int32_t low, std::int32_t high) {
        return static_cast<std::uint32_t>(low & 0xffff) | static_cast<std::uint32_t>(high) << 16;
    };
    CubicSeeds seeds{};
    for (int i = 0; i < 8; ++i) {
        seeds.c0_c1[i] = word(c.c0[i], c.c1[i]);
        seeds.c2_c3[i] = word(c.c2[i], c.c3[i]);
    }
    return seeds;
}

} // namespace detail

inline constexpr CubicSeeds projection_seeds = detail::seeds_of(projection_coefficients);

// m: Q2.30 in [1, 4), that is from 2^30 to 2^32 - 1. Returns 1/sqrt(m) as Q1.31, from 2^30 to 2^31 - 1.
static constexpr std::uint32_t projection_reciprocal_sqrt(std::uint32_t m) {
    const std::uint32_t octave = m >> 31;
    const std::uint32_t aligned = octave != 0 ? m : m << 1;
    const std::uint32_t segment = octave << 2 | ((aligned >> 29) & 3);
    const std::int32_t t = static_cast<std::int32_t>((aligned >> 13) & 0xffffu) - 0x8000;
    const CubicCoefficients& c = projection_coefficients;
    const std::int32_t quadratic = c.c2[segment] + rounding_multiply(t, c.c3[segment]);
    const std::int32_t slope = c.c1[segment] + rounding_multiply(t, quadratic);
    const auto y0 = static_cast<std::uint32_t>(c.c0[segment] + (rounding_multiply(t, slope) >> 3));
    // e in Q30, |e| < 2^15.7.
    const auto e = static_cast<std::int32_t>((std::uint64_t{m} * (y0 * y0)) >> 32) - (1 << 30);
    const std::int32_t step = static_cast<std::int32_t>(y0) * (e >> 1); // Q45, below 2^31
    return (y0 << 15) - static_cast<std::uint32_t>((step + (1 << 14)) >> 15);
}

// As reciprocal_length. u: a squared length, greater than zero.
static constexpr ReciprocalLength projection_reciprocal_length(std::uint64_t u) {
    const int shift = std::countl_zero(u) >> 1;
    const auto m = static_cast<std::uint32_t>((u << (2 * shift)) >> 32);
    return {projection_reciprocal_sqrt(m), shift};
}

} // namespace lks::fixed
