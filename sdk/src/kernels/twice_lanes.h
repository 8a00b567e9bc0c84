// Two registers of an instruction set as one of twice the width: each operation on both, one after the other,
// so that neither waits for the results of its own last step.
#pragma once

#include <cstdint>

namespace lks {
namespace {

template <typename L>
struct TwiceLanes {
    static constexpr std::uint32_t half = 2 * L::half;
    static constexpr std::uint32_t interleaved = L::interleaved;
    static constexpr std::uint32_t together = L::together;
    static constexpr std::uint32_t singles_together = L::singles_together;
    static constexpr bool has_rows = false;
    static constexpr std::uint32_t worth_a_group = L::worth_a_group;
    static constexpr bool has_signed_shift = L::has_signed_shift;
    static constexpr bool has_shift_each = L::has_shift_each;
    static constexpr bool has_minimum_64 = false;
    static constexpr bool has_mask_tests = false;
    static constexpr bool has_rounding_multiply_16 = L::has_rounding_multiply_16;
    static constexpr bool has_quick_shift = L::has_quick_shift;
    static constexpr bool packs_factors = true;
    static_assert(L::packs_factors);

    static constexpr std::uint32_t rolls_from = L::rolls_from;
    struct Register {
        typename L::Register a, b;
    };
    using R = Register;
    using Shift = typename L::Shift;

    static R load(const std::int64_t* p) { return {L::load(p), L::load(p + L::half)}; }
    static void store(std::int64_t* p, R v) {
        L::store(p, v.a);
        L::store(p + L::half, v.b);
    }
    static R load_32(const std::uint32_t* p) { return {L::load_32(p), L::load_32(p + half)}; }
    static R gather(const std::int64_t* p, const std::uint32_t* at) {
        return {L::gather(p, at), L::gather(p, at + half)};
    }
    static R set(std::int64_t value) { return {L::set(value), L::set(value)}; }
    static R set_32(std::int32_t value) { return {L::set_32(value), L::set_32(value)}; }
    static Shift make_shift(int count) { return L::make_shift(count); }

    static R add(R x, R y) { return {L::add(x.a, y.a), L::add(x.b, y.b)}; }
    static R subtract(R x, R y) { return {L::subtract(x.a, y.a), L::subtract(x.b, y.b)}; }
    static R shift_left(R v, Shift count) { return {L::shift_left(v.a, count), L::shift_left(v.b, count)}; }
    static R shift_right(R v, Shift count) {
        return {L::shift_right(v.a, count), L::shift_right(v.b, count)};
    }
    template <int count>
    static R shift_right(R v) {
        return {L::template shift_right<count>(v.a), L::template shift_right<count>(v.b)};
    }
    static R shift_right_each(R v, R counts) {
        return {L::shift_right_each(v.a, counts.a), L::shift_right_each(v.b, counts.b)};
    }
    static R shift_left_each(R v, R counts) {
        return {L::shift_left_each(v.a, counts.a), L::shift_left_each(v.b, counts.b)};
    }
    static R select_by_sign(R x, R y, R sign) {
        return {L::select_by_sign(x.a, y.a, sign.a), L::select_by_sign(x.b, y.b, sign.b)};
    }

    // Of 32-bit numbers the first `half` are in the first register.
    static R multiply_low_half_signed(R x, R y) {
        return {L::multiply_low_half_signed(x.a, y.a), L::multiply_high_half_signed(x.a, y.a)};
    }
    static R multiply_high_half_signed(R x, R y) {
        return {L::multiply_low_half_signed(x.b, y.b), L::multiply_high_half_signed(x.b, y.b)};
    }
    static R multiply_low_half_unsigned(R x, R y) {
        return {L::multiply_low_half_unsigned(x.a, y.a), L::multiply_high_half_unsigned(x.a, y.a)};
    }
    static R multiply_high_half_unsigned(R x, R y) {
        return {L::multiply_low_half_unsigned(x.b, y.b), L::multiply_high_half_unsigned(x.b, y.b)};
    }
    static R pack_low_halves(R x, R y) {
        return {L::pack_low_halves(x.a, x.b), L::pack_low_halves(y.a, y.b)};
    }
    static R pack_high_halves(R x, R y) {
        return {L::pack_high_halves(x.a, x.b), L::pack_high_halves(y.a, y.b)};
    }
    static R high_halves(R x, R y) { return {L::high_halves(x.a, y.a), L::high_halves(x.b, y.b)}; }

    static R add_32(R x, R y) { return {L::add_32(x.a, y.a), L::add_32(x.b, y.b)}; }
    static R subtract_32(R x, R y) { return {L::subtract_32(x.a, y.a), L::subtract_32(x.b, y.b)}; }
    static R equal_32(R x, R y) { return {L::equal_32(x.a, y.a), L::equal_32(x.b, y.b)}; }
    static R absolute_32(R v) { return {L::absolute_32(v.a), L::absolute_32(v.b)}; }
    static R minimum_32(R x, R y) { return {L::minimum_32(x.a, y.a), L::minimum_32(x.b, y.b)}; }
    static R multiply_low_32(R x, R y) {
        return {L::multiply_low_32(x.a, y.a), L::multiply_low_32(x.b, y.b)};
    }
    template <int count>
    static R shift_left_32(R v) {
        return {L::template shift_left_32<count>(v.a), L::template shift_left_32<count>(v.b)};
    }
    template <int count>
    static R shift_right_32(R v) {
        return {L::template shift_right_32<count>(v.a), L::template shift_right_32<count>(v.b)};
    }
    template <int count>
    static R shift_right_32_signed(R v) {
        return {L::template shift_right_32_signed<count>(v.a), L::template shift_right_32_signed<count>(v.b)};
    }
    static R shift_right_32(R v, Shift count) {
        return {L::shift_right_32(v.a, count), L::shift_right_32(v.b, count)};
    }
    static R shift_right_32_signed(R v, Shift count) {
        return {L::shift_right_32_signed(v.a, count), L::shift_right_32_signed(v.b, count)};
    }
    static R select_by_sign_32(R x, R y, R sign) {
        return {L::select_by_sign_32(x.a, y.a, sign.a), L::select_by_sign_32(x.b, y.b, sign.b)};
    }
    static R leading_zeros_32(R v) { return {L::leading_zeros_32(v.a), L::leading_zeros_32(v.b)}; }
    static R coefficient_index(R entry) {
        return {L::coefficient_index(entry.a), L::coefficient_index(entry.b)};
    }
    template <typename Int16>
    static R coefficient(const Int16 (&table)[8], R index) {
        return {L::coefficient(table, index.a), L::coefficient(table, index.b)};
    }
    static R multiply_16(R x, R y) { return {L::multiply_16(x.a, y.a), L::multiply_16(x.b, y.b)}; }

    static R bit_and(R x, R y) { return {L::bit_and(x.a, y.a), L::bit_and(x.b, y.b)}; }
    static R bit_or(R x, R y) { return {L::bit_or(x.a, y.a), L::bit_or(x.b, y.b)}; }
    static R exclusive_or(R x, R y) { return {L::exclusive_or(x.a, y.a), L::exclusive_or(x.b, y.b)}; }
    static R and_not(R mask, R v) { return {L::and_not(mask.a, v.a), L::and_not(mask.b, v.b)}; }
    static bool any(R v) { return L::any(L::bit_or(v.a, v.b)); }
    static bool any_negative_32(R v) { return L::any_negative_32(L::bit_or(v.a, v.b)); }
    static bool all(R v) { return L::all(L::bit_and(v.a, v.b)); }
};

} // namespace
} // namespace lks
