// What plain 64-bit integers have to do without undefined behaviour at any input.
//
// Internal linkage: kernels use these, too, and each file of them compiles its own copy, for its own
// instruction set.
#pragma once

#include <bit>
#include <cstdint>

namespace lks::fixed {

// Modulo 2^64, through unsigned: signed overflow would be undefined.
static constexpr std::int64_t wrapping_add(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

static constexpr std::int64_t wrapping_subtract(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

static constexpr std::int64_t wrapping_negate(std::int64_t a) {
    return static_cast<std::int64_t>(0 - static_cast<std::uint64_t>(a));
}

static constexpr std::int64_t wrapping_multiply(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}

// |a|; 2^63 for INT64_MIN.
static constexpr std::uint64_t magnitude(std::int64_t a) {
    return a < 0 ? 0 - static_cast<std::uint64_t>(a) : static_cast<std::uint64_t>(a);
}

// ±size, saturating at INT64_MIN and INT64_MAX.
static constexpr std::int64_t with_sign(std::uint64_t size, bool negative) {
    constexpr std::uint64_t beyond = std::uint64_t{1} << 63;
    if (size >= beyond)
        return negative ? INT64_MIN : INT64_MAX;
    const std::int64_t value = static_cast<std::int64_t>(size);
    return negative ? -value : value;
}

// Those that stop at the ends of the range.
static constexpr std::int64_t saturating_add(std::int64_t a, std::int64_t b) {
    const std::int64_t sum = wrapping_add(a, b);
    const bool overflow = ((a ^ sum) & (b ^ sum)) < 0;
    return overflow ? (a < 0 ? INT64_MIN : INT64_MAX) : sum;
}

static constexpr std::int64_t saturating_subtract(std::int64_t a, std::int64_t b) {
    const std::int64_t difference = wrapping_subtract(a, b);
    const bool overflow = ((a ^ b) & (a ^ difference)) < 0;
    return overflow ? (a < 0 ? INT64_MIN : INT64_MAX) : difference;
}

// a / 2^n to the nearest, half up; 0 <= n <= 63. One is added to the bit below the cut, where from two bits
// on nothing overflows.
static constexpr std::int64_t shift_right_rounded(std::int64_t a, int n) {
    if (n < 2)
        return n == 0 ? a : (a >> 1) + (a & 1);
    return ((a >> (n - 1)) + 1) >> 1;
}

static constexpr std::uint64_t shift_right_rounded(std::uint64_t a, int n) {
    if (n < 2)
        return n == 0 ? a : (a >> 1) + (a & 1);
    return ((a >> (n - 1)) + 1) >> 1;
}

} // namespace lks::fixed
