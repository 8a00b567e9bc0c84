// Four 64-bit lanes: AVX2.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace lks {
namespace {

struct LanesAvx2 {
    static constexpr std::uint32_t half = 4;
    // Groups of which the lengths are found step by step, side by side.
    static constexpr std::uint32_t interleaved = 3;
    // Groups that go through the stages together.
    static constexpr std::uint32_t together = 6;
    static constexpr std::uint32_t singles_together = 8;
    // Fewer constraints are faster by themselves than as part of a group.
    static constexpr std::uint32_t worth_a_group = 2;
    // Fewer contacts of a group are faster one by one.
    static constexpr std::uint32_t worth_a_response = 2;
    // Of several objects side by side more go over lanes, the same constraint of an object in each.
    static constexpr std::uint32_t worth_across = 3;
    // Parts of so many constraints roll (kernels/distance_rolling.h).
    static constexpr std::uint32_t rolls_from = 192;
    using Register = __m256i;
    using Shift = __m128i;
    static constexpr bool has_signed_shift = false;
    static constexpr bool has_shift_each = true;
    static constexpr bool has_quick_shift = true;
    static constexpr bool has_minimum_64 = false;
    static constexpr bool has_multiply_low_64 = false;
    static constexpr bool has_mask_tests = false;
    static constexpr bool has_rounding_multiply_16 = true;
    static constexpr bool packs_factors = false;

    static Register load(const std::int64_t* p) {
        return _mm256_loadu_si256(reinterpret_cast<const Register*>(p));
    }
    static void store(std::int64_t* p, Register v) { _mm256_storeu_si256(reinterpret_cast<Register*>(p), v); }
    static Register load_widened(const std::uint32_t* p) {
        return _mm256_cvtepu32_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
    }
    // Every other index of `at`.
    static Register gather(const std::int64_t* p, const std::uint32_t* at) {
        return _mm256_set_epi64x(p[at[6]], p[at[4]], p[at[2]], p[at[0]]);
    }
    static Register gather(const std::int64_t* p, const std::ptrdiff_t* at) {
        return _mm256_set_epi64x(p[at[3]], p[at[2]], p[at[1]], p[at[0]]);
    }

    // Rows of a particle (kernels/row_task.h).
    static constexpr bool has_rows = true;
    template <typename Int>
    static Int* row(Int* rows, std::uint32_t particle) {
        return rows + 4 * std::size_t{particle};
    }
    static void to_rows(const Register (&columns)[4], Register (&rows)[4]) {
        const Register xy_02 = _mm256_unpacklo_epi64(columns[0], columns[1]);
        const Register xy_13 = _mm256_unpackhi_epi64(columns[0], columns[1]);
        const Register zw_02 = _mm256_unpacklo_epi64(columns[2], columns[3]);
        const Register zw_13 = _mm256_unpackhi_epi64(columns[2], columns[3]);
        rows[0] = _mm256_permute2x128_si256(xy_02, zw_02, 0x20);
        rows[1] = _mm256_permute2x128_si256(xy_13, zw_13, 0x20);
        rows[2] = _mm256_permute2x128_si256(xy_02, zw_02, 0x31);
        rows[3] = _mm256_permute2x128_si256(xy_13, zw_13, 0x31);
    }
    static void to_rows(const Register (&axes)[3], Register (&rows)[4]) {
        to_rows({axes[0], axes[1], axes[2], set(0)}, rows);
    }
    static void from_rows(const Register (&rows)[4], Register (&columns)[4]) {
        const Register xz_01 = _mm256_unpacklo_epi64(rows[0], rows[1]);
        const Register xz_23 = _mm256_unpacklo_epi64(rows[2], rows[3]);
        const Register yw_01 = _mm256_unpackhi_epi64(rows[0], rows[1]);
        const Register yw_23 = _mm256_unpackhi_epi64(rows[2], rows[3]);
        columns[0] = _mm256_permute2x128_si256(xz_01, xz_23, 0x20);
        columns[1] = _mm256_permute2x128_si256(yw_01, yw_23, 0x20);
        columns[2] = _mm256_permute2x128_si256(xz_01, xz_23, 0x31);
        columns[3] = _mm256_permute2x128_si256(yw_01, yw_23, 0x31);
    }
    static void from_rows(const Register (&rows)[4], Register (&axes)[3]) {
        Register columns[4];
        from_rows(rows, columns);
        for (int axis = 0; axis < 3; ++axis) {
            axes[axis] = columns[axis];
        }
    }
    // Four numbers from each lane's address on: address(lane).
    template <typename Address>
    static void load_rows(const Address& address, Register (&columns)[4]) {
        const auto at = [&](std::uint32_t i) {
            return _mm256_loadu_si256(reinterpret_cast<const Register*>(address(i)));
        };
        from_rows({at(0), at(1), at(2), at(3)}, columns);
    }
    template <typename Address>
    static void store_rows(const Address& address, const Register (&columns)[4]) {
        Register rows[4];
        to_rows(columns, rows);
        for (std::uint32_t i = 0; i < half; ++i) {
            _mm256_storeu_si256(reinterpret_cast<Register*>(address(i)), rows[i]);
        }
    }
    // Of both ends of half a group, along each axis.
    static void row_differences(const std::int64_t* rows, const std::uint32_t* ends, Register (&d)[3]) {
        Register wide[4];
        for (int i = 0; i < 4; ++i) {
            wide[i] = subtract(load(row(rows, ends[2 * i])), load(row(rows, ends[2 * i + 1])));
        }
        from_rows(wide, d);
    }
    // a += plus, b −= minus.
    static void move_rows(std::int64_t* rows, const std::uint32_t* ends, const Register (&plus)[3],
                          const Register (&minus)[3]) {
        Register plus_rows[4];
        Register minus_rows[4];
        to_rows(plus, plus_rows);
        to_rows(minus, minus_rows);
        for (int i = 0; i < 4; ++i) {
            std::int64_t* a = row(rows, ends[2 * i]);
            std::int64_t* b = row(rows, ends[2 * i + 1]);
            store(a, add(load(a), plus_rows[i]));
            store(b, subtract(load(b), minus_rows[i]));
        }
    }

    static Register set(std::int64_t value) { return _mm256_set1_epi64x(value); }
    static Register set_32(std::int32_t value) { return _mm256_set1_epi32(value); }
    static Shift make_shift(int count) { return _mm_cvtsi32_si128(count); }

    static Register add(Register a, Register b) { return _mm256_add_epi64(a, b); }
    static Register subtract(Register a, Register b) { return _mm256_sub_epi64(a, b); }
    static Register shift_right(Register v, Shift count) { return _mm256_srl_epi64(v, count); }
    static Register shift_left(Register v, Shift count) { return _mm256_sll_epi64(v, count); }
    template <int count>
    static Register shift_right(Register v) {
        return _mm256_srli_epi64(v, count);
    }
    template <int count>
    static Register shift_left(Register v) {
        return _mm256_slli_epi64(v, count);
    }
    static Register shift_right_each(Register v, Register counts) { return _mm256_srlv_epi64(v, counts); }
    static Register shift_left_each(Register v, Register counts) { return _mm256_sllv_epi64(v, counts); }
    static Register equal(Register a, Register b) { return _mm256_cmpeq_epi64(a, b); }
    static Register minimum_signed(Register a, Register b) {
        return _mm256_blendv_epi8(a, b, _mm256_cmpgt_epi64(a, b));
    }
    static Register maximum_signed(Register a, Register b) {
        return _mm256_blendv_epi8(a, b, _mm256_cmpgt_epi64(b, a));
    }
    // b where the 64-bit lane of `sign` is negative.
    static Register select_by_sign(Register a, Register b, Register sign) {
        return _mm256_castpd_si256(
            _mm256_blendv_pd(_mm256_castsi256_pd(a), _mm256_castsi256_pd(b), _mm256_castsi256_pd(sign)));
    }

    // Of the low halves of 64-bit lanes.
    static Register multiply_signed(Register a, Register b) { return _mm256_mul_epi32(a, b); }
    static Register multiply_unsigned(Register a, Register b) { return _mm256_mul_epu32(a, b); }
    // Even 32-bit lanes from a's high halves, odd ones from b's.
    static Register high_halves(Register a, Register b) {
        return _mm256_blend_epi32(_mm256_srli_epi64(a, 32), b, 0xaa);
    }

    static Register add_32(Register a, Register b) { return _mm256_add_epi32(a, b); }
    static Register subtract_32(Register a, Register b) { return _mm256_sub_epi32(a, b); }
    static Register equal_32(Register a, Register b) { return _mm256_cmpeq_epi32(a, b); }
    static Register greater_32(Register a, Register b) { return _mm256_cmpgt_epi32(a, b); }
    static Register absolute_32(Register v) { return _mm256_abs_epi32(v); }
    static Register minimum_32(Register a, Register b) { return _mm256_min_epi32(a, b); }
    static Register multiply_low_32(Register a, Register b) { return _mm256_mullo_epi32(a, b); }
    template <int count>
    static Register shift_left_32(Register v) {
        return _mm256_slli_epi32(v, count);
    }
    template <int count>
    static Register shift_right_32(Register v) {
        return _mm256_srli_epi32(v, count);
    }
    static Register shift_right_32_signed(Register v, Shift count) { return _mm256_sra_epi32(v, count); }
    template <int count>
    static Register shift_right_32_signed(Register v) {
        return _mm256_srai_epi32(v, count);
    }
    static Register select_by_sign_32(Register a, Register b, Register sign) {
        return _mm256_castps_si256(
            _mm256_blendv_ps(_mm256_castsi256_ps(a), _mm256_castsi256_ps(b), _mm256_castsi256_ps(sign)));
    }
    // Of positive numbers. With the bit below the leading one cleared the conversion never rounds up, and its
    // exponent is the place of that bit in every rounding mode.
    static Register leading_zeros_32(Register v) {
        const Register lone = _mm256_andnot_si256(_mm256_srli_epi32(v, 1), v);
        const Register exponent = _mm256_srli_epi32(_mm256_castps_si256(_mm256_cvtepi32_ps(lone)), 23);
        return _mm256_sub_epi32(_mm256_set1_epi32(158), exponent);
    }
    static Register lookup(const std::uint32_t (&table)[8], Register index) {
        return _mm256_permutevar8x32_epi32(_mm256_loadu_si256(reinterpret_cast<const Register*>(table)),
                                           index);
    }

    static Register add_16(Register a, Register b) { return _mm256_add_epi16(a, b); }
    static Register rounding_multiply_16(Register a, Register b) { return _mm256_mulhrs_epi16(a, b); }
    template <int count>
    static Register shift_right_16_signed(Register v) {
        return _mm256_srai_epi16(v, count);
    }

    static Register bit_and(Register a, Register b) { return _mm256_and_si256(a, b); }
    static Register bit_or(Register a, Register b) { return _mm256_or_si256(a, b); }
    static Register exclusive_or(Register a, Register b) { return _mm256_xor_si256(a, b); }
    static Register and_not(Register mask, Register v) { return _mm256_andnot_si256(mask, v); }
    // Bit i: lane i is negative.
    static std::uint32_t sign_bits(Register v) {
        return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_castsi256_pd(v)));
    }
    static bool any(Register v) { return _mm256_testz_si256(v, v) == 0; }
    // Every bit is set.
    static bool all(Register v) { return _mm256_testc_si256(v, _mm256_set1_epi32(-1)) != 0; }

    static void leave() { _mm256_zeroupper(); }
};

} // namespace
} // namespace lks
