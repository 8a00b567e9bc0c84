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
    // So many at its beginning have been in a group before, and stay as they are.
    std::uint32_t done;

    std::uint32_t first_constraint() const { return constraint; }

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t lane = done; lane < 2 * L::half; ++lane) {
            use(constraint + lane, a + lane, b + lane);
        }
    }
    // Nothing for them.
    LKS_FORCE_INLINE void clear_done(Group<L>& values) const {
        if (done != 0) {
            const std::int64_t* bits = lane_bits + widest_group - done;
            values = {L::bit_and(values.a, L::load(bits)), L::bit_and(values.b, L::load(bits + L::half))};
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
        std::int64_t* x_a = as_it_stands(x + a);
        std::int64_t* x_b = as_it_stands(x + b);
        const Group<L> at_a{L::load(x_a), L::load(x_a + L::half)};
        const Group<L> at_b{L::load(x_b), L::load(x_b + L::half)};
        L::store(x_a, L::add(at_a.a, plus_a.a));
        L::store(x_a + L::half, L::add(at_a.b, plus_a.b));
        L::store(x_b, L::subtract(at_b.a, minus_b.a));
        L::store(x_b + L::half, L::subtract(at_b.b, minus_b.b));
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

// The first `count` lanes of a stretch; the others are not part of it, and do not move.
template <typename L>
struct PartialAccess {
    static constexpr std::uint32_t together = L::together;
    static constexpr bool whole = false;

    RunAccess<L> run;
    std::uint32_t count;
    // Whether the particles of the other lanes may be read, and written as they are.
    bool loads_whole;
    bool stores_whole;

    std::uint32_t first_constraint() const { return run.constraint; }
    LKS_FORCE_INLINE Group<L> masked(const Group<L>& values) const {
        const std::int64_t* bits = lane_bits + 2 * widest_group - count;
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
        for (std::uint32_t lane = 0; lane < count; ++lane) {
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
    // Those have no difference.
    static void clear_done(const Group<L>&) {}

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            use(run.constraint + lane, run.a + lane, run.b + lane);
        }
    }

private:
    Group<L> load_lanes(const std::int64_t* x) const {
        std::int64_t values[2 * L::half] = {};
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            values[lane] = x[lane];
        }
        return {L::load(values), L::load(values + L::half)};
    }
    void store_lanes(std::int64_t* x, const Group<L>& group) const {
        const LaneValues<L> lanes(group);
        for (std::uint32_t lane = 0; lane < count; ++lane) {
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

    std::uint32_t first_constraint() const { return constraint; }

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
    static void clear_done(const Group<L>&) {}

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

// Something of each of n groups.
template <typename T, std::uint32_t n>
struct Each {
    T at[n];
    LKS_FORCE_INLINE const T& operator[](std::uint32_t i) const { return at[i]; }
};

// One step for each of n groups, so that steps of different groups follow each other: those of one group wait
// for each other.
template <std::uint32_t n, typename Step>
LKS_FORCE_INLINE auto of_each(const Step& step) {
    Each<decltype(step(0u)), n> values;
#pragma GCC unroll 8
    for (std::uint32_t i = 0; i < n; ++i) {
        values.at[i] = step(i);
    }
    return values;
}

// 1/√m for 32-bit lanes whose even and odd halves are also given by themselves, low in 64 bits:
// fixed/projection_reciprocal_sqrt.h.
template <typename L, std::uint32_t n>
LKS_FORCE_INLINE auto reciprocal_sqrt_lanes(const Each<typename L::Register, n>& even,
                                            const Each<typename L::Register, n>& odd,
                                            const Each<typename L::Register, n>& m) {
    using I = std::uint32_t;
    // Aligned, with the leading bit replaced by the octave.
    const auto cut = of_each<n>([&](I i) { return L::add_32(L::add_32(m[i], m[i]), L::set_32(INT32_MIN)); });
    const auto aligned = of_each<n>([&](I i) { return L::select_by_sign_32(cut[i], m[i], m[i]); });
    const auto segment = of_each<n>([&](I i) { return L::template shift_right_32<29>(aligned[i]); });
    const auto c2_c3 = of_each<n>([&](I i) { return L::lookup(fixed::projection_seeds.c2_c3, segment[i]); });
    const auto c0_c1 = of_each<n>([&](I i) { return L::lookup(fixed::projection_seeds.c0_c1, segment[i]); });
    // t in the high 16 bits, and something else in the low ones.
    const auto high_t = of_each<n>(
        [&](I i) { return L::exclusive_or(L::template shift_left_32<3>(aligned[i]), L::set_32(INT32_MIN)); });
    const auto cubic = of_each<n>([&](I i) { return L::rounding_multiply_16(high_t[i], c2_c3[i]); });
    const auto t = of_each<n>([&](I i) { return L::template shift_right_32<16>(high_t[i]); });
    const auto low_cubic = of_each<n>([&](I i) { return L::template shift_right_32<16>(cubic[i]); });
    const auto quadratic = of_each<n>([&](I i) { return L::add_16(c2_c3[i], low_cubic[i]); });
    const auto c1 = of_each<n>([&](I i) { return L::template shift_right_32<16>(c0_c1[i]); });
    const auto bent = of_each<n>([&](I i) { return L::rounding_multiply_16(t[i], quadratic[i]); });
    const auto slope = of_each<n>([&](I i) { return L::add_16(c1[i], bent[i]); });
    const auto rise = of_each<n>([&](I i) { return L::rounding_multiply_16(t[i], slope[i]); });
    const auto correction = of_each<n>([&](I i) { return L::template shift_right_16_signed<3>(rise[i]); });
    const auto seed = of_each<n>([&](I i) { return L::add_16(c0_c1[i], correction[i]); });
    const auto y0 = of_each<n>([&](I i) { return L::bit_and(seed[i], L::set_32(0xffff)); });
    const auto squared = of_each<n>([&](I i) { return L::multiply_low_32(y0[i], y0[i]); });
    const auto even_product = of_each<n>([&](I i) { return L::multiply_unsigned(even[i], squared[i]); });
    const auto odd_squared = of_each<n>([&](I i) { return L::template shift_right<32>(squared[i]); });
    const auto odd_product = of_each<n>([&](I i) { return L::multiply_unsigned(odd[i], odd_squared[i]); });
    const auto product = of_each<n>([&](I i) { return L::high_halves(even_product[i], odd_product[i]); });
    const auto e = of_each<n>([&](I i) { return L::subtract_32(product[i], L::set_32(1 << 30)); });
    const auto half_e = of_each<n>([&](I i) { return L::template shift_right_32_signed<1>(e[i]); });
    const auto step = of_each<n>([&](I i) { return L::multiply_low_32(y0[i], half_e[i]); });
    const auto wide = of_each<n>([&](I i) { return L::template shift_left_32<15>(y0[i]); });
    const auto rounded = of_each<n>([&](I i) { return L::add_32(step[i], L::set_32(1 << 14)); });
    const auto taken = of_each<n>([&](I i) { return L::template shift_right_32_signed<15>(rounded[i]); });
    return of_each<n>([&](I i) { return L::subtract_32(wide[i], taken[i]); });
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

template <typename L, bool soft, bool damped, bool multiplier>
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
            const G now = lifted_difference(at, axes_[axis], beyond);
            if constexpr (damped) {
                const G start = lifted_difference(at, starts_[axis], beyond);
                add_product(group.motion, axis, unlifted(now),
                            {L::subtract(now.a, start.a), L::subtract(now.b, start.b)});
            }
            group.d[axis] = unlifted(now);
            add_product(group.u, axis, group.d[axis], group.d[axis]);
        }
        const R high_u = L::high_halves(group.u.a, group.u.b);
        R outside = L::equal_32(high_u, L::set_32(0));
        if constexpr (damped) {
            outside = L::bit_or(outside, exceeds(L::high_halves(group.motion.a, group.motion.b), high_u));
        }
        if constexpr (!Access::whole) {
            const G mask = at.masked({L::set(-1), L::set(-1)});
            outside = L::bit_and(outside, L::high_halves(mask.a, mask.b));
        }
        group.plain = L::any(L::bit_or(outside, L::bit_and(beyond, L::set(~std::int64_t{INT32_MAX}))));
    }

    // Of n groups at once.
    template <std::uint32_t n, typename Access>
    LKS_FORCE_INLINE void find_corrections(const Access* at, StagedGroup<L>* groups) const {
        const auto lengths = measure<n>(groups);
        for (std::uint32_t i = 0; i < n; ++i) {
            groups[i].f = relative_error(lengths[i], at[i].load(task_.rest_mantissas));
            find_correction(at[i], groups[i], lengths[i]);
        }
    }

    template <bool alike_throughout, typename Access>
    LKS_FORCE_INLINE void move(const Access& at, const StagedGroup<L>& group) const {
        const G share_a = at.load(task_.shares_a);
        if constexpr (alike_throughout) {
            move_alike(at, group.d, group.f, share_a);
            return;
        }
        const G share_b = at.load(task_.shares_b);
        const G alike{L::equal(share_a.a, share_b.a), L::equal(share_a.b, share_b.b)};
        if (L::all(L::bit_and(alike.a, alike.b))) {
            move_alike(at, group.d, group.f, share_a);
        } else {
            move_by_share(at, group.d, group.f, share_a, share_b, alike);
        }
    }

private:
    template <typename Access>
    LKS_FORCE_INLINE void find_correction(const Access& at, StagedGroup<L>& group,
                                          const Lengths& lengths) const {
        if constexpr (soft && (damped || multiplier)) {
            group.plain = !soften(at, group, lengths, group.f) || group.plain;
        }
        if constexpr (multiplier) {
            at.clear_done(group.f);
            if (!group.plain) {
                add_to_multipliers(at, lengths, group.f);
            }
        }
    }

    // Half a unit to round, and what makes 2^30 units positive.
    static R bias(const DistanceTask& task) {
        return L::set((std::int64_t{1} << (task.parameters.difference_shift - 1)) +
                      (std::int64_t{1} << (task.parameters.difference_shift + 30)));
    }

    // x_a − x_b in difference units, lifted.
    template <typename Access>
    LKS_FORCE_INLINE G lifted_difference(const Access& at, const std::int64_t* x, R& beyond) const {
        const G a = at.load_a(x);
        const G b = at.load_b(x);
        G wide{L::subtract(a.a, b.a), L::subtract(a.b, b.b)};
        if constexpr (!Access::whole) {
            wide = at.masked(wide);
        }
        return lifted(wide, beyond);
    }

    // In difference units, within ±2^30, and 2^30 more; else bits above the 31st of `beyond` are set.
    LKS_FORCE_INLINE G lifted(const G& wide, R& beyond) const {
        const R a = L::shift_right(L::add(wide.a, bias_), shift_);
        const R b = L::shift_right(L::add(wide.b, bias_), shift_);
        beyond = L::bit_or(beyond, L::bit_or(a, b));
        return {a, b};
    }

    LKS_FORCE_INLINE static G unlifted(const G& values) {
        return {L::subtract(values.a, L::set(direction_one)), L::subtract(values.b, L::set(direction_one))};
    }

    // The sign bit of 32-bit lanes in which |motion| might exceed u, from the high halves of both.
    LKS_FORCE_INLINE static R exceeds(R high_motion, R high_u) {
        const R below = L::add_32(high_u, high_motion);
        const R above = L::subtract_32(L::add_32(high_u, L::set_32(-1)), high_motion);
        return L::bit_and(L::bit_or(below, above), L::set_32(INT32_MIN));
    }

    // sum = v·w for the first axis, and more by it for the others.
    LKS_FORCE_INLINE static void add_product(G& sum, int axis, const G& v, const G& w) {
        const G product{L::multiply_signed(v.a, w.a), L::multiply_signed(v.b, w.b)};
        sum = axis == 0 ? product : G{L::add(sum.a, product.a), L::add(sum.b, product.b)};
    }

    template <std::uint32_t n>
    LKS_FORCE_INLINE static auto measure(const StagedGroup<L>* groups) {
        using I = std::uint32_t;
        const auto high = of_each<n>([&](I i) { return L::high_halves(groups[i].u.a, groups[i].u.b); });
        const auto zeros = of_each<n>([&](I i) { return L::leading_zeros_32(high[i]); });
        const auto twice_k = of_each<n>([&](I i) { return L::bit_and(zeros[i], L::set_32(~1)); });
        const auto even_2k = of_each<n>([&](I i) { return L::bit_and(twice_k[i], L::set(UINT32_MAX)); });
        const auto odd_2k = of_each<n>([&](I i) { return L::template shift_right<32>(twice_k[i]); });
        const auto a = of_each<n>([&](I i) { return L::shift_left_each(groups[i].u.a, even_2k[i]); });
        const auto b = of_each<n>([&](I i) { return L::shift_left_each(groups[i].u.b, odd_2k[i]); });
        const auto even_m = of_each<n>([&](I i) { return L::template shift_right<32>(a[i]); });
        const auto odd_m = of_each<n>([&](I i) { return L::template shift_right<32>(b[i]); });
        const auto m = of_each<n>([&](I i) { return L::high_halves(a[i], b[i]); });
        const auto y = reciprocal_sqrt_lanes<L, n>(even_m, odd_m, m);
        return of_each<n>([&](I i) {
            return Lengths{
                {even_2k[i], odd_2k[i]}, {even_m[i], odd_m[i]}, {y[i], L::template shift_right<32>(y[i])}};
        });
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
        const G length = unlifted(lifted(at.load_wide(task_.arrays.multipliers), beyond));
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
        const R rounded = L::template shift_right<31>(L::multiply_unsigned(m, y));
        const R root = L::select_by_sign_32(rounded, L::set(INT32_MAX), rounded);
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

// Takes groups that touch no common particle through the stages together.
template <typename L, typename Groups, typename ProjectOne>
class Stages {
public:
    Stages(const Groups& groups, const ProjectOne& project_one, ConstraintRange unequal_shares)
        : groups_(groups), project_one_(project_one), unequal_(groups_into(unequal_shares)) {}

    template <typename Access>
    LKS_FORCE_INLINE void project(const Access* at, std::uint32_t count) const {
        StagedGroup<L> staged[Access::together];
        for (std::uint32_t i = 0; i < count; ++i) {
            groups_.find_differences(at[i], staged[i]);
        }
        find_corrections<L::interleaved>(at, staged, count);
        bool alike = true;
        for (std::uint32_t i = 0; i < count; ++i) {
            at[i].clear_done(staged[i].f);
            alike = alike && !is_in(unequal_, at[i].first_constraint());
        }
        alike ? move<true>(at, staged, count) : move<false>(at, staged, count);
    }
    // What is rare, and would only be in the way of what is not.
    template <typename Access>
    LKS_NEVER_INLINE void project_apart(const Access* at, std::uint32_t count) const {
        project(at, count);
    }
    LKS_NEVER_INLINE void project_one(std::uint32_t constraint, std::uint32_t a, std::uint32_t b) const {
        project_one_(constraint, a, b);
    }

private:
    // Where groups begin that reach into the range.
    static ConstraintRange groups_into(ConstraintRange range) {
        if (range.first == range.last) {
            return range;
        }
        // Before the first constraint of all it wraps around, and is_in as well.
        return {range.first - (2 * L::half - 1), range.last};
    }

    // As many at once as can be.
    template <std::uint32_t n, typename Access>
    LKS_FORCE_INLINE void find_corrections(const Access* at, StagedGroup<L>* staged,
                                           std::uint32_t count) const {
        for (; count >= n; count -= n) {
            groups_.template find_corrections<n>(at, staged);
            at += n;
            staged += n;
        }
        if constexpr (n > 1) {
            find_corrections<n - 1>(at, staged, count);
        }
    }

    template <bool alike, typename Access>
    LKS_FORCE_INLINE void move(const Access* at, const StagedGroup<L>* staged, std::uint32_t count) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (staged[i].plain) {
                at[i].for_each([this](std::uint32_t constraint, std::uint32_t a, std::uint32_t b) {
                    project_one(constraint, a, b);
                });
            } else if (alike || !is_in(unequal_, at[i].first_constraint())) {
                groups_.template move<true>(at[i], staged[i]);
            } else {
                groups_.template move<false>(at[i], staged[i]);
            }
        }
    }

    const Groups& groups_;
    const ProjectOne& project_one_;
    ConstraintRange unequal_;
};

// Takes a part's runs apart: into whole groups, the last of a run over lanes that were in the one before it,
// into groups that are not filled where a run is shorter than a group, and into what is better off alone.
template <typename L, typename Stage>
class RunGroups {
public:
    RunGroups(const BatchPart& part, const Stage& stages) : part_(part), stages_(stages) {}

    // The next whole groups, of which there are fewer than L::together at the end only.
    LKS_FORCE_INLINE std::uint32_t take(RunAccess<L>* groups) {
        std::uint32_t taken = 0;
        for (;;) {
            for (; at_ < in_groups_; at_ += lanes) {
                if (taken == L::together) {
                    return taken;
                }
                const std::uint32_t done = at_ + lanes > in_groups_ ? at_ + lanes - in_groups_ : 0;
                const std::uint32_t from = at_ - done;
                groups[taken++] = {run_.constraint + from, run_.a + from, run_.b + from, done};
            }
            if (next_ == part_.run_count) {
                return taken;
            }
            begin_run(run_part(part_, next_++));
        }
    }

    void finish() {
        if (short_count_ != 0) {
            stages_.project_apart(short_, short_count_);
        }
    }

private:
    static constexpr std::uint32_t lanes = 2 * L::half;

    void begin_run(const RunPart& run) {
        run_ = run;
        at_ = 0;
        const std::uint32_t left = run.count % lanes;
        const bool alone = left < L::worth_a_group;
        in_groups_ = alone ? run.count - left : run.count < lanes ? 0 : run.count;
        if (alone) {
            for (std::uint32_t i = in_groups_; i < run.count; ++i) {
                stages_.project_one(run.constraint + i, run.a + i, run.b + i);
            }
        } else if (run.count < lanes) {
            add_short();
        }
    }

    void add_short() {
        const bool spares = run_.count + run_.spare >= lanes;
        // Lanes behind the end are read, so nobody else may write them meanwhile.
        short_[short_count_++] = {
            {run_.constraint, run_.a, run_.b, 0}, run_.count, spares || part_.whole, spares};
        if (short_count_ == PartialAccess<L>::together) {
            stages_.project_apart(short_, short_count_);
            short_count_ = 0;
        }
    }

    const BatchPart& part_;
    const Stage& stages_;
    std::uint32_t next_ = 0; // run
    RunPart run_{};
    std::uint32_t at_ = 0;
    std::uint32_t in_groups_ = 0;
    std::uint32_t short_count_ = 0;
    PartialAccess<L> short_[PartialAccess<L>::together];
};

template <typename L, typename Stage>
inline void project_runs(const BatchPart& part, const Stage& stages) {
    RunGroups<L, Stage> runs(part, stages);
    RunAccess<L> groups[L::together];
    std::uint32_t count;
    while ((count = runs.take(groups)) == L::together) {
        stages.project(groups, L::together);
    }
    if (count != 0) {
        stages.project_apart(groups, count);
    }
    runs.finish();
}

template <typename L, typename Stage>
inline void project_singles(const DistanceTask& task, const BatchPart& part, const Stage& stages) {
    constexpr std::uint32_t lanes = 2 * L::half;
    SinglesAccess<L> groups[SinglesAccess<L>::together];
    ConstraintRange rest = singles(part);
    std::uint32_t count = 0;
    while (rest.first + L::worth_a_group <= rest.last) {
        const std::uint32_t left = rest.last - rest.first;
        const std::uint32_t number = left < lanes ? left : lanes;
        groups[count++].take(task.constraints, rest.first, number);
        rest.first += number;
        if (count == SinglesAccess<L>::together || rest.first + L::worth_a_group > rest.last) {
            stages.project(groups, count);
            count = 0;
        }
    }
    for (; rest.first < rest.last; ++rest.first) {
        stages.project_one(rest.first, task.constraints[rest.first].a, task.constraints[rest.first].b);
    }
}

template <typename L, bool soft, bool damped, bool multiplier>
inline void project_in_groups(const DistanceTask& task) {
    using Groups = DistanceGroups<L, soft, damped, multiplier>;
    using ProjectOne = Projection<soft, damped, multiplier>;
    const Groups groups(task);
    const ProjectOne project_one(task);
    for (std::uint32_t p = 0; p < task.part_count; ++p) {
        const BatchPart& part = task.parts[p];
        const Stages<L, Groups, ProjectOne> stages(groups, project_one, part.unequal_shares);
        if (part.run_count != 0) {
            project_runs<L>(part, stages);
        }
        if (part.first_single < part.range.last) {
            project_singles<L>(task, part, stages);
        }
    }
}

template <typename L, bool multiplier>
inline void project_family_in_groups(const DistanceTask& task) {
    if (!task.soft) {
        project_in_groups<L, false, false, multiplier>(task);
    } else if (!task.damped) {
        project_in_groups<L, true, false, multiplier>(task);
    } else {
        project_in_groups<L, true, true, multiplier>(task);
    }
}

template <typename L>
inline void project_lanes(const DistanceTask& task) {
    if (task.arrays.multipliers == nullptr) {
        project_family_in_groups<L, false>(task);
    } else {
        project_family_in_groups<L, true>(task);
    }
}

} // namespace
} // namespace lks
