// The steps of a rope's solve over lanes: kernels/chain_scalar.cpp, which measures groups in which a segment
// is not from 0.2 µm to 16 m long, or ends within rounding of a power of two, moves those in which a
// particle moves far, and takes the part across where the rope turns by much.
#pragma once

#include <algorithm>

#include "fixed/formats.h"
#include "kernels/chain_scalar.h"
#include "kernels/force_inline.h"
#include "kernels/leave_lanes.h"
#include "kernels/mantissa_lanes.h"

namespace lks {
namespace {

template <typename L>
class ChainLanes {
    using R = typename L::Register;

public:
    // Segments first .. first + L::half − 1. False: one has to be measured in plain integers, and nothing was
    // written.
    LKS_FORCE_INLINE static bool measure(ChainSegments& segments, std::uint32_t first) {
        R d[3];
        R size = L::set(0); // in the high halves
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t* const x = segments.points[axis] + first;
            d[axis] = L::subtract(L::load(x + 1), L::load(x));
            size = L::bit_or(size, L::exclusive_or(d[axis], L::template shift_right_32_signed<31>(d[axis])));
        }
        // The high half from 1 to 2^28 − 1.
        R outside = L::bit_and(L::add_32(size, L::set_32(-1)),
                               L::set(static_cast<std::int64_t>(std::uint64_t{0xf0000000} << 32)));
        const R shift = L::subtract(L::set(33), L::template shift_right<32>(L::leading_zeros_32(size)));
        const R half = L::shift_left_each(L::set(1), L::subtract(shift, L::set(1)));
        R squared = L::set(0);
        for (R& v : d) {
            v = L::shift_right_each(L::add(v, half), shift);
            // 2^31 would be read as −2^31; so would 2^31 of y.
            outside = L::bit_or(outside, L::equal_32(L::template shift_left<32>(v), L::set(INT64_MIN)));
            squared = L::add(squared, L::multiply_signed(v, v));
        }
        // 1 where the upper two bits are clear, or else 0.
        const R up = L::bit_and(L::equal(L::template shift_right<62>(squared), L::set(0)), L::set(1));
        const R m = L::shift_left_each(squared, L::add(up, up));
        const R y = MantissaLanes<L>::reciprocal_sqrt(L::template shift_right<32>(m));
        outside = L::bit_or(outside, L::bit_and(L::template shift_left<32>(y), L::set(INT64_MIN)));
        if (L::any(L::bit_and(outside, L::set(high_halves)))) {
            return false;
        }
        const R down = L::subtract(L::set(32), up);
        const R direction_half = L::shift_left_each(L::set(1), L::subtract(L::set(31), up));
        for (int axis = 0; axis < 3; ++axis) {
            L::store(segments.directions[axis] + first,
                     L::shift_right_each(L::add(L::multiply_signed(d[axis], y), direction_half), down));
        }
        // m·y / 2^32
        const R root = L::add(L::multiply_unsigned(L::template shift_right<32>(m), y),
                              L::template shift_right<32>(L::multiply_unsigned(m, y)));
        const R length_shift = L::subtract(L::add(L::set(30), up), shift);
        const R length_half = L::shift_left_each(L::set(1), L::subtract(length_shift, L::set(1)));
        L::store(segments.lengths + first, L::shift_right_each(L::add(root, length_half), length_shift));
        return true;
    }

    // False: one of them is folded back, and nothing was written.
    LKS_FORCE_INLINE static bool turn(ChainSegments& segments, std::uint32_t first) {
        R squared = L::set(0);
        for (const auto& axis : segments.directions) {
            const R difference = L::subtract(L::load(axis + first), L::load(axis + first + 1));
            squared = L::add(squared, L::multiply_signed(difference, difference));
        }
        const R versine = L::template shift_right<1>(squared);
        // A difference of 2^31 + 1, as rounding makes it, is read as one of 2^31 − 1: nearly two even so.
        const R two = L::set((std::int64_t{2} << cosine_fraction_bits) - (std::int64_t{1} << 32));
        if (L::any(L::bit_and(L::subtract(two, versine), L::set(INT64_MIN)))) {
            return false;
        }
        L::store(segments.versines + first, versine);
        return true;
    }

    // False: one of them is torn or a change might be too large, and nothing was written.
    LKS_FORCE_INLINE static bool stretch(ChainSegments& segments, std::uint32_t first) {
        const R length = L::load(segments.lengths + first);
        const R change = L::subtract(L::load(segments.rest_lengths + first), length);
        const R beyond = L::bit_or(
            L::bit_or(L::add(L::load(segments.slacks + first), change), L::subtract(length, change)),
            L::subtract(L::set(substep_motion_limit), length));
        if (L::sign_bits(beyond) != 0) {
            return false;
        }
        L::store(segments.changes + first,
                 L::subtract(L::template shift_right<side_shift>(L::add(change, L::set(lift))),
                             L::set(lift >> side_shift)));
        return true;
    }

    LKS_FORCE_INLINE static void turn_row(ChainRows& rows, std::uint32_t i) {
        const R v = L::load(rows.versines + i);
        const R part = L::template shift_right<30>(v);
        const R s = L::template shift_left<chain_share_bits - cosine_fraction_bits>(
            L::subtract(L::add(v, v), L::multiply_unsigned(part, part)));
        const R weight = L::load_widened(rows.near.weights + i + 1);
        const R product = L::add(L::multiply_unsigned(L::template shift_right<32>(s), weight),
                                 L::template shift_right<32>(L::multiply_unsigned(s, weight)));
        const R shares =
            L::shift_right_each(L::add(product, product), L::load_widened(rows.near.weight_shifts + i + 1));
        L::store(rows.turns + i, L::add(shares, L::set(static_cast<std::int64_t>(rows.softness))));
    }

    LKS_FORCE_INLINE static void divide_row(ChainRows& rows, std::uint32_t i) {
        const R y = MantissaLanes<L>::reciprocal(L::template shift_right<31>(L::load(rows.scales + i)));
        const R ratio = L::multiply_unsigned(L::template shift_right<31>(L::load(rows.scales + i + 1)), y);
        const R up = L::load(rows.shifts + i);
        L::store(rows.ratios + i, L::template shift_right<32>(ratio));
        const R share =
            L::multiply_unsigned(L::template shift_right<31>(ratio), L::load_widened(rows.near.weights + i));
        const R down = L::add(L::load_widened(rows.near.weight_shifts + i), L::set(3));
        L::store(rows.shares + i, L::shift_right_each(share, L::subtract(down, up)));
    }

    LKS_FORCE_INLINE static void carry_row(ChainRows& rows, std::uint32_t i) {
        const R x = L::load(rows.shares + i + 1);
        const R v = L::template shift_right<29>(L::load(rows.versines + i));
        const R turned = share_31(x, v);
        L::store(rows.carried + i + 1,
                 L::template shift_left<carried_bits - chain_x_bits>(L::subtract(x, turned)));
    }

    // False: one of them might be too large, and nothing was written.
    LKS_FORCE_INLINE static bool solve(ChainRows& rows, std::uint32_t i) {
        const R side = L::load(rows.sides + i);
        const R ratio = L::load(rows.ratios + i);
        const R low = L::multiply_unsigned(L::bit_and(side, L::set(low_31)), ratio);
        const R product = L::add(L::multiply_signed(L::template shift_right<31>(side), ratio),
                                 L::template shift_right<31>(low));
        const R up = L::add(L::load(rows.shifts + i), L::set(side_shift + 64 - rows.exponent));
        const R right = L::subtract(L::set(64), L::minimum_32(up, L::set(64)));
        const R left = L::subtract(L::add(up, right), L::set(64));
        const R limit = L::shift_right_each(L::set(multiplier_limit), left);
        const R lifted = L::shift_right_each(L::add(product, L::set(lift)), right);
        const R solved = L::subtract(lifted, L::shift_right_each(L::set(lift), right));
        if (L::sign_bits(L::bit_or(L::add(limit, solved), L::subtract(limit, solved))) != 0) {
            return false;
        }
        L::store(rows.multipliers + i, L::shift_left_each(solved, left));
        return true;
    }

    LKS_FORCE_INLINE static void push(ChainMoves& moves, std::uint32_t i) {
        const R multiplier = L::load(moves.multipliers + i);
        const R high = L::template shift_right<30>(multiplier);
        const R low = L::bit_and(multiplier, L::set(low_30));
        for (int axis = 0; axis < 3; ++axis) {
            const R n = L::load(moves.directions[axis] + i);
            L::store(moves.pushes[axis] + i + 1,
                     L::add(L::multiply_signed(high, n), signed_upper(L::multiply_signed(low, n))));
        }
    }

    // False: one of them might move too far, and nothing was written.
    LKS_FORCE_INLINE static bool move(ChainMoves& moves, std::uint32_t i) {
        const R weight = L::load_widened(moves.near.weights + i);
        const R up =
            L::subtract_32(L::set(moves.exponent - 1), L::load_widened(moves.near.weight_shifts + i));
        const R less = L::minimum_32(up, L::set(0));
        const R left = L::subtract_32(up, less);
        const R right = L::subtract_32(L::set(0), less);
        const R limit = L::shift_right_each(L::set(substep_motion_limit), left);
        const R before =
            L::add(L::template shift_right<1>(L::shift_left_each(L::set(1), right)), L::set(lift));
        const R after = L::shift_right_each(L::set(lift), right);
        R beyond = L::set(0);
        R movements[3];
        for (int axis = 0; axis < 3; ++axis) {
            const R pushed =
                L::subtract(L::load(moves.pushes[axis] + i), L::load(moves.pushes[axis] + i + 1));
            const R low = L::multiply_unsigned(L::bit_and(pushed, L::set(low_30)), weight);
            const R moved = L::add(L::multiply_signed(L::template shift_right<30>(pushed), weight),
                                   L::template shift_right<30>(low));
            const R shifted = L::subtract(L::shift_right_each(L::add(moved, before), right), after);
            beyond = L::bit_or(beyond, L::bit_or(L::add(limit, shifted), L::subtract(limit, shifted)));
            movements[axis] = L::shift_left_each(shifted, left);
        }
        if (L::sign_bits(beyond) != 0) {
            return false;
        }
        for (int axis = 0; axis < 3; ++axis) {
            L::store(moves.movements[axis] + i, movements[axis]);
        }
        return true;
    }

    LKS_FORCE_INLINE static R stiffen(ChainTensions& tensions, std::uint32_t i) {
        const R tension = L::load(tensions.tensions + i);
        const R size = L::select_by_sign(tension, L::subtract(L::set(0), tension), tension);
        const R stiffness = L::load_widened(tensions.stiffness + i);
        const R kappa = L::add(L::multiply_unsigned(L::template shift_right<32>(size), stiffness),
                               L::template shift_right<32>(L::multiply_unsigned(size, stiffness)));
        const R excess = L::subtract(kappa, L::set(tensions.stable));
        const R beyond = L::select_by_sign(excess, L::set(0), excess);
        L::store(tensions.near + i, share_31(beyond, L::load_widened(tensions.near_shares + i)));
        L::store(tensions.far + i, share_31(beyond, L::load_widened(tensions.far_shares + i)));
        return beyond;
    }

    LKS_FORCE_INLINE static void share(ChainShares& shares, std::uint32_t i) {
        const R whole = L::load(shares.scales + i);
        const R part = L::load(shares.parts + i);
        // As of numbers whose sign bit is clear, in the high halves.
        const R high = L::bit_or(L::template shift_right<1>(part), L::set(std::int64_t{1} << 32));
        const R up = L::subtract(L::template shift_right<32>(L::leading_zeros_32(high)), L::set(1));
        const R scale = L::template shift_right<32>(whole);
        const R mantissa = L::bit_or(L::template shift_right<32>(L::shift_left_each(part, up)),
                                     L::set(std::int64_t{1} << 31));
        const R product = L::multiply_unsigned(scale, mantissa);
        const R y = MantissaLanes<L>::reciprocal(
            L::template shift_right<32>(L::select_by_sign(L::add(product, product), product, product)));
        const R up_y = L::select_by_sign(L::add(y, y), y, product);
        const R inverse = L::subtract(up_y, L::template shift_right<32>(up_y));
        const R rest = L::template shift_right<32>(L::subtract(whole, part));
        const R far = L::template shift_right<32>(L::shift_left_each(L::load(shares.fars + i), up));
        L::store(shares.takes + i, L::multiply_unsigned(rest, L::template shift_right<32>(
                                                                  L::multiply_unsigned(mantissa, inverse))));
        L::store(shares.gives + i, L::multiply_unsigned(far, L::template shift_right<32>(
                                                                 L::multiply_unsigned(scale, inverse))));
    }

    // False: the rope turns by much at one of them, and nothing was written.
    LKS_FORCE_INLINE static bool cross(ChainAcross& task, std::uint32_t i) {
        R t[3];
        R squared = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t* const n = task.directions[axis] + i;
            t[axis] = L::add_32(L::template shift_right_32_signed<1>(L::load(n)),
                                L::template shift_right_32_signed<1>(L::load(n - 1)));
            squared = L::add(squared, L::multiply_signed(t[axis], t[axis]));
        }
        const R lifted =
            L::template shift_right<30>(L::subtract(L::set(tangent_one + (greatest_turn << 30)), squared));
        if (L::any(L::template shift_right<greatest_turn_bits + 1>(lifted))) {
            return false;
        }
        const R e = L::subtract(lifted, L::set(greatest_turn));
        const R e_2 = L::template shift_right<30>(L::multiply_signed(e, e));
        const R e_4 = L::template shift_right<30>(L::multiply_signed(e_2, e_2));
        const R sum = L::add(e, e_2);
        const R excess = L::add(sum, signed_upper(L::multiply_signed(sum, L::add(e_2, e_4))));
        R v[3];
        R product = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            v[axis] = L::subtract(L::load(task.changes[axis] + i), L::load(task.movements[axis] + i));
            product = L::add(product, share_32(v[axis], t[axis]));
        }
        product = L::template shift_left<3>(product);
        const R along = L::add(product, share_32(product, L::template shift_left<2>(excess)));
        for (int axis = 0; axis < 3; ++axis) {
            const R half = share_32(along, t[axis]);
            const R across = L::subtract(v[axis], L::add(half, half));
            std::int64_t* const to = task.movements[axis] + i;
            L::store(to, L::add(L::load(to), across));
            L::store(task.changes[axis] + i, across);
        }
        return true;
    }

    // Whether one of them may be left off its length: between particle i and the one before, and so on.
    LKS_FORCE_INLINE static bool may_leave_off(const ChainAcross& task, std::uint32_t i) {
        const R rest = L::load(task.rest_lengths + i - 1);
        const R apart_limit = L::template shift_right<turned_shift>(rest);
        const R change_limit = L::template shift_right<error_shift + 1>(rest);
        R beyond = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t* const movements = task.movements[axis] + i;
            const std::int64_t* const changes = task.changes[axis] + i;
            const R apart = L::subtract(L::load(movements), L::load(movements - 1));
            const R changed = L::subtract(L::load(changes), L::load(changes - 1));
            beyond =
                L::bit_or(beyond, L::bit_or(L::add(apart_limit, apart), L::subtract(apart_limit, apart)));
            beyond = L::bit_or(beyond,
                               L::bit_or(L::add(change_limit, changed), L::subtract(change_limit, changed)));
        }
        return L::sign_bits(beyond) != 0;
    }

private:
    static constexpr std::int64_t high_halves = -(std::int64_t{1} << 32);
    static constexpr std::int64_t low_30 = (std::int64_t{1} << 30) - 1;
    static constexpr std::int64_t low_31 = (std::int64_t{1} << 31) - 1;
    // What makes numbers positive for a shift without a sign.
    static constexpr std::int64_t lift = std::int64_t{1} << 62;

    // v / 2^30, rounded down.
    LKS_FORCE_INLINE static R signed_upper(R v) {
        return L::subtract(L::template shift_right<30>(L::add(v, L::set(lift))), L::set(lift >> 30));
    }

    // a·b / 2^32, rounded down; of b the low half counts.
    LKS_FORCE_INLINE static R share_32(R a, R b) {
        const R high = L::template shift_right<32>(L::add(a, L::set(std::int64_t{1} << 31)));
        const R low = L::template shift_right<32>(L::add(L::multiply_signed(a, b), L::set(lift)));
        return L::add(L::multiply_signed(high, b), L::subtract(low, L::set(lift >> 32)));
    }

    // a·b / 2^31 of what is not negative, rounded down.
    LKS_FORCE_INLINE static R share_31(R a, R b) {
        return L::add(L::multiply_unsigned(L::template shift_right<31>(a), b),
                      L::template shift_right<31>(L::multiply_unsigned(L::bit_and(a, L::set(low_31)), b)));
    }
};

template <typename L>
inline void measure_chain_lanes(ChainSegments& segments) {
    const std::uint32_t count = segments.count;
    if (count < L::half) {
        measure_chain_scalar(segments);
        return;
    }
    // The last group begins early enough to be whole.
    bool plain = false; // some may have no direction
    for (std::uint32_t i = 0; i < count; i += L::half) {
        const std::uint32_t first = i < count - L::half ? i : count - L::half;
        if (!ChainLanes<L>::measure(segments, first)) {
            measure_segments_scalar(segments, first, L::half);
            plain = true;
        }
    }
    for (std::uint32_t i = 0; i < count; i += L::half) {
        const std::uint32_t first = i < count - L::half ? i : count - L::half;
        if (!ChainLanes<L>::turn(segments, first)) {
            measure_turns_scalar(segments, first, L::half);
        }
    }
    if (plain) {
        measure_turns_scalar(segments, 0, count);
    } else if ((segments.directions[0][count] | segments.directions[1][count] |
                segments.directions[2][count]) == 0) {
        measure_turns_scalar(segments, count - 1, 1);
    }
}

// Those below run over the end by less than a group: chain_padding.

template <typename L>
inline void turn_chain_lanes(ChainRows& rows) {
    for (std::uint32_t i = 0; i < rows.count; i += L::half) {
        ChainLanes<L>::turn_row(rows, i);
    }
}

// From the far end on: what was written last is not read as part of a group before it has come to memory.
template <typename L, typename Use>
LKS_FORCE_INLINE void each_group_back(std::uint32_t count, const Use& use) {
    for (std::uint32_t i = (count + L::half - 1) / L::half * L::half; i > 0;) {
        i -= L::half;
        use(i);
    }
}

template <typename L>
inline void divide_chain_lanes(ChainRows& rows) {
    const std::int64_t given = rows.shares[rows.count];
    each_group_back<L>(rows.count, [&](std::uint32_t i) { ChainLanes<L>::divide_row(rows, i); });
    rows.shares[rows.count] = given;
    each_group_back<L>(rows.count, [&](std::uint32_t i) { ChainLanes<L>::carry_row(rows, i); });
}

template <typename L>
inline bool stretch_chain_lanes(ChainSegments& segments) {
    for (std::uint32_t i = 0; i < segments.count; i += L::half) {
        if (!ChainLanes<L>::stretch(segments, i) &&
            !measure_changes_scalar(segments, i, std::min(L::half, segments.count - i))) {
            return false;
        }
    }
    return true;
}

template <typename L>
inline void solve_chain_lanes(ChainRows& rows) {
    each_group_back<L>(rows.count, [&](std::uint32_t i) {
        if (!ChainLanes<L>::solve(rows, i)) {
            solve_rows_scalar(rows, i, std::min(L::half, rows.count - i));
        }
    });
}

template <typename L>
inline void push_chain_lanes(ChainMoves& moves) {
    for (std::uint32_t i = 0; i < moves.count; i += L::half) {
        ChainLanes<L>::push(moves, i);
    }
    for (std::uint32_t i = 0; i < moves.count; i += L::half) {
        if (!ChainLanes<L>::move(moves, i)) {
            move_chain_scalar(moves, i, std::min(L::half, moves.count - i));
        }
    }
}

template <typename L>
inline bool stiffen_chain_lanes(ChainTensions& tensions) {
    typename L::Register any = L::set(0);
    for (std::uint32_t i = 0; i < tensions.count; i += L::half) {
        any = L::bit_or(any, ChainLanes<L>::stiffen(tensions, i));
    }
    return L::any(any);
}

template <typename L>
inline void share_chain_lanes(ChainShares& shares) {
    each_group_back<L>(shares.count, [&](std::uint32_t i) { ChainLanes<L>::share(shares, i); });
}

template <typename L>
inline bool cross_chain_lanes(ChainAcross& task) {
    for (std::uint32_t i = 0; i < task.count; i += L::half) {
        if (!ChainLanes<L>::cross(task, i)) {
            cross_particles_scalar(task, i, std::min(L::half, task.count - i));
        }
    }
    bool off = false;
    for (std::uint32_t i = 1; i < task.count && !off; i += L::half) {
        off = ChainLanes<L>::may_leave_off(task, i) &&
              leaves_off_scalar(task, i, std::min(L::half, task.count - i));
    }
    return off;
}

template <typename L>
constexpr ChainKernels chain_lanes() {
    return {measure_chain_lanes<L>, stretch_chain_lanes<L>, turn_chain_lanes<L>,
            divide_chain_lanes<L>,  solve_chain_lanes<L>,   push_chain_lanes<L>,
            stiffen_chain_lanes<L>, share_chain_lanes<L>,   cross_chain_lanes<L>};
}

// With registers left as leave_lanes.h says.
template <typename L>
constexpr ChainKernels leaving_chain_lanes() {
    return {leaving<L, measure_chain_lanes<L>, ChainSegments&>,
            leaving<L, stretch_chain_lanes<L>, ChainSegments&>,
            leaving<L, turn_chain_lanes<L>, ChainRows&>,
            leaving<L, divide_chain_lanes<L>, ChainRows&>,
            leaving<L, solve_chain_lanes<L>, ChainRows&>,
            leaving<L, push_chain_lanes<L>, ChainMoves&>,
            leaving<L, stiffen_chain_lanes<L>, ChainTensions&>,
            leaving<L, share_chain_lanes<L>, ChainShares&>,
            leaving<L, cross_chain_lanes<L>, ChainAcross&>};
}

} // namespace
} // namespace lks
