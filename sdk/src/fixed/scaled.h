// Scaled: a non-negative software number of 64 bits with its own exponent, for what is computed once: masses,
// compliances, coefficients. In a tick only where a rope bears a body, by particle (rigid/rope_loads.h).
//
// value = mantissa * 2^exponent; the mantissa is zero (and then so is the exponent) or has its top bit set.
//
// Every operation returns the exact result rounded to the nearest 64-bit mantissa, half up: relative error at
// most 2^-64. Exponents saturate at ±exponent_limit: above it a result becomes the largest number, below it
// zero. Numbers that come from doubles are thousands of multiplications away from either.
#pragma once

#include "fixed/int128.h"

namespace lks::fixed {

struct Scaled {
    std::uint64_t mantissa = 0;
    std::int32_t exponent = 0;

    static constexpr std::int32_t exponent_limit = 1 << 28;

    static constexpr Scaled from_u64(std::uint64_t value) { return rounded({value, 0}, -64); }
    static constexpr Scaled from_fixed(std::uint64_t raw, int fraction_bits) {
        return rounded({raw, 0}, -64 - std::int64_t{fraction_bits});
    }
    static constexpr Scaled from_u128(UInt128 raw, int fraction_bits) {
        return rounded(raw, -std::int64_t{fraction_bits});
    }
    // n / d; d = 0 gives the largest number, 0 / 0 zero.
    static constexpr Scaled ratio(std::uint64_t n, std::uint64_t d);
    // The bits of a finite, non-negative IEEE 754 binary64; exact, subnormals too. The sign bit is ignored.
    static constexpr Scaled from_double_bits(std::uint64_t bits);
    static constexpr Scaled largest() { return {UINT64_MAX, exponent_limit}; }

    constexpr bool is_zero() const { return mantissa == 0; }

    // Floor of the logarithm to base 2; INT32_MIN for zero.
    constexpr std::int32_t log2_floor() const { return is_zero() ? INT32_MIN : exponent + 63; }

    // value * 2^power, exactly.
    constexpr Scaled times_power_of_two(int power) const {
        return rounded({mantissa, 0}, std::int64_t{exponent} + power - 64);
    }

    // To the nearest unit, half up; saturates at UINT64_MAX.
    constexpr std::uint64_t to_fixed(int fraction_bits) const {
        const std::int64_t shift = std::int64_t{exponent} + fraction_bits;
        if (is_zero() || shift < -64)
            return 0;
        if (shift > 0)
            return UINT64_MAX;
        if (shift == -64)
            return 1; // the top bit is worth a half, and halves go up
        return shift_right_rounded(mantissa, static_cast<int>(-shift));
    }

    // The same; saturates at INT64_MAX.
    constexpr std::int64_t to_i64_fixed(int fraction_bits) const {
        return with_sign(to_fixed(fraction_bits), false);
    }

    // value = m * 2^exponent, rounded.
    static constexpr Scaled rounded(UInt128 m, std::int64_t exponent) {
        if (m == UInt128{0, 0})
            return {};
        const int shift = leading_zeros(m);
        const UInt128 n = m << shift;
        std::uint64_t top = n.hi + (n.lo >> 63);
        std::int64_t power = exponent + 64 - shift;
        if (top < n.hi) { // rounded up to 2^64
            top = std::uint64_t{1} << 63;
            ++power;
        }
        if (power > exponent_limit)
            return largest();
        if (power < -exponent_limit)
            return {};
        return {top, static_cast<std::int32_t>(power)};
    }

    friend constexpr bool operator==(const Scaled&, const Scaled&) = default;
};

// -1, 0 or 1.
constexpr int compare(Scaled a, Scaled b) {
    if (a.is_zero() || b.is_zero())
        return (b.is_zero() ? 0 : -1) + (a.is_zero() ? 0 : 1);
    if (a.exponent != b.exponent)
        return a.exponent < b.exponent ? -1 : 1;
    if (a.mantissa != b.mantissa)
        return a.mantissa < b.mantissa ? -1 : 1;
    return 0;
}

constexpr bool operator<(Scaled a, Scaled b) {
    return compare(a, b) < 0;
}
constexpr bool operator>(Scaled a, Scaled b) {
    return compare(a, b) > 0;
}
constexpr bool operator<=(Scaled a, Scaled b) {
    return compare(a, b) <= 0;
}
constexpr bool operator>=(Scaled a, Scaled b) {
    return compare(a, b) >= 0;
}

constexpr Scaled operator*(Scaled a, Scaled b) {
    return Scaled::rounded(multiply_unsigned(a.mantissa, b.mantissa), std::int64_t{a.exponent} + b.exponent);
}

// The larger one stands in the upper half of 127 bits. What the shift cuts off the smaller one cannot change
// a rounding half up, whose decision needs no bit below the half.
constexpr Scaled operator+(Scaled a, Scaled b) {
    const Scaled large = a < b ? b : a;
    const Scaled small = a < b ? a : b;
    if (small.is_zero())
        return large;
    const std::int64_t distance = std::int64_t{large.exponent} - small.exponent;
    UInt128 sum = UInt128{large.mantissa, 0} >> 1;
    if (distance < 127)
        sum = sum + ((UInt128{small.mantissa, 0} >> 1) >> static_cast<int>(distance));
    return Scaled::rounded(sum, std::int64_t{large.exponent} - 63);
}

// a - b, or zero where b is not less than a. One unit is borrowed for what the shift cuts off b, so that the
// difference, too, is rounded down before it is rounded half up.
constexpr Scaled subtract_or_zero(Scaled a, Scaled b) {
    if (a <= b)
        return {};
    if (b.is_zero())
        return a;
    const std::int64_t distance = std::int64_t{a.exponent} - b.exponent;
    UInt128 taken{0, 1};
    if (distance < 127) {
        const UInt128 whole = UInt128{b.mantissa, 0};
        const int shift = static_cast<int>(distance);
        taken = whole >> shift;
        if ((taken << shift) != whole)
            taken = taken + UInt128{0, 1};
    }
    return Scaled::rounded(UInt128{a.mantissa, 0} - taken, std::int64_t{a.exponent} - 64);
}

// Division by zero gives the largest number, 0 / 0 zero.
constexpr Scaled operator/(Scaled a, Scaled b) {
    if (a.is_zero())
        return {};
    if (b.is_zero())
        return Scaled::largest();
    // The quotient of the mantissas lies in (1/2, 2); the shift makes its integer part exactly 64 bits long.
    const int shift = a.mantissa >= b.mantissa ? 63 : 64;
    const Quotient128 q = divide(UInt128{0, a.mantissa} << shift, b.mantissa);
    const bool up = q.remainder >= b.mantissa - q.remainder;
    return Scaled::rounded(q.quotient + UInt128{0, up ? 1u : 0u},
                           std::int64_t{a.exponent} - b.exponent - shift);
}

constexpr Scaled square_root(Scaled a) {
    if (a.is_zero())
        return {};
    const int shift = (a.exponent & 1) != 0 ? 63 : 64; // makes the remaining exponent even
    const UInt128 n = UInt128{0, a.mantissa} << shift;
    const std::uint64_t root = square_root(n);
    const bool up = n - multiply_unsigned(root, root) > UInt128{0, root};
    return Scaled::rounded(UInt128{0, root} + UInt128{0, up ? 1u : 0u},
                           (std::int64_t{a.exponent} - shift) / 2);
}

constexpr Scaled Scaled::ratio(std::uint64_t n, std::uint64_t d) {
    return from_u64(n) / from_u64(d);
}

constexpr Scaled Scaled::from_double_bits(std::uint64_t bits) {
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const std::int32_t biased = static_cast<std::int32_t>((bits >> 52) & 0x7ff);
    if (biased == 0)
        return rounded({0, fraction}, -1074);
    return rounded({0, fraction | (std::uint64_t{1} << 52)}, std::int64_t{biased} - 1075);
}

} // namespace lks::fixed
