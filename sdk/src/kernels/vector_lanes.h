// Vectors of 64-bit numbers over lanes, and what fixed/vector.h does with them. Sums wrap.
#pragma once

#include <cstdint>

#include "kernels/force_inline.h"

namespace lks {
namespace {

template <typename L>
struct VectorLanes {
    using R = typename L::Register;
    struct Vector {
        R x, y, z;
    };

    LKS_FORCE_INLINE static Vector add(const Vector& a, const Vector& b) {
        return {L::add(a.x, b.x), L::add(a.y, b.y), L::add(a.z, b.z)};
    }
    LKS_FORCE_INLINE static Vector subtract(const Vector& a, const Vector& b) {
        return {L::subtract(a.x, b.x), L::subtract(a.y, b.y), L::subtract(a.z, b.z)};
    }
    LKS_FORCE_INLINE static Vector negate(const Vector& a) {
        return subtract({L::set(0), L::set(0), L::set(0)}, a);
    }
    LKS_FORCE_INLINE static R clamp(R v, R limit) {
        return L::maximum_signed(L::minimum_signed(v, limit), L::subtract(L::set(0), limit));
    }
    LKS_FORCE_INLINE static R clamp(R v, std::int64_t limit) { return clamp(v, L::set(limit)); }
    LKS_FORCE_INLINE static Vector clamp(const Vector& v, std::int64_t limit) {
        return {clamp(v.x, limit), clamp(v.y, limit), clamp(v.z, limit)};
    }
    // Not zero where a component is not below 2^bits.
    template <int bits>
    LKS_FORCE_INLINE static R not_within(const Vector& v) {
        const R lift = L::set(std::int64_t{1} << bits);
        const R all = L::bit_or(L::bit_or(L::add(v.x, lift), L::add(v.y, lift)), L::add(v.z, lift));
        return L::bit_and(all, L::set(static_cast<std::int64_t>(~((std::uint64_t{2} << bits) - 1))));
    }
    // v / 2^count, rounded down; any v.
    template <int count>
    LKS_FORCE_INLINE static R shift_down(R v) {
        if constexpr (L::has_signed_shift) {
            return L::template shift_right_signed<count>(v);
        } else {
            const R lifted = L::exclusive_or(v, L::set(INT64_MIN));
            return L::subtract(L::template shift_right<count>(lifted),
                               L::set(std::int64_t{1} << (63 - count)));
        }
    }

    // A long number as high · 2^32 + low, both with signs, in the low halves; |v| <= 2^62.
    struct Halves {
        R high, low;
    };
    LKS_FORCE_INLINE static Halves halves(R v) {
        return {L::template shift_right<32>(L::add(v, L::set(std::int64_t{1} << 31))), v};
    }
    // fixed::dot_shift_30 of the low halves of a, b and c.
    LKS_FORCE_INLINE static R dot_30(R a, R b, R c, const Halves& x, const Halves& y, const Halves& z) {
        const R high = L::add(L::add(L::multiply_signed(a, x.high), L::multiply_signed(b, y.high)),
                              L::multiply_signed(c, z.high));
        const R low = L::add(L::add(L::multiply_signed(a, x.low), L::multiply_signed(b, y.low)),
                             L::multiply_signed(c, z.low));
        return L::add(L::template shift_left<2>(high),
                      shift_down<30>(L::add(low, L::set(std::int64_t{1} << 29))));
    }
    // fixed::scale_component of a in the low halves.
    LKS_FORCE_INLINE static R scale_30(R a, const Halves& s) {
        return L::add(L::template shift_left<2>(L::multiply_signed(a, s.high)),
                      shift_down<30>(L::add(L::multiply_signed(a, s.low), L::set(std::int64_t{1} << 29))));
    }
    LKS_FORCE_INLINE static Vector scale(const Vector& direction, R s) {
        const Halves h = halves(s);
        return {scale_30(direction.x, h), scale_30(direction.y, h), scale_30(direction.z, h)};
    }
    LKS_FORCE_INLINE static R dot(const Vector& direction, const Vector& v) {
        return dot_30(direction.x, direction.y, direction.z, halves(v.x), halves(v.y), halves(v.z));
    }
    // Of magnitudes, the sign of `sign`.
    LKS_FORCE_INLINE static R with_sign(R magnitude, R sign) {
        return L::select_by_sign(magnitude, L::subtract(L::set(0), magnitude), sign);
    }
    LKS_FORCE_INLINE static R absolute(R v) { return with_sign(v, v); }
    LKS_FORCE_INLINE static Vector select_by_sign(const Vector& a, const Vector& b, R sign) {
        return {L::select_by_sign(a.x, b.x, sign), L::select_by_sign(a.y, b.y, sign),
                L::select_by_sign(a.z, b.z, sign)};
    }
    // collide/saturation.h's.
    LKS_FORCE_INLINE static R saturating_add(R a, R b) {
        const R sum = L::add(a, b);
        const R beyond = L::bit_and(L::exclusive_or(a, sum), L::exclusive_or(b, sum));
        return L::select_by_sign(sum, end_towards(a), beyond);
    }
    LKS_FORCE_INLINE static R saturating_subtract(R a, R b) {
        const R difference = L::subtract(a, b);
        const R beyond = L::bit_and(L::exclusive_or(a, b), L::exclusive_or(a, difference));
        return L::select_by_sign(difference, end_towards(a), beyond);
    }
    LKS_FORCE_INLINE static Vector saturating_add(const Vector& a, const Vector& b) {
        return {saturating_add(a.x, b.x), saturating_add(a.y, b.y), saturating_add(a.z, b.z)};
    }
    LKS_FORCE_INLINE static Vector saturating_subtract(const Vector& a, const Vector& b) {
        return {saturating_subtract(a.x, b.x), saturating_subtract(a.y, b.y), saturating_subtract(a.z, b.z)};
    }
    // The end of the range on the side of v.
    LKS_FORCE_INLINE static R end_towards(R v) {
        return L::select_by_sign(L::set(INT64_MAX), L::set(INT64_MIN), v);
    }
    // The low 64 bits of v·q.
    LKS_FORCE_INLINE static R multiply_narrow(R v, R q) {
        if constexpr (L::has_multiply_low_64) {
            return L::multiply_low_64(v, q);
        } else {
            return L::add(L::multiply_signed(v, q),
                          L::template shift_left<32>(L::multiply_signed(halves(v).high, q)));
        }
    }
};

} // namespace
} // namespace lks
