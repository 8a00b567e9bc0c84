// Whether a component of a unit vector is right, decided by exact squares.
#pragma once

#include "big_integer.h"

namespace lks::test {

// |unit - 2^30 * v / sqrt(squared)| <= tolerance / 256, that is: with everything times 256 and squared,
// (256 |unit| -+ tolerance)^2 * squared against (2^38 v)^2. The signs must agree where the lower bound is
// positive.
template <int N>
bool is_unit_component(std::int32_t unit, const Big<N>& v, const Big<N>& squared, std::int64_t tolerance) {
    using Wide = Big<N>;
    const std::int64_t size = unit < 0 ? -std::int64_t{unit} : std::int64_t{unit};
    const Wide target = (v * v) << 76;
    const Wide above = Wide::from_i64(256 * size + tolerance);
    if (above * above * squared < target)
        return false;
    if (256 * size <= tolerance)
        return true;
    if ((unit < 0) != v.negative())
        return false;
    const Wide below = Wide::from_i64(256 * size - tolerance);
    return below * below * squared <= target;
}

} // namespace lks::test
