// Shifts of a group's numbers by a count that all constraints of a batch share.
//
// Where an instruction set has them, they are one instruction. Engines make four of a shift in WebAssembly
// whose count they don't know; there, multiplications by powers of two and shifts by fixed counts take their
// place (L::has_quick_shift).
#pragma once

#include <type_traits>

#include "fixed/formats.h"
#include "kernels/distance_task.h"
#include "kernels/factors.h"

namespace lks {
namespace {

// In place of constants that an instruction set has no use for: what is made for each call takes its time.
struct Needless {
    explicit Needless(int) {}
};

// value · 2^-count with its sign, rounded down after `rounding` was added; |value| < 2^62. Where there is no
// such shift the value is made positive, and back.
template <typename L>
class SignedShift {
    using R = typename L::Register;

public:
    explicit SignedShift(int count, std::int64_t rounding = 0)
        : count_(L::make_shift(count)), before_(L::set(rounding + lift)), after_(count) {}

    LKS_FORCE_INLINE R operator()(R value) const {
        const R lifted = L::add(value, before_);
        if constexpr (L::has_signed_shift) {
            return L::shift_right_signed(lifted, count_);
        } else {
            return L::subtract(L::shift_right(lifted, count_), after_.lanes);
        }
    }
    LKS_FORCE_INLINE Group<L> operator()(const Group<L>& values) const {
        return {(*this)(values.a), (*this)(values.b)};
    }
    LKS_FORCE_INLINE Factors<L> factors(const Group<L>& values) const {
        if constexpr (L::has_signed_shift) {
            return FactorsOf<L>::low((*this)(values));
        } else {
            using F = FactorsOf<L>;
            return F::less(F::low({L::shift_right(L::add(values.a, before_), count_),
                                   L::shift_right(L::add(values.b, before_), count_)}),
                           after_.low);
        }
    }

private:
    static constexpr std::int64_t lift = L::has_signed_shift ? 0 : std::int64_t{1} << 62;

    // What the shift makes of it.
    struct Lift {
        explicit Lift(int count) : lanes(L::set(lift >> count)), low(FactorsOf<L>::constant(lift >> count)) {}
        R lanes;
        R low;
    };

    typename L::Shift count_;
    R before_;
    std::conditional_t<L::has_signed_shift, Needless, Lift> after_;
};

// The same to the nearest, for counts from 31 on and values within ±2^61.
template <typename L>
class GainShift {
    using R = typename L::Register;
    using F = FactorsOf<L>;

public:
    explicit GainShift(int count) : shift_(count) {}

    LKS_FORCE_INLINE Factors<L> factors(const Group<L>& values) const { return shift_.factors(values); }

private:
    struct Whole : SignedShift<L> {
        explicit Whole(int count) : SignedShift<L>(count, std::int64_t{1} << (count - 1)) {}
    };
    // By 31 in 64-bit lanes, and the rest in words.
    struct InTwo {
        explicit InTwo(int count)
            : rest(L::make_shift(count - 31)), rounding(L::set(std::int64_t{1} << (count - 1))) {}
        LKS_FORCE_INLINE Factors<L> factors(const Group<L>& values) const {
            return L::shift_right_32_signed(F::low({L::template shift_right<31>(L::add(values.a, rounding)),
                                                    L::template shift_right<31>(L::add(values.b, rounding))}),
                                            rest);
        }
        typename L::Shift rest;
        R rounding;
    };

    std::conditional_t<L::has_quick_shift, Whole, InTwo> shift_;
};

// The same of each times a share of a half: nothing is multiplied.
template <typename L>
class HalfGain {
    using R = typename L::Register;

public:
    explicit HalfGain(int gain_shift)
        : count_(L::make_shift(gain_shift - half_share_bits)),
          rounding_(L::set_32(1 << (gain_shift - half_share_bits - 1))) {}

    LKS_FORCE_INLINE Factors<L> operator()(const Factors<L>& f) const {
        if constexpr (L::packs_factors) {
            return of(f);
        } else {
            return {of(f.a), of(f.b)};
        }
    }

private:
    LKS_FORCE_INLINE R of(R f) const { return L::shift_right_32_signed(L::add_32(f, rounding_), count_); }

    typename L::Shift count_;
    R rounding_;
};

// Numbers of 64 bits to 32 bits in units of 2^count, 20 .. 30, to the nearest and within ±2^30: lifted, that
// is 2^30 more.
template <typename L>
class Narrowing {
    using R = typename L::Register;
    using F = FactorsOf<L>;

public:
    // Half a unit to round, and what makes 2^30 units positive.
    explicit Narrowing(int count)
        : bias_(L::set((std::int64_t{1} << (count - 1)) + (std::int64_t{1} << (count + 30)))),
          count_(L::make_shift(count)), product_(count) {}

    // `beyond` starts as zero and collects what leaves() needs.
    LKS_FORCE_INLINE Factors<L> operator()(const Group<L>& wide, R& beyond) const {
        const Group<L> biased{L::add(wide.a, bias_), L::add(wide.b, bias_)};
        if constexpr (L::has_quick_shift) {
            const Group<L> units{L::shift_right(biased.a, count_), L::shift_right(biased.b, count_)};
            beyond = L::bit_or(beyond, L::bit_or(units.a, units.b));
            return F::low(units);
        } else {
            const R high = F::high(biased);
            beyond = L::bit_or(beyond, high);
            // Of the low half 15 bits count, which have room for the power.
            const R low = L::multiply_low_32(L::template shift_right_32<17>(F::low(biased)), product_.power);
            return L::add_32(L::multiply_low_32(high, product_.power), L::template shift_right_32<15>(low));
        }
    }
    LKS_FORCE_INLINE static Factors<L> unlifted(const Factors<L>& lifted) {
        return F::less(lifted, F::constant(direction_one));
    }
    // Whether a number was too large, or one of these words is zero.
    LKS_FORCE_INLINE bool leaves_or_vanishes(R beyond, R words) const {
        if constexpr (L::has_mask_tests) {
            return L::any_beyond_or_zero(beyond, words);
        } else {
            return leaves(beyond, L::equal_32(words, L::set_32(0)));
        }
    }
    // Whether a number was too large, or the sign bit of one of these words is set.
    LKS_FORCE_INLINE bool leaves(R beyond, R words) const {
        if constexpr (L::has_quick_shift) {
            return L::any(
                L::bit_or(L::template shift_right_32<31>(words), L::template shift_right<31>(beyond)));
        } else {
            return L::any_negative_32(
                L::bit_or(L::bit_or(words, beyond), L::subtract_32(product_.highest, beyond)));
        }
    }

private:
    // Of a shift by multiplication.
    struct Product {
        explicit Product(int count)
            : power(L::set_32(1 << (32 - count))), highest(L::set_32((1 << (count - 1)) - 1)) {}
        R power;
        R highest;
    };

    R bias_;
    typename L::Shift count_;
    std::conditional_t<L::has_quick_shift, Needless, Product> product_;
};

// The high halves of u·2^count, for counts from 2 to 30.
template <typename L>
class HighShift {
    using R = typename L::Register;
    using F = FactorsOf<L>;

public:
    explicit HighShift(int count)
        : count_(L::make_shift(count)), down_(L::make_shift(32 - count)), power_(L::set_32(1 << count)) {}

    LKS_FORCE_INLINE Numbers<L> operator()(const Group<L>& u) const {
        if constexpr (L::has_quick_shift) {
            return high_numbers<L>({L::shift_left(u.a, count_), L::shift_left(u.b, count_)});
        } else {
            const R words =
                L::add_32(L::multiply_low_32(F::high(u), power_), L::shift_right_32(F::low(u), down_));
            return {words, words};
        }
    }

private:
    typename L::Shift count_;
    typename L::Shift down_;
    R power_;
};

} // namespace
} // namespace lks
