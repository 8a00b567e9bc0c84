// The rotation between two given ones, so fine that what it turns is rounded once.
//
// Not by quaternions of length one, whose rounding would come twice into each entry: R(q)·v = q·v·q* / |q|²
// for q of any length, and the product of two rotations in Q2.30 is exact.
#pragma once

#include "fixed/rotation.h"

namespace lks::fixed {

// Q2.62, from below.
inline constexpr int turn_matrix_bits = 62;

struct TurnMatrix {
    std::int64_t m[3][3]; // m[row][column]
};

// A row times a vector of any components, exact: turn_matrix_bits more fraction bits than the vector's.
constexpr Int128 turn_row(const TurnMatrix& a, int row, Vec3 v) {
    return multiply_signed(a.m[row][0], v.x) + multiply_signed(a.m[row][1], v.y) +
           multiply_signed(a.m[row][2], v.z);
}

// To the nearest, half up, saturating.
constexpr std::int64_t round_turned(Int128 sum) {
    return saturate_to_int64(shift_right_rounded(sum, turn_matrix_bits));
}

struct TurnBetween {
    bool turns; // false: both are the same rotation
    TurnMatrix matrix;
};

// What takes `from` to `to`, both nearly unit. Each entry is within 0.76 units of 2^-62 of the exact one, and
// exact where that is -1, 0 or 1.
constexpr TurnBetween turn_between(Rotation from, Rotation to) {
    const auto product = [](std::int32_t a, std::int32_t b) { return std::int64_t{a} * b; };
    // to ⊗ from*, Q60.
    const std::int64_t x =
        product(to.x, from.w) - product(to.w, from.x) - product(to.y, from.z) + product(to.z, from.y);
    const std::int64_t y =
        product(to.y, from.w) - product(to.w, from.y) - product(to.z, from.x) + product(to.x, from.z);
    const std::int64_t z =
        product(to.z, from.w) - product(to.w, from.z) - product(to.x, from.y) + product(to.y, from.x);
    const std::int64_t w =
        product(to.w, from.w) + product(to.x, from.x) + product(to.y, from.y) + product(to.z, from.z);
    const Int128 xx = multiply_signed(x, x), yy = multiply_signed(y, y), zz = multiply_signed(z, z);
    const Int128 ww = multiply_signed(w, w);
    const Int128 xy = multiply_signed(x, y), yz = multiply_signed(y, z), zx = multiply_signed(z, x);
    const Int128 wx = multiply_signed(w, x), wy = multiply_signed(w, y), wz = multiply_signed(w, z);
    // |q|² is within 4e-4 of 2^120: so shifted it has 63 bits or 64.
    constexpr int shift = 57;
    const std::uint64_t square = shift_right_rounded(as_unsigned(xx + yy + zz + ww), shift).lo;
    const auto entry = [square](Int128 numerator) {
        const UInt128 scaled = abs(numerator) << (turn_matrix_bits - shift);
        const UInt128 quotient = divide(scaled + UInt128{0, square / 2}, square).quotient;
        return with_sign(quotient.lo, numerator.hi < 0);
    };
    return {x != 0 || y != 0 || z != 0,
            {{{entry(ww + xx - yy - zz), entry((xy - wz) << 1), entry((zx + wy) << 1)},
              {entry((xy + wz) << 1), entry(ww + yy - zz - xx), entry((yz - wx) << 1)},
              {entry((zx - wy) << 1), entry((yz + wx) << 1), entry(ww + zz - xx - yy)}}}};
}

} // namespace lks::fixed
