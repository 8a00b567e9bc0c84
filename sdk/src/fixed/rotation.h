// Rotations: unit quaternions and matrices in Q2.30.
//
// Quaternions are kept, and matrices made from them: rotating by a matrix is nine products, and its result
// for 64-bit vectors is exact but for one rounding.
#pragma once

#include "fixed/vector.h"

namespace lks::fixed {

struct Rotation {
    std::int32_t x, y, z, w;

    friend constexpr bool operator==(const Rotation&, const Rotation&) = default;
};

struct Matrix3 {
    std::int32_t m[3][3]; // m[row][column]

    friend constexpr bool operator==(const Matrix3&, const Matrix3&) = default;
};

inline constexpr std::int32_t rotation_one = std::int32_t{1} << 30;

constexpr Rotation identity_rotation() {
    return {0, 0, 0, rotation_one};
}

// |length - 1| <= 1e-4, decided exactly at the nearest bounds of the squared length in Q60. The sum of the
// squares of four 32-bit numbers wraps for one value only, 2^64, and then is zero.
constexpr bool is_nearly_unit(Rotation q) {
    const auto square = [](std::int32_t c) { return static_cast<std::uint64_t>(std::int64_t{c} * c); };
    const std::uint64_t squared = square(q.x) + square(q.y) + square(q.z) + square(q.w);
    constexpr std::uint64_t low = 1152690931835140653u;  // ceil(0.9999^2 * 2^60)
    constexpr std::uint64_t high = 1153152100436983391u; // floor(1.0001^2 * 2^60)
    return squared >= low && squared <= high;
}

// The four-dimensional unit vector along v, Q2.62: each component within two units of 2^-62 towards zero.
// False for the zero vector. |components| < 2^63 (the sum of their squares then fits into 128 bits).
struct UnitVector4 {
    std::int64_t component[4];
};

constexpr bool normalise_wide(const std::int64_t (&v)[4], UnitVector4& out) {
    UInt128 squared{0, 0};
    for (const std::int64_t c : v)
        squared = squared + multiply_unsigned(magnitude(c), magnitude(c));
    if (squared == UInt128{0, 0})
        return false;
    const int shift = leading_zeros(squared) & ~1;
    const std::uint64_t root = square_root(squared << shift); // |v| * 2^(shift/2), at least 2^63
    for (int i = 0; i < 4; ++i) {
        const UInt128 numerator = UInt128{0, magnitude(v[i])} << (shift / 2 + 62);
        const std::uint64_t c = divide(numerator, root).quotient.lo;
        constexpr std::uint64_t one = std::uint64_t{1} << 62;
        out.component[i] = with_sign(c < one ? c : one, v[i] < 0);
    }
    return true;
}

// Q2.62 to Q2.30, to the nearest with ties away from zero: a rotation and its negative round alike.
constexpr std::int32_t round_component(std::int64_t c) {
    return static_cast<std::int32_t>(with_sign(shift_right_rounded(magnitude(c), 32), c < 0));
}

constexpr Rotation round_rotation(const UnitVector4& u) {
    return {round_component(u.component[0]), round_component(u.component[1]), round_component(u.component[2]),
            round_component(u.component[3])};
}

// Error of each component: at most 0.5 + 2^-30 units. Any length; zero gives no rotation.
constexpr Rotation normalise(Rotation q) {
    UnitVector4 unit{};
    if (!normalise_wide({q.x, q.y, q.z, q.w}, unit))
        return identity_rotation();
    return round_rotation(unit);
}

// Normalised until that changes nothing: a hundredth of all need it twice. So what is taken from an image is
// what it was made of.
constexpr Rotation settle(Rotation q) {
    constexpr int most = 8;
    for (int i = 0; i < most; ++i) {
        const Rotation next = normalise(q);
        if (next == q) {
            break;
        }
        q = next;
    }
    return q;
}

constexpr Rotation conjugate(Rotation q) {
    return {-q.x, -q.y, -q.z, q.w};
}

// First b, then a. Both nearly unit; each component is rounded half up and the result not normalised, so its
// length is off by at most the sum of theirs and one unit.
constexpr Rotation multiply(Rotation a, Rotation b) {
    const auto product = [](std::int32_t p, std::int32_t q) { return std::int64_t{p} * q; };
    const auto rounded = [](std::int64_t c) { return static_cast<std::int32_t>(shift_right_rounded(c, 30)); };
    return {rounded(product(a.w, b.x) + product(a.x, b.w) + product(a.y, b.z) - product(a.z, b.y)),
            rounded(product(a.w, b.y) + product(a.y, b.w) + product(a.z, b.x) - product(a.x, b.z)),
            rounded(product(a.w, b.z) + product(a.z, b.w) + product(a.x, b.y) - product(a.y, b.x)),
            rounded(product(a.w, b.w) - product(a.x, b.x) - product(a.y, b.y) - product(a.z, b.z))};
}

// Local to world. q nearly unit. Against the matrix of these same components each entry is rounded once, half
// up (0.5 units). For a normalised q its rows have length one and stand at right angles within 5 units
// (measured: 3.9).
constexpr Matrix3 to_matrix(Rotation q) {
    const auto product = [](std::int32_t a, std::int32_t b) { return std::int64_t{a} * b; };
    const auto entry = [](std::int64_t half) { // half the entry in Q60
        return static_cast<std::int32_t>(shift_right_rounded(half, 29));
    };
    constexpr std::int64_t half = std::int64_t{1} << 59;
    const std::int64_t xx = product(q.x, q.x), yy = product(q.y, q.y), zz = product(q.z, q.z);
    const std::int64_t xy = product(q.x, q.y), yz = product(q.y, q.z), zx = product(q.z, q.x);
    const std::int64_t wx = product(q.w, q.x), wy = product(q.w, q.y), wz = product(q.w, q.z);
    return {{{entry(half - yy - zz), entry(xy - wz), entry(zx + wy)},
             {entry(xy + wz), entry(half - zz - xx), entry(yz - wx)},
             {entry(zx - wy), entry(yz + wx), entry(half - xx - yy)}}};
}

// Exact products, one rounding, half up. |components| <= 2^62 (larger ones wrap where the result does not
// fit).
constexpr Vec3 rotate(const Matrix3& a, Vec3 v) {
    return {dot_components(a.m[0][0], a.m[0][1], a.m[0][2], v),
            dot_components(a.m[1][0], a.m[1][1], a.m[1][2], v),
            dot_components(a.m[2][0], a.m[2][1], a.m[2][2], v)};
}

// By the inverse rotation.
constexpr Vec3 rotate_transposed(const Matrix3& a, Vec3 v) {
    return {dot_components(a.m[0][0], a.m[1][0], a.m[2][0], v),
            dot_components(a.m[0][1], a.m[1][1], a.m[2][1], v),
            dot_components(a.m[0][2], a.m[1][2], a.m[2][2], v)};
}

// Directions; Q2.30, rounded half up.
constexpr Direction rotate(const Matrix3& a, Direction d) {
    return {dot(Direction{a.m[0][0], a.m[0][1], a.m[0][2]}, d),
            dot(Direction{a.m[1][0], a.m[1][1], a.m[1][2]}, d),
            dot(Direction{a.m[2][0], a.m[2][1], a.m[2][2]}, d)};
}

constexpr Direction rotate_transposed(const Matrix3& a, Direction d) {
    return {dot(Direction{a.m[0][0], a.m[1][0], a.m[2][0]}, d),
            dot(Direction{a.m[0][1], a.m[1][1], a.m[2][1]}, d),
            dot(Direction{a.m[0][2], a.m[1][2], a.m[2][2]}, d)};
}

// First b, then a; each entry rounded half up.
constexpr Matrix3 multiply(const Matrix3& a, const Matrix3& b) {
    Matrix3 out{};
    for (int column = 0; column < 3; ++column) {
        const Direction d = rotate(a, Direction{b.m[0][column], b.m[1][column], b.m[2][column]});
        out.m[0][column] = d.x;
        out.m[1][column] = d.y;
        out.m[2][column] = d.z;
    }
    return out;
}

// Between a (0 / denominator) and b (denominator / denominator), both unit: the components interpolated
// linearly on the shorter way and normalised, which turns at a rate within 10 % of even for up to 90 degrees
// and is symmetric. b is negated where the dot product is negative, not where it is zero. Both ends return
// their rotation untouched; a numerator beyond the denominator counts as equal to it. Error against the exact
// formula: 0.5 + 2^-30 units.
constexpr Rotation interpolate(Rotation a, Rotation b, std::uint32_t numerator, std::uint32_t denominator) {
    if (numerator == 0)
        return a;
    if (numerator >= denominator)
        return b;
    const std::int64_t dot =
        std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z + std::int64_t{a.w} * b.w;
    const std::int64_t share_b = dot < 0 ? -std::int64_t{numerator} : std::int64_t{numerator};
    const std::int64_t share_a = std::int64_t{denominator} - numerator;
    const auto mixed = [share_a, share_b](std::int32_t p, std::int32_t q) {
        return p * share_a + q * share_b;
    };
    UnitVector4 unit{};
    if (!normalise_wide({mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.z, b.z), mixed(a.w, b.w)}, unit))
        return a;
    return round_rotation(unit);
}

} // namespace lks::fixed
