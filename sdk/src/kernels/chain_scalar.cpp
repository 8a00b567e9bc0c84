#include "kernels/chain_scalar.h"

#include <algorithm>
#include <bit>

#include "fixed/formats.h"
#include "fixed/vector.h"
#include "kernels/bounded.h"
#include "kernels/force_inline.h"
#include "kernels/measure_segment.h"

namespace lks {
namespace {

// a·b / 2^31, rounded down.
std::int64_t share_31(std::int64_t a, std::uint32_t b) {
    return fixed::multiply_signed(4 * a, std::int64_t{b} << 31).hi;
}

bool all_within(const fixed::Vec3& v, std::int64_t limit) {
    return within(v.x, limit) && within(v.y, limit) && within(v.z, limit);
}

template <typename Arrays>
fixed::Vec3 vector_at(const Arrays& arrays, std::uint32_t i) {
    return {arrays[0][i], arrays[1][i], arrays[2][i]};
}

void store(std::int64_t* const (&arrays)[3], std::uint32_t i, const fixed::Vec3& v) {
    arrays[0][i] = v.x;
    arrays[1][i] = v.y;
    arrays[2][i] = v.z;
}

// Of the low half.
LKS_FORCE_INLINE std::int64_t half_component(std::int64_t v) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(v) << 32) >> 33;
}

LKS_FORCE_INLINE fixed::Vec3 half_direction(const fixed::Vec3& v) {
    return {half_component(v.x), half_component(v.y), half_component(v.z)};
}

// a·b / 2^32, rounded down; of b the low half counts.
LKS_FORCE_INLINE std::int64_t share_32(std::int64_t a, std::int64_t b) {
    const auto factor = static_cast<std::int64_t>(static_cast<std::uint64_t>(b) << 32);
    return fixed::multiply_signed(as_it_stands(a), as_it_stands(factor)).hi;
}

// What of a vector is along a rope: its product with t, times 1/|t|², along t. Only where a rope turns by
// much is t a unit vector.
struct Tangent {
    fixed::Vec3 t;
    std::int64_t excess; // 1/|t|² − 1, direction_fraction_bits
};

// Of half the sum of two directions that turn by more than 29 degrees.
Tangent turned_tangent(const fixed::Vec3& t, std::uint64_t squared) {
    if (squared < least_tangent_squared) {
        return {{0, 0, 0}, 0};
    }
    const int up = std::countl_zero(squared) >> 1;
    const std::int64_t y_31 =
        fixed::reciprocal_sqrt_mantissa(static_cast<std::uint32_t>(squared << (2 * up) >> 32));
    const std::int64_t y = y_31 - (y_31 >> 31);
    return {{t.x * y >> (32 - up), t.y * y >> (32 - up), t.z * y >> (32 - up)}, 0};
}

LKS_FORCE_INLINE Tangent tangent_between(const fixed::Vec3& near, const fixed::Vec3& far) {
    const fixed::Vec3 t{near.x + far.x, near.y + far.y, near.z + far.z};
    const std::int64_t squared = t.x * t.x + t.y * t.y + t.z * t.z;
    const std::int64_t e = (tangent_one - squared) >> direction_fraction_bits;
    if ((e + greatest_turn) >> (greatest_turn_bits + 1) != 0) {
        return turned_tangent(t, static_cast<std::uint64_t>(squared));
    }
    // e + e² + e³ + e⁴ + e⁵ + e⁶; the next is 2^-28 at most.
    const std::int64_t e_2 = e * e >> direction_fraction_bits;
    const std::int64_t e_4 = e_2 * e_2 >> direction_fraction_bits;
    const std::int64_t sum = e + e_2;
    return {t, sum + (sum * (e_2 + e_4) >> direction_fraction_bits)};
}

struct CrossedParticle {
    fixed::Vec3 movement;
    fixed::Vec3 across;
};

// Writes the particle's. `near` is half the direction before it, and becomes that behind.
LKS_FORCE_INLINE CrossedParticle cross_particle(ChainAcross& task, std::uint32_t i, fixed::Vec3& near) {
    const fixed::Vec3 far = half_direction(vector_at(task.directions, i));
    const Tangent tangent = tangent_between(near, far);
    const fixed::Vec3 before = vector_at(task.movements, i);
    const fixed::Vec3 wanted = vector_at(task.changes, i);
    const fixed::Vec3 v = wanted - before;
    // Twice v·t, and that over |t|².
    const std::int64_t product =
        8 * (share_32(v.x, tangent.t.x) + share_32(v.y, tangent.t.y) + share_32(v.z, tangent.t.z));
    const std::int64_t along = product + share_32(product, 4 * tangent.excess);
    const fixed::Vec3 kept{2 * share_32(along, tangent.t.x), 2 * share_32(along, tangent.t.y),
                           2 * share_32(along, tangent.t.z)};
    const CrossedParticle crossed{wanted - kept, v - kept};
    store(task.movements, i, crossed.movement);
    store(task.changes, i, crossed.across);
    near = far;
    return crossed;
}

// Whether the segment with this direction, between two particles, is left off its length.
LKS_FORCE_INLINE bool leaves_off(const ChainAcross& task, std::uint32_t segment, const fixed::Vec3& apart,
                                 const fixed::Vec3& changed) {
    const std::int64_t rest = task.rest_lengths[segment];
    if (!all_within(apart, rest >> turned_shift)) {
        return true;
    }
    if (all_within(changed, rest >> (error_shift + 1))) { // and so in any direction
        return false;
    }
    const fixed::Vec3 n = vector_at(task.directions, segment);
    const std::int64_t quarter =
        share_32(changed.x, n.x) + share_32(changed.y, n.y) + share_32(changed.z, n.z);
    return !within(quarter, rest >> (error_shift + 2));
}

fixed::Vec3 half_direction_before(const ChainAcross& task, std::uint32_t i) {
    return half_direction(
        {(task.directions[0] - 1)[i], (task.directions[1] - 1)[i], (task.directions[2] - 1)[i]});
}

} // namespace

void measure_segments_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        fixed::Vec3 d{};
        std::int64_t* const components[3] = {&d.x, &d.y, &d.z};
        for (int axis = 0; axis < 3; ++axis) {
            *components[axis] =
                fixed::wrapping_subtract(segments.points[axis][i + 1], segments.points[axis][i]);
        }
        fixed::NormalisedVector n{};
        static_cast<void>(measure_segment(d, n));
        segments.directions[0][i] = n.direction.x;
        segments.directions[1][i] = n.direction.y;
        segments.directions[2][i] = n.direction.z;
        segments.lengths[i] = n.length;
    }
}

void measure_turns_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count) {
    // So that the upper 32 bits of 62 are below 2^32.
    constexpr std::uint64_t below_two = (std::uint64_t{2} << cosine_fraction_bits) - (std::uint64_t{1} << 32);
    for (std::uint32_t i = first; i < first + count; ++i) {
        std::uint64_t squared = 0;
        std::int32_t next = 0;
        for (const auto& axis : segments.directions) {
            const auto b = static_cast<std::int32_t>(axis[i + 1]);
            const std::int64_t d = std::int64_t{static_cast<std::int32_t>(axis[i])} - std::int64_t{b};
            squared += static_cast<std::uint64_t>(d * d);
            next |= b;
        }
        segments.versines[i] = segments.lengths[i] == 0 || next == 0
                                   ? std::int64_t{1} << cosine_fraction_bits
                                   : static_cast<std::int64_t>(std::min(squared >> 1, below_two));
    }
}

bool measure_changes_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        const std::int64_t length = segments.lengths[i];
        const std::int64_t change = segments.rest_lengths[i] - length;
        if (change < -segments.slacks[i]) {
            return false;
        }
        const bool small = change <= length && length <= substep_motion_limit; // it is not below −length
        const std::int64_t most = std::min(length, substep_motion_limit);
        segments.changes[i] = (small ? change : std::clamp(change, -most, most)) >> side_shift;
    }
    return true;
}

void solve_rows_scalar(ChainRows& rows, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        const std::int64_t product = fixed::multiply_signed(2 * rows.sides[i], rows.ratios[i] << 32).hi;
        const int up = static_cast<int>(rows.shifts[i]) + side_shift - rows.exponent;
        if (up >= 0) {
            const std::int64_t limit = multiplier_limit >> up;
            rows.multipliers[i] = bounded(product, limit) * (std::int64_t{1} << up);
        } else {
            rows.multipliers[i] = bounded(product >> -up, multiplier_limit);
        }
    }
}

void move_chain_scalar(ChainMoves& moves, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        const std::int64_t weight = std::int64_t{moves.near.weights[i]} << 32;
        const int up = moves.exponent - 1 - static_cast<int>(moves.near.weight_shifts[i]);
        std::int64_t moved[3];
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t push = moves.pushes[axis][i] - moves.pushes[axis][i + 1];
            moved[axis] = fixed::multiply_signed(4 * push, weight).hi;
        }
        if (up >= 0) {
            const std::int64_t limit = substep_motion_limit >> up;
            for (int axis = 0; axis < 3; ++axis) {
                moves.movements[axis][i] = bounded(moved[axis], limit) * (std::int64_t{1} << up);
            }
        } else {
            const std::int64_t half = std::int64_t{1} << (-up - 1);
            for (int axis = 0; axis < 3; ++axis) {
                moves.movements[axis][i] = bounded((moved[axis] + half) >> -up, substep_motion_limit);
            }
        }
    }
}

void cross_particles_scalar(ChainAcross& task, std::uint32_t first, std::uint32_t count) {
    fixed::Vec3 near = half_direction_before(task, first);
    for (std::uint32_t i = first; i < first + count; ++i) {
        static_cast<void>(cross_particle(task, i, near));
    }
}

bool leaves_off_scalar(const ChainAcross& task, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
        if (leaves_off(task, i - 1, vector_at(task.movements, i) - vector_at(task.movements, i - 1),
                       vector_at(task.changes, i) - vector_at(task.changes, i - 1))) {
            return true;
        }
    }
    return false;
}

bool stretch_chain_scalar(ChainSegments& segments) {
    return measure_changes_scalar(segments, 0, segments.count);
}

void solve_chain_scalar(ChainRows& rows) {
    solve_rows_scalar(rows, 0, rows.count);
}

void measure_chain_scalar(ChainSegments& segments) {
    measure_segments_scalar(segments, 0, segments.count);
    measure_turns_scalar(segments, 0, segments.count);
}

void turn_chain_scalar(ChainRows& rows) {
    for (std::uint32_t i = 0; i < rows.count; ++i) {
        // s² = 2v − v², in 63 bits; then times w.
        const auto v = static_cast<std::uint64_t>(rows.versines[i]);
        const std::uint64_t s = (2 * v - (v >> 30) * (v >> 30)) << (chain_share_bits - cosine_fraction_bits);
        const std::uint64_t weight = rows.near.weights[i + 1];
        const std::uint64_t product = fixed::multiply_unsigned(s, weight << 32).hi;
        rows.turns[i] =
            static_cast<std::int64_t>(rows.softness + (product << 1 >> rows.near.weight_shifts[i + 1]));
    }
}

void divide_chain_scalar(ChainRows& rows) {
    for (std::uint32_t i = rows.count; i-- > 0;) {
        const auto scale = static_cast<std::uint64_t>(rows.scales[i]);
        const auto behind = static_cast<std::uint64_t>(rows.scales[i + 1]);
        const auto up = static_cast<int>(rows.shifts[i]);
        // 2^61 .. 2^63
        const std::uint64_t ratio =
            (behind >> 31) * fixed::reciprocal_mantissa(static_cast<std::uint32_t>(scale >> 31));
        rows.ratios[i] = static_cast<std::int64_t>(ratio >> 32);
        const int down = static_cast<int>(rows.near.weight_shifts[i]) + 3 - up;
        rows.shares[i] = static_cast<std::int64_t>(rows.near.weights[i] * (ratio >> 31) >> down);
        const auto x = static_cast<std::uint64_t>(rows.shares[i + 1]);
        const std::uint64_t v = static_cast<std::uint64_t>(rows.versines[i]) >> 29;
        rows.carried[i + 1] = static_cast<std::int64_t>((x - fixed::multiply_unsigned(2 * x, v << 32).hi)
                                                        << (carried_bits - chain_x_bits));
    }
}

void push_chain_scalar(ChainMoves& moves) {
    for (std::uint32_t i = 0; i < moves.count; ++i) {
        const std::int64_t multiplier = 4 * moves.multipliers[i];
        for (int axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<std::int32_t>(moves.directions[axis][i]);
            moves.pushes[axis][i + 1] = fixed::multiply_signed(multiplier, n * (std::int64_t{1} << 32)).hi;
        }
    }
    move_chain_scalar(moves, 0, moves.count);
}

bool stiffen_chain_scalar(ChainTensions& tensions) {
    std::int64_t any = 0;
    for (std::uint32_t i = 0; i < tensions.count; ++i) {
        const std::uint64_t tension = fixed::magnitude(tensions.tensions[i]);
        const auto kappa = static_cast<std::int64_t>(
            fixed::multiply_unsigned(tension, std::uint64_t{tensions.stiffness[i]} << 32).hi);
        const std::int64_t beyond = std::max<std::int64_t>(kappa - tensions.stable, 0);
        any |= beyond;
        tensions.near[i] = share_31(beyond, tensions.near_shares[i]);
        tensions.far[i] = share_31(beyond, tensions.far_shares[i]);
    }
    return any != 0;
}

void share_chain_scalar(ChainShares& shares) {
    for (std::uint32_t i = 0; i < shares.count; ++i) {
        const auto whole = static_cast<std::uint64_t>(shares.scales[i]);
        const auto part = static_cast<std::uint64_t>(shares.parts[i]);
        const int up = std::countl_zero(static_cast<std::uint32_t>(part >> 33) | 1) - 1;
        const std::uint64_t scale = whole >> 32;
        const std::uint64_t mantissa = part << up >> 32 | std::uint64_t{1} << 31;
        // Both by one reciprocal, of their product: 2^62 / scale is that of the product times the mantissa.
        const std::uint64_t product = scale * mantissa;
        const int double_up = std::countl_zero(product);
        const std::uint64_t y =
            std::uint64_t{fixed::reciprocal_mantissa(static_cast<std::uint32_t>(product << double_up >> 32))}
            << double_up;
        const std::uint64_t reciprocal = y - (y >> 32);
        shares.takes[i] = static_cast<std::int64_t>(((whole - part) >> 32) * (mantissa * reciprocal >> 32));
        shares.gives[i] = static_cast<std::int64_t>((static_cast<std::uint64_t>(shares.fars[i]) << up >> 32) *
                                                    (scale * reciprocal >> 32));
    }
}

bool cross_chain_scalar(ChainAcross& task) {
    fixed::Vec3 near = half_direction_before(task, 0);
    CrossedParticle before = cross_particle(task, 0, near);
    bool off = false;
    for (std::uint32_t i = 1; i < task.count; ++i) {
        const CrossedParticle crossed = cross_particle(task, i, near);
        off = off ||
              leaves_off(task, i - 1, crossed.movement - before.movement, crossed.across - before.across);
        before = crossed;
    }
    return off;
}

} // namespace lks
