// Two 64-bit lanes: WebAssembly SIMD.
#pragma once

#include <wasm_simd128.h>

#include <cstdint>

namespace lks {
namespace {

struct LanesWasm {
    static constexpr std::uint32_t half = 2;
    // Groups of which the lengths are found step by step, side by side.
    static constexpr std::uint32_t interleaved = 1;
    // Groups that go through the stages together.
    static constexpr std::uint32_t together = 1;
    static constexpr std::uint32_t singles_together = 4;
    static constexpr bool has_rows = false;
    // Fewer constraints are faster by themselves than as part of a group.
    static constexpr std::uint32_t worth_a_group = 3;
    static constexpr std::uint32_t worth_a_response = 2;
    static constexpr std::uint32_t rolls_from = 0; // never
    using Register = v128_t;
    using Shift = std::uint32_t;
    // There is one, but x86 before AVX-512 has none, and engines make it of several instructions.
    static constexpr bool has_signed_shift = false;
    static constexpr bool has_shift_each = false;
    static constexpr bool has_minimum_64 = false;
    static constexpr bool has_multiply_low_64 = false;
    static constexpr bool has_mask_tests = false;
    // There is one that saturates, of which engines make five instructions for x86.
    static constexpr bool has_rounding_multiply_16 = false;
    static constexpr bool has_quick_shift = false;
    static constexpr bool packs_factors = true;

    static Register load(const std::int64_t* p) { return wasm_v128_load(p); }
    static void store(std::int64_t* p, Register v) { wasm_v128_store(p, v); }
    static Register load_32(const std::uint32_t* p) { return wasm_v128_load(p); }
    static Register load_widened(const std::uint32_t* p) { return wasm_u64x2_load32x2(p); }
    // Every other index of `at`.
    static Register gather(const std::int64_t* p, const std::uint32_t* at) {
        return wasm_i64x2_make(p[at[0]], p[at[2]]);
    }
    static Register set(std::int64_t value) { return wasm_i64x2_splat(value); }
    static Register set_32(std::int32_t value) { return wasm_i32x4_splat(value); }
    static Shift make_shift(int count) { return static_cast<Shift>(count); }

    static Register add(Register a, Register b) { return wasm_i64x2_add(a, b); }
    static Register subtract(Register a, Register b) { return wasm_i64x2_sub(a, b); }
    static Register shift_right(Register v, Shift count) { return wasm_u64x2_shr(v, count); }
    static Register shift_left(Register v, Shift count) { return wasm_i64x2_shl(v, count); }
    template <int count>
    static Register shift_right(Register v) {
        return wasm_u64x2_shr(v, count);
    }
    template <int count>
    static Register shift_left(Register v) {
        return wasm_i64x2_shl(v, count);
    }
    static Register shift_right_each(Register v, Register counts) {
        return wasm_i64x2_shuffle(wasm_u64x2_shr(v, static_cast<Shift>(wasm_i32x4_extract_lane(counts, 0))),
                                  wasm_u64x2_shr(v, static_cast<Shift>(wasm_i32x4_extract_lane(counts, 2))),
                                  0, 3);
    }
    static Register shift_left_each(Register v, Register counts) {
        return wasm_i64x2_shuffle(wasm_i64x2_shl(v, static_cast<Shift>(wasm_i32x4_extract_lane(counts, 0))),
                                  wasm_i64x2_shl(v, static_cast<Shift>(wasm_i32x4_extract_lane(counts, 2))),
                                  0, 3);
    }
    static Register equal(Register a, Register b) { return wasm_i64x2_eq(a, b); }
    static Register minimum_signed(Register a, Register b) {
        return wasm_v128_bitselect(b, a, wasm_i64x2_gt(a, b));
    }
    static Register maximum_signed(Register a, Register b) {
        return wasm_v128_bitselect(a, b, wasm_i64x2_gt(a, b));
    }
    // b where the 64-bit lane of `sign` is negative.
    static Register select_by_sign(Register a, Register b, Register sign) {
        return wasm_v128_bitselect(b, a, wasm_i64x2_lt(sign, wasm_i64x2_splat(0)));
    }

    // Of the low halves of 64-bit lanes.
    static Register multiply_signed(Register a, Register b) {
        return wasm_i64x2_extmul_low_i32x4(low_halves(a), low_halves(b));
    }
    static Register multiply_unsigned(Register a, Register b) {
        return wasm_u64x2_extmul_low_u32x4(low_halves(a), low_halves(b));
    }
    // Of one half of 32-bit lanes.
    static Register multiply_low_half_signed(Register a, Register b) {
        return wasm_i64x2_extmul_low_i32x4(opaque(a), opaque(b));
    }
    static Register multiply_high_half_signed(Register a, Register b) {
        return wasm_i64x2_extmul_high_i32x4(opaque(a), opaque(b));
    }
    static Register multiply_low_half_unsigned(Register a, Register b) {
        return wasm_u64x2_extmul_low_u32x4(opaque(a), opaque(b));
    }
    static Register multiply_high_half_unsigned(Register a, Register b) {
        return wasm_u64x2_extmul_high_u32x4(opaque(a), opaque(b));
    }
    // Halves of a's 64-bit lanes low in 32-bit lanes, b's high.
    static Register pack_low_halves(Register a, Register b) { return wasm_i32x4_shuffle(a, b, 0, 2, 4, 6); }
    static Register pack_high_halves(Register a, Register b) { return wasm_i32x4_shuffle(a, b, 1, 3, 5, 7); }
    // Even 32-bit lanes from a's high halves, odd ones from b's.
    static Register high_halves(Register a, Register b) { return wasm_i32x4_shuffle(a, b, 1, 5, 3, 7); }

    static Register add_32(Register a, Register b) { return wasm_i32x4_add(a, b); }
    static Register subtract_32(Register a, Register b) { return wasm_i32x4_sub(a, b); }
    static Register equal_32(Register a, Register b) { return wasm_i32x4_eq(a, b); }
    static Register greater_32(Register a, Register b) { return wasm_i32x4_gt(a, b); }
    static Register absolute_32(Register v) { return wasm_i32x4_abs(v); }
    static Register minimum_32(Register a, Register b) { return wasm_i32x4_min(a, b); }
    static Register multiply_low_32(Register a, Register b) { return wasm_i32x4_mul(a, b); }
    template <int count>
    static Register shift_left_32(Register v) {
        return wasm_i32x4_shl(v, count);
    }
    template <int count>
    static Register shift_right_32(Register v) {
        return wasm_u32x4_shr(v, count);
    }
    template <int count>
    static Register shift_right_32_signed(Register v) {
        return wasm_i32x4_shr(v, count);
    }
    static Register shift_right_32(Register v, Shift count) { return wasm_u32x4_shr(v, count); }
    static Register shift_right_32_signed(Register v, Shift count) { return wasm_i32x4_shr(v, count); }
    static Register select_by_sign_32(Register a, Register b, Register sign) {
        return wasm_v128_bitselect(b, a, wasm_i32x4_shr(sign, 31));
    }
    // Of positive numbers; see LanesAvx2.
    static Register leading_zeros_32(Register v) {
        const Register lone = wasm_v128_andnot(v, wasm_u32x4_shr(v, 1));
        const Register exponent = wasm_u32x4_shr(wasm_f32x4_convert_i32x4(lone), 23);
        return wasm_i32x4_sub(wasm_i32x4_splat(158), exponent);
    }
    // Bytes 4·index .. 4·index + 3 of the table's 32; a byte number beyond 15 gives zero.
    static Register lookup(const std::uint32_t (&table)[8], Register index) {
        const Register at = wasm_i32x4_add(
            wasm_i32x4_mul(wasm_v128_and(index, wasm_i32x4_splat(7)), wasm_i32x4_splat(0x04040404)),
            wasm_i32x4_splat(0x03020100));
        return wasm_v128_or(
            wasm_i8x16_swizzle(wasm_v128_load(table), at),
            wasm_i8x16_swizzle(wasm_v128_load(table + 4), wasm_i8x16_sub(at, wasm_i8x16_splat(16))));
    }

    // Where coefficient() finds the entry of each 32-bit lane, 0 .. 7; byte numbers beyond 15 give zero.
    static Register coefficient_index(Register entry) {
        return wasm_i32x4_add(wasm_i16x8_mul(entry, wasm_i32x4_splat(0x0202)),
                              wasm_i32x4_splat(static_cast<std::int32_t>(0xffff0100)));
    }
    // Low in 32-bit lanes, with nothing above.
    template <typename Int16>
    static Register coefficient(const Int16 (&table)[8], Register index) {
        return wasm_i8x16_swizzle(wasm_v128_load(table), index);
    }
    // Of the low 16 bits of 32-bit lanes; a has nothing above.
    static Register multiply_16(Register a, Register b) { return wasm_i32x4_dot_i16x8(a, b); }

    static Register add_16(Register a, Register b) { return wasm_i16x8_add(a, b); }
    static Register rounding_multiply_16(Register a, Register b) { return wasm_i16x8_q15mulr_sat(a, b); }

    static Register bit_and(Register a, Register b) { return wasm_v128_and(a, b); }
    static Register bit_or(Register a, Register b) { return wasm_v128_or(a, b); }
    static Register exclusive_or(Register a, Register b) { return wasm_v128_xor(a, b); }
    static Register and_not(Register mask, Register v) { return wasm_v128_andnot(v, mask); }
    // Bit i: lane i is negative.
    static std::uint32_t sign_bits(Register v) { return wasm_i64x2_bitmask(v); }
    static bool any(Register v) { return wasm_v128_any_true(v); }
    // Every bit is set.
    static bool all(Register v) { return wasm_i8x16_bitmask(v) == 0xffff; }
    static bool any_negative_32(Register v) { return wasm_i32x4_bitmask(v) != 0; }

private:
    // The compiler may not look through it: it would share one widened operand between several products, far
    // apart, and then take 64-bit multiplications for them, which no processor has.
    static Register opaque(Register v) {
        __asm__ volatile("" : "+r"(v));
        return v;
    }
    static Register low_halves(Register v) { return opaque(wasm_i32x4_shuffle(v, v, 0, 2, 0, 2)); }
};

} // namespace
} // namespace lks
