// Authored doubles, taken apart bit by bit: the one place where the SDK looks into them. No arithmetic and no
// comparison on a double anywhere, so neither rounding modes nor flags nor the FPU can have a say.
#pragma once

#include <cstdint>
#include <cstring>

#include "fixed/scaled.h"

namespace lks {

enum class NumberClass { finite, infinite, not_a_number };

// A finite number, exactly. Zero is never negative.
struct SignedScaled {
    bool negative = false;
    fixed::Scaled magnitude{};
};

static_assert(sizeof(double) == sizeof(std::uint64_t), "double must be an IEEE 754 binary64");

// std::bit_cast is younger than some of the C++ libraries that are in use, emscripten's among them.
inline std::uint64_t bits_of(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits;
}

inline NumberClass classify_double(double value) {
    constexpr std::uint64_t exponent_mask = std::uint64_t{0x7ff} << 52;
    constexpr std::uint64_t fraction_mask = (std::uint64_t{1} << 52) - 1;
    const std::uint64_t bits = bits_of(value);
    if ((bits & exponent_mask) != exponent_mask)
        return NumberClass::finite;
    return (bits & fraction_mask) != 0 ? NumberClass::not_a_number : NumberClass::infinite;
}

// False, and no change, for NaN and the infinities.
inline bool decode_double(double value, SignedScaled& out) {
    if (classify_double(value) != NumberClass::finite)
        return false;
    const std::uint64_t bits = bits_of(value);
    const fixed::Scaled magnitude = fixed::Scaled::from_double_bits(bits);
    out = {(bits >> 63) != 0 && !magnitude.is_zero(), magnitude};
    return true;
}

// To the nearest unit of 2^-fraction_bits, ties away from zero. False, and no change, for NaN, the infinities
// and what rounds to more than INT64_MAX units (in either direction: INT64_MIN is refused too).
inline bool to_coordinate(double value, int fraction_bits, std::int64_t& raw) {
    SignedScaled number;
    if (!decode_double(value, number))
        return false;
    const std::uint64_t size = number.magnitude.to_fixed(fraction_bits);
    if (size > static_cast<std::uint64_t>(INT64_MAX))
        return false;
    raw = fixed::with_sign(size, number.negative);
    return true;
}

} // namespace lks
