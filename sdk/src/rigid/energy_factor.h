// What velocities are multiplied by, so that of an energy there is as much as there may be.
#pragma once

#include <algorithm>

#include "fixed/int128.h"

namespace lks {

inline constexpr int factor_fraction_bits = 30;
inline constexpr std::int64_t one_factor = std::int64_t{1} << factor_fraction_bits;

// √(allowed/energy), rounded down; energy > allowed ≥ 0.
inline std::int64_t energy_factor(const fixed::Int128& allowed, const fixed::Int128& energy) {
    const fixed::UInt128 whole = fixed::abs(energy);
    const int down = std::max(0, 64 - fixed::leading_zeros(whole));
    const fixed::UInt128 part =
        fixed::UInt128{(fixed::abs(allowed) >> down).lo, 0} >> (64 - 2 * factor_fraction_bits);
    const std::uint64_t ratio = fixed::divide(part, (whole >> down).lo).quotient.lo;
    return static_cast<std::int64_t>(fixed::square_root(ratio));
}

} // namespace lks
