// The orientation of a rigid body: a unit quaternion in Turn format, Q4.60, and what turns it.
//
// A rotation by small steps is kept as a half turn τ = axis·tan(angle/2): q' = normalise(q + τ⊗q) turns by
// exactly that angle (Cayley's map), and the half turn between two orientations is the vector part of q'⊗q*
// over its scalar part. Both are each other's inverse, so a body that nothing touches keeps its spin.
#pragma once

#include "fixed/rotation.h"

namespace lks {

// Turn: 60 fraction bits, components of unit quaternions and half turns.
inline constexpr int turn_fraction_bits = 60;
inline constexpr std::int64_t turn_one = std::int64_t{1} << turn_fraction_bits;

// a·b in Turn format; |a|, |b| < 4, |a·b| < 8. Three of the four partial products: less than 18 units too
// small.
constexpr std::int64_t multiply_turn(std::int64_t a, std::int64_t b) {
    const std::int64_t a_high = a >> 32;
    const std::int64_t b_high = b >> 32;
    const std::int64_t a_low = a & 0xffffffff;
    const std::int64_t b_low = b & 0xffffffff;
    return a_high * b_high * 16 + ((a_high * b_low) >> 28) + ((a_low * b_high) >> 28);
}

struct Quaternion {
    std::int64_t x, y, z, w;

    friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

constexpr Quaternion conjugate(const Quaternion& q) {
    return {-q.x, -q.y, -q.z, q.w};
}

constexpr Quaternion operator-(const Quaternion& q) {
    return {-q.x, -q.y, -q.z, -q.w};
}

// First b, then a.
constexpr Quaternion multiply(const Quaternion& a, const Quaternion& b) {
    const auto m = multiply_turn;
    return {m(a.w, b.x) + m(a.x, b.w) + m(a.y, b.z) - m(a.z, b.y),
            m(a.w, b.y) + m(a.y, b.w) + m(a.z, b.x) - m(a.x, b.z),
            m(a.w, b.z) + m(a.z, b.w) + m(a.x, b.y) - m(a.y, b.x),
            m(a.w, b.w) - m(a.x, b.x) - m(a.y, b.y) - m(a.z, b.z)};
}

// Of squared length 1/4 to 4 before; within 2^-52 of one after (measured: 2^-53.0, and 2^-54.1 where it
// was about one before). What is shorter was no rotation and becomes none.
constexpr Quaternion normalise(const Quaternion& q) {
    const std::int64_t squared =
        multiply_turn(q.x, q.x) + multiply_turn(q.y, q.y) + multiply_turn(q.z, q.z) + multiply_turn(q.w, q.w);
    if (squared < turn_one / 4) {
        return {0, 0, 0, turn_one};
    }
    // 1/√s to 30 bits, and once Newton's step: y·(3 − s·y²)/2.
    const fixed::ReciprocalLength r = fixed::reciprocal_length(static_cast<std::uint64_t>(squared));
    // 1/√(s·2^60) = mantissa·2^(shift − 62), and s = squared/2^60.
    const std::int64_t seed = static_cast<std::int64_t>(r.mantissa) << (r.shift + 28);
    const std::int64_t deviation = 3 * turn_one - multiply_turn(squared, multiply_turn(seed, seed));
    const std::int64_t inverse = multiply_turn(seed, deviation >> 1);
    return {multiply_turn(q.x, inverse), multiply_turn(q.y, inverse), multiply_turn(q.z, inverse),
            multiply_turn(q.w, inverse)};
}

constexpr Quaternion widen(const fixed::Rotation& q) {
    constexpr std::int64_t scale = std::int64_t{1} << (turn_fraction_bits - 30);
    return normalise({q.x * scale, q.y * scale, q.z * scale, q.w * scale});
}

// To Q2.30, to the nearest.
constexpr fixed::Rotation narrow(const Quaternion& q) {
    const auto part = [](std::int64_t c) {
        return static_cast<std::int32_t>(fixed::shift_right_rounded(c, turn_fraction_bits - 30));
    };
    return {part(q.x), part(q.y), part(q.z), part(q.w)};
}

// normalise(q + τ⊗q), τ in world axes; |τ| ≤ 1.
constexpr Quaternion turned(const Quaternion& q, const fixed::Vec3& half_turn) {
    const Quaternion moved = multiply(Quaternion{half_turn.x, half_turn.y, half_turn.z, 0}, q);
    return normalise({q.x + moved.x, q.y + moved.y, q.z + moved.z, q.w + moved.w});
}

// The half turn, in world axes, that takes `from` to `to`; Turn, each component within ±2 (beyond 126°: that
// of 126°).
constexpr fixed::Vec3 half_turn_between(const Quaternion& from, const Quaternion& to) {
    Quaternion d = multiply(to, conjugate(from));
    if (d.w < 0) {
        d = -d;
    }
    constexpr std::int64_t least = turn_one / 2;
    const std::int64_t w = d.w < least ? least : d.w;
    // 1/w to 30 bits, and once Newton's step: y·(2 − w·y).
    const std::int64_t seed = ((std::int64_t{1} << 62) / (w >> 30)) << 28;
    const std::int64_t inverse = multiply_turn(seed, 2 * turn_one - multiply_turn(w, seed));
    return {multiply_turn(d.x, inverse), multiply_turn(d.y, inverse), multiply_turn(d.z, inverse)};
}

} // namespace lks
