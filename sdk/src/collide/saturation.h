// Sums and differences that stop at the ends of the range, of vectors too: what saturates here is further
// away than anything that can touch.
#pragma once

#include <cstdint>

#include "fixed/integer.h"
#include "fixed/vector.h"

namespace lks {

using fixed::saturating_add;
using fixed::saturating_subtract;

constexpr fixed::Vec3 saturating_subtract(const fixed::Vec3& a, const fixed::Vec3& b) {
    return {saturating_subtract(a.x, b.x), saturating_subtract(a.y, b.y), saturating_subtract(a.z, b.z)};
}

constexpr fixed::Vec3 saturating_add(const fixed::Vec3& a, const fixed::Vec3& b) {
    return {saturating_add(a.x, b.x), saturating_add(a.y, b.y), saturating_add(a.z, b.z)};
}

constexpr std::int64_t saturating_double(std::int64_t a) {
    return saturating_add(a, a);
}

// min(a, INT64_MAX)
constexpr std::int64_t saturate(std::uint64_t a) {
    return a > static_cast<std::uint64_t>(INT64_MAX) ? INT64_MAX : static_cast<std::int64_t>(a);
}

// |x| + |y| + |z|, at least as long as v; at most 2^63 - 1.
constexpr std::int64_t sum_of_magnitudes(const fixed::Vec3& v) {
    return saturating_add(saturating_add(saturate(fixed::magnitude(v.x)), saturate(fixed::magnitude(v.y))),
                          saturate(fixed::magnitude(v.z)));
}

} // namespace lks
