// How bodies move in a substep in six dimensions, for sums over figures: metres of 26 fraction bits, up to
// 8 m. Turns are in the body's axes and count at the body's unit of length (rigid/inertia.h).
#pragma once

#include <algorithm>

#include "rigid/pair.h"

namespace lks {

inline constexpr int motion_fraction_bits = 26;
inline constexpr std::int64_t greatest_motion = std::int64_t{1} << (motion_fraction_bits + 3);

struct Motion {
    fixed::Vec3 shift;
    fixed::Vec3 turn;
};

inline fixed::Vec3 limited_motion(const fixed::Vec3& v) {
    const auto part = [](std::int64_t c) { return std::clamp(c, -greatest_motion, greatest_motion); };
    return {part(v.x), part(v.y), part(v.z)};
}

inline fixed::Vec3 to_motion(const fixed::Vec3& world) {
    constexpr int down = world_fraction_bits - motion_fraction_bits;
    return limited_motion({world.x >> down, world.y >> down, world.z >> down});
}

// Half turns of so many fraction bits, in the body's axes.
inline fixed::Vec3 to_turn_motion(const Body& body, const fixed::Vec3& half_turn, int fraction_bits) {
    const int up = body.scale + 1 + motion_fraction_bits - fraction_bits;
    const auto part = [up](std::int64_t c) {
        return up >= 0 ? c * (std::int64_t{1} << up) : c >> std::min(-up, 63);
    };
    return limited_motion({part(half_turn.x), part(half_turn.y), part(half_turn.z)});
}

// Of one kilogram with this inertia, 52 fraction bits. Motions are so short that 64 bits hold their products.
inline std::int64_t product(const SymmetricMatrix& inertia, const Motion& p, const Motion& q) {
    const auto row = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        return fixed::shift_right_rounded(x * q.turn.x + y * q.turn.y + z * q.turn.z, 30);
    };
    const fixed::Vec3 turn{row(inertia.xx, inertia.xy, inertia.xz), row(inertia.xy, inertia.yy, inertia.yz),
                           row(inertia.xz, inertia.yz, inertia.zz)};
    return p.shift.x * q.shift.x + p.shift.y * q.shift.y + p.shift.z * q.shift.z + p.turn.x * turn.x +
           p.turn.y * turn.y + p.turn.z * turn.z;
}

} // namespace lks
