// Two 64-bit lanes: NEON of 64-bit arm.
#pragma once

#include <arm_neon.h>

#include <cstdint>

namespace lks {
namespace {

struct LanesNeon {
    static constexpr std::uint32_t half = 2;
    // Groups of which the lengths are found step by step, side by side.
    static constexpr std::uint32_t interleaved = 2;
    // Groups that go through the stages together.
    static constexpr std::uint32_t together = 4;
    static constexpr std::uint32_t singles_together = 4;
    static constexpr bool has_rows = false;
    // Fewer constraints are faster by themselves than as part of a group.
    static constexpr std::uint32_t worth_a_group = 3;
    static constexpr std::uint32_t worth_a_response = 2;
    static constexpr std::uint32_t rolls_from = 0; // never
    using Register = uint64x2_t;
    using Shift = int64x2_t; // to the left: negative
    static constexpr bool has_signed_shift = true;
    static constexpr bool has_shift_each = true;
    static constexpr bool has_minimum_64 = false;
    static constexpr bool has_multiply_low_64 = false;
    static constexpr bool has_mask_tests = false;
    static constexpr bool has_rounding_multiply_16 = true;
    static constexpr bool has_quick_shift = true;
    static constexpr bool packs_factors = true;

    static Register load(const std::int64_t* p) { return vreinterpretq_u64_s64(vld1q_s64(p)); }
    static void store(std::int64_t* p, Register v) { vst1q_s64(p, vreinterpretq_s64_u64(v)); }
    static Register load_32(const std::uint32_t* p) { return vreinterpretq_u64_u32(vld1q_u32(p)); }
    static Register load_widened(const std::uint32_t* p) { return vmovl_u32(vld1_u32(p)); }
    // Every other index of `at`.
    static Register gather(const std::int64_t* p, const std::uint32_t* at) {
        return vcombine_u64(vcreate_u64(static_cast<std::uint64_t>(p[at[0]])),
                            vcreate_u64(static_cast<std::uint64_t>(p[at[2]])));
    }
    static Register set(std::int64_t value) { return vdupq_n_u64(static_cast<std::uint64_t>(value)); }
    static Register set_32(std::int32_t value) { return from_32(vdupq_n_s32(value)); }
    static Shift make_shift(int count) { return vdupq_n_s64(-count); }

    static Register add(Register a, Register b) { return vaddq_u64(a, b); }
    static Register subtract(Register a, Register b) { return vsubq_u64(a, b); }
    static Register shift_right(Register v, Shift count) { return vshlq_u64(v, count); }
    static Register shift_left(Register v, Shift count) { return vshlq_u64(v, vnegq_s64(count)); }
    static Register shift_right_signed(Register v, Shift count) {
        return vreinterpretq_u64_s64(vshlq_s64(vreinterpretq_s64_u64(v), count));
    }
    template <int count>
    static Register shift_right(Register v) {
        return vshrq_n_u64(v, count);
    }
    template <int count>
    static Register shift_right_signed(Register v) {
        return vreinterpretq_u64_s64(vshrq_n_s64(vreinterpretq_s64_u64(v), count));
    }
    template <int count>
    static Register shift_left(Register v) {
        return vshlq_n_u64(v, count);
    }
    static Register shift_right_each(Register v, Register counts) {
        return vshlq_u64(v, vnegq_s64(vreinterpretq_s64_u64(counts)));
    }
    static Register shift_left_each(Register v, Register counts) {
        return vshlq_u64(v, vreinterpretq_s64_u64(counts));
    }
    static Register equal(Register a, Register b) { return vceqq_u64(a, b); }
    static Register minimum_signed(Register a, Register b) {
        return vbslq_u64(vcgtq_s64(vreinterpretq_s64_u64(a), vreinterpretq_s64_u64(b)), b, a);
    }
    static Register maximum_signed(Register a, Register b) {
        return vbslq_u64(vcgtq_s64(vreinterpretq_s64_u64(a), vreinterpretq_s64_u64(b)), a, b);
    }
    // b where the 64-bit lane of `sign` is negative.
    static Register select_by_sign(Register a, Register b, Register sign) {
        return vbslq_u64(vcltzq_s64(vreinterpretq_s64_u64(sign)), b, a);
    }

    // Of the low halves of 64-bit lanes.
    static Register multiply_signed(Register a, Register b) {
        return vreinterpretq_u64_s64(
            vmull_s32(vmovn_s64(vreinterpretq_s64_u64(a)), vmovn_s64(vreinterpretq_s64_u64(b))));
    }
    static Register multiply_unsigned(Register a, Register b) {
        return vmull_u32(vmovn_u64(a), vmovn_u64(b));
    }
    // Of one half of 32-bit lanes.
    static Register multiply_low_half_signed(Register a, Register b) {
        return vreinterpretq_u64_s64(vmull_s32(vget_low_s32(to_32(a)), vget_low_s32(to_32(b))));
    }
    static Register multiply_high_half_signed(Register a, Register b) {
        return vreinterpretq_u64_s64(vmull_high_s32(to_32(a), to_32(b)));
    }
    static Register multiply_low_half_unsigned(Register a, Register b) {
        return vmull_u32(vget_low_u32(vreinterpretq_u32_u64(a)), vget_low_u32(vreinterpretq_u32_u64(b)));
    }
    static Register multiply_high_half_unsigned(Register a, Register b) {
        return vmull_high_u32(vreinterpretq_u32_u64(a), vreinterpretq_u32_u64(b));
    }
    // Halves of a's 64-bit lanes low in 32-bit lanes, b's high.
    static Register pack_low_halves(Register a, Register b) {
        return vreinterpretq_u64_u32(vuzp1q_u32(vreinterpretq_u32_u64(a), vreinterpretq_u32_u64(b)));
    }
    static Register pack_high_halves(Register a, Register b) {
        return vreinterpretq_u64_u32(vuzp2q_u32(vreinterpretq_u32_u64(a), vreinterpretq_u32_u64(b)));
    }
    // Even 32-bit lanes from a's high halves, odd ones from b's.
    static Register high_halves(Register a, Register b) {
        return vreinterpretq_u64_u32(vtrn2q_u32(vreinterpretq_u32_u64(a), vreinterpretq_u32_u64(b)));
    }

    static Register add_32(Register a, Register b) { return from_32(vaddq_s32(to_32(a), to_32(b))); }
    static Register subtract_32(Register a, Register b) { return from_32(vsubq_s32(to_32(a), to_32(b))); }
    static Register equal_32(Register a, Register b) {
        return vreinterpretq_u64_u32(vceqq_s32(to_32(a), to_32(b)));
    }
    static Register greater_32(Register a, Register b) {
        return vreinterpretq_u64_u32(vcgtq_s32(to_32(a), to_32(b)));
    }
    static Register absolute_32(Register v) { return from_32(vabsq_s32(to_32(v))); }
    static Register minimum_32(Register a, Register b) { return from_32(vminq_s32(to_32(a), to_32(b))); }
    static Register multiply_low_32(Register a, Register b) { return from_32(vmulq_s32(to_32(a), to_32(b))); }
    template <int count>
    static Register shift_left_32(Register v) {
        return from_32(vshlq_n_s32(to_32(v), count));
    }
    template <int count>
    static Register shift_right_32(Register v) {
        return vreinterpretq_u64_u32(vshrq_n_u32(vreinterpretq_u32_u64(v), count));
    }
    static Register shift_right_32_signed(Register v, Shift count) {
        return from_32(vshlq_s32(to_32(v), vdupq_laneq_s32(vreinterpretq_s32_s64(count), 0)));
    }
    template <int count>
    static Register shift_right_32_signed(Register v) {
        return from_32(vshrq_n_s32(to_32(v), count));
    }
    static Register select_by_sign_32(Register a, Register b, Register sign) {
        return from_32(vbslq_s32(vcltzq_s32(to_32(sign)), to_32(b), to_32(a)));
    }
    static Register leading_zeros_32(Register v) { return from_32(vclzq_s32(to_32(v))); }
    // Bytes 4·index .. 4·index + 3 of the table's 32.
    static Register lookup(const std::uint32_t (&table)[8], Register index) {
        const uint32x4_t entry = vandq_u32(vreinterpretq_u32_u64(index), vdupq_n_u32(7));
        const uint32x4_t at = vmlaq_n_u32(vdupq_n_u32(0x03020100), entry, 0x04040404);
        const uint8x16x2_t bytes{
            {vreinterpretq_u8_u32(vld1q_u32(table)), vreinterpretq_u8_u32(vld1q_u32(table + 4))}};
        return vreinterpretq_u64_u8(vqtbl2q_u8(bytes, vreinterpretq_u8_u32(at)));
    }

    static Register add_16(Register a, Register b) { return from_16(vaddq_s16(to_16(a), to_16(b))); }
    static Register rounding_multiply_16(Register a, Register b) {
        return from_16(vqrdmulhq_s16(to_16(a), to_16(b)));
    }
    template <int count>
    static Register shift_right_16_signed(Register v) {
        return from_16(vshrq_n_s16(to_16(v), count));
    }

    static Register bit_and(Register a, Register b) { return vandq_u64(a, b); }
    static Register bit_or(Register a, Register b) { return vorrq_u64(a, b); }
    static Register exclusive_or(Register a, Register b) { return veorq_u64(a, b); }
    static Register and_not(Register mask, Register v) { return vbicq_u64(v, mask); }
    // Bit i: lane i is negative.
    static std::uint32_t sign_bits(Register v) {
        return static_cast<std::uint32_t>(vgetq_lane_u64(v, 0) >> 63 | vgetq_lane_u64(v, 1) >> 63 << 1);
    }
    static bool any(Register v) { return (vgetq_lane_u64(v, 0) | vgetq_lane_u64(v, 1)) != 0; }
    // Every bit is set.
    static bool all(Register v) { return (vgetq_lane_u64(v, 0) & vgetq_lane_u64(v, 1)) == UINT64_MAX; }

private:
    static int32x4_t to_32(Register v) { return vreinterpretq_s32_u64(v); }
    static Register from_32(int32x4_t v) { return vreinterpretq_u64_s32(v); }
    static int16x8_t to_16(Register v) { return vreinterpretq_s16_u64(v); }
    static Register from_16(int16x8_t v) { return vreinterpretq_u64_s16(v); }
};

} // namespace
} // namespace lks
