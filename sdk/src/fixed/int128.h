// 128-bit integers from two halves, for targets whose compiler has none. Every operation is exact; whatever
// cannot be (a quotient, a root, a narrowing) says how it rounds and what it does at the edge.
#pragma once

#include <type_traits>

#include "fixed/integer.h"

namespace lks::fixed {

struct UInt128 {
    std::uint64_t hi, lo;

    friend constexpr bool operator==(const UInt128&, const UInt128&) = default;
    friend constexpr bool operator<(const UInt128& a, const UInt128& b) {
        return a.hi != b.hi ? a.hi < b.hi : a.lo < b.lo;
    }
    friend constexpr bool operator>(const UInt128& a, const UInt128& b) { return b < a; }
    friend constexpr bool operator<=(const UInt128& a, const UInt128& b) { return !(b < a); }
    friend constexpr bool operator>=(const UInt128& a, const UInt128& b) { return !(a < b); }
};

// Two's complement: value = hi * 2^64 + lo.
struct Int128 {
    std::int64_t hi;
    std::uint64_t lo;

    friend constexpr bool operator==(const Int128&, const Int128&) = default;
    friend constexpr bool operator<(const Int128& a, const Int128& b) {
        return a.hi != b.hi ? a.hi < b.hi : a.lo < b.lo;
    }
    friend constexpr bool operator>(const Int128& a, const Int128& b) { return b < a; }
    friend constexpr bool operator<=(const Int128& a, const Int128& b) { return !(b < a); }
    friend constexpr bool operator>=(const Int128& a, const Int128& b) { return !(a < b); }
};

constexpr Int128 to_int128(std::int64_t a) {
    return {a >> 63, static_cast<std::uint64_t>(a)};
}
constexpr UInt128 as_unsigned(Int128 a) {
    return {static_cast<std::uint64_t>(a.hi), a.lo};
}
constexpr Int128 as_signed(UInt128 a) {
    return {static_cast<std::int64_t>(a.hi), a.lo};
}

// Sums and differences wrap modulo 2^128.
constexpr UInt128 operator+(UInt128 a, UInt128 b) {
    const std::uint64_t lo = a.lo + b.lo;
    return {a.hi + b.hi + (lo < a.lo ? 1u : 0u), lo};
}

constexpr UInt128 operator-(UInt128 a, UInt128 b) {
    return {a.hi - b.hi - (a.lo < b.lo ? 1u : 0u), a.lo - b.lo};
}

constexpr Int128 operator+(Int128 a, Int128 b) {
    return as_signed(as_unsigned(a) + as_unsigned(b));
}
constexpr Int128 operator-(Int128 a, Int128 b) {
    return as_signed(as_unsigned(a) - as_unsigned(b));
}
constexpr Int128 operator-(Int128 a) {
    return as_signed(UInt128{0, 0} - as_unsigned(a));
}
constexpr Int128 negate(Int128 a) {
    return -a;
}

// |a|; 2^127 for the most negative value.
constexpr UInt128 abs(Int128 a) {
    return a.hi < 0 ? as_unsigned(-a) : as_unsigned(a);
}

// Shifts by 0 to 127.
constexpr UInt128 operator<<(UInt128 a, int n) {
    if (n == 0)
        return a;
    if (n >= 64)
        return {a.lo << (n - 64), 0};
    return {(a.hi << n) | (a.lo >> (64 - n)), a.lo << n};
}

constexpr UInt128 operator>>(UInt128 a, int n) {
    if (n == 0)
        return a;
    if (n >= 64)
        return {0, a.hi >> (n - 64)};
    return {a.hi >> n, (a.lo >> n) | (a.hi << (64 - n))};
}

constexpr Int128 operator<<(Int128 a, int n) {
    return as_signed(as_unsigned(a) << n);
}

// Arithmetic: rounds towards minus infinity.
constexpr Int128 operator>>(Int128 a, int n) {
    if (n == 0)
        return a;
    if (n >= 64)
        return {a.hi >> 63, static_cast<std::uint64_t>(a.hi >> (n - 64))};
    return {a.hi >> n, (a.lo >> n) | (static_cast<std::uint64_t>(a.hi) << (64 - n))};
}

// 128 for zero.
constexpr int leading_zeros(UInt128 a) {
    return a.hi != 0 ? std::countl_zero(a.hi) : 64 + std::countl_zero(a.lo);
}

// Schoolbook on 32-bit halves. Neither sum overflows: each is at most (2^32 - 1)^2 + 2^32 - 1.
constexpr UInt128 multiply_halves(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t low_half = 0xffffffffu;
    const std::uint64_t a0 = a & low_half, a1 = a >> 32;
    const std::uint64_t b0 = b & low_half, b1 = b >> 32;
    const std::uint64_t low = a0 * b0;
    const std::uint64_t carried = a1 * b0 + (low >> 32);
    const std::uint64_t middle = a0 * b1 + (carried & low_half);
    return {a1 * b1 + (carried >> 32) + (middle >> 32), (middle << 32) | (low & low_half)};
}

// By the machine's own product where it has one (WebAssembly has a function of another library): the same in
// one instruction.
constexpr UInt128 multiply_unsigned(std::uint64_t a, std::uint64_t b) {
#if defined(__SIZEOF_INT128__) && !defined(__wasm__)
    __extension__ using Native = unsigned __int128;
    const Native product = static_cast<Native>(a) * b;
    return {static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
#else
    return multiply_halves(a, b);
#endif
}

// The same with upper halves that have the factors' signs.
constexpr Int128 multiply_signed_halves(std::int64_t a, std::int64_t b) {
    constexpr std::int64_t low_half = 0xffffffff;
    const std::int64_t a0 = a & low_half, a1 = a >> 32;
    const std::int64_t b0 = b & low_half, b1 = b >> 32;
    const std::uint64_t low = static_cast<std::uint64_t>(a0) * static_cast<std::uint64_t>(b0);
    const std::int64_t carried = a1 * b0 + static_cast<std::int64_t>(low >> 32);
    const std::int64_t middle = a0 * b1 + (carried & low_half);
    return {a1 * b1 + (carried >> 32) + (middle >> 32),
            (static_cast<std::uint64_t>(middle) << 32) | (low & static_cast<std::uint64_t>(low_half))};
}

constexpr Int128 multiply_signed(std::int64_t a, std::int64_t b) {
#if defined(__SIZEOF_INT128__) && !defined(__wasm__)
    __extension__ using Native = __int128;
    const Native product = static_cast<Native>(a) * b;
    return {static_cast<std::int64_t>(product >> 64), static_cast<std::uint64_t>(product)};
#else
    return multiply_signed_halves(a, b);
#endif
}

constexpr UInt128 multiply(std::uint64_t a, std::uint64_t b) {
    return multiply_unsigned(a, b);
}
constexpr Int128 multiply(std::int64_t a, std::int64_t b) {
    return multiply_signed(a, b);
}

// a / 2^n to the nearest, half up; 0 <= n <= 127.
constexpr Int128 shift_right_rounded(Int128 a, int n) {
    if (n == 0)
        return a;
    return (a >> n) + Int128{0, (a >> (n - 1)).lo & 1};
}

constexpr UInt128 shift_right_rounded(UInt128 a, int n) {
    if (n == 0)
        return a;
    return (a >> n) + UInt128{0, (a >> (n - 1)).lo & 1};
}

constexpr std::int64_t saturate_to_int64(Int128 a) {
    const std::int64_t low = static_cast<std::int64_t>(a.lo);
    if (a.hi == (low >> 63))
        return low;
    return a.hi < 0 ? INT64_MIN : INT64_MAX;
}

constexpr std::uint64_t saturate_to_uint64(UInt128 a) {
    return a.hi == 0 ? a.lo : UINT64_MAX;
}

struct Quotient64 {
    std::uint64_t quotient;
    std::uint64_t remainder;
};

// (hi * 2^64 + lo) / divisor where hi < divisor, so that the quotient fits: long division by two digits of 32
// bits (Knuth, volume 2, algorithm D). With the divisor normalised a digit's estimate is too large by at most
// two.
constexpr Quotient64 divide_by_digits(std::uint64_t hi, std::uint64_t lo, std::uint64_t divisor) {
    constexpr std::uint64_t base = std::uint64_t{1} << 32;
    constexpr std::uint64_t low_half = base - 1;
    const int shift = std::countl_zero(divisor);
    const UInt128 dividend = UInt128{hi, lo} << shift;
    const std::uint64_t d = divisor << shift;
    const std::uint64_t d1 = d >> 32, d0 = d & low_half;

    std::uint64_t rest = dividend.hi;
    std::uint64_t quotient = 0;
    for (int digit = 1; digit >= 0; --digit) {
        const std::uint64_t next = (dividend.lo >> (32 * digit)) & low_half;
        std::uint64_t estimate = rest / d1;
        std::uint64_t estimate_rest = rest % d1;
        while (estimate >= base || estimate * d0 > ((estimate_rest << 32) | next)) {
            --estimate;
            estimate_rest += d1;
            if (estimate_rest >= base)
                break;
        }
        rest = ((rest << 32) | next) - estimate * d;
        quotient = (quotient << 32) | estimate;
    }
    return {quotient, rest >> shift};
}

// The same. The instruction for it, which no compiler chooses by itself as it faults where the quotient does
// not fit, takes half of the time.
constexpr Quotient64 divide_narrow(std::uint64_t hi, std::uint64_t lo, std::uint64_t divisor) {
#if defined(__x86_64__) && defined(__GNUC__)
    if (!std::is_constant_evaluated()) {
        Quotient64 result{};
        __asm__("divq %[divisor]"
                : "=a"(result.quotient), "=d"(result.remainder)
                : "a"(lo), "d"(hi), [divisor] "rm"(divisor)
                : "cc");
        return result;
    }
#endif
    return divide_by_digits(hi, lo, divisor);
}

struct Quotient128 {
    UInt128 quotient;
    std::uint64_t remainder;
};

// Rounded down. Division by zero: all ones, remainder zero.
constexpr Quotient128 divide(UInt128 dividend, std::uint64_t divisor) {
    if (divisor == 0)
        return {{UINT64_MAX, UINT64_MAX}, 0};
    if (dividend.hi == 0)
        return {{0, dividend.lo / divisor}, dividend.lo % divisor};
    const std::uint64_t high = dividend.hi < divisor ? 0 : dividend.hi / divisor;
    const Quotient64 low = divide_narrow(dividend.hi - high * divisor, dividend.lo, divisor);
    return {{high, low.quotient}, low.remainder};
}

// Rounded down. Division by zero: all ones.
//
// A divisor of more than 64 bits: its top 64 bits give an estimate that is right or one too large; starting
// one below it keeps quotient * divisor within 128 bits.
constexpr UInt128 divide(UInt128 dividend, UInt128 divisor) {
    if (divisor.hi == 0)
        return divide(dividend, divisor.lo).quotient;
    const int shift = std::countl_zero(divisor.hi);
    const std::uint64_t top = (divisor << shift).hi;
    const UInt128 half = dividend >> 1;
    std::uint64_t quotient = divide_narrow(half.hi, half.lo, top).quotient >> (63 - shift);
    if (quotient != 0)
        --quotient;
    UInt128 product = multiply_unsigned(divisor.lo, quotient);
    product.hi += divisor.hi * quotient;
    if (dividend - product >= divisor)
        ++quotient;
    return {0, quotient};
}

// Floor of the square root of 32 bits, digit by digit.
constexpr std::uint32_t square_root(std::uint32_t a) {
    std::uint32_t root = 0;
    for (std::uint32_t bit = std::uint32_t{1} << 15; bit != 0; bit >>= 1) {
        const std::uint32_t trial = root | bit;
        if (trial * trial <= a)
            root = trial;
    }
    return root;
}

// Floor. The root of the top half gives the upper digits, one division by it the lower ones, at most one too
// large (Zimmermann, Karatsuba Square Root, INRIA RR-3805). The operand is normalised first: its top two bits
// not both zero.
constexpr std::uint32_t square_root(std::uint64_t a) {
    if (a == 0)
        return 0;
    const int shift = std::countl_zero(a) & ~1;
    const std::uint64_t n = a << shift;
    const std::uint32_t top = static_cast<std::uint32_t>(n >> 32);
    const std::uint32_t upper = square_root(top);
    const std::uint64_t rest = top - upper * upper;
    const std::uint64_t lower = ((rest << 16) | ((n >> 16) & 0xffffu)) / (2 * upper);
    std::uint64_t root = (std::uint64_t{upper} << 16) + lower;
    // A lower digit of 2^16 may carry the root to 2^32, whose square does not fit: it is too large in any
    // case.
    if (root > 0xffffffffu || root * root > n)
        --root;
    return static_cast<std::uint32_t>(root >> (shift / 2));
}

// Floor; the same step once more.
constexpr std::uint64_t square_root(UInt128 a) {
    if (a.hi == 0)
        return square_root(a.lo);
    const int shift = leading_zeros(a) & ~1;
    const UInt128 n = a << shift;
    const std::uint64_t upper = square_root(n.hi);
    const std::uint64_t rest = n.hi - upper * upper; // at most 2 * upper: 33 bits
    // (rest * 2^32 + next digit) / (2 * upper) with both halved, for rest * 2^32 may have 65 bits.
    const std::uint64_t lower = ((rest << 31) | ((n.lo >> 32) >> 1)) / upper;
    std::uint64_t root =
        lower >= (std::uint64_t{1} << 32) ? (upper << 32) + 0xffffffffu : (upper << 32) + lower;
    if (multiply_unsigned(root, root) > n)
        --root;
    return root >> (shift / 2);
}

// a * b / 2^n to the nearest, half up, saturating; 0 <= n <= 127.
constexpr std::int64_t multiply_shift_halves(std::int64_t a, std::int64_t b, int n) {
    return saturate_to_int64(shift_right_rounded(multiply_signed(a, b), n));
}

// The same: with the machine's 128 bits it takes half the instructions.
constexpr std::int64_t multiply_shift(std::int64_t a, std::int64_t b, int n) {
#if defined(__SIZEOF_INT128__) && !defined(__wasm__)
    __extension__ using Native = __int128;
    const Native product = Native{a} * b;
    const Native shifted = n == 0 ? product : ((product >> (n - 1)) + 1) >> 1;
    const auto low = static_cast<std::int64_t>(shifted);
    return shifted == low ? low : shifted < 0 ? INT64_MIN : INT64_MAX;
#else
    return multiply_shift_halves(a, b, n);
#endif
}

// (a * x + b * y + c * z) / 2^30 to the nearest, half up; wraps. The magnitudes of a, b and c sum to less
// than 2^31. Exact before the rounding: each product is split at bit 32 of the long factor, and the upper
// part times 2^32 is a whole number of units.
constexpr std::int64_t dot_shift_30_halves(std::int32_t a, std::int32_t b, std::int32_t c, std::int64_t x,
                                           std::int64_t y, std::int64_t z) {
    const std::int64_t upper = a * (x >> 32) + b * (y >> 32) + c * (z >> 32);
    const std::int64_t lower = a * static_cast<std::int64_t>(x & 0xffffffff) +
                               b * static_cast<std::int64_t>(y & 0xffffffff) +
                               c * static_cast<std::int64_t>(z & 0xffffffff);
    return wrapping_add(wrapping_multiply(upper, 4), shift_right_rounded(lower, 30));
}

// The same: with the machine's 128 bits it takes half the instructions.
constexpr std::int64_t dot_shift_30(std::int32_t a, std::int32_t b, std::int32_t c, std::int64_t x,
                                    std::int64_t y, std::int64_t z) {
#if defined(__SIZEOF_INT128__) && !defined(__wasm__)
    __extension__ using Native = __int128;
    const Native sum = Native{a} * x + Native{b} * y + Native{c} * z + (Native{1} << 29);
    return static_cast<std::int64_t>(sum >> 30);
#else
    return dot_shift_30_halves(a, b, c, x, y, z);
#endif
}

// a * b / 2^32, rounded down; wraps.
constexpr std::int64_t multiply_shift_32_halves(std::int64_t a, std::int64_t b) {
    const auto low = [](std::int64_t v) { return static_cast<std::uint64_t>(v) & 0xffffffffu; };
    const auto high = [](std::int64_t v) { return static_cast<std::uint64_t>(v >> 32); };
    return static_cast<std::int64_t>(((high(a) * high(b)) << 32) + high(a) * low(b) + low(a) * high(b) +
                                     ((low(a) * low(b)) >> 32));
}

constexpr std::int64_t multiply_shift_32(std::int64_t a, std::int64_t b) {
#if defined(__SIZEOF_INT128__) && !defined(__wasm__)
    return static_cast<std::int64_t>((multiply_signed(a, b) >> 32).lo);
#else
    return multiply_shift_32_halves(a, b);
#endif
}

// a * b / d to the nearest, ties away from zero, saturating. d = 0 saturates with the sign of the product; 0
// / 0 is 0.
constexpr std::int64_t multiply_divide(std::int64_t a, std::int64_t b, std::int64_t d) {
    const UInt128 product = multiply_unsigned(magnitude(a), magnitude(b));
    if (product == UInt128{0, 0})
        return 0;
    const bool negative = ((a ^ b) ^ d) < 0;
    const std::uint64_t divisor = magnitude(d);
    const Quotient128 q = divide(product, divisor);
    if (q.quotient.hi != 0)
        return negative ? INT64_MIN : INT64_MAX;
    const bool up = divisor != 0 && q.remainder >= divisor - q.remainder;
    if (up && q.quotient.lo == UINT64_MAX)
        return negative ? INT64_MIN : INT64_MAX;
    return with_sign(q.quotient.lo + (up ? 1u : 0u), negative);
}

} // namespace lks::fixed
