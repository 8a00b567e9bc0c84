// Of 40 fraction bits, with reciprocals of 62: where masses are uneven (rigid/uneven_tree.h), and of what
// closes loops (rigid/closures.h).
#pragma once

#include <bit>

#include "fixed/product_sum.h"
#include "rigid/articulation_algebra.h"
#include "rigid/uneven_tree_parts.h"

namespace lks::tree_detail {

inline constexpr int fine_fraction_bits = 40;

// One factor of 40 fraction bits, the other and the result in any format; wraps.
inline std::int64_t multiply_40(std::int64_t a, std::int64_t b) {
    fixed::ProductSum product;
    product.add(a, b);
    return product.shifted(fine_fraction_bits);
}

inline fixed::Vec3 multiply_40(std::int64_t a, const fixed::Vec3& v) {
    return {multiply_40(a, v.x), multiply_40(a, v.y), multiply_40(a, v.z)};
}

inline std::int64_t dot_40(const fixed::Vec3& a, const fixed::Vec3& b) {
    return plus(plus(multiply_40(a.x, b.x), multiply_40(a.y, b.y)), multiply_40(a.z, b.z));
}

// What is no more than roundings lets nothing be pushed.
inline FineInverse invert_fine(std::int64_t pivot) {
    constexpr std::int64_t least = 1 << 5;
    if (pivot < least) {
        return {0, 0};
    }
    // pivot = m / 2^zeros with m from 2^62 on; the reciprocal is 2^124 / m.
    const int zeros = std::countl_zero(static_cast<std::uint64_t>(pivot)) - 1;
    const auto m = static_cast<std::uint64_t>(pivot) << zeros;
    const auto reciprocal =
        static_cast<std::int64_t>(fixed::divide(fixed::UInt128{std::uint64_t{1} << 60, 0}, m).quotient.lo);
    return {reciprocal, 124 - fine_fraction_bits - zeros};
}

// To the nearest; saturates.
inline std::int64_t divide(std::int64_t value, const FineInverse& inverse) {
    return fixed::multiply_shift(value, inverse.mantissa, inverse.shift);
}

// Of a body without what its joints carry.
inline ArticulatedInverse own_fine_inverse(const Body& body, std::int64_t share) {
    ArticulatedInverse inverse{};
    inverse.shift[0] = inverse.shift[3] = inverse.shift[5] = share;
    const SymmetricMatrix& m = body.world_inverse;
    const std::int32_t entries[6] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
    for (int i = 0; i < 6; ++i) {
        inverse.turn[i] = fixed::multiply_shift(share, entries[i], 30 - body.inverse_shift);
    }
    return inverse;
}

} // namespace lks::tree_detail
