// Where a group of constraints keeps 32-bit numbers, so that 32×32→64 multiplications find them.
#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/force_inline.h"

namespace lks {
namespace {

// 2·L::half 64-bit numbers.
template <typename L>
struct Group {
    typename L::Register a, b;
};

// x86 multiplies even 32-bit lanes: factors are low in 64-bit lanes, with anything above them. Words, on
// which 32-bit operations work, are in one register: A's even, B's odd.
template <typename L>
struct EvenFactors {
    using R = typename L::Register;
    using Factors = Group<L>;

    // The same number everywhere.
    static R constant(std::int64_t value) { return L::set(value); }
    LKS_FORCE_INLINE static Factors splat(R constant) { return {constant, constant}; }
    LKS_FORCE_INLINE static Factors none() { return splat(L::set(0)); }
    static Factors load(const std::uint32_t* p) { return {L::load_widened(p), L::load_widened(p + L::half)}; }

    LKS_FORCE_INLINE static Factors low(const Group<L>& v) { return v; }
    LKS_FORCE_INLINE static Factors less(const Factors& v, R amount) {
        return {L::subtract(v.a, amount), L::subtract(v.b, amount)};
    }
    LKS_FORCE_INLINE static Factors difference(const Factors& x, const Factors& y) {
        return {L::subtract(x.a, y.a), L::subtract(x.b, y.b)};
    }
    LKS_FORCE_INLINE static Factors sum(const Factors& x, const Factors& y) {
        return {L::add(x.a, y.a), L::add(x.b, y.b)};
    }
    LKS_FORCE_INLINE static Factors high(const Group<L>& v) {
        return {L::template shift_right<32>(v.a), L::template shift_right<32>(v.b)};
    }
    LKS_FORCE_INLINE static R high_words(const Group<L>& v) { return L::high_halves(v.a, v.b); }
    LKS_FORCE_INLINE static Factors of_words(R words) { return {words, L::template shift_right<32>(words)}; }

    LKS_FORCE_INLINE static Group<L> multiply_signed(const Factors& x, const Factors& y) {
        return {L::multiply_signed(x.a, y.a), L::multiply_signed(x.b, y.b)};
    }
    LKS_FORCE_INLINE static Group<L> multiply_unsigned(const Factors& x, const Factors& y) {
        return {L::multiply_unsigned(x.a, y.a), L::multiply_unsigned(x.b, y.b)};
    }
    // Of loaded ones: all bits, or none.
    LKS_FORCE_INLINE static Factors equal(const Factors& x, R constant) {
        return {L::equal(x.a, constant), L::equal(x.b, constant)};
    }
    LKS_FORCE_INLINE static bool all_equal(const Factors& x, R constant) {
        const Factors alike = equal(x, constant);
        return L::all(L::bit_and(alike.a, alike.b));
    }
    // v where these are all bits.
    LKS_FORCE_INLINE static Factors where(const Factors& bits, const Factors& v) {
        return {L::bit_and(v.a, bits.a), L::bit_and(v.b, bits.b)};
    }
    LKS_FORCE_INLINE static Group<L> wide_where(const Factors& bits, const Group<L>& v) {
        return where(bits, v);
    }
};

// NEON and WebAssembly multiply one half of a register: factors are words, A's in the low half.
template <typename L>
struct PackedFactors {
    using R = typename L::Register;
    using Factors = R;

    static R constant(std::int64_t value) {
        return L::set_32(static_cast<std::int32_t>(static_cast<std::uint32_t>(value)));
    }
    LKS_FORCE_INLINE static Factors splat(R constant) { return constant; }
    LKS_FORCE_INLINE static Factors none() { return L::set(0); }
    static Factors load(const std::uint32_t* p) { return L::load_32(p); }

    LKS_FORCE_INLINE static Factors low(const Group<L>& v) { return L::pack_low_halves(v.a, v.b); }
    LKS_FORCE_INLINE static Factors less(Factors v, R amount) { return L::subtract_32(v, amount); }
    LKS_FORCE_INLINE static Factors difference(Factors x, Factors y) { return L::subtract_32(x, y); }
    LKS_FORCE_INLINE static Factors sum(Factors x, Factors y) { return L::add_32(x, y); }
    LKS_FORCE_INLINE static Factors high(const Group<L>& v) { return L::pack_high_halves(v.a, v.b); }
    LKS_FORCE_INLINE static R high_words(const Group<L>& v) { return high(v); }
    LKS_FORCE_INLINE static Factors of_words(R words) { return words; }

    LKS_FORCE_INLINE static Group<L> multiply_signed(Factors x, Factors y) {
        return {L::multiply_low_half_signed(x, y), L::multiply_high_half_signed(x, y)};
    }
    LKS_FORCE_INLINE static Group<L> multiply_unsigned(Factors x, Factors y) {
        return {L::multiply_low_half_unsigned(x, y), L::multiply_high_half_unsigned(x, y)};
    }
    LKS_FORCE_INLINE static Factors equal(Factors x, R constant) { return L::equal_32(x, constant); }
    LKS_FORCE_INLINE static bool all_equal(Factors x, R constant) { return L::all(equal(x, constant)); }
    LKS_FORCE_INLINE static Factors where(Factors bits, Factors v) { return L::bit_and(v, bits); }
    LKS_FORCE_INLINE static Group<L> wide_where(Factors bits, const Group<L>& v) {
        const Group<L> wide = multiply_signed(bits, L::set_32(1));
        return {L::bit_and(v.a, wide.a), L::bit_and(v.b, wide.b)};
    }
};

template <typename L>
using FactorsOf = std::conditional_t<L::packs_factors, PackedFactors<L>, EvenFactors<L>>;

template <typename L>
using Factors = typename FactorsOf<L>::Factors;

// The same numbers as factors and as words.
template <typename L>
struct Numbers {
    Factors<L> factors;
    typename L::Register words;
};

template <typename L>
LKS_FORCE_INLINE Numbers<L> high_numbers(const Group<L>& v) {
    return {FactorsOf<L>::high(v), FactorsOf<L>::high_words(v)};
}

} // namespace
} // namespace lks
