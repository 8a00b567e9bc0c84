// The steps of a group of constraints: kernels/distance_scalar.h over lanes.
#pragma once

#include "kernels/distance_access.h"
#include "kernels/distance_scalar.h"
#include "kernels/length_lanes.h"

namespace lks {
namespace {

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

// What a group's differences come to.
template <typename L, bool damped>
struct Sums {
    Group<L> u;
    Group<L> motion;
};
template <typename L>
struct Sums<L, false> {
    Group<L> u;
};

// A group that rolls (kernels/distance_rolling.h).
template <typename L, typename Access>
struct RollingGroup {
    Access at;
    StagedGroup<L> staged;
    bool apart;   // it goes in plain integers
    bool unequal; // some have ends with shares of their own
};

template <typename L, bool soft, bool damped, bool multiplier>
class DistanceGroups {
    using R = typename L::Register;
    using G = Group<L>;
    using F = FactorsOf<L>;
    using N = Factors<L>;
    using I = std::uint32_t;
    using Lengths = LengthLanes<L>;

public:
    using OfDifferences = Sums<L, damped>;

    explicit DistanceGroups(const DistanceTask& task)
        : task_(task), narrow_(task.parameters.difference_shift),
          rounded_gain_shift_(task.parameters.gain_shift), half_gain_(task.parameters.gain_shift),
          product_shift_(task.parameters.product_shift, rounding_of(task.parameters.product_shift)),
          octave_(task.parameters.rest_exponent),
          ratio_shift_(L::set(32 + task.parameters.rest_exponent)), axes_{task.arrays.x, task.arrays.y,
                                                                          task.arrays.z},
          starts_{task.arrays.start_x, task.arrays.start_y, task.arrays.start_z} {}

    template <typename Access>
    LKS_FORCE_INLINE void find_differences(const Access& at, StagedGroup<L>& group) const {
        R beyond = L::set(0);
        OfDifferences sums;
        find_each_difference(at, group.d, sums, beyond);
        group.u = sums.u;
        if constexpr (damped) {
            group.motion = sums.motion;
        }
        const R high_u = F::high_words(group.u);
        // Whether a lane is not as these words want it, or its motion is too large.
        const auto leaves = [&](R words) {
            if constexpr (damped) {
                words = L::bit_or(words, exceeds(high_magnitudes(group.motion), high_u));
            }
            if constexpr (!Access::whole) {
                words = L::bit_and(words, F::high_words(at.masked({L::set(-1), L::set(-1)})));
            }
            return narrow_.leaves(beyond, words);
        };
        group.in_octave = false;
        if constexpr (!L::has_shift_each) {
            group.in_octave = !leaves(octave_.leaves(high_u));
        }
        // Where there is damping u is larger than the motion's magnitude, and not zero.
        group.plain = !group.in_octave && leaves(damped ? L::set_32(0) : L::equal_32(high_u, L::set_32(0)));
    }

    // Of n groups at once.
    template <std::uint32_t n, typename Access>
    LKS_FORCE_INLINE void find_corrections(const Access* at, StagedGroup<L>* groups) const {
        bool in_octave = !L::has_shift_each;
        for (I i = 0; i < n; ++i) {
            in_octave = in_octave && groups[i].in_octave;
        }
        const Aligned<L, n> aligned = align<n>(groups, in_octave);
        const auto words = reciprocal_sqrt_lanes<L, n>(aligned.m);
        for (I i = 0; i < n; ++i) {
            const Lengths lengths{aligned.twice_k[i], aligned.m[i].factors, F::of_words(words[i])};
            const G ratio = F::multiply_unsigned(at[i].load(task_.rest_mantissas), lengths.y);
            if (in_octave) [[likely]] {
                // It is in the upper half, and not limited: below 2.
                groups[i].f = error_or_ratio(F::high_words(ratio));
            } else {
                groups[i].f = error_or_ratio(ratio, lengths.twice_k);
            }
            find_correction(at[i], groups[i], lengths, in_octave);
        }
    }

    template <bool alike_throughout, typename Access>
    LKS_FORCE_INLINE void move(const Access& at, const StagedGroup<L>& group) const {
        if (alike_throughout || alike(at)) {
            move_all<false>(at, group.d, group.f);
        } else {
            move_unequal(at, group, group.f);
        }
    }

    // The first group that rolls.
    template <typename Access>
    LKS_FORCE_INLINE void begin(RollingGroup<L, Access>& group, OfDifferences& sums) const {
        R beyond = L::set(0);
        find_each_difference(group.at, group.staged.d, sums, beyond);
        look_at<true>(group.staged, sums, beyond);
    }

    // From the sums of a group and f of the one before it the sums of the next and f of its own.
    // Between the steps of its square root the differences of the next are found, and the one before moves:
    // both ends alike, or each by its part. `in_octave`: the group's lengths are.
    template <bool in_octave, bool by_parts, typename Access>
    LKS_FORCE_INLINE void roll(const RollingGroup<L, Access>& before, const RollingGroup<L, Access>& now,
                               RollingGroup<L, Access>& next, OfDifferences& sums, N& f) const {
        R beyond = L::set(0);
        OfDifferences of_next;
        const N gain = find_gain<by_parts>(before.at, f);
        const auto meanwhile = [&](int axis) {
            if constexpr (Access::in_rows) {
                if (axis == 1) {
                    find_each_difference(next.at, next.staged.d, of_next, beyond);
                } else if (axis == 2) {
                    move_by_gain<by_parts>(before.at, before.staged.d, gain);
                }
            } else {
                find_difference(next.at, differences(next.at, axes_), start_differences(next.at), axis,
                                next.staged.d, of_next, beyond);
                move_axis<by_parts>(before.at, axis, before.staged.d[axis], gain);
            }
        };
        const Aligned<L, 1> aligned = align_sum<in_octave>(sums.u);
        const auto words = reciprocal_sqrt_lanes<L, 1>(aligned.m, meanwhile);
        const Lengths lengths{aligned.twice_k[0], aligned.m[0].factors, F::of_words(words[0])};
        const G ratio = F::multiply_unsigned(now.at.load(task_.rest_mantissas), lengths.y);
        f = in_octave ? error_or_ratio(F::high_words(ratio)) : error_or_ratio(ratio, lengths.twice_k);
        if constexpr (damped) {
            f = F::low(damp(sums.motion, f, lengths, in_octave));
        }
        now.at.clear_done(f);
        look_at<in_octave>(next.staged, of_next, beyond);
        sums = of_next;
    }

    // Where ends have shares of their own.
    template <typename Access>
    LKS_FORCE_INLINE void move_unequal(const Access& at, const StagedGroup<L>& group, const N& f) const {
        move_all<true>(at, group.d, f);
    }
    // Whether both ends move alike.
    template <typename Access>
    LKS_FORCE_INLINE bool alike(const Access& at) const {
        return F::all_equal(at.load(task_.parts_b), F::constant(half_part));
    }

private:
    // In rows coordinates stand together, in arrays each axis by itself.
    template <typename Access, typename Axes>
    LKS_FORCE_INLINE static auto differences(const Access& at, const Axes& axes) {
        if constexpr (Access::in_rows) {
            return at.differences(axes[0]);
        } else {
            return AxisDifferences<L, Access>{at, axes};
        }
    }

    template <typename Access>
    LKS_FORCE_INLINE auto start_differences([[maybe_unused]] const Access& at) const {
        if constexpr (damped) {
            return differences(at, starts_);
        } else {
            return NothingElse{};
        }
    }

    template <typename Access>
    LKS_FORCE_INLINE void find_each_difference(const Access& at, N* d, OfDifferences& sums, R& beyond) const {
        const auto now = differences(at, axes_);
        const auto start = start_differences(at);
        for (int axis = 0; axis < 3; ++axis) {
            find_difference(at, now, start, axis, d, sums, beyond);
        }
    }

    // d along one axis, and what it adds to the group's squares.
    template <typename Access, typename Now, typename Start>
    LKS_FORCE_INLINE void find_difference(const Access& at, const Now& wide,
                                          [[maybe_unused]] const Start& wide_start, int axis, N* d,
                                          OfDifferences& sums, R& beyond) const {
        const N now = lifted_difference(at, wide(axis), beyond);
        d[axis] = Narrowing<L>::unlifted(now);
        if constexpr (damped) {
            const N start = lifted_difference(at, wide_start(axis), beyond);
            add_product(sums.motion, axis, d[axis], F::difference(now, start));
        }
        add_product(sums.u, axis, d[axis], d[axis]);
    }
    // Whether a rolling group is one of a single octave, where that is asked, and whether it leaves the fast
    // range.
    template <bool asks_octave>
    LKS_FORCE_INLINE void look_at(StagedGroup<L>& group, const OfDifferences& sums, R beyond) const {
        const R high_u = F::high_words(sums.u);
        group.in_octave = asks_octave && is_in_octave(sums, high_u, beyond);
        group.plain = !group.in_octave && leaves(sums, high_u, beyond);
    }
    LKS_FORCE_INLINE bool is_in_octave(const OfDifferences& sums, R high_u, R beyond) const {
        if constexpr (L::has_mask_tests) {
            const bool outside =
                L::any_beyond_or_outside(beyond, high_u, octave_.lowest(), octave_.highest());
            if constexpr (damped) {
                return !outside & !L::any_beyond_or_not_greater(beyond, high_u, high_magnitudes(sums.motion));
            } else {
                return !outside;
            }
        } else {
            R words = octave_.leaves(high_u);
            if constexpr (damped) {
                words = L::bit_or(words, exceeds(high_magnitudes(sums.motion), high_u));
            }
            return !narrow_.leaves(beyond, words);
        }
    }
    LKS_FORCE_INLINE bool leaves(const OfDifferences& sums, R high_u, R beyond) const {
        if constexpr (damped) {
            const R magnitudes = high_magnitudes(sums.motion);
            if constexpr (L::has_mask_tests) {
                return L::any_beyond_or_not_greater(beyond, high_u, magnitudes);
            } else {
                return narrow_.leaves(beyond, exceeds(magnitudes, high_u));
            }
        } else {
            return narrow_.leaves_or_vanishes(beyond, high_u);
        }
    }

    template <bool in_octave>
    LKS_FORCE_INLINE Aligned<L, 1> align_sum(const G& u) const {
        if constexpr (in_octave) {
            return {{{octave_.align(u)}}, {{G{octave_.twice_k(), octave_.twice_k()}}}};
        } else {
            return align_each<L, 1>(Each<G, 1>{{u}});
        }
    }

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
    LKS_FORCE_INLINE void find_correction(const Access& at, StagedGroup<L>& group, const Lengths& lengths,
                                          [[maybe_unused]] bool in_octave) const {
        if constexpr (soft && (damped || multiplier)) {
            group.plain = !soften(at, group, lengths, in_octave) || group.plain;
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
    LKS_FORCE_INLINE N lifted_difference(const Access& at, G wide, R& beyond) const {
        if constexpr (!Access::whole) {
            wide = at.masked(wide);
        }
        return narrow_(wide, beyond);
    }

    // Where a high half of u is larger than one of these, |motion| is below u.
    LKS_FORCE_INLINE static R high_magnitudes(const G& motion) {
        return L::absolute_32(F::high_words(motion));
    }
    // The sign bit of words in which it is not.
    LKS_FORCE_INLINE static R exceeds(R magnitudes, R high_u) {
        return L::subtract_32(L::add_32(high_u, L::set_32(-1)), magnitudes);
    }

    // What damping starts from is L/len, all else g = L/len − 1. In words, or from L/len times
    // 2^(ratio_shift_ − k).
    LKS_FORCE_INLINE static N error_or_ratio(R ratio) {
        return F::of_words(damped ? ratio : L::subtract_32(ratio, L::set_32(direction_one)));
    }
    LKS_FORCE_INLINE N error_or_ratio(const G& product, const G& twice_k) const {
        const N ratio = limited_ratio_each<L>(product, ratio_shift_, twice_k);
        return damped ? ratio : F::less(ratio, F::constant(direction_one));
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
    LKS_FORCE_INLINE bool soften(const Access& at, StagedGroup<L>& group, const Lengths& lengths,
                                 [[maybe_unused]] bool in_octave) const {
        [[maybe_unused]] const bool relaxed = task_.relaxations != nullptr;
        if constexpr (damped) {
            const G f = damp(group.motion, group.f, lengths, in_octave);
            if constexpr (multiplier) {
                if (relaxed) {
                    return relax_by_multiplier(at, lengths, f, group.f);
                }
            }
            group.f = F::low(f);
        } else if constexpr (multiplier) {
            if (relaxed) {
                const G f = F::multiply_signed(group.f, F::splat(F::constant(1)));
                return relax_by_multiplier(at, lengths, f, group.f);
            }
        }
        return true;
    }

    static SignedShift<L> rounded_unit_shift() {
        return SignedShift<L>(unit_fraction_bits, std::int64_t{1} << (unit_fraction_bits - 1));
    }

    template <typename Access>
    LKS_FORCE_INLINE bool relax_by_multiplier(const Access& at, const Lengths& lengths, const G& f,
                                              N& relaxed) const {
        R beyond = L::set(0);
        const N length = Narrowing<L>::unlifted(narrow_(at.load_wide(task_.arrays.multipliers), beyond));
        const G share = rounded_unit_shift()(F::multiply_signed(at.load(task_.relaxations), length));
        const G product = F::multiply_signed(F::low(share), lengths.y);
        const R a = L::subtract(f.a, over_length(product.a, LengthShift(lengths.twice_k.a)));
        const R b = L::subtract(f.b, over_length(product.b, LengthShift(lengths.twice_k.b)));
        relaxed = F::low({a, b});
        // |f| ≤ 1, but for the upper end itself.
        const R above = L::bit_or(L::add(a, L::set(direction_one)), L::add(b, L::set(direction_one)));
        return !narrow_.leaves(beyond, L::set_32(0)) &&
               !L::any(L::bit_and(above, L::set(~std::int64_t{INT32_MAX})));
    }

    // motion·2^(2k − 2), high halves to the nearest.
    LKS_FORCE_INLINE N align_motion(const G& motion, const G& twice_k, bool in_octave) const {
        if (in_octave) [[likely]] {
            return octave_.align_signed(motion);
        }
        const auto align = [](R product, R k2) {
            return L::add(L::shift_left_each(product, L::subtract(k2, L::set(2))),
                          L::set(std::int64_t{1} << 31));
        };
        return F::high({align(motion.a, twice_k.a), align(motion.b, twice_k.b)});
    }

    // c·(L/len − 1) − γ'·motion/u. Only the low halves count where there are no multipliers: f is within ±1.
    LKS_FORCE_INLINE G damp(const G& motion, const N& ratio, const Lengths& lengths, bool in_octave) const {
        const N reciprocal = F::high(F::multiply_unsigned(lengths.y, lengths.y));
        const G product = F::multiply_signed(align_motion(motion, lengths.twice_k, in_octave), reciprocal);
        const N share =
            F::low({L::template shift_right<28>(product.a), L::template shift_right<28>(product.b)});
        const std::int64_t error_share = task_.parameters.error_share;
        const std::uint32_t damping_share = task_.parameters.damping_share;
        const std::int64_t before = damped_rounding(damping_share) - error_share * direction_one;
        const G error = F::multiply_unsigned(F::splat(F::constant(error_share)), ratio); // at most 2^62
        const G damping = F::multiply_signed(F::splat(F::constant(damping_share)), share);
        const G f{L::subtract(error.a, damping.a), L::subtract(error.b, damping.b)};
        if constexpr (multiplier) {
            return SignedShift<L>(unit_fraction_bits, before)(f);
        } else {
            const auto low = [before](R sum) {
                return L::template shift_right<unit_fraction_bits>(L::add(sum, L::set(before)));
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
        const R right =
            L::add(L::set(30 - task_.parameters.difference_shift), L::template shift_right<1>(twice_k));
        const R lift = L::set(std::int64_t{1} << 62);
        return L::subtract(L::shift_right_each(L::add(L::add(product, product), lift), right),
                           L::shift_right_each(lift, right));
    }

    // `by_parts`: as both_movements wants it. What is stiff and moves alike has a share of a half.
    template <bool by_parts, typename Access>
    LKS_FORCE_INLINE N find_gain(const Access& at, const N& f) const {
        if constexpr (!by_parts && !soft) {
            return half_gain_(f);
        } else {
            const N once = rounded_gain_shift_.factors(F::multiply_signed(at.load(task_.shares), f));
            if constexpr (by_parts && !soft) {
                return F::sum(once, F::where(moves_alike(at.load(task_.parts_b)), once));
            } else {
                return once;
            }
        }
    }
    LKS_FORCE_INLINE static N moves_alike(const N& part_b) {
        return F::equal(part_b, F::constant(half_part));
    }

    // Both ends alike, or each by its part.
    template <bool by_parts, typename Access>
    LKS_FORCE_INLINE void move_all(const Access& at, const N* d, const N& f) const {
        move_by_gain<by_parts>(at, d, find_gain<by_parts>(at, f));
    }

    template <bool by_parts, typename Access>
    LKS_FORCE_INLINE void move_by_gain(const Access& at, const N* d, const N& gain) const {
        if constexpr (!Access::in_rows) {
            for (int axis = 0; axis < 3; ++axis) {
                move_axis<by_parts>(at, axis, d[axis], gain);
            }
        } else if constexpr (by_parts) {
            const N part = at.load(task_.parts_b);
            const G x = both_movements(d[0], gain, part);
            const G y = both_movements(d[1], gain, part);
            const G z = both_movements(d[2], gain, part);
            const G x_b = part_of(x, part);
            const G y_b = part_of(y, part);
            const G z_b = part_of(z, part);
            at.move(axes_[0], less(x, x_b), less(y, y_b), less(z, z_b), x_b, y_b, z_b);
        } else {
            const G x = to_coordinate(F::multiply_signed(d[0], gain));
            const G y = to_coordinate(F::multiply_signed(d[1], gain));
            const G z = to_coordinate(F::multiply_signed(d[2], gain));
            at.move(axes_[0], x, y, z, x, y, z);
        }
    }

    template <bool by_parts, typename Access>
    LKS_FORCE_INLINE void move_axis(const Access& at, int axis, const N& d, const N& gain) const {
        if constexpr (by_parts) {
            const N part = at.load(task_.parts_b);
            const G both = both_movements(d, gain, part);
            const G of_b = part_of(both, part);
            at.move(axes_[axis], less(both, of_b), of_b);
        } else {
            const G correction = to_coordinate(F::multiply_signed(d, gain));
            at.move(axes_[axis], correction, correction);
        }
    }

    LKS_FORCE_INLINE G to_coordinate(const G& product) const {
        if constexpr (soft) {
            return task_.parameters.product_shift == 0 ? product : product_shift_(product);
        } else {
            return product;
        }
    }

    // Of both ends together: twice what each moves by where they move alike. Handed on by themselves: in one
    // structure, compilers would copy both movements through memory.
    LKS_FORCE_INLINE G both_movements(const N& difference, const N& gain_of_both, const N& part_b) const {
        const G product = F::multiply_signed(difference, gain_of_both);
        if constexpr (soft) {
            const G once = to_coordinate(product);
            const G again = F::wide_where(moves_alike(part_b), once);
            return {L::add(once.a, again.a), L::add(once.b, again.b)};
        } else {
            return product;
        }
    }
    // b's part of them: kernels/distance_scalar.h.
    LKS_FORCE_INLINE static G part_of(const G& both, const N& part) {
        constexpr int bits = direction_fraction_bits;
        const R below = L::set(direction_one - 1);
        const R half = L::set(direction_one / 2);
        const G high = F::multiply_signed(
            F::low({L::template shift_right<bits>(both.a), L::template shift_right<bits>(both.b)}), part);
        const G low =
            F::multiply_unsigned(F::low({L::bit_and(both.a, below), L::bit_and(both.b, below)}), part);
        return {L::add(high.a, L::template shift_right<bits>(L::add(low.a, half))),
                L::add(high.b, L::template shift_right<bits>(L::add(low.b, half)))};
    }
    LKS_FORCE_INLINE static G less(const G& both, const G& of_b) {
        return {L::subtract(both.a, of_b.a), L::subtract(both.b, of_b.b)};
    }

    DistanceTask task_; // a copy, so that what is stored can't be thought to change it
    Narrowing<L> narrow_;
    GainShift<L> rounded_gain_shift_;
    HalfGain<L> half_gain_;
    SignedShift<L> product_shift_;
    Octave<L> octave_;
    R ratio_shift_;
    std::int64_t* axes_[3];
    const std::int64_t* starts_[3];
};

} // namespace
} // namespace lks
