// Two bodies that a constraint moves, and a constraint's effect on them along one direction.
//
// Masses enter as shares of the greater inverse mass of the two, levers in each body's own unit of length
// (rigid/inertia.h), so that
//
//     W = Σ wᵢ·(1 + (r̂ᵢ×n)ᵀ Ĵᵢ (r̂ᵢ×n))       for a push along n at r
//     W = Σ wᵢ·Ĵᵢ-quadratic form of n            for a turn about n
//
// lie near one whatever the bodies weigh. What a projection moves is p = C/W, a length (or an angle), of
// which each body takes its share: Δx = ±wᵢ·p·n, Δθ = ±wᵢ·p·Ĵᵢ(r̂ᵢ×n) (Müller et al. 2020, eq. 2 to 9). The
// impulse is p·h⁻¹ / (the greater inverse mass).
#pragma once

#include "rigid/body.h"
#include "rigid/push_limits.h"

namespace lks {

// Share of a body's inverse mass in the greater one of the pair, 30 fraction bits.
struct PairShares {
    std::int32_t a;
    std::int32_t b;

    friend constexpr bool operator==(const PairShares&, const PairShares&) = default;
};

// Whether the first one's mass is the greater.
bool heavier(const InverseMass& a, const InverseMass& b);
// Both zero where both are infinitely heavy.
PairShares pair_shares(const InverseMass& a, const InverseMass& b);
// The first one's alone.
std::int32_t share_in_greater(const InverseMass& a, const InverseMass& b);

// From 30 fraction bits, positive, to what divides by it: 1/W = mantissa · 2^-shift with W in units of one.
struct Inverse {
    std::uint32_t mantissa; // 2^30 .. 2^31
    std::int32_t shift;     // value / W = value · mantissa · 2^-shift
};

// W: 30 fraction bits, above zero.
Inverse invert(std::int64_t weight);
// value / W to the nearest, of values below 2^56; saturates.
std::int64_t divide(std::int64_t value, const Inverse& inverse);

// The one by which less is left of a value.
inline const Inverse& lesser(const Inverse& a, const Inverse& b) {
    return a.shift != b.shift ? (a.shift > b.shift ? a : b) : (a.mantissa < b.mantissa ? a : b);
}

// One body's part in a row.
struct RowSide {
    fixed::Direction turn; // Ĵ(r̂×n), or Ĵn
    std::int32_t share;
    std::int32_t turn_shift; // Δθ/2 = share · p · turn · 2^turn_shift
};

// A lever (World, from the centre of mass, world axes) in units of 2^unit m, below one half, and what
// products with it are shifted by.
struct UnitLever {
    fixed::Direction lever;
    std::int32_t weight_shift;
    std::int32_t turn_shift; // as in RowSide
    std::int32_t arm_shift;  // World motion = arm · half turn · 2^-arm_shift
};
UnitLever to_unit(const Body& body, const fixed::Vec3& lever);

// One body's part in one of several rows at the same lever.
inline constexpr int arm_fraction_bits = 23;
struct PushRow {
    fixed::Direction arm;  // r̂×n, arm_fraction_bits
    fixed::Direction turn; // Ĵ(r̂×n)
};
PushRow push_row(const Body& body, std::int32_t share, const fixed::Direction& normal, const UnitLever& lever,
                 std::int64_t& weight);

// A push along `normal` at `lever`.
RowSide push_side(const Body& body, std::int32_t share, const fixed::Direction& normal,
                  const fixed::Vec3& lever, std::int64_t& weight);
// A turn about `axis`; angles count in metres at a radius of 2^reach m, which both sides of a pair share.
RowSide turn_side(const Body& body, std::int32_t share, const fixed::Direction& axis, int reach,
                  std::int64_t& weight);

// One body's part in a push in any direction.
struct BlockSide {
    fixed::Direction lever; // in units of the body, 30 fraction bits
    std::int32_t share;
    std::int32_t turn_shift;
};

// Adds the body's part to K = Σ wᵢ(1 − r̂ᵢ Ĵᵢ r̂ᵢ): xx, xy, xz, yy, yz, zz, 30 fraction bits.
BlockSide block_side(const Body& body, std::int32_t share, const fixed::Vec3& lever, std::int64_t (&k)[6]);

// value · 2^shift, rounded to the nearest; saturates at greatest_shifted, 2^50.
inline std::int64_t shifted(std::int64_t value, int shift) {
    constexpr std::int64_t limit = greatest_shifted;
    if (shift <= 0) {
        return shift < -62 ? 0 : fixed::shift_right_rounded(value, -shift);
    }
    if (shift > 50 || value > (limit >> shift) || value < -(limit >> shift)) {
        return value == 0 ? 0 : value < 0 ? -limit : limit;
    }
    return value * (std::int64_t{1} << shift);
}

// What one or several rows do to a body: added up, and then applied together.
struct Move {
    fixed::Vec3 shift{0, 0, 0};     // World
    fixed::Vec3 half_turn{0, 0, 0}; // half_turn_fraction_bits
};

inline void add_move(const Move& more, Move& sum) {
    sum = {sum.shift + more.shift, sum.half_turn + more.half_turn};
}

// Adds the body's part to K = Σ wᵢ·Ĵᵢ of turning pushes with that reach, entries as above.
void add_turning_block(const Body& body, std::int32_t share, int reach, std::int64_t (&k)[6]);
// By a push (World).
Move move_of(const Body& body, const BlockSide& side, const fixed::Vec3& p, int sign);
void push(Body& body, const BlockSide& side, const fixed::Vec3& p, int sign);
// By a turning push (World) with the reach of turn_side.
Move turning_move_of(const Body& body, std::int32_t share, int reach, const fixed::Vec3& p, int sign);
void turn(Body& body, std::int32_t share, int reach, const fixed::Vec3& p, int sign);

// By a push p (World) along the row's normal, p_normal; `sign` is 1 or -1. Turns stay within a quarter an
// axis.
void add_push(Move& move, const PushRow& row, std::int32_t share, std::int32_t turn_shift,
              const fixed::Vec3& p_normal, std::int64_t p, int sign);
// How far the move has turned the point along the row's normal, World; to first order.
inline std::int64_t turned_along(const PushRow& row, std::int32_t arm_shift, const Move& move) {
    // 23 and 40 fraction bits; below 2^63 for turns of a quarter.
    return fixed::shift_right_rounded(row.arm.x * move.half_turn.x + row.arm.y * move.half_turn.y +
                                          row.arm.z * move.half_turn.z,
                                      arm_shift);
}
void apply(Body& body, const Move& move);
// Moves a body at once.
void push(Body& body, const RowSide& side, const fixed::Vec3& p_normal, std::int64_t p, int sign);
// Turns it only.
void turn(Body& body, const RowSide& side, std::int64_t p, int sign);
// The same for velocities: p in World m/s along `normal`.
void accelerate(Body& body, const PushRow& row, std::int32_t share, std::int32_t turn_shift,
                const fixed::Direction& normal, std::int64_t p, int sign);
// By a half turn in world axes, clamped to one quarter an axis.
void turn_body(Body& body, const fixed::Vec3& half_turn);

} // namespace lks
