// Lengths, speeds, pushes and other World values as numbers, and times a ratio.
#pragma once

#include "fixed/formats.h"
#include "fixed/scaled.h"

namespace lks {

// Of a value that is not negative.
inline fixed::Scaled world_value(std::int64_t value) {
    return fixed::Scaled::from_fixed(static_cast<std::uint64_t>(value), world_fraction_bits);
}

// value · factor with its sign, World; saturates at ±INT64_MAX.
inline std::int64_t times(std::int64_t value, const fixed::Scaled& factor) {
    const fixed::Scaled size = fixed::Scaled::from_fixed(fixed::magnitude(value), world_fraction_bits);
    const std::int64_t result = (size * factor).to_i64_fixed(world_fraction_bits);
    return value < 0 ? -result : result;
}

} // namespace lks
