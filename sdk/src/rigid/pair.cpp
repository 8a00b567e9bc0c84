#include "rigid/pair.h"

#include <algorithm>

#include "fixed/formats.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

constexpr int half_turn_bits = half_turn_fraction_bits;
// Beyond this a lever is so long against the body that the body turns as if it were heavier.
constexpr std::int32_t heaviest_turn_shift = 24;

std::int32_t narrow_share(const InverseMass& part, const InverseMass& whole) {
    if (part.mantissa == 0) {
        return 0;
    }
    // Both mantissas have their top bits; the quotient is at most one.
    const int down = whole.exponent - part.exponent;
    if (down > 32) {
        return 0;
    }
    const std::uint64_t quotient = (std::uint64_t{part.mantissa} << 30) / whole.mantissa;
    return static_cast<std::int32_t>(
        std::min<std::uint64_t>(fixed::shift_right_rounded(quotient, down), direction_one));
}

Direction multiply_direction(const SymmetricMatrix& m, const Direction& v) {
    return {fixed::dot(Direction{m.xx, m.xy, m.xz}, v), fixed::dot(Direction{m.xy, m.yy, m.yz}, v),
            fixed::dot(Direction{m.xz, m.yz, m.zz}, v)};
}

// Of 30 fraction bits.
Direction narrow_cross(const Direction& u, const Direction& v) {
    const Vec3 exact = fixed::cross(u, v);
    const auto part = [](std::int64_t c) {
        return static_cast<std::int32_t>(fixed::shift_right_rounded(c, 30));
    };
    return {part(exact.x), part(exact.y), part(exact.z)};
}

// Of a turn about an axis: Ĵ is in 1/(2^scale m)².
std::int32_t turning_shift(const Body& body, int reach) {
    return std::min(body.inverse_shift + 2 * (reach - body.scale), heaviest_turn_shift);
}

// share · quadratic form · 2^shift
std::int64_t turning_weight(std::int32_t share, const Direction& turn, const Direction& arm, int shift) {
    const std::int64_t form =
        (std::int64_t{turn.x} * arm.x + std::int64_t{turn.y} * arm.y + std::int64_t{turn.z} * arm.z) >> 30;
    return shifted((form * share) >> 30, shift);
}

// What a push of p does to the body.
Vec3 half_turn_of(const Direction& turn, std::int32_t share, std::int32_t turn_shift, std::int64_t p,
                  int sign) {
    const std::int64_t own = sign * fixed::scale_component(share, p);
    const int shift = turn_shift + half_turn_bits - world_fraction_bits;
    const auto part = [&](std::int32_t c) { return shifted(fixed::scale_component(c, own), shift); };
    return {part(turn.x), part(turn.y), part(turn.z)};
}

Vec3 half_turn_of(const RowSide& side, std::int64_t p, int sign) {
    return half_turn_of(side.turn, side.share, side.turn_shift, p, sign);
}

// Δθ/2 = share · Ĵ · p · 2^shift.
Vec3 half_turn_of(const Body& body, std::int32_t share, int shift, const Vec3& p, int sign) {
    const Vec3 turned = multiply(body.world_inverse, p);
    const auto part = [&](std::int64_t c) {
        return shifted(sign * fixed::scale_component(share, c), shift + half_turn_bits - world_fraction_bits);
    };
    return {part(turned.x), part(turned.y), part(turned.z)};
}

// A quarter an axis.
Vec3 clamped_turn(const Vec3& half_turn) {
    const auto part = [](std::int64_t c) { return std::clamp(c, -greatest_half_turn, greatest_half_turn); };
    return {part(half_turn.x), part(half_turn.y), part(half_turn.z)};
}

// q += τ⊗q, τ of so many fraction bits.
template <int bits>
void add_turn(Quaternion& to, const Vec3& half_turn) {
    const auto [x, y, z] = half_turn;
    const fixed::Rotation q = narrow(to);
    const auto part = [](std::int64_t c) {
        return fixed::shift_right_rounded(c, bits + 30 - turn_fraction_bits);
    };
    to.x += part(x * q.w + y * q.z - z * q.y);
    to.y += part(y * q.w + z * q.x - x * q.z);
    to.z += part(z * q.w + x * q.y - y * q.x);
    to.w -= part(x * q.x + y * q.y + z * q.z);
}

} // namespace

bool heavier(const InverseMass& a, const InverseMass& b) {
    if (a.mantissa == 0 || b.mantissa == 0) {
        return a.mantissa == 0 && b.mantissa != 0;
    }
    return a.exponent != b.exponent ? a.exponent < b.exponent : a.mantissa < b.mantissa;
}

std::int32_t share_in_greater(const InverseMass& a, const InverseMass& b) {
    return narrow_share(a, heavier(a, b) ? b : a);
}

PairShares pair_shares(const InverseMass& a, const InverseMass& b) {
    return {share_in_greater(a, b), share_in_greater(b, a)};
}

Inverse invert(std::int64_t weight) {
    const auto w = static_cast<std::uint64_t>(weight);
    const int zeros = std::countl_zero(w);
    // m in [1, 2) with 31 fraction bits: W = m · 2^(33 − zeros) (63 − zeros is the place of the top bit).
    const auto m = static_cast<std::uint32_t>((w << zeros) >> 32);
    return {fixed::reciprocal_mantissa(m), 31 + 33 - zeros};
}

std::int64_t divide(std::int64_t value, const Inverse& inverse) {
    const std::int64_t high = (value >> 32) * static_cast<std::int64_t>(inverse.mantissa);
    const std::int64_t low = (value & 0xffffffff) * static_cast<std::int64_t>(inverse.mantissa);
    // value · mantissa = high · 2^32 + low; first by 2^-24, which keeps what matters within 64 bits.
    const std::int64_t scaled = fixed::wrapping_add(fixed::wrapping_multiply(high, 256), low >> 24);
    return shifted(scaled, 24 - inverse.shift);
}

// Contacts lie within the body's own unit; joints may be further out.
UnitLever to_unit(const Body& body, const Vec3& lever) {
    const std::uint64_t greatest = fixed::greatest_magnitude(lever);
    int unit = body.scale;
    while (greatest >> (world_fraction_bits + unit - 1) != 0) {
        ++unit;
    }
    const int down = world_fraction_bits - 30 + unit; // to 30 fraction bits
    const auto part = [down](std::int64_t c) {
        return static_cast<std::int32_t>(down >= 0 ? c >> down : c * (std::int64_t{1} << -down));
    };
    const int longer = unit - body.scale;
    const int wanted = body.inverse_shift + 2 * longer;
    const int weight_shift = std::min(wanted, heaviest_turn_shift);
    // Ĵ is in 1/unit², the arm in units: by 2^longer more, and over 2^scale for radians; half of the angle.
    return {{part(lever.x), part(lever.y), part(lever.z)},
            weight_shift,
            body.inverse_shift + longer - body.scale - (wanted - weight_shift) - 1,
            std::max(half_turn_bits + arm_fraction_bits - 1 - world_fraction_bits - unit, 0)};
}

PushRow push_row(const Body& body, std::int32_t share, const Direction& normal, const UnitLever& lever,
                 std::int64_t& weight) {
    const Direction arm = narrow_cross(lever.lever, normal);
    const Direction turn = multiply_direction(body.world_inverse, arm);
    weight += share + turning_weight(share, turn, arm, lever.weight_shift);
    const auto part = [](std::int32_t c) {
        return static_cast<std::int32_t>(fixed::shift_right_rounded(std::int64_t{c}, 30 - arm_fraction_bits));
    };
    return {{part(arm.x), part(arm.y), part(arm.z)}, turn};
}

RowSide push_side(const Body& body, std::int32_t share, const Direction& normal, const Vec3& lever,
                  std::int64_t& weight) {
    if (share == 0) {
        return {};
    }
    const UnitLever unit = to_unit(body, lever);
    return {push_row(body, share, normal, unit, weight).turn, share, unit.turn_shift};
}

BlockSide block_side(const Body& body, std::int32_t share, const Vec3& lever, std::int64_t (&k)[6]) {
    BlockSide side{};
    side.share = share;
    if (share == 0) {
        return side;
    }
    const UnitLever unit = to_unit(body, lever);
    side.lever = unit.lever;
    side.turn_shift = unit.turn_shift;
    Direction arms[3];
    Direction turns[3];
    for (int i = 0; i < 3; ++i) {
        arms[i] = narrow_cross(
            unit.lever, {i == 0 ? direction_one : 0, i == 1 ? direction_one : 0, i == 2 ? direction_one : 0});
        turns[i] = multiply_direction(body.world_inverse, arms[i]);
    }
    int entry = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            k[entry++] += (i == j ? share : 0) + turning_weight(share, turns[i], arms[j], unit.weight_shift);
        }
    }
    return side;
}

RowSide turn_side(const Body& body, std::int32_t share, const Direction& axis, int reach,
                  std::int64_t& weight) {
    RowSide side{};
    side.share = share;
    if (share == 0) {
        return side;
    }
    side.turn = multiply_direction(body.world_inverse, axis);
    const std::int32_t shift = turning_shift(body, reach);
    side.turn_shift = shift - 1;
    weight += turning_weight(share, side.turn, axis, shift);
    return side;
}

void add_turning_block(const Body& body, std::int32_t share, int reach, std::int64_t (&k)[6]) {
    const SymmetricMatrix& m = body.world_inverse;
    const std::int32_t entries[6] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
    for (int i = 0; i < 6; ++i) {
        k[i] += shifted((std::int64_t{entries[i]} * share) >> 30, turning_shift(body, reach));
    }
}

void turn_body(Body& body, const Vec3& half_turn) {
    if ((half_turn.x | half_turn.y | half_turn.z) == 0) {
        return;
    }
    // Of a large turn q += τ⊗q would need more than 64 bits.
    const auto beyond = [](std::int64_t c) {
        return static_cast<std::uint64_t>(c) + small_half_turn > 2 * std::uint64_t{small_half_turn} ? 1u : 0u;
    };
    if ((beyond(half_turn.x) | beyond(half_turn.y) | beyond(half_turn.z)) != 0) [[unlikely]] {
        constexpr int coarser = 7;
        const Vec3 clamped = clamped_turn(half_turn);
        add_turn<half_turn_bits - coarser>(body.orientation,
                                           {fixed::shift_right_rounded(clamped.x, coarser),
                                            fixed::shift_right_rounded(clamped.y, coarser),
                                            fixed::shift_right_rounded(clamped.z, coarser)});
        // Small turns leave the length as it is but for their square, and the end of the substep sees to
        // that.
        body.orientation = normalise(body.orientation);
    } else {
        add_turn<half_turn_bits>(body.orientation, half_turn);
    }
    body.follow_orientation();
}

void turn(Body& body, const RowSide& side, std::int64_t p, int sign) {
    if (side.share != 0) {
        turn_body(body, half_turn_of(side, p, sign));
    }
}

Move turning_move_of(const Body& body, std::int32_t share, int reach, const Vec3& p, int sign) {
    return {{0, 0, 0}, clamped_turn(half_turn_of(body, share, turning_shift(body, reach) - 1, p, sign))};
}

void turn(Body& body, std::int32_t share, int reach, const Vec3& p, int sign) {
    turn_body(body, turning_move_of(body, share, reach, p, sign).half_turn);
}

Move move_of(const Body& body, const BlockSide& side, const Vec3& p, int sign) {
    if (side.share == 0) {
        return {};
    }
    const auto part = [&](std::int64_t c) { return sign * fixed::scale_component(side.share, c); };
    const Direction& r = side.lever;
    const Vec3 arm{fixed::dot_components(0, -r.z, r.y, p), fixed::dot_components(r.z, 0, -r.x, p),
                   fixed::dot_components(-r.y, r.x, 0, p)};
    return {{part(p.x), part(p.y), part(p.z)}, half_turn_of(body, side.share, side.turn_shift, arm, sign)};
}

void push(Body& body, const BlockSide& side, const Vec3& p, int sign) {
    if (side.share != 0) {
        apply(body, move_of(body, side, p, sign));
    }
}

void accelerate(Body& body, const PushRow& row, std::int32_t share, std::int32_t turn_shift,
                const Direction& normal, std::int64_t p, int sign) {
    if (share == 0) {
        return;
    }
    const std::int64_t own = sign * fixed::scale_component(share, p);
    body.velocity = body.velocity + fixed::scale(normal, own);
    const auto part = [&](std::int32_t c) { return shifted(fixed::scale_component(c, own), turn_shift + 1); };
    body.angular_velocity =
        body.angular_velocity + Vec3{part(row.turn.x), part(row.turn.y), part(row.turn.z)};
}

void add_push(Move& move, const PushRow& row, std::int32_t share, std::int32_t turn_shift,
              const Vec3& p_normal, std::int64_t p, int sign) {
    if (share == 0) {
        return;
    }
    const auto moved = [&](std::int64_t c) { return sign * fixed::scale_component(share, c); };
    move.shift = move.shift + Vec3{moved(p_normal.x), moved(p_normal.y), moved(p_normal.z)};
    move.half_turn = clamped_turn(move.half_turn + half_turn_of(row.turn, share, turn_shift, p, sign));
}

void apply(Body& body, const Move& move) {
    body.position = body.position + move.shift;
    turn_body(body, move.half_turn);
}

void push(Body& body, const RowSide& side, const Vec3& p_normal, std::int64_t p, int sign) {
    if (side.share == 0) {
        return; // others may read it at the same time
    }
    Move move;
    add_push(move, {{}, side.turn}, side.share, side.turn_shift, p_normal, p, sign);
    apply(body, move);
}

} // namespace lks
