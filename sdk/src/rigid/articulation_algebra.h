// Vectors and inverse masses as rigid/articulation.h has them: 32 fraction bits, and what they are multiplied
// with in any format.
#pragma once

#include <algorithm>

#include "kernels/force_inline.h"
#include "rigid/articulation_parts.h"
#include "rigid/joint.h"

namespace lks::tree_detail {

inline constexpr int tree_fraction_bits = 32;
inline constexpr std::int64_t tree_one = std::int64_t{1} << tree_fraction_bits;

// What an image made up may be anything: sums wrap.
inline constexpr auto plus = fixed::wrapping_add;
inline constexpr auto minus = fixed::wrapping_subtract;

inline fixed::Vec3 multiply_32(std::int64_t a, const fixed::Vec3& v) {
    return {lks::multiply_32(a, v.x), lks::multiply_32(a, v.y), lks::multiply_32(a, v.z)};
}

// To the nearest, so that bodies keep their momentum.
template <int fraction_bits = tree_fraction_bits>
fixed::Vec3 rounded_share(std::int64_t share, const fixed::Vec3& v) {
    const auto part = [share](std::int64_t c) { return fixed::multiply_shift(share, c, fraction_bits); };
    return {part(v.x), part(v.y), part(v.z)};
}

inline std::int64_t dot_32(const fixed::Vec3& a, const fixed::Vec3& b) {
    return plus(plus(lks::multiply_32(a.x, b.x), lks::multiply_32(a.y, b.y)), lks::multiply_32(a.z, b.z));
}

LKS_FORCE_INLINE fixed::Vec3 cross_32(const fixed::Vec3& a, const fixed::Vec3& b) {
    const auto m = lks::multiply_32;
    return fixed::Vec3{m(a.y, b.z), m(a.z, b.x), m(a.x, b.y)} -
           fixed::Vec3{m(a.z, b.y), m(a.x, b.z), m(a.y, b.x)};
}

// Where a symmetric matrix has its rows: xx, xy, xz, yy, yz, zz.
inline constexpr int rows_of_symmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

inline fixed::Vec3 symmetric(const std::int64_t (&m)[6], const fixed::Vec3& v) {
    return {dot_32({m[0], m[1], m[2]}, v), dot_32({m[1], m[3], m[4]}, v), dot_32({m[2], m[4], m[5]}, v)};
}

// Without what its joints carry.
inline ArticulatedInverse own_inverse(const Body& body, std::int64_t share) {
    ArticulatedInverse inverse{};
    inverse.shift[0] = inverse.shift[3] = inverse.shift[5] = share;
    const SymmetricMatrix& m = body.world_inverse;
    const std::int32_t entries[6] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
    for (int i = 0; i < 6; ++i) {
        const int up = body.inverse_shift + tree_fraction_bits - 30;
        const std::int64_t entry =
            up >= 0 ? entries[i] * (std::int64_t{1} << up) : entries[i] >> std::min(-up, 31);
        inverse.turn[i] = lks::multiply_32(share, entry);
    }
    return inverse;
}

// Of a pivot with 32 fraction bits. What is too small to be one lets nothing be pushed.
inline Inverse invert_pivot(std::int64_t pivot) {
    constexpr std::int64_t least = 1 << 4;
    if (pivot < least) {
        return {0, 0};
    }
    Inverse inverse = lks::invert(pivot);
    inverse.shift -= tree_fraction_bits - 30;
    return inverse;
}

// Of a lever in world axes.
inline fixed::Vec3 arm_in_units(const Body& body, const fixed::Vec3& lever) {
    const int down = world_fraction_bits - tree_fraction_bits + body.scale;
    const auto part = [down](std::int64_t c) {
        return down >= 0 ? c >> down : c * (std::int64_t{1} << -down);
    };
    return {part(lever.x), part(lever.y), part(lever.z)};
}

// Of a point in the body's.
inline fixed::Vec3 lever_in_units(const Body& body, const fixed::Vec3& point) {
    return arm_in_units(body, fixed::rotate(body.rotation, point));
}

inline const fixed::Vec3& point_of(const Joint& joint, bool on_a) {
    return on_a ? joint.description.point_a : joint.description.point_b;
}

// How the body's point at the lever moves with it.
inline fixed::Vec3 point_motion(const ArticulatedBody& body, const fixed::Vec3& lever) {
    return body.shift + cross_32(body.turn, lever);
}

// What a push along each axis at the lever does: its shift and its turn.
inline void push_columns(const ArticulatedInverse& w, const fixed::Vec3& lever, fixed::Vec3 (&shift)[3],
                         fixed::Vec3 (&turn)[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const fixed::Vec3 arm = axis == 0   ? fixed::Vec3{0, lever.z, -lever.y}
                                : axis == 1 ? fixed::Vec3{-lever.z, 0, lever.x}
                                            : fixed::Vec3{lever.y, -lever.x, 0};
        const int(&row)[3] = rows_of_symmetric[axis];
        shift[axis] = fixed::Vec3{w.shift[row[0]], w.shift[row[1]], w.shift[row[2]]} +
                      fixed::Vec3{dot_32({w.mixed[0], w.mixed[1], w.mixed[2]}, arm),
                                  dot_32({w.mixed[3], w.mixed[4], w.mixed[5]}, arm),
                                  dot_32({w.mixed[6], w.mixed[7], w.mixed[8]}, arm)};
        turn[axis] = fixed::Vec3{w.mixed[3 * axis], w.mixed[3 * axis + 1], w.mixed[3 * axis + 2]} +
                     symmetric(w.turn, arm);
    }
}

// How the point moves: xx, xy, xz, yy, yz, zz are added to.
inline void add_point_motion(const fixed::Vec3& lever, const fixed::Vec3 (&shift)[3],
                             const fixed::Vec3 (&turn)[3], std::int64_t (&d)[6]) {
    int entry = 0;
    for (int i = 0; i < 3; ++i) {
        const fixed::Vec3 moved = shift[i] + cross_32(turn[i], lever);
        for (int j = i; j < 3; ++j) {
            d[entry] = plus(d[entry], component(moved, j));
            ++entry;
        }
    }
}

inline void add_force(ArticulatedBody& body, const fixed::Vec3& lever, const fixed::Vec3& push) {
    body.force = body.force + push;
    body.torque = body.torque + cross_32(lever, push);
}

inline fixed::Vec3 shifted(const fixed::Vec3& v, int up) {
    return {lks::shifted(v.x, up), lks::shifted(v.y, up), lks::shifted(v.z, up)};
}

// How a torque turns the body by itself, in its unit.
template <int fraction_bits = tree_fraction_bits>
fixed::Vec3 own_turn(const Body& body, std::int64_t share, const fixed::Vec3& torque) {
    return shifted(multiply(body.world_inverse, rounded_share<fraction_bits>(share, torque)),
                   body.inverse_shift);
}

// What the pushes of its joints do to it, all at once: one by one they may be large, and of the heavy end of
// a chain only a small rest remains.
template <int fraction_bits = tree_fraction_bits>
Move move_of(const Body& body, std::int64_t share, const ArticulatedBody& part) {
    const fixed::Vec3 turn = multiply(body.world_inverse, rounded_share<fraction_bits>(share, part.torque));
    const int up = body.inverse_shift - body.scale - 1 + half_turn_fraction_bits - world_fraction_bits;
    return {rounded_share<fraction_bits>(share, part.force), shifted(turn, up)};
}

} // namespace lks::tree_detail
