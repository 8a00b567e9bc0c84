// A range of one batch, groups of 2·L::half constraints at a time: kernels/distance_scalar.h over lanes.
//
// L is one instruction set: registers of L::half 64-bit lanes and a few operations on them. A group of
// constraints is two registers of coordinates, A and B; what is 32 bits wide is kept in one register, A's in
// the even halves and B's in the odd ones, where 32×32→64 multiplications find it. Some groups go through
// each stage together (differences, corrections, movements): a group's steps wait for each other, and the
// steps of its neighbours fill the time. A group in which a lane leaves the fast range (an edge 2^30 units
// long, or shorter than 2^16) is projected in plain integers, which gives the same bits.
#pragma once

#include "kernels/distance_scalar_loop.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

template <typename L>
struct Group {
    typename L::Register a, b;
};

template <typename L>
struct LaneValues {
    LKS_FORCE_INLINE explicit LaneValues(const Group<L>& group) {
        L::store(values, group.a);
        L::store(values + L::half, group.b);
    }
    std::int64_t values[2 * L::half];
};

// All bits in the first lanes that are loaded from widest_group on, and none before and behind.
constexpr std::int64_t lane_bits[3 * widest_group] = {0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,
                                                      0,  0,  0,  0,  0,  -1, -1, -1, -1, -1, -1,
                                                      -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

// A stretch in which both ends advance by one.
template <typename L>
struct RunAccess {
    static constexpr std::uint32_t together = L::together;
    static constexpr bool whole = true;

    std::uint32_t constraint;
    std::uint32_t a;
    std::uint32_t b;

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t lane = 0; lane < 2 * L::half; ++lane) {
            use(constraint + lane, a + lane, b + lane);
        }
    }

    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::load(x + a), L::load(x + a + L::half)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::load(x + b), L::load(x + b + L::half)};
    }
    // x_a += plus_a, x_b −= minus_b.
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        const Group<L> at_a = load_a(x);
        const Group<L> at_b = load_b(x);
        L::store(x + a, L::add(at_a.a, plus_a.a));
        L::store(x + a + L::half, L::add(at_a.b, plus_a.b));
        L::store(x + b, L::subtract(at_b.a, minus_b.a));
        L::store(x + b + L::half, L::subtract(at_b.b, minus_b.b));
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        return {L::load(values + constraint), L::load(values + constraint + L::half)};
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        L::store(values + constraint, group.a);
        L::store(values + constraint + L::half, group.b);
    }
    LKS_FORCE_INLINE Group<L> load(const std::uint32_t* values) const {
        return {L::load_widened(values + constraint), L::load_widened(values + constraint + L::half)};
    }
};

// `count` lanes from `first` on of a stretch; the others are not part of it, and do not move.
template <typename L>
struct PartialAccess {
    static constexpr std::uint32_t together = L::together;
    static constexpr bool whole = false;

    RunAccess<L> run;
    std::uint32_t first;
    std::uint32_t count;
    // Whether the particles of the other lanes may be read, and written as they are.
    bool loads_whole;
    bool stores_whole;

    LKS_FORCE_INLINE Group<L> masked(const Group<L>& values) const {
        const std::int64_t* bits = lane_bits + (first == 0 ? 2 * widest_group - count : widest_group - first);
        return {L::bit_and(values.a, L::load(bits)), L::bit_and(values.b, L::load(bits + L::half))};
    }
    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return loads_whole ? run.load_a(x) : load_lanes(x + run.a);
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return loads_whole ? run.load_b(x) : load_lanes(x + run.b);
    }
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        if (stores_whole) {
            run.move(x, plus_a, minus_b);
            return;
        }
        const LaneValues<L> a(plus_a);
        const LaneValues<L> b(minus_b);
        for (std::uint32_t lane = first; lane < first + count; ++lane) {
            x[run.a + lane] = wrapping_add(x[run.a + lane], a.values[lane]);
            x[run.b + lane] = wrapping_subtract(x[run.b + lane], b.values[lane]);
        }
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        return load_lanes(values + run.constraint);
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        store_lanes(values + run.constraint, group);
    }
    LKS_FORCE_INLINE Group<L> load(const std::uint32_t* values) const { return run.load(values); }

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t lane = first; lane < first + count; ++lane) {
            use(run.constraint + lane, run.a + lane, run.b + lane);
        }
    }

private:
    Group<L> load_lanes(const std::int64_t* x) const {
        std::int64_t values[2 * L::half] = {};
        for (std::uint32_t lane = first; lane < first + count; ++lane) {
            values[lane] = x[lane];
        }
        return {L::load(values), L::load(values + L::half)};
    }
    void store_lanes(std::int64_t* x, const Group<L>& group) const {
        const LaneValues<L> lanes(group);
        for (std::uint32_t lane = first; lane < first + count; ++lane) {
            x[lane] = lanes.values[lane];
        }
    }
};

// Constraints that follow each other in the batch, with ends anywhere; lanes from `count` on repeat the first
// one and are not stored.
template <typename L>
struct SinglesAccess {
    static constexpr std::uint32_t lanes = 2 * L::half;
    static constexpr std::uint32_t together = L::singles_together;
    static constexpr bool whole = true;

    std::uint32_t constraint;
    std::uint32_t count;
    Constraint ends[lanes];

    void take(const Constraint* constraints, std::uint32_t first, std::uint32_t number) {
        constraint = first;
        count = number;
        for (std::uint32_t i = 0; i < lanes; ++i) {
            ends[i] = constraints[first + (i < number ? i : 0)];
        }
    }
    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            use(constraint + i, ends[i].a, ends[i].b);
        }
    }

    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::gather(x, &ends[0].a), L::gather(x, &ends[L::half].a)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::gather(x, &ends[0].b), L::gather(x, &ends[L::half].b)};
    }
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        const LaneValues<L> a(plus_a);
        const LaneValues<L> b(minus_b);
        for (std::uint32_t i = 0; i < count; ++i) {
            x[ends[i].a] = wrapping_add(x[ends[i].a], a.values[i]);
            x[ends[i].b] = wrapping_subtract(x[ends[i].b], b.values[i]);
        }
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        std::int64_t parts[lanes] = {};
        for (std::uint32_t i = 0; i < count; ++i) {
            parts[i] = values[constraint + i];
        }
        return {L::load(parts), L::load(parts + L::half)};
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        const LaneValues<L> parts(group);
        for (std::uint32_t i = 0; i < count; ++i) {
            values[constraint + i] = parts.values[i];
        }
    }
    LKS_FORCE_INLINE Group<L> load(const std::uint32_t* values) const {
        return {L::load_widened(values + constraint), L::load_widened(values + constraint + L::half)};
    }
};

// 1/√m for 32-bit lanes whose even and odd halves are also given by themselves, low in 64 bits:
// fixed/projection_reciprocal_sqrt.h.
template <typename L>
LKS_FORCE_INLINE typename L::Register
reciprocal_sqrt_lanes(typename L::Register even, typename L::Register odd, typename L::Register m) {
    using R = typename L::Register;
    // Aligned, with the leading bit replaced by the octave.
    const R aligned = L::select_by_sign_32(L::add_32(m, L::add_32(m, L::set_32(INT32_MIN))), m, m);
    const R segment = L::template shift_right_32<29>(aligned);
    const R c0_c1 = L::lookup(fixed::projection_seeds.c0_c1, segment);
    const R c2_c3 = L::lookup(fixed::projection_seeds.c2_c3, segment);
    // t in the high 16 bits, and something else in the low ones.
    const R high_t = L::exclusive_or(L::template shift_left_32<3>(aligned), L::set_32(INT32_MIN));
    const R t = L::template shift_right_32<16>(high_t);
    const R quadratic =
        L::add_16(c2_c3, L::template shift_right_32<16>(L::rounding_multiply_16(high_t, c2_c3)));
    const R slope = L::add_16(L::template shift_right_32<16>(c0_c1), L::rounding_multiply_16(t, quadratic));
    const R correction = L::template shift_right_16_signed<3>(L::rounding_multiply_16(t, slope));
    const R y0 = L::bit_and(L::add_16(c0_c1, correction), L::set_32(0xffff));
    const R y0_squared = L::multiply_low_32(y0, y0);
    const R e =
        L::subtract_32(L::high_halves(L::multiply_unsigned(even, y0_squared),
                                      L::multiply_unsigned(odd, L::template shift_right<32>(y0_squared))),
                       L::set_32(1 << 30));
    const R step = L::multiply_low_32(y0, L::template shift_right_32_signed<1>(e));
    return L::subtract_32(L::template shift_left_32<15>(y0),
                          L::template shift_right_32_signed<15>(L::add_32(step, L::set_32(1 << 14))));
}

// value · 2^-count with its sign, rounded down after `rounding` was added; |value| < 2^62. Where there is no
// such shift the value is made positive, and back.
template <typename L>
class SignedShift {
    using R = typename L::Register;

public:
    explicit SignedShift(int count, std::int64_t rounding = 0)
        : count_(L::make_shift(count)), before_(L::set(rounding + lift)), after_(L::set(lift >> count)) {}

    LKS_FORCE_INLINE R operator()(R value) const {
        const R lifted = L::add(value, before_);
        if constexpr (L::has_signed_shift) {
            return L::shift_right_signed(lifted, count_);
        } else {
            return L::subtract(L::shift_right(lifted, count_), after_);
        }
    }

private:
    static constexpr std::int64_t lift = L::has_signed_shift ? 0 : std::int64_t{1} << 62;

    typename L::Shift count_;
    R before_;
    R after_;
};

// Of a group's squared lengths u.
template <typename L>
struct LengthLanes {
    Group<L> twice_k;
    Group<L> m; // Q2.30, low in each lane
    Group<L> y; // low in each lane, with something else above it
};

// A group between the stages.
template <typename L>
struct StagedGroup {
    bool plain; // a lane leaves the fast range
    Group<L> d[3];
    Group<L> u;
    Group<L> motion; // u − d·(d at the start of the substep), where there is damping
    Group<L> f;
};

template <typename L, bool equal_shares, bool soft, bool damped, bool multiplier>
class DistanceGroups {
    using R = typename L::Register;
    using G = Group<L>;
    using Lengths = LengthLanes<L>;

public:
    explicit DistanceGroups(const DistanceTask& task)
        : task_(task), shift_(L::make_shift(task.parameters.difference_shift)),
          gain_shift_(task.parameters.gain_shift),
          rounded_gain_shift_(task.parameters.gain_shift,
                              std::int64_t{1} << (task.parameters.gain_shift - 1)),
          low_gain_shift_(L::make_shift(task.parameters.gain_shift - 31)),
          product_shift_(
              task.parameters.product_shift,
              task.parameters.product_shift > 0 ? std::int64_t{1} << (task.parameters.product_shift - 1) : 0),
          plain_(task.parameters.product_shift == 0), bias_(bias(task)),
          ratio_shift_(L::set(32 + task.parameters.rest_exponent)),
          gain_rounding_(L::set(std::int64_t{1} << (task.parameters.gain_shift - 1))),
          error_share_(L::set(task.parameters.error_share)),
          damping_share_(L::set(task.parameters.damping_share)),
          length_shift_(L::set(30 - task.parameters.difference_shift)), axes_{task.arrays.x, task.arrays.y,
                                                                              task.arrays.z},
          starts_{task.arrays.start_x, task.arrays.start_y, task.arrays.start_z} {}

    template <typename Access>
    LKS_FORCE_INLINE void find_differences(const Access& at, StagedGroup<L>& group) const {
        R beyond = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            group.d[axis] = difference(at, axes_[axis], beyond);
        }
        group.u = dot_product(group.d, group.d);
        const R high_u = L::high_halves(group.u.a, group.u.b);
        R outside = L::equal_32(high_u, L::set_32(0));
        if constexpr (damped) {
            G start[3];
            for (int axis = 0; axis < 3; ++axis) {
                start[axis] = difference(at, starts_[axis], beyond);
            }
            const G product = dot_product(group.d, start);
            group.motion = {L::subtract(group.u.a, product.a), L::subtract(group.u.b, product.b)};
            outside = L::bit_or(outside, exceeds(L::high_halves(group.motion.a, group.motion.b), high_u));
        }
        if constexpr (!Access::whole) {
            const G mask = at.masked({L::set(-1), L::set(-1)});
            outside = L::bit_and(outside, L::high_halves(mask.a, mask.b));
        }
        group.plain = L::any(L::bit_or(outside, L::bit_and(beyond, L::set(~std::int64_t{INT32_MAX}))));
    }

    template <typename Access>
    LKS_FORCE_INLINE void find_correction(const Access& at, StagedGroup<L>& group) const {
        const Lengths lengths = measure(group.u);
        group.f = relative_error(lengths, at.load(task_.rest_mantissas));
        if constexpr (soft && (damped || multiplier)) {
            group.plain = !soften(at, group, lengths, group.f) || group.plain;
        }
        if constexpr (multiplier) {
            if (!group.plain) {
                add_to_multipliers(at, lengths, group.f);
            }
        }
    }

    template <typename Access>
    LKS_FORCE_INLINE void move(const Access& at, const StagedGroup<L>& group) const {
        const G share_a = at.load(task_.shares_a);
        if constexpr (equal_shares) {
            move_alike(at, group.d, group.f, share_a);
        } else {
            const G share_b = at.load(task_.shares_b);
            const G alike{L::equal(share_a.a, share_b.a), L::equal(share_a.b, share_b.b)};
            if (L::all(L::bit_and(alike.a, alike.b))) {
                move_alike(at, group.d, group.f, share_a);
            } else {
                move_by_share(at, group.d, group.f, share_a, share_b, alike);
            }
        }
    }

private:
    // Half a unit to round, and what makes 2^30 units positive.
    static R bias(const DistanceTask& task) {
        return L::set((std::int64_t{1} << (task.parameters.difference_shift - 1)) +
                      (std::int64_t{1} << (task.parameters.difference_shift + 30)));
    }

    // x_a − x_b in difference units.
    template <typename Access>
    LKS_FORCE_INLINE G difference(const Access& at, const std::int64_t* x, R& beyond) const {
        const G a = at.load_a(x);
        const G b = at.load_b(x);
        G wide{L::subtract(a.a, b.a), L::subtract(a.b, b.b)};
        if constexpr (!Access::whole) {
            wide = at.masked(wide);
        }
        return narrow(wide, beyond);
    }

    // In difference units, within ±2^30; else bits above the 31st of `beyond` are set.
    LKS_FORCE_INLINE G narrow(const G& wide, R& beyond) const {
        const R a = L::shift_right(L::add(wide.a, bias_), shift_);
        const R b = L::shift_right(L::add(wide.b, bias_), shift_);
        beyond = L::bit_or(beyond, L::bit_or(a, b));
        return {L::subtract(a, L::set(direction_one)), L::subtract(b, L::set(direction_one))};
    }

    // The sign bit of 32-bit lanes in which |motion| might exceed u, from the high halves of both.
    LKS_FORCE_INLINE static R exceeds(R high_motion, R high_u) {
        const R below = L::add_32(high_u, high_motion);
        const R above = L::subtract_32(L::add_32(high_u, L::set_32(-1)), high_motion);
        return L::bit_and(L::bit_or(below, above), L::set_32(INT32_MIN));
    }

    LKS_FORCE_INLINE static G dot_product(const G* v, const G* w) {
        const auto sum = [](R x, R y, R z) { return L::add(L::add(x, y), z); };
        return {sum(L::multiply_signed(v[0].a, w[0].a), L::multiply_signed(v[1].a, w[1].a),
                    L::multiply_signed(v[2].a, w[2].a)),
                sum(L::multiply_signed(v[0].b, w[0].b), L::multiply_signed(v[1].b, w[1].b),
                    L::multiply_signed(v[2].b, w[2].b))};
    }

    LKS_FORCE_INLINE static Lengths measure(const G& u) {
        Lengths lengths;
        const R twice_k = L::bit_and(L::leading_zeros_32(L::high_halves(u.a, u.b)), L::set_32(~1));
        lengths.twice_k = {L::bit_and(twice_k, L::set(UINT32_MAX)), L::template shift_right<32>(twice_k)};
        const G aligned{L::shift_left_each(u.a, lengths.twice_k.a),
                        L::shift_left_each(u.b, lengths.twice_k.b)};
        lengths.m = {L::template shift_right<32>(aligned.a), L::template shift_right<32>(aligned.b)};
        const R y = reciprocal_sqrt_lanes<L>(lengths.m.a, lengths.m.b, L::high_halves(aligned.a, aligned.b));
        lengths.y = {y, L::template shift_right<32>(y)};
        return lengths;
    }

    // g = min(L/len, 2) − 1 in Direction format, as 64-bit numbers.
    LKS_FORCE_INLINE G relative_error(const Lengths& lengths, const G& rest) const {
        return {ratio_less_one(L::multiply_unsigned(rest.a, lengths.y.a), lengths.twice_k.a),
                ratio_less_one(L::multiply_unsigned(rest.b, lengths.y.b), lengths.twice_k.b)};
    }

    LKS_FORCE_INLINE R ratio_less_one(R product, R twice_k) const {
        const R ratio =
            L::shift_right_each(product, L::subtract(ratio_shift_, L::template shift_right<1>(twice_k)));
        const R two = L::set(2 * std::int64_t{direction_one});
        // Neither exceeds 2^63, so the sign of the difference decides.
        const R limited = L::select_by_sign(ratio, two, L::subtract(two, ratio));
        return L::subtract(limited, L::set(direction_one));
    }

    // f from g. False: a lane leaves the fast range.
    template <typename Access>
    LKS_FORCE_INLINE bool soften(const Access& at, const StagedGroup<L>& group, const Lengths& lengths,
                                 G& f) const {
        if constexpr (damped) {
            const G shift{L::subtract(lengths.twice_k.a, L::set(2)),
                          L::subtract(lengths.twice_k.b, L::set(2))};
            f = {damp(f.a, L::shift_left_each(group.motion.a, shift.a), lengths.y.a),
                 damp(f.b, L::shift_left_each(group.motion.b, shift.b), lengths.y.b)};
        }
        if constexpr (multiplier) {
            if (task_.relaxations != nullptr) {
                return relax_by_multiplier(at, lengths, f);
            }
        }
        return true;
    }

    template <typename Access>
    LKS_FORCE_INLINE bool relax_by_multiplier(const Access& at, const Lengths& lengths, G& f) const {
        R beyond = L::set(0);
        const G length = narrow(at.load_wide(task_.arrays.multipliers), beyond);
        const G relaxation = at.load(task_.relaxations);
        f = {relax(f.a, length.a, relaxation.a, lengths.y.a, lengths.twice_k.a),
             relax(f.b, length.b, relaxation.b, lengths.y.b, lengths.twice_k.b)};
        // |f| ≤ 1, but for the upper end itself.
        beyond = L::bit_or(beyond,
                           L::bit_or(L::add(f.a, L::set(direction_one)), L::add(f.b, L::set(direction_one))));
        return !L::any(L::bit_and(beyond, L::set(~std::int64_t{INT32_MAX})));
    }

    // c·g − γ'·motion/u; `aligned` is motion·2^(2k − 2). Only the low half counts where there are no
    // multipliers: f is within ±1.
    LKS_FORCE_INLINE R damp(R g, R aligned, R y) const {
        const R high = L::template shift_right<32>(L::add(aligned, L::set(std::int64_t{1} << 31)));
        const R reciprocal = L::template shift_right<32>(L::multiply_unsigned(y, y));
        const R motion = L::template shift_right<28>(
            L::add(L::multiply_signed(high, reciprocal), L::set(std::int64_t{1} << 27)));
        const R f =
            L::subtract(L::multiply_signed(error_share_, g), L::multiply_signed(damping_share_, motion));
        if constexpr (multiplier) {
            return rounded_unit_shift_(f);
        } else {
            return L::template shift_right<unit_fraction_bits>(
                L::add(f, L::set(std::int64_t{1} << (unit_fraction_bits - 1))));
        }
    }

    LKS_FORCE_INLINE R relax(R f, R length, R relaxation, R y, R twice_k) const {
        const R relaxed = rounded_unit_shift_(L::multiply_signed(relaxation, length));
        return L::subtract(f, over_length(relaxed, y, LengthShift(twice_k)));
    }

    // By 32 − k to the right, and half of what is lost.
    struct LengthShift {
        explicit LengthShift(R twice_k)
            : right(L::subtract(L::set(32), L::template shift_right<1>(twice_k))),
              half(L::shift_left_each(L::set(1), L::subtract(right, L::set(1)))) {}
        R right, half;
    };

    // Of values whose low halves count; the shift with its sign, by lanes.
    LKS_FORCE_INLINE static R over_length(R value, R y, const LengthShift& by) {
        const R lift = L::set(std::int64_t{1} << 62);
        const R lifted = L::add(L::multiply_signed(value, y), L::add(lift, by.half));
        return L::subtract(L::shift_right_each(lifted, by.right), L::shift_right_each(lift, by.right));
    }

    // Λ += f·len.
    template <typename Access>
    LKS_FORCE_INLINE void add_to_multipliers(const Access& at, const Lengths& lengths, const G& f) const {
        const G lambda = at.load_wide(task_.arrays.multipliers);
        at.store_wide(task_.arrays.multipliers,
                      {L::add(lambda.a, length_of(f.a, lengths.m.a, lengths.y.a, lengths.twice_k.a)),
                       L::add(lambda.b, length_of(f.b, lengths.m.b, lengths.y.b, lengths.twice_k.b))});
    }

    LKS_FORCE_INLINE R length_of(R f, R m, R y, R twice_k) const {
        const R root = L::template shift_right<31>(L::multiply_unsigned(m, y));
        const R product = L::multiply_signed(f, root);
        const R right = L::add(length_shift_, L::template shift_right<1>(twice_k));
        const R lift = L::set(std::int64_t{1} << 62);
        return L::subtract(L::shift_right_each(L::add(L::add(product, product), lift), right),
                           L::shift_right_each(lift, right));
    }

    template <typename Access>
    LKS_FORCE_INLINE void move_alike(const Access& at, const G* d, const G& f, const G& share) const {
        const G gain{rounded_gain_shift_(L::multiply_signed(share.a, f.a)),
                     rounded_gain_shift_(L::multiply_signed(share.b, f.b))};
        for (int axis = 0; axis < 3; ++axis) {
            const R correction_a = to_coordinate(L::multiply_signed(d[axis].a, gain.a));
            const R correction_b = to_coordinate(L::multiply_signed(d[axis].b, gain.b));
            at.move(axes_[axis], {correction_a, correction_b}, {correction_a, correction_b});
        }
    }

    LKS_FORCE_INLINE R to_coordinate(R product) const {
        if constexpr (soft) {
            return plain_ ? product : product_shift_(product);
        } else {
            return product;
        }
    }

    struct LongGain {
        R high, low;
    };

    // Where the shares are equal: the rounded gain, and no bits behind it.
    LKS_FORCE_INLINE LongGain long_gain(R share, R f, R alike) const {
        const R product = L::add(L::multiply_signed(share, f), L::bit_and(gain_rounding_, alike));
        const R low = L::bit_and(L::shift_right(product, low_gain_shift_), L::set(INT32_MAX));
        return {gain_shift_(product), L::and_not(alike, low)};
    }

    LKS_FORCE_INLINE R long_product(R difference, const LongGain& gain) const {
        return to_coordinate(L::add(L::multiply_signed(difference, gain.high),
                                    low_product_shift_(L::multiply_signed(difference, gain.low))));
    }

    template <typename Access>
    LKS_FORCE_INLINE void move_by_share(const Access& at, const G* d, const G& f, const G& share_a,
                                        const G& share_b, const G& alike) const {
        const LongGain a_a = long_gain(share_a.a, f.a, alike.a);
        const LongGain a_b = long_gain(share_a.b, f.b, alike.b);
        const LongGain b_a = long_gain(share_b.a, f.a, alike.a);
        const LongGain b_b = long_gain(share_b.b, f.b, alike.b);
        for (int axis = 0; axis < 3; ++axis) {
            at.move(axes_[axis], {long_product(d[axis].a, a_a), long_product(d[axis].b, a_b)},
                    {long_product(d[axis].a, b_a), long_product(d[axis].b, b_b)});
        }
    }

    DistanceTask task_; // a copy, so that what is stored can't be thought to change it
    typename L::Shift shift_;
    SignedShift<L> gain_shift_;
    SignedShift<L> rounded_gain_shift_;
    typename L::Shift low_gain_shift_;
    SignedShift<L> low_product_shift_{31};
    SignedShift<L> rounded_unit_shift_{unit_fraction_bits, std::int64_t{1} << (unit_fraction_bits - 1)};
    SignedShift<L> product_shift_;
    bool plain_;
    R bias_;
    R ratio_shift_;
    R gain_rounding_;
    R error_share_;
    R damping_share_;
    R length_shift_;
    std::int64_t* axes_[3];
    const std::int64_t* starts_[3];
};

// Groups that are waiting to go through the stages together. They touch no common particle.
template <typename L, typename Access, typename Groups, typename ProjectOne>
class Stages {
public:
    Stages(const Groups& groups, const ProjectOne& project_one)
        : groups_(groups), project_one_(project_one) {}

    // Where the next one is to be written; then added.
    Access& next() { return waiting_[count_]; }
    LKS_FORCE_INLINE void add() {
        if (++count_ == Access::together) {
            project(groups_, waiting_, Access::together);
            count_ = 0;
        }
    }
    // Without waiting for others.
    LKS_FORCE_INLINE void add_alone(const Access& at) const { project(groups_, &at, 1); }
    LKS_NEVER_INLINE void finish() {
        if (count_ != 0) {
            project(groups_, waiting_, count_);
        }
    }

private:
    LKS_FORCE_INLINE void project(const Groups& groups, const Access* at, std::uint32_t count) const {
        StagedGroup<L> staged[Access::together];
        for (std::uint32_t i = 0; i < count; ++i) {
            groups.find_differences(at[i], staged[i]);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            groups.find_correction(at[i], staged[i]);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!staged[i].plain) {
                groups.move(at[i], staged[i]);
            } else {
                at[i].for_each(project_one_);
            }
        }
    }

    const Groups& groups_;
    const ProjectOne& project_one_;
    std::uint32_t count_ = 0;
    Access waiting_[Access::together];
};

template <typename L, typename Groups, typename ProjectOne>
inline void project_runs(const DistanceTask& task, const Groups& groups, const ProjectOne& project_one) {
    constexpr std::uint32_t lanes = 2 * L::half;
    Stages<L, RunAccess<L>, Groups, ProjectOne> stages(groups, project_one);
    Stages<L, PartialAccess<L>, Groups, ProjectOne> ends(groups, project_one);
    visit_runs(task, [&](std::uint32_t constraint, std::uint32_t a, std::uint32_t b, std::uint32_t count,
                         std::uint32_t spare) {
        std::uint32_t i = 0;
        for (; i + lanes <= count; i += lanes) {
            if constexpr (L::together == 1) {
                stages.add_alone({constraint + i, a + i, b + i});
            } else {
                stages.next() = {constraint + i, a + i, b + i};
                stages.add();
            }
        }
        const std::uint32_t left = count - i;
        if (left < L::worth_a_group) {
            for (; i < count; ++i) {
                project_one(constraint + i, a + i, b + i);
            }
            return;
        }
        PartialAccess<L>& end = ends.next();
        if (count > lanes) {
            // The last `lanes` of it, of which some have been in a group already.
            const std::uint32_t back = lanes - left;
            end = {{constraint + i - back, a + i - back, b + i - back}, back, left, true, true};
        } else {
            const bool spares = left + spare >= lanes;
            // Lanes behind the end are read, so nobody else may write them meanwhile.
            end = {{constraint + i, a + i, b + i}, 0, left, spares || task.whole_batch, spares};
        }
        ends.add();
    });
    stages.finish();
    ends.finish();
}

template <typename L, typename Groups, typename ProjectOne>
inline void project_singles(const DistanceTask& task, const Groups& groups, const ProjectOne& project_one) {
    constexpr std::uint32_t lanes = 2 * L::half;
    Stages<L, SinglesAccess<L>, Groups, ProjectOne> stages(groups, project_one);
    std::uint32_t i = task.first_single < task.range.first ? task.range.first : task.first_single;
    for (; i + L::worth_a_group <= task.range.last; i += lanes) {
        const std::uint32_t left = task.range.last - i;
        stages.next().take(task.constraints, i, left < lanes ? left : lanes);
        stages.add();
    }
    stages.finish();
    for (; i < task.range.last; ++i) {
        project_one(i, task.constraints[i].a, task.constraints[i].b);
    }
}

template <typename L, bool equal_shares, bool soft, bool damped, bool multiplier>
inline void project_in_groups(const DistanceTask& task) {
    using Groups = DistanceGroups<L, equal_shares, soft, damped, multiplier>;
    const Groups groups(task);
    const Projection<equal_shares, soft, damped, multiplier> project_one(task);
    if (task.run_count != 0) {
        project_runs<L>(task, groups, project_one);
    }
    if (task.first_single < task.range.last) {
        project_singles<L>(task, groups, project_one);
    }
}

template <typename L, bool equal_shares, bool multiplier>
inline void project_family_in_groups(const DistanceTask& task) {
    if (!task.soft) {
        project_in_groups<L, equal_shares, false, false, multiplier>(task);
    } else if (!task.damped) {
        project_in_groups<L, equal_shares, true, false, multiplier>(task);
    } else {
        project_in_groups<L, equal_shares, true, true, multiplier>(task);
    }
}

template <typename L>
inline void project_lanes(const DistanceTask& task) {
    if (task.arrays.multipliers == nullptr) {
        task.equal_shares ? project_family_in_groups<L, true, false>(task)
                          : project_family_in_groups<L, false, false>(task);
    } else {
        task.equal_shares ? project_family_in_groups<L, true, true>(task)
                          : project_family_in_groups<L, false, true>(task);
    }
}

} // namespace
} // namespace lks
