// Of a segment of a rope, by 64-bit products: fixed::normalise for the lengths that ropes have.
#pragma once

#include <bit>

#include "fixed/vector.h"

namespace lks {

// The direction and the length of a segment; false where it has none.
inline bool measure_segment(const fixed::Vec3& d, fixed::NormalisedVector& out) {
    const auto size = [](std::int64_t v) { return static_cast<std::uint64_t>(v ^ (v >> 63)); };
    const int shift = 33 - std::countl_zero(size(d.x) | size(d.y) | size(d.z));
    // From 0.1 µm to 16 m; what is not is rare.
    if (shift < 1 || shift > 29) {
        return fixed::normalise(d, out);
    }
    const auto narrow = [shift](std::int64_t v) { return (v + (std::int64_t{1} << (shift - 1))) >> shift; };
    const std::int64_t x = narrow(d.x);
    const std::int64_t y = narrow(d.y);
    const std::int64_t z = narrow(d.z);
    // From 2^60 to 3·2^62.
    const std::uint64_t squared = static_cast<std::uint64_t>(x * x) + static_cast<std::uint64_t>(y * y) +
                                  static_cast<std::uint64_t>(z * z);
    const int up = std::countl_zero(squared) >> 1;
    const std::uint64_t m = squared << (2 * up);
    const std::uint64_t reciprocal = fixed::reciprocal_sqrt_mantissa(static_cast<std::uint32_t>(m >> 32));
    const auto component = [&](std::int64_t v) {
        return static_cast<std::int32_t>(
            (v * static_cast<std::int64_t>(reciprocal) + (std::int64_t{1} << (31 - up))) >> (32 - up));
    };
    out.direction = {component(x), component(y), component(z)};
    const std::uint64_t root = fixed::multiply_unsigned(m, reciprocal << 32).hi;
    out.length =
        static_cast<std::int64_t>((root + (std::uint64_t{1} << (29 + up - shift))) >> (30 + up - shift));
    return true;
}

} // namespace lks
