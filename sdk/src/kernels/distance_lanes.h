// A range of one batch, groups of 2·L::half constraints at a time: kernels/distance_scalar.h over lanes.
//
// L is one instruction set: registers of L::half 64-bit lanes and a few operations on them. A group of
// constraints is two registers of coordinates, A and B; what is 32 bits wide is kept where 32×32→64
// multiplications find it, and worked on in one register (kernels/factors.h). Some groups go through
// each stage together (differences, corrections, movements): a group's steps wait for each other, and the
// steps of its neighbours fill the time. A group in which a lane leaves the fast range (an edge 2^30 units
// long, or shorter than 2^16) is projected in plain integers, which gives the same bits.
#pragma once

#include <utility>

#include "kernels/distance_scalar_loop.h"
#include "kernels/factors.h"
#include "kernels/force_inline.h"
#include "kernels/shift_lanes.h"

namespace lks {
namespace {

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
    LKS_FORCE_INLINE void clear_done(Factors<L>& values) const {
        if (done != 0) {
            const std::int64_t* bits = lane_bits + widest_group - done;
            values = FactorsOf<L>::masked(values, {L::load(bits), L::load(bits + L::half)});
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
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const {
        return FactorsOf<L>::load(values + constraint);
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
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const { return run.load(values); }
    // Those have no difference.
    static void clear_done(const Factors<L>&) {}

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
    static void clear_done(const Factors<L>&) {}

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
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const {
        return FactorsOf<L>::load(values + constraint);
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
template <typename Step, std::uint32_t... indices>
LKS_FORCE_INLINE auto of_these(const Step& step, std::integer_sequence<std::uint32_t, indices...>) {
    return Each<decltype(step(0u)), sizeof...(indices)>{{step(indices)...}};
}
template <std::uint32_t n, typename Step>
LKS_FORCE_INLINE auto of_each(const Step& step) {
    return of_these(step, std::make_integer_sequence<std::uint32_t, n>{});
}

// A seed in 32-bit arithmetic, from t in the low 16 bits with nothing above. What is above the 16th bit of a
// sum counts for nothing until the last one.
template <typename L>
LKS_FORCE_INLINE typename L::Register seed_by_words(typename L::Register segment, typename L::Register t) {
    using R = typename L::Register;
    const R half = L::set_32(1 << 14);
    const R at = L::coefficient_index(segment);
    const R c3_t = L::multiply_16(t, L::coefficient(fixed::projection_coefficients.c3, at));
    const R quadratic = L::add_32(L::template shift_right_32_signed<15>(L::add_32(c3_t, half)),
                                  L::coefficient(fixed::projection_coefficients.c2, at));
    const R slope =
        L::add_32(L::template shift_right_32_signed<15>(L::add_32(L::multiply_16(t, quadratic), half)),
                  L::coefficient(fixed::projection_coefficients.c1, at));
    return L::add_32(L::template shift_right_32_signed<18>(L::add_32(L::multiply_16(t, slope), half)),
                     L::coefficient(fixed::projection_coefficients.c0, at));
}

// Estimates of 1/√m, low in 32-bit lanes: the cubics of fixed/projection_reciprocal_sqrt.h at t, which is in
// the high 16 bits of high_t.
template <typename L, std::uint32_t n>
LKS_FORCE_INLINE auto seed_lanes(const Each<typename L::Register, n>& segment,
                                 const Each<typename L::Register, n>& high_t) {
    using I = std::uint32_t;
    const auto t = of_each<n>([&](I i) { return L::template shift_right_32<16>(high_t[i]); });
    if constexpr (L::has_rounding_multiply_16) {
        const auto c2_c3 =
            of_each<n>([&](I i) { return L::lookup(fixed::projection_seeds.c2_c3, segment[i]); });
        const auto c0_c1 =
            of_each<n>([&](I i) { return L::lookup(fixed::projection_seeds.c0_c1, segment[i]); });
        const auto cubic = of_each<n>([&](I i) { return L::rounding_multiply_16(high_t[i], c2_c3[i]); });
        const auto low_cubic = of_each<n>([&](I i) { return L::template shift_right_32<16>(cubic[i]); });
        const auto quadratic = of_each<n>([&](I i) { return L::add_16(c2_c3[i], low_cubic[i]); });
        const auto c1 = of_each<n>([&](I i) { return L::template shift_right_32<16>(c0_c1[i]); });
        const auto bent = of_each<n>([&](I i) { return L::rounding_multiply_16(t[i], quadratic[i]); });
        const auto slope = of_each<n>([&](I i) { return L::add_16(c1[i], bent[i]); });
        const auto rise = of_each<n>([&](I i) { return L::rounding_multiply_16(t[i], slope[i]); });
        const auto correction =
            of_each<n>([&](I i) { return L::template shift_right_16_signed<3>(rise[i]); });
        const auto seed = of_each<n>([&](I i) { return L::add_16(c0_c1[i], correction[i]); });
        return of_each<n>([&](I i) { return L::bit_and(seed[i], L::set_32(0xffff)); });
    } else {
        return of_each<n>([&](I i) { return seed_by_words<L>(segment[i], t[i]); });
    }
}

// 1/√m: fixed/projection_reciprocal_sqrt.h.
template <typename L, std::uint32_t n>
LKS_FORCE_INLINE auto reciprocal_sqrt_lanes(const Each<Numbers<L>, n>& m) {
    using I = std::uint32_t;
    using F = FactorsOf<L>;
    // Aligned, with the leading bit replaced by the octave: m where its top bit is set, else 2·m − 2^31.
    const auto above = of_each<n>([&](I i) { return L::exclusive_or(m[i].words, L::set_32(INT32_MIN)); });
    const auto shorter = of_each<n>([&](I i) { return L::minimum_32(above[i], L::set_32(0)); });
    const auto aligned = of_each<n>([&](I i) { return L::add_32(m[i].words, shorter[i]); });
    const auto segment = of_each<n>([&](I i) { return L::template shift_right_32<29>(aligned[i]); });
    const auto high_t = of_each<n>(
        [&](I i) { return L::exclusive_or(L::template shift_left_32<3>(aligned[i]), L::set_32(INT32_MIN)); });
    const auto y0 = seed_lanes<L, n>(segment, high_t);
    const auto squared = of_each<n>([&](I i) { return L::multiply_low_32(y0[i], y0[i]); });
    const auto products =
        of_each<n>([&](I i) { return F::multiply_unsigned(m[i].factors, F::of_words(squared[i])); });
    const auto product = of_each<n>([&](I i) { return F::high_words(products[i]); });
    const auto e = of_each<n>([&](I i) { return L::subtract_32(product[i], L::set_32(1 << 30)); });
    const auto half_e = of_each<n>([&](I i) { return L::template shift_right_32_signed<1>(e[i]); });
    const auto step = of_each<n>([&](I i) { return L::multiply_low_32(y0[i], half_e[i]); });
    const auto wide = of_each<n>([&](I i) { return L::template shift_left_32<15>(y0[i]); });
    const auto rounded = of_each<n>([&](I i) { return L::add_32(step[i], L::set_32(1 << 14)); });
    const auto taken = of_each<n>([&](I i) { return L::template shift_right_32_signed<15>(rounded[i]); });
    return of_each<n>([&](I i) { return L::subtract_32(wide[i], taken[i]); });
}

// Lengths in one octave, of which clz(u) / 2 is k.
template <typename L>
class Octave {
    using R = typename L::Register;

public:
    explicit Octave(int k)
        : twice_k_(L::set(2 * in_range(k))), align_(2 * in_range(k)),
          lowest_(L::set_32(k == in_range(k) ? 1 << (30 - 2 * k) : INT32_MAX)),
          highest_(L::set_32(
              k == in_range(k) ? static_cast<std::int32_t>((std::int64_t{1} << (32 - 2 * k)) - 1) : -1)) {}

    // The sign bit of those words that are not the high half of such a u. Others are below 2^31.
    LKS_FORCE_INLINE R leaves(R high_u) const {
        return L::bit_or(L::subtract_32(high_u, lowest_), L::subtract_32(highest_, high_u));
    }
    // u·2^2k, high halves.
    LKS_FORCE_INLINE Numbers<L> align(const Group<L>& u) const { return align_(u); }
    LKS_FORCE_INLINE R twice_k() const { return twice_k_; }

private:
    // Beyond these, nothing is in it: u has a bit in its high half, and is below 2^62.
    static constexpr int in_range(int k) { return k < 1 || k > 15 ? 1 : k; }

    R twice_k_;
    HighShift<L> align_;
    R lowest_;
    R highest_;
};

// Of a group's squared lengths u.
template <typename L>
struct LengthLanes {
    Group<L> twice_k;
    Factors<L> m; // Q2.30
    Factors<L> y;
};

// A group between the stages.
template <typename L>
struct StagedGroup {
    bool plain;     // a lane leaves the fast range
    bool in_octave; // all lengths are known to be in the octave of the longest rest length
    Factors<L> d[3];
    Group<L> u;
    Group<L> motion; // u − d·(d at the start of the substep), where there is damping
    Factors<L> f;
};

// Squared lengths, shifted to the left.
template <typename L, std::uint32_t n>
struct Aligned {
    Each<Numbers<L>, n> m; // u·2^2k, high half
    Each<Group<L>, n> twice_k;
};

template <typename L, std::uint32_t n, typename Squares>
LKS_SELDOM Aligned<L, n> align_each(const Squares& u) {
    using I = std::uint32_t;
    const auto high = of_each<n>([&](I i) { return L::high_halves(u[i].a, u[i].b); });
    const auto zeros = of_each<n>([&](I i) { return L::leading_zeros_32(high[i]); });
    const auto words = of_each<n>([&](I i) { return L::bit_and(zeros[i], L::set_32(~1)); });
    const auto even = of_each<n>([&](I i) { return L::bit_and(words[i], L::set(UINT32_MAX)); });
    const auto odd = of_each<n>([&](I i) { return L::template shift_right<32>(words[i]); });
    const auto a = of_each<n>([&](I i) { return L::shift_left_each(u[i].a, even[i]); });
    const auto b = of_each<n>([&](I i) { return L::shift_left_each(u[i].b, odd[i]); });
    return {of_each<n>([&](I i) {
                return high_numbers<L>({a[i], b[i]});
            }),
            of_each<n>([&](I i) {
                return Group<L>{even[i], odd[i]};
            })};
}

// min(L/len, 2) − 1 in Direction format from L/len times 2^(shift - k).
template <typename L>
LKS_SELDOM Factors<L> relative_error_each(const Group<L>& product, typename L::Register shift,
                                          const Group<L>& twice_k) {
    using R = typename L::Register;
    const auto limited = [&](R wide, R k2) {
        const R ratio = L::shift_right_each(wide, L::subtract(shift, L::template shift_right<1>(k2)));
        const R two = L::set(2 * std::int64_t{direction_one});
        // Neither exceeds 2^63, so the sign of the difference decides.
        return L::select_by_sign(ratio, two, L::subtract(two, ratio));
    };
    using F = FactorsOf<L>;
    return F::less(F::low({limited(product.a, twice_k.a), limited(product.b, twice_k.b)}),
                   F::constant(direction_one));
}

template <typename L, bool soft, bool damped, bool multiplier>
class DistanceGroups {
    using R = typename L::Register;
    using G = Group<L>;
    using F = FactorsOf<L>;
    using N = Factors<L>;
    using I = std::uint32_t;
    using Lengths = LengthLanes<L>;

public:
    explicit DistanceGroups(const DistanceTask& task)
        : task_(task), narrow_(task.parameters.difference_shift), gain_shift_(task.parameters.gain_shift),
          rounded_gain_shift_(task.parameters.gain_shift),
          low_gain_shift_(L::make_shift(task.parameters.gain_shift - 31)),
          product_shift_(
              task.parameters.product_shift,
              task.parameters.product_shift > 0 ? std::int64_t{1} << (task.parameters.product_shift - 1) : 0),
          plain_(task.parameters.product_shift == 0), octave_(task.parameters.rest_exponent),
          ratio_shift_(L::set(32 + task.parameters.rest_exponent)),
          gain_rounding_(L::set(std::int64_t{1} << (task.parameters.gain_shift - 1))),
          error_share_(F::constant(task.parameters.error_share)),
          damping_share_(F::constant(task.parameters.damping_share)),
          length_shift_(L::set(30 - task.parameters.difference_shift)), axes_{task.arrays.x, task.arrays.y,
                                                                              task.arrays.z},
          starts_{task.arrays.start_x, task.arrays.start_y, task.arrays.start_z} {}

    template <typename Access>
    LKS_FORCE_INLINE void find_differences(const Access& at, StagedGroup<L>& group) const {
        R beyond = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            const N now = lifted_difference(at, axes_[axis], beyond);
            group.d[axis] = Narrowing<L>::unlifted(now);
            if constexpr (damped) {
                const N start = lifted_difference(at, starts_[axis], beyond);
                add_product(group.motion, axis, group.d[axis], F::difference(now, start));
            }
            add_product(group.u, axis, group.d[axis], group.d[axis]);
        }
        const R high_u = F::high_words(group.u);
        R outside = L::equal_32(high_u, L::set_32(0));
        R unusual = octave_.leaves(high_u);
        if constexpr (damped) {
            const R much = exceeds(F::high_words(group.motion), high_u);
            outside = L::bit_or(outside, much);
            unusual = L::bit_or(unusual, much);
        }
        if constexpr (!Access::whole) {
            const R mask = F::high_words(at.masked({L::set(-1), L::set(-1)}));
            outside = L::bit_and(outside, mask);
            unusual = L::bit_and(unusual, mask);
        }
        if constexpr (L::has_shift_each) {
            group.in_octave = false;
            group.plain = narrow_.leaves(beyond, outside);
        } else {
            group.in_octave = !narrow_.leaves(beyond, unusual);
            group.plain = false;
            if (!group.in_octave) [[unlikely]] {
                group.plain = narrow_.leaves(beyond, outside);
            }
        }
    }

    // Of n groups at once.
    template <std::uint32_t n, typename Access>
    LKS_FORCE_INLINE void find_corrections(const Access* at, StagedGroup<L>* groups) const {
        bool in_octave = !L::has_shift_each;
        if constexpr (!L::has_shift_each) {
            for (I i = 0; i < n; ++i) {
                in_octave = in_octave && groups[i].in_octave;
            }
        }
        const Aligned<L, n> aligned = align<n>(groups, in_octave);
        const auto words = reciprocal_sqrt_lanes<L, n>(aligned.m);
        for (I i = 0; i < n; ++i) {
            const Lengths lengths{aligned.twice_k[i], aligned.m[i].factors, F::of_words(words[i])};
            const G ratio = F::multiply_unsigned(at[i].load(task_.rest_mantissas), lengths.y);
            if (in_octave) [[likely]] {
                // It is in the upper half, and not limited: below 2.
                groups[i].f = F::of_words(L::subtract_32(F::high_words(ratio), L::set_32(direction_one)));
            } else {
                groups[i].f = relative_error_each<L>(ratio, ratio_shift_, lengths.twice_k);
            }
            find_correction(at[i], groups[i], lengths);
        }
    }

    template <bool alike_throughout, typename Access>
    LKS_FORCE_INLINE void move(const Access& at, const StagedGroup<L>& group) const {
        const N share_a = at.load(task_.shares_a);
        if constexpr (alike_throughout) {
            move_alike(at, group.d, group.f, share_a);
            return;
        }
        const N share_b = at.load(task_.shares_b);
        if (F::all_equal(share_a, share_b)) {
            move_alike(at, group.d, group.f, share_a);
        } else {
            move_by_share(at, group.d, group.f, share_a, share_b);
        }
    }

private:
    struct Squares {
        const StagedGroup<L>* groups;
        LKS_FORCE_INLINE const G& operator[](I i) const { return groups[i].u; }
    };

    template <std::uint32_t n>
    LKS_FORCE_INLINE Aligned<L, n> align(const StagedGroup<L>* groups, bool in_octave) const {
        if constexpr (L::has_shift_each) {
            return align_each<L, n>(Squares{groups});
        } else {
            const auto u = of_each<n>([&](I i) { return groups[i].u; });
            if (in_octave) [[likely]] {
                return {of_each<n>([&](I i) { return octave_.align(u[i]); }), of_each<n>([&](I) {
                            return G{octave_.twice_k(), octave_.twice_k()};
                        })};
            }
            return align_each<L, n>(u);
        }
    }

    template <typename Access>
    LKS_FORCE_INLINE void find_correction(const Access& at, StagedGroup<L>& group,
                                          const Lengths& lengths) const {
        if constexpr (soft && (damped || multiplier)) {
            group.plain = !soften(at, group, lengths) || group.plain;
        }
        if constexpr (multiplier) {
            at.clear_done(group.f);
            if (!group.plain) {
                add_to_multipliers(at, lengths, group.f);
            }
        }
    }

    // x_a − x_b in difference units, lifted.
    template <typename Access>
    LKS_FORCE_INLINE N lifted_difference(const Access& at, const std::int64_t* x, R& beyond) const {
        const G a = at.load_a(x);
        const G b = at.load_b(x);
        G wide{L::subtract(a.a, b.a), L::subtract(a.b, b.b)};
        if constexpr (!Access::whole) {
            wide = at.masked(wide);
        }
        return narrow_(wide, beyond);
    }

    // The sign bit of words in which |motion| might exceed u, from the high halves of both.
    LKS_FORCE_INLINE static R exceeds(R high_motion, R high_u) {
        const R below = L::add_32(high_u, high_motion);
        const R above = L::subtract_32(L::add_32(high_u, L::set_32(-1)), high_motion);
        return L::bit_and(L::bit_or(below, above), L::set_32(INT32_MIN));
    }

    // sum = v·w for the first axis, and more by it for the others.
    LKS_FORCE_INLINE static void add_product(G& sum, int axis, const N& v, const N& w) {
        const G product = F::multiply_signed(v, w);
        // By halves: whole, compilers would copy it through memory.
        sum.a = axis == 0 ? product.a : L::add(sum.a, product.a);
        sum.b = axis == 0 ? product.b : L::add(sum.b, product.b);
    }

    // f from g. False: a lane leaves the fast range.
    template <typename Access>
    LKS_FORCE_INLINE bool soften(const Access& at, StagedGroup<L>& group, const Lengths& lengths) const {
        const bool relaxed = multiplier && task_.relaxations != nullptr;
        if constexpr (damped) {
            const G f = damp(group, lengths);
            if (relaxed) {
                return relax_by_multiplier(at, lengths, f, group.f);
            }
            group.f = F::low(f);
        } else if (relaxed) {
            const G f = F::multiply_signed(group.f, F::splat(F::constant(1)));
            return relax_by_multiplier(at, lengths, f, group.f);
        }
        return true;
    }

    template <typename Access>
    LKS_FORCE_INLINE bool relax_by_multiplier(const Access& at, const Lengths& lengths, const G& f,
                                              N& relaxed) const {
        R beyond = L::set(0);
        const N length = Narrowing<L>::unlifted(narrow_(at.load_wide(task_.arrays.multipliers), beyond));
        const G share = rounded_unit_shift_(F::multiply_signed(at.load(task_.relaxations), length));
        const G product = F::multiply_signed(F::low(share), lengths.y);
        const R a = L::subtract(f.a, over_length(product.a, LengthShift(lengths.twice_k.a)));
        const R b = L::subtract(f.b, over_length(product.b, LengthShift(lengths.twice_k.b)));
        relaxed = F::low({a, b});
        // |f| ≤ 1, but for the upper end itself.
        const R above = L::bit_or(L::add(a, L::set(direction_one)), L::add(b, L::set(direction_one)));
        return !narrow_.leaves(beyond, L::set_32(0)) &&
               !L::any(L::bit_and(above, L::set(~std::int64_t{INT32_MAX})));
    }

    // c·g − γ'·motion/u. Only the low halves count where there are no multipliers: f is within ±1.
    LKS_FORCE_INLINE G damp(const StagedGroup<L>& group, const Lengths& lengths) const {
        const auto align = [](R motion, R twice_k) {
            return L::add(L::shift_left_each(motion, L::subtract(twice_k, L::set(2))),
                          L::set(std::int64_t{1} << 31));
        };
        const N high =
            F::high({align(group.motion.a, lengths.twice_k.a), align(group.motion.b, lengths.twice_k.b)});
        const N reciprocal = F::high(F::multiply_unsigned(lengths.y, lengths.y));
        const auto rounded = [](R product) {
            return L::template shift_right<28>(L::add(product, L::set(std::int64_t{1} << 27)));
        };
        const G product = F::multiply_signed(high, reciprocal);
        const N motion = F::low({rounded(product.a), rounded(product.b)});
        const G error = F::multiply_signed(F::splat(error_share_), group.f);
        const G damping = F::multiply_signed(F::splat(damping_share_), motion);
        const G f{L::subtract(error.a, damping.a), L::subtract(error.b, damping.b)};
        if constexpr (multiplier) {
            return rounded_unit_shift_(f);
        } else {
            const auto low = [](R sum) {
                return L::template shift_right<unit_fraction_bits>(
                    L::add(sum, L::set(std::int64_t{1} << (unit_fraction_bits - 1))));
            };
            return {low(f.a), low(f.b)};
        }
    }

    // By 32 − k to the right, and half of what is lost.
    struct LengthShift {
        explicit LengthShift(R twice_k)
            : right(L::subtract(L::set(32), L::template shift_right<1>(twice_k))),
              half(L::shift_left_each(L::set(1), L::subtract(right, L::set(1)))) {}
        R right, half;
    };

    // Of products with y; the shift with its sign, by lanes.
    LKS_FORCE_INLINE static R over_length(R product, const LengthShift& by) {
        const R lift = L::set(std::int64_t{1} << 62);
        const R lifted = L::add(product, L::add(lift, by.half));
        return L::subtract(L::shift_right_each(lifted, by.right), L::shift_right_each(lift, by.right));
    }

    // Λ += f·len.
    template <typename Access>
    LKS_FORCE_INLINE void add_to_multipliers(const Access& at, const Lengths& lengths, const N& f) const {
        const G root = F::multiply_unsigned(lengths.m, lengths.y);
        const G product = F::multiply_signed(f, F::low({root_of(root.a), root_of(root.b)}));
        const G lambda = at.load_wide(task_.arrays.multipliers);
        at.store_wide(task_.arrays.multipliers, {L::add(lambda.a, length_of(product.a, lengths.twice_k.a)),
                                                 L::add(lambda.b, length_of(product.b, lengths.twice_k.b))});
    }

    // √m from m times 1/√m, at most one.
    LKS_FORCE_INLINE static R root_of(R product) {
        const R rounded = L::template shift_right<31>(product);
        return L::select_by_sign_32(rounded, L::set(INT32_MAX), rounded);
    }

    // From f·√m.
    LKS_FORCE_INLINE R length_of(R product, R twice_k) const {
        const R right = L::add(length_shift_, L::template shift_right<1>(twice_k));
        const R lift = L::set(std::int64_t{1} << 62);
        return L::subtract(L::shift_right_each(L::add(L::add(product, product), lift), right),
                           L::shift_right_each(lift, right));
    }

    template <typename Access>
    LKS_FORCE_INLINE void move_alike(const Access& at, const N* d, const N& f, const N& share) const {
        const N gain = rounded_gain_shift_.factors(F::multiply_signed(share, f));
        for (int axis = 0; axis < 3; ++axis) {
            const G correction = to_coordinate(F::multiply_signed(d[axis], gain));
            at.move(axes_[axis], correction, correction);
        }
    }

    LKS_FORCE_INLINE G to_coordinate(const G& product) const {
        if constexpr (soft) {
            return plain_ ? product : product_shift_(product);
        } else {
            return product;
        }
    }

    struct LongGain {
        N high, low;
    };

    // Where the shares are equal: the rounded gain, and no bits behind it.
    LKS_FORCE_INLINE LongGain long_gain(const N& share, const N& f, const G& alike) const {
        G product = F::multiply_signed(share, f);
        product = {L::add(product.a, L::bit_and(gain_rounding_, alike.a)),
                   L::add(product.b, L::bit_and(gain_rounding_, alike.b))};
        const auto low = [this](R value, R none) {
            return L::and_not(none, L::bit_and(L::shift_right(value, low_gain_shift_), L::set(INT32_MAX)));
        };
        return {gain_shift_.factors(product), F::low({low(product.a, alike.a), low(product.b, alike.b)})};
    }

    LKS_FORCE_INLINE G long_product(const N& difference, const LongGain& gain) const {
        const G high = F::multiply_signed(difference, gain.high);
        const G low = low_product_shift_(F::multiply_signed(difference, gain.low));
        return to_coordinate({L::add(high.a, low.a), L::add(high.b, low.b)});
    }

    template <typename Access>
    LKS_FORCE_INLINE void move_by_share(const Access& at, const N* d, const N& f, const N& share_a,
                                        const N& share_b) const {
        const G alike = F::equal(share_a, share_b);
        const LongGain gain_a = long_gain(share_a, f, alike);
        const LongGain gain_b = long_gain(share_b, f, alike);
        for (int axis = 0; axis < 3; ++axis) {
            at.move(axes_[axis], long_product(d[axis], gain_a), long_product(d[axis], gain_b));
        }
    }

    DistanceTask task_; // a copy, so that what is stored can't be thought to change it
    Narrowing<L> narrow_;
    SignedShift<L> gain_shift_;
    GainShift<L> rounded_gain_shift_;
    typename L::Shift low_gain_shift_;
    SignedShift<L> low_product_shift_{31};
    SignedShift<L> rounded_unit_shift_{unit_fraction_bits, std::int64_t{1} << (unit_fraction_bits - 1)};
    SignedShift<L> product_shift_;
    bool plain_;
    Octave<L> octave_;
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
        if constexpr (Access::together == 1) {
            project_alone(*at);
            return;
        }
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
    // By itself, in registers from one stage to the next.
    template <typename Access>
    LKS_FORCE_INLINE void project_alone(const Access& at) const {
        StagedGroup<L> group;
        groups_.find_differences(at, group);
        groups_.template find_corrections<1>(&at, &group);
        at.clear_done(group.f);
        if (group.plain) {
            at.for_each([this](std::uint32_t constraint, std::uint32_t a, std::uint32_t b) {
                project_one(constraint, a, b);
            });
        } else if (!is_in(unequal_, at.first_constraint())) {
            groups_.template move<true>(at, group);
        } else {
            groups_.template move<false>(at, group);
        }
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
                groups[taken++] = group();
            }
            if (next_ == part_.run_count) {
                return taken;
            }
            begin_run(run_part(part_, next_++));
        }
    }

    // All of them, one after the other.
    LKS_FORCE_INLINE void project_in_turn() {
        while (next_ != part_.run_count) {
            begin_run(run_part(part_, next_++));
            for (; at_ < in_groups_; at_ += lanes) {
                stages_.project_alone(group());
            }
        }
    }

    void finish() {
        if (short_count_ != 0) {
            stages_.project_apart(short_, short_count_);
        }
    }

private:
    static constexpr std::uint32_t lanes = 2 * L::half;

    LKS_FORCE_INLINE RunAccess<L> group() const {
        const std::uint32_t done = at_ + lanes > in_groups_ ? at_ + lanes - in_groups_ : 0;
        const std::uint32_t from = at_ - done;
        return {run_.constraint + from, run_.a + from, run_.b + from, done};
    }

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
    if constexpr (L::together == 1) {
        runs.project_in_turn();
    } else {
        RunAccess<L> groups[L::together];
        std::uint32_t count;
        while ((count = runs.take(groups)) == L::together) {
            stages.project(groups, L::together);
        }
        if (count != 0) {
            stages.project_apart(groups, count);
        }
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

// One function for each kind of task, called through this table: linkers for WebAssembly would join what is
// called from one place alone, and engines allocate registers badly in functions of that size.
template <typename L>
constexpr void (*project_kinds[])(const DistanceTask&) = {
    project_in_groups<L, false, false, false>, project_in_groups<L, true, false, false>,
    project_in_groups<L, true, true, false>,   project_in_groups<L, false, false, true>,
    project_in_groups<L, true, false, true>,   project_in_groups<L, true, true, true>};

template <typename L>
inline void project_lanes(const DistanceTask& task) {
    const int softness = !task.soft ? 0 : !task.damped ? 1 : 2;
    project_kinds<L>[softness + (task.arrays.multipliers != nullptr ? 3 : 0)](task);
}

} // namespace
} // namespace lks
