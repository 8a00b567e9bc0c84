// Vectors of 64-bit components in any format, and unit directions in Q2.30.
#pragma once

#include "fixed/int128.h"
#include "fixed/reciprocal_sqrt.h"

namespace lks::fixed {

struct Vec3 {
    std::int64_t x, y, z;

    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

// Of anything with x, y and z: the one of axis 0, 1 or 2.
template <typename Vector>
constexpr auto& component(Vector& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// The greatest of |x|, |y| and |z|.
constexpr std::uint64_t greatest_magnitude(const Vec3& v) {
    const std::uint64_t x = magnitude(v.x), y = magnitude(v.y), z = magnitude(v.z);
    const std::uint64_t greater = x < y ? y : x;
    return greater < z ? z : greater;
}

// Sums wrap modulo 2^64; callers bound their coordinates where that would be wrong.
constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {wrapping_add(a.x, b.x), wrapping_add(a.y, b.y), wrapping_add(a.z, b.z)};
}

constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {wrapping_subtract(a.x, b.x), wrapping_subtract(a.y, b.y), wrapping_subtract(a.z, b.z)};
}

constexpr Vec3 operator-(Vec3 a) {
    return {wrapping_negate(a.x), wrapping_negate(a.y), wrapping_negate(a.z)};
}
constexpr Vec3 negate(Vec3 a) {
    return -a;
}

// A unit vector in Q2.30.
struct Direction {
    std::int32_t x, y, z;

    friend constexpr bool operator==(const Direction&, const Direction&) = default;
};

constexpr Direction operator-(Direction a) {
    return {-a.x, -a.y, -a.z};
}

// a * x + b * y + c * z over 2^30 to the nearest, half up, where (a, b, c) is a unit vector in Q2.30, whose
// components sum to at most sqrt(3) * 2^30. The result fits where |x|, |y|, |z| <= 2^62; beyond that it
// wraps.
constexpr std::int64_t dot_components(std::int32_t a, std::int32_t b, std::int32_t c, Vec3 v) {
    return dot_shift_30(a, b, c, v.x, v.y, v.z);
}

constexpr std::int64_t dot(Direction d, Vec3 v) {
    return dot_components(d.x, d.y, d.z, v);
}

// Of two directions, Q2.30, rounded half up.
constexpr std::int32_t dot(Direction a, Direction b) {
    const std::int64_t sum = std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z;
    return static_cast<std::int32_t>(shift_right_rounded(sum, 30));
}

// Exact, 60 fraction bits.
constexpr Vec3 cross(Direction a, Direction b) {
    return {std::int64_t{a.y} * b.z - std::int64_t{a.z} * b.y,
            std::int64_t{a.z} * b.x - std::int64_t{a.x} * b.z,
            std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x};
}

// Some vector across d, not shorter than 2^30 / sqrt(2) for a unit vector.
constexpr Vec3 some_across(Direction d) {
    const std::int32_t x = d.x < 0 ? -d.x : d.x;
    const std::int32_t y = d.y < 0 ? -d.y : d.y;
    return x < y ? Vec3{0, -d.z, d.y} : Vec3{-d.z, 0, d.x};
}

// a * s over 2^30 to the nearest, half up; |a| <= 2^30, so that it always fits.
constexpr std::int64_t scale_component(std::int32_t a, std::int64_t s) {
    return dot_shift_30(a, 0, 0, s, 0, 0);
}

constexpr Vec3 scale(Direction d, std::int64_t s) {
    return {scale_component(d.x, s), scale_component(d.y, s), scale_component(d.z, s)};
}

// The share a / 2^30 of each component.
constexpr Vec3 scaled(std::int32_t a, Vec3 v) {
    return {scale_component(a, v.x), scale_component(a, v.y), scale_component(a, v.z)};
}

// Exact; at most 3 * 2^126.
constexpr UInt128 length_squared(Vec3 v) {
    const std::uint64_t x = magnitude(v.x), y = magnitude(v.y), z = magnitude(v.z);
    return multiply_unsigned(x, x) + multiply_unsigned(y, y) + multiply_unsigned(z, z);
}

// To the nearest unit: error at most half a unit at any length. Costs a 128-bit root; normalise() is the
// quick way.
constexpr std::uint64_t length(Vec3 v) {
    const UInt128 squared = length_squared(v);
    const std::uint64_t root = square_root(squared);
    return root + (squared - multiply_unsigned(root, root) > UInt128{0, root} ? 1u : 0u);
}

struct NormalisedVector {
    Direction direction;
    std::int64_t length;
};

// False, and no change, for the zero vector. Works at every length: components are shifted until the largest
// has 31 bits. |v| as a result saturates at 2^63 - 1. normalise(-v) is exactly the negative.
//
// Worst errors: direction 1.5 units of 2^-30 per component (measured: 1.30); length half a unit plus 2^-29.4
// of it (measured: 2^-29.65).
constexpr bool normalise(Vec3 v, NormalisedVector& out) {
    const std::uint64_t x = magnitude(v.x), y = magnitude(v.y), z = magnitude(v.z);
    const std::uint64_t all = x | y | z;
    if (all == 0)
        return false;

    const int shift = 33 - std::countl_zero(all); // to the right where positive
    const auto shifted = [shift](std::uint64_t a) {
        return shift >= 0 ? shift_right_rounded(a, shift) : a << -shift;
    };
    // At most 2^31 each: squares and their sum fit.
    const std::uint64_t dx = shifted(x), dy = shifted(y), dz = shifted(z);
    const std::uint64_t squared = dx * dx + dy * dy + dz * dz;
    const ReciprocalLength r = reciprocal_length(squared);

    const auto component = [r](std::uint64_t d, bool negative) {
        const std::uint64_t c = shift_right_rounded(d * r.mantissa, 32 - r.shift);
        const std::int32_t bounded = c > (1u << 30) ? (1 << 30) : static_cast<std::int32_t>(c);
        return negative ? -bounded : bounded;
    };
    out.direction = {component(dx, v.x < 0), component(dy, v.y < 0), component(dz, v.z < 0)};

    // sqrt(u) = u / sqrt(u), back in the caller's units.
    const UInt128 scaled = multiply_unsigned(squared, r.mantissa);
    const UInt128 length = shift_right_rounded(scaled, 62 - r.shift - shift);
    out.length = with_sign(saturate_to_uint64(length), false);
    return true;
}

} // namespace lks::fixed
