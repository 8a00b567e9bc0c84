// Two 64-bit lanes: SSE4.1. What AVX2 has and it has not is put together from two or three instructions.
#pragma once

#include <smmintrin.h>

#include <cstdint>

namespace lks {
namespace {

struct LanesSse41 {
    static constexpr std::uint32_t half = 2;
    // Groups of which the lengths are found step by step, side by side.
    static constexpr std::uint32_t interleaved = 3;
    // Groups that go through the stages together.
    static constexpr std::uint32_t together = 6;
    static constexpr std::uint32_t singles_together = 8;
    static constexpr bool has_rows = false;
    // Fewer constraints are faster by themselves than as part of a group.
    static constexpr std::uint32_t worth_a_group = 2;
    static constexpr std::uint32_t rolls_from = 0; // never
    // Fewer contacts of a group are faster one by one.
    static constexpr std::uint32_t worth_a_response = 2;
    using Register = __m128i;
    using Shift = __m128i;
    static constexpr bool has_signed_shift = false;
    static constexpr bool has_shift_each = false;
    static constexpr bool has_quick_shift = true;
    static constexpr bool has_minimum_64 = false;
    static constexpr bool has_multiply_low_64 = false;
    static constexpr bool has_mask_tests = false;
    static constexpr bool has_rounding_multiply_16 = true;
    static constexpr bool packs_factors = false;

    static Register load(const std::int64_t* p) {
        return _mm_loadu_si128(reinterpret_cast<const Register*>(p));
    }
    static void store(std::int64_t* p, Register v) { _mm_storeu_si128(reinterpret_cast<Register*>(p), v); }
    static Register load_widened(const std::uint32_t* p) {
        return _mm_cvtepu32_epi64(_mm_loadl_epi64(reinterpret_cast<const Register*>(p)));
    }
    // Every other index of `at`.
    static Register gather(const std::int64_t* p, const std::uint32_t* at) {
        return _mm_set_epi64x(p[at[2]], p[at[0]]);
    }
    static Register set(std::int64_t value) { return _mm_set1_epi64x(value); }
    static Register set_32(std::int32_t value) { return _mm_set1_epi32(value); }
    static Shift make_shift(int count) { return _mm_cvtsi32_si128(count); }

    static Register add(Register a, Register b) { return _mm_add_epi64(a, b); }
    static Register subtract(Register a, Register b) { return _mm_sub_epi64(a, b); }
    static Register shift_right(Register v, Shift count) { return _mm_srl_epi64(v, count); }
    static Register shift_left(Register v, Shift count) { return _mm_sll_epi64(v, count); }
    template <int count>
    static Register shift_right(Register v) {
        return _mm_srli_epi64(v, count);
    }
    template <int count>
    static Register shift_left(Register v) {
        return _mm_slli_epi64(v, count);
    }
    // Both lanes by either count, and from each the lane that it was meant for.
    static Register shift_right_each(Register v, Register counts) {
        return _mm_blend_epi16(_mm_srl_epi64(v, counts), _mm_srl_epi64(v, upper(counts)), 0xf0);
    }
    static Register shift_left_each(Register v, Register counts) {
        return _mm_blend_epi16(_mm_sll_epi64(v, counts), _mm_sll_epi64(v, upper(counts)), 0xf0);
    }
    static Register equal(Register a, Register b) { return _mm_cmpeq_epi64(a, b); }
    static Register minimum_signed(Register a, Register b) { return select_by_sign(a, b, less(b, a)); }
    static Register maximum_signed(Register a, Register b) { return select_by_sign(a, b, less(a, b)); }
    // b where the 64-bit lane of `sign` is negative.
    static Register select_by_sign(Register a, Register b, Register sign) {
        return _mm_castpd_si128(
            _mm_blendv_pd(_mm_castsi128_pd(a), _mm_castsi128_pd(b), _mm_castsi128_pd(sign)));
    }

    // Of the low halves of 64-bit lanes.
    static Register multiply_signed(Register a, Register b) { return _mm_mul_epi32(a, b); }
    static Register multiply_unsigned(Register a, Register b) { return _mm_mul_epu32(a, b); }
    // Even 32-bit lanes from a's high halves, odd ones from b's.
    static Register high_halves(Register a, Register b) {
        return _mm_blend_epi16(_mm_srli_epi64(a, 32), b, 0xcc);
    }

    static Register add_32(Register a, Register b) { return _mm_add_epi32(a, b); }
    static Register subtract_32(Register a, Register b) { return _mm_sub_epi32(a, b); }
    static Register equal_32(Register a, Register b) { return _mm_cmpeq_epi32(a, b); }
    static Register greater_32(Register a, Register b) { return _mm_cmpgt_epi32(a, b); }
    static Register absolute_32(Register v) { return _mm_abs_epi32(v); }
    static Register minimum_32(Register a, Register b) { return _mm_min_epi32(a, b); }
    static Register multiply_low_32(Register a, Register b) { return _mm_mullo_epi32(a, b); }
    template <int count>
    static Register shift_left_32(Register v) {
        return _mm_slli_epi32(v, count);
    }
    template <int count>
    static Register shift_right_32(Register v) {
        return _mm_srli_epi32(v, count);
    }
    static Register shift_right_32_signed(Register v, Shift count) { return _mm_sra_epi32(v, count); }
    template <int count>
    static Register shift_right_32_signed(Register v) {
        return _mm_srai_epi32(v, count);
    }
    static Register select_by_sign_32(Register a, Register b, Register sign) {
        return _mm_castps_si128(
            _mm_blendv_ps(_mm_castsi128_ps(a), _mm_castsi128_ps(b), _mm_castsi128_ps(sign)));
    }
    // Of positive numbers; see LanesAvx2.
    static Register leading_zeros_32(Register v) {
        const Register lone = _mm_andnot_si128(_mm_srli_epi32(v, 1), v);
        const Register exponent = _mm_srli_epi32(_mm_castps_si128(_mm_cvtepi32_ps(lone)), 23);
        return _mm_sub_epi32(_mm_set1_epi32(158), exponent);
    }
    // Bytes 4·index .. 4·index + 3 of the table's 32; a byte number with its top bit set gives zero.
    static Register lookup(const std::uint32_t (&table)[8], Register index) {
        const Register at =
            _mm_add_epi8(_mm_mullo_epi32(_mm_and_si128(index, _mm_set1_epi32(7)), _mm_set1_epi32(0x04040404)),
                         _mm_set1_epi32(0x03020100));
        const Register low = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const Register*>(table)),
                                              _mm_adds_epu8(at, _mm_set1_epi8(0x70)));
        const Register high = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const Register*>(table + 4)),
                                               _mm_sub_epi8(at, _mm_set1_epi8(16)));
        return _mm_or_si128(low, high);
    }

    static Register add_16(Register a, Register b) { return _mm_add_epi16(a, b); }
    static Register rounding_multiply_16(Register a, Register b) { return _mm_mulhrs_epi16(a, b); }
    template <int count>
    static Register shift_right_16_signed(Register v) {
        return _mm_srai_epi16(v, count);
    }

    static Register bit_and(Register a, Register b) { return _mm_and_si128(a, b); }
    static Register bit_or(Register a, Register b) { return _mm_or_si128(a, b); }
    static Register exclusive_or(Register a, Register b) { return _mm_xor_si128(a, b); }
    static Register and_not(Register mask, Register v) { return _mm_andnot_si128(mask, v); }
    // Bit i: lane i is negative.
    static std::uint32_t sign_bits(Register v) {
        return static_cast<std::uint32_t>(_mm_movemask_pd(_mm_castsi128_pd(v)));
    }
    static bool any(Register v) { return _mm_testz_si128(v, v) == 0; }
    // Every bit is set.
    static bool all(Register v) { return _mm_testc_si128(v, _mm_set1_epi32(-1)) != 0; }

private:
    // The sign bit: a < b.
    static Register less(Register a, Register b) {
        const Register borrows = _mm_and_si128(_mm_cmpeq_epi32(a, b), _mm_sub_epi64(a, b));
        return _mm_or_si128(borrows, _mm_cmpgt_epi32(b, a));
    }
    static Register upper(Register v) { return _mm_unpackhi_epi64(v, v); }
};

} // namespace
} // namespace lks
