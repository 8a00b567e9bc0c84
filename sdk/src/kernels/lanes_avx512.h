// Eight 64-bit lanes: AVX-512 F, BW, CD, DQ and VL.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace lks {
namespace {

struct LanesAvx512 {
    static constexpr std::uint32_t half = 8;
    // Groups of which the lengths are found step by step, side by side.
    static constexpr std::uint32_t interleaved = 3;
    // Groups that go through the stages together.
    static constexpr std::uint32_t together = 3;
    static constexpr std::uint32_t singles_together = 6;
    // Fewer constraints are faster by themselves than as part of a group.
    static constexpr std::uint32_t worth_a_group = 3;
    // Fewer contacts of a group are faster one by one.
    static constexpr std::uint32_t worth_a_response = 3;
    // Of several objects side by side more go over lanes, the same constraint of an object in each.
    static constexpr std::uint32_t worth_across = 5;
    // Parts of so many constraints roll (kernels/distance_rolling.h).
    static constexpr std::uint32_t rolls_from = 192;
    using Register = __m512i;
    using Shift = __m128i;
    static constexpr bool has_signed_shift = true;
    static constexpr bool has_shift_each = true;
    static constexpr bool has_quick_shift = true;
    static constexpr bool has_minimum_64 = true;
    static constexpr bool has_multiply_low_64 = true;
    static constexpr bool has_mask_tests = true;
    static constexpr bool has_rounding_multiply_16 = true;
    static constexpr bool packs_factors = false;

    static Register load(const std::int64_t* p) { return _mm512_loadu_si512(p); }
    static void store(std::int64_t* p, Register v) { _mm512_storeu_si512(p, v); }
    static Register load_widened(const std::uint32_t* p) {
        return _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
    }
    // Every other index of `at`.
    static Register gather(const std::int64_t* p, const std::uint32_t* at) {
        return _mm512_set_epi64(p[at[14]], p[at[12]], p[at[10]], p[at[8]], p[at[6]], p[at[4]], p[at[2]],
                                p[at[0]]);
    }
    static Register gather(const std::int64_t* p, const std::ptrdiff_t* at) {
        return _mm512_set_epi64(p[at[7]], p[at[6]], p[at[5]], p[at[4]], p[at[3]], p[at[2]], p[at[1]],
                                p[at[0]]);
    }

    // Rows of a particle (kernels/row_task.h), two to a register.
    static constexpr bool has_rows = true;
    template <typename Int>
    static Int* row(Int* rows, std::uint32_t particle) {
        return rows + 4 * std::size_t{particle};
    }
    static __m256i load_row(const std::int64_t* row) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row));
    }
    static void store_row(std::int64_t* row, __m256i v) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(row), v);
    }
    // The lower, or upper, 128 bits of each half of a, followed by b's.
    static Register low_quarters(Register a, Register b) {
        return _mm512_permutex2var_epi64(a, _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0), b);
    }
    static Register high_quarters(Register a, Register b) {
        return _mm512_permutex2var_epi64(a, _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2), b);
    }
    // Of rows 0 and 4, 1 and 5, and so on.
    static void from_pairs(const Register (&pairs)[4], Register (&columns)[4]) {
        const Register xz_0145 = _mm512_unpacklo_epi64(pairs[0], pairs[1]);
        const Register xz_2367 = _mm512_unpacklo_epi64(pairs[2], pairs[3]);
        const Register yw_0145 = _mm512_unpackhi_epi64(pairs[0], pairs[1]);
        const Register yw_2367 = _mm512_unpackhi_epi64(pairs[2], pairs[3]);
        columns[0] = low_quarters(xz_0145, xz_2367);
        columns[1] = low_quarters(yw_0145, yw_2367);
        columns[2] = high_quarters(xz_0145, xz_2367);
        columns[3] = high_quarters(yw_0145, yw_2367);
    }
    static void to_pairs(const Register (&columns)[4], Register (&pairs)[4]) {
        const Register xy_0246 = _mm512_unpacklo_epi64(columns[0], columns[1]);
        const Register xy_1357 = _mm512_unpackhi_epi64(columns[0], columns[1]);
        const Register zw_0246 = _mm512_unpacklo_epi64(columns[2], columns[3]);
        const Register zw_1357 = _mm512_unpackhi_epi64(columns[2], columns[3]);
        pairs[0] = low_quarters(xy_0246, zw_0246);
        pairs[1] = low_quarters(xy_1357, zw_1357);
        pairs[2] = high_quarters(xy_0246, zw_0246);
        pairs[3] = high_quarters(xy_1357, zw_1357);
    }
    // Four numbers from each lane's address on: address(lane).
    template <typename Address>
    static void load_rows(const Address& address, Register (&columns)[4]) {
        const auto and_fourth_next = [&](std::uint32_t i) {
            const auto at = [&](std::uint32_t lane) {
                return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(address(lane)));
            };
            return _mm512_inserti64x4(_mm512_castsi256_si512(at(i)), at(i + 4), 1);
        };
        from_pairs({and_fourth_next(0), and_fourth_next(1), and_fourth_next(2), and_fourth_next(3)}, columns);
    }
    template <typename Address>
    static void store_rows(const Address& address, const Register (&columns)[4]) {
        const auto put = [&](std::uint32_t i, Register v) {
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(address(i)), _mm512_castsi512_si256(v));
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(address(i + 4)), _mm512_extracti64x4_epi64(v, 1));
        };
        Register pairs[4];
        to_pairs(columns, pairs);
        for (std::uint32_t i = 0; i < 4; ++i) {
            put(i, pairs[i]);
        }
    }
    // Of both ends of half a group, along each axis.
    static void row_differences(const std::int64_t* rows, const std::uint32_t* ends, Register (&d)[3]) {
        const auto difference = [&](int i) {
            return _mm256_sub_epi64(load_row(row(rows, ends[2 * i])), load_row(row(rows, ends[2 * i + 1])));
        };
        const auto and_fourth_next = [&](int i) {
            return _mm512_inserti64x4(_mm512_castsi256_si512(difference(i)), difference(i + 4), 1);
        };
        Register columns[4];
        from_pairs({and_fourth_next(0), and_fourth_next(1), and_fourth_next(2), and_fourth_next(3)}, columns);
        for (int axis = 0; axis < 3; ++axis) {
            d[axis] = columns[axis];
        }
    }
    static void to_rows(const Register (&axes)[3], __m256i (&rows)[8]) {
        Register pairs[4];
        to_pairs({axes[0], axes[1], axes[2], set(0)}, pairs);
        for (int i = 0; i < 4; ++i) {
            rows[i] = _mm512_castsi512_si256(pairs[i]);
            rows[i + 4] = _mm512_extracti64x4_epi64(pairs[i], 1);
        }
    }
    // a += plus, b −= minus.
    static void move_rows(std::int64_t* rows, const std::uint32_t* ends, const Register (&plus)[3],
                          const Register (&minus)[3]) {
        __m256i plus_rows[8];
        __m256i minus_rows[8];
        to_rows(plus, plus_rows);
        to_rows(minus, minus_rows);
        for (int i = 0; i < 8; ++i) {
            std::int64_t* a = row(rows, ends[2 * i]);
            std::int64_t* b = row(rows, ends[2 * i + 1]);
            store_row(a, _mm256_add_epi64(load_row(a), plus_rows[i]));
            store_row(b, _mm256_sub_epi64(load_row(b), minus_rows[i]));
        }
    }

    static Register set(std::int64_t value) { return _mm512_set1_epi64(value); }
    static Register set_32(std::int32_t value) { return _mm512_set1_epi32(value); }
    static Shift make_shift(int count) { return _mm_cvtsi32_si128(count); }

    static Register add(Register a, Register b) { return _mm512_add_epi64(a, b); }
    static Register subtract(Register a, Register b) { return _mm512_sub_epi64(a, b); }
    static Register shift_right(Register v, Shift count) { return _mm512_srl_epi64(v, count); }
    static Register shift_right_signed(Register v, Shift count) { return _mm512_sra_epi64(v, count); }
    static Register shift_left(Register v, Shift count) { return _mm512_sll_epi64(v, count); }
    template <int count>
    static Register shift_right(Register v) {
        return _mm512_srli_epi64(v, count);
    }
    template <int count>
    static Register shift_left(Register v) {
        return _mm512_slli_epi64(v, count);
    }
    template <int count>
    static Register shift_right_signed(Register v) {
        return _mm512_srai_epi64(v, count);
    }
    static Register shift_right_each(Register v, Register counts) { return _mm512_srlv_epi64(v, counts); }
    static Register shift_left_each(Register v, Register counts) { return _mm512_sllv_epi64(v, counts); }
    static Register equal(Register a, Register b) { return _mm512_movm_epi64(_mm512_cmpeq_epi64_mask(a, b)); }
    static Register minimum_64(Register a, Register b) { return _mm512_min_epu64(a, b); }
    static Register minimum_signed(Register a, Register b) { return _mm512_min_epi64(a, b); }
    static Register maximum_signed(Register a, Register b) { return _mm512_max_epi64(a, b); }
    static Register multiply_low_64(Register a, Register b) { return _mm512_mullo_epi64(a, b); }
    // b where the 64-bit lane of `sign` is negative.
    static Register select_by_sign(Register a, Register b, Register sign) {
        return _mm512_mask_blend_epi64(_mm512_movepi64_mask(sign), a, b);
    }

    // Of the low halves of 64-bit lanes.
    static Register multiply_signed(Register a, Register b) { return _mm512_mul_epi32(a, b); }
    static Register multiply_unsigned(Register a, Register b) { return _mm512_mul_epu32(a, b); }
    // Even 32-bit lanes from a's high halves, odd ones from b's.
    static Register high_halves(Register a, Register b) {
        return _mm512_mask_blend_epi32(0xaaaa, _mm512_srli_epi64(a, 32), b);
    }

    static Register add_32(Register a, Register b) { return _mm512_add_epi32(a, b); }
    static Register subtract_32(Register a, Register b) { return _mm512_sub_epi32(a, b); }
    static Register equal_32(Register a, Register b) {
        return _mm512_movm_epi32(_mm512_cmpeq_epi32_mask(a, b));
    }
    static Register greater_32(Register a, Register b) {
        return _mm512_movm_epi32(_mm512_cmpgt_epi32_mask(a, b));
    }
    static Register absolute_32(Register v) { return _mm512_abs_epi32(v); }
    static Register minimum_32(Register a, Register b) { return _mm512_min_epi32(a, b); }
    static Register multiply_low_32(Register a, Register b) { return _mm512_mullo_epi32(a, b); }
    template <int count>
    static Register shift_left_32(Register v) {
        return _mm512_slli_epi32(v, count);
    }
    template <int count>
    static Register shift_right_32(Register v) {
        return _mm512_srli_epi32(v, count);
    }
    static Register shift_right_32_signed(Register v, Shift count) { return _mm512_sra_epi32(v, count); }
    template <int count>
    static Register shift_right_32_signed(Register v) {
        return _mm512_srai_epi32(v, count);
    }
    static Register select_by_sign_32(Register a, Register b, Register sign) {
        return _mm512_mask_blend_epi32(_mm512_movepi32_mask(sign), a, b);
    }
    static Register leading_zeros_32(Register v) { return _mm512_lzcnt_epi32(v); }
    static Register lookup(const std::uint32_t (&table)[8], Register index) {
        return _mm512_permutexvar_epi32(
            index, _mm512_broadcast_i64x4(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(table))));
    }

    static Register add_16(Register a, Register b) { return _mm512_add_epi16(a, b); }
    static Register rounding_multiply_16(Register a, Register b) { return _mm512_mulhrs_epi16(a, b); }
    template <int count>
    static Register shift_right_16_signed(Register v) {
        return _mm512_srai_epi16(v, count);
    }

    static Register bit_and(Register a, Register b) { return _mm512_and_si512(a, b); }
    static Register bit_or(Register a, Register b) { return _mm512_or_si512(a, b); }
    static Register exclusive_or(Register a, Register b) { return _mm512_xor_si512(a, b); }
    static Register and_not(Register mask, Register v) { return _mm512_andnot_si512(mask, v); }
    // Bit i: lane i is negative.
    static std::uint32_t sign_bits(Register v) { return _mm512_movepi64_mask(v); }
    static bool any(Register v) { return _mm512_test_epi64_mask(v, v) != 0; }
    // Every bit is set.
    static bool all(Register v) { return _mm512_cmpneq_epi64_mask(v, _mm512_set1_epi64(-1)) == 0; }

    // Whether a 64-bit lane is 2^31 or more, or a word zero.
    static bool any_beyond_or_zero(Register lanes, Register words) {
        const __mmask8 beyond = _mm512_test_epi64_mask(lanes, _mm512_set1_epi64(~std::int64_t{INT32_MAX}));
        return (beyond | _mm512_testn_epi32_mask(words, words)) != 0;
    }
    // Whether a 64-bit lane is 2^31 or more, or a word not between these.
    static bool any_beyond_or_outside(Register lanes, Register words, Register least, Register most) {
        const __mmask8 beyond = _mm512_test_epi64_mask(lanes, _mm512_set1_epi64(~std::int64_t{INT32_MAX}));
        return (beyond | _mm512_cmplt_epi32_mask(words, least) | _mm512_cmpgt_epi32_mask(words, most)) != 0;
    }
    // Whether a 64-bit lane is 2^31 or more, or a word of a no more than b's.
    static bool any_beyond_or_not_greater(Register lanes, Register a, Register b) {
        const __mmask8 beyond = _mm512_test_epi64_mask(lanes, _mm512_set1_epi64(~std::int64_t{INT32_MAX}));
        return (beyond | _mm512_cmple_epi32_mask(a, b)) != 0;
    }

    static void leave() { _mm256_zeroupper(); }
};

} // namespace
} // namespace lks
