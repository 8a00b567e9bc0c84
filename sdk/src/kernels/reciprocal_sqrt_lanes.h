// 1/√m of several groups, side by side: fixed/projection_reciprocal_sqrt.h over lanes.
#pragma once

#include <cstdint>
#include <utility>

#include "fixed/projection_reciprocal_sqrt.h"
#include "kernels/factors.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

// Something of each of n groups.
template <typename T, std::uint32_t n>
struct Each {
    T at[n];
    LKS_FORCE_INLINE const T& operator[](std::uint32_t i) const { return at[i]; }
};

// One step for each of n groups, so that steps of different groups follow each other: those of one group wait
// for each other.
template <typename Step, std::uint32_t... indices>
LKS_FORCE_INLINE auto of_these(const Step& step, std::integer_sequence<std::uint32_t, indices...>) {
    return Each<decltype(step(0u)), sizeof...(indices)>{{step(indices)...}};
}
template <std::uint32_t n, typename Step>
LKS_FORCE_INLINE auto of_each(const Step& step) {
    return of_these(step, std::make_integer_sequence<std::uint32_t, n>{});
}

// A seed in 32-bit arithmetic, from t in the low 16 bits with nothing above. What is above the 16th bit of a
// sum counts for nothing until the last one.
template <typename L>
LKS_FORCE_INLINE typename L::Register seed_by_words(typename L::Register segment, typename L::Register t) {
    using R = typename L::Register;
    const R half = L::set_32(1 << 14);
    const R at = L::coefficient_index(segment);
    const R c3_t = L::multiply_16(t, L::coefficient(fixed::projection_coefficients.c3, at));
    const R quadratic = L::add_32(L::template shift_right_32_signed<15>(L::add_32(c3_t, half)),
                                  L::coefficient(fixed::projection_coefficients.c2, at));
    const R slope =
        L::add_32(L::template shift_right_32_signed<15>(L::add_32(L::multiply_16(t, quadratic), half)),
                  L::coefficient(fixed::projection_coefficients.c1, at));
    return L::add_32(L::template shift_right_32_signed<18>(L::add_32(L::multiply_16(t, slope), half)),
                     L::coefficient(fixed::projection_coefficients.c0, at));
}

// Estimates of 1/√m, low in 32-bit lanes: the cubics of fixed/projection_reciprocal_sqrt.h at t, which is in
// the high 16 bits of high_t.
template <typename L, std::uint32_t n>
LKS_FORCE_INLINE auto seed_lanes(const Each<typename L::Register, n>& segment,
                                 const Each<typename L::Register, n>& high_t) {
    using I = std::uint32_t;
    const auto t = of_each<n>([&](I i) { return L::template shift_right_32<16>(high_t[i]); });
    if constexpr (L::has_rounding_multiply_16) {
        const auto c2_c3 =
            of_each<n>([&](I i) { return L::lookup(fixed::projection_seeds.c2_c3, segment[i]); });
        const auto c0_c1 =
            of_each<n>([&](I i) { return L::lookup(fixed::projection_seeds.c0_c1, segment[i]); });
        const auto cubic = of_each<n>([&](I i) { return L::rounding_multiply_16(high_t[i], c2_c3[i]); });
        const auto low_cubic = of_each<n>([&](I i) { return L::template shift_right_32<16>(cubic[i]); });
        const auto quadratic = of_each<n>([&](I i) { return L::add_16(c2_c3[i], low_cubic[i]); });
        const auto c1 = of_each<n>([&](I i) { return L::template shift_right_32<16>(c0_c1[i]); });
        const auto bent = of_each<n>([&](I i) { return L::rounding_multiply_16(t[i], quadratic[i]); });
        const auto slope = of_each<n>([&](I i) { return L::add_16(c1[i], bent[i]); });
        const auto rise = of_each<n>([&](I i) { return L::rounding_multiply_16(t[i], slope[i]); });
        const auto correction =
            of_each<n>([&](I i) { return L::template shift_right_16_signed<3>(rise[i]); });
        const auto seed = of_each<n>([&](I i) { return L::add_16(c0_c1[i], correction[i]); });
        return of_each<n>([&](I i) { return L::bit_and(seed[i], L::set_32(0xffff)); });
    } else {
        return of_each<n>([&](I i) { return seed_by_words<L>(segment[i], t[i]); });
    }
}

// Nothing else is to be done meanwhile.
struct NothingElse {
    LKS_FORCE_INLINE void operator()(int) const {}
};

// 1/√m: fixed/projection_reciprocal_sqrt.h. Its steps wait for each other; meanwhile(0), (1) and (2) are
// written between them.
template <typename L, std::uint32_t n, typename Meanwhile = NothingElse>
LKS_FORCE_INLINE auto reciprocal_sqrt_lanes(const Each<Numbers<L>, n>& m, const Meanwhile& meanwhile = {}) {
    using I = std::uint32_t;
    using F = FactorsOf<L>;
    // Aligned, with the leading bit replaced by the octave: m where its top bit is set, else 2·m − 2^31.
    const auto above = of_each<n>([&](I i) { return L::exclusive_or(m[i].words, L::set_32(INT32_MIN)); });
    const auto shorter = of_each<n>([&](I i) { return L::minimum_32(above[i], L::set_32(0)); });
    const auto aligned = of_each<n>([&](I i) { return L::add_32(m[i].words, shorter[i]); });
    const auto segment = of_each<n>([&](I i) { return L::template shift_right_32<29>(aligned[i]); });
    const auto high_t = of_each<n>(
        [&](I i) { return L::exclusive_or(L::template shift_left_32<3>(aligned[i]), L::set_32(INT32_MIN)); });
    meanwhile(0);
    const auto y0 = seed_lanes<L, n>(segment, high_t);
    meanwhile(1);
    const auto squared = of_each<n>([&](I i) { return L::multiply_low_32(y0[i], y0[i]); });
    const auto products =
        of_each<n>([&](I i) { return F::multiply_unsigned(m[i].factors, F::of_words(squared[i])); });
    const auto product = of_each<n>([&](I i) { return F::high_words(products[i]); });
    const auto e = of_each<n>([&](I i) { return L::subtract_32(product[i], L::set_32(1 << 30)); });
    const auto half_e = of_each<n>([&](I i) { return L::template shift_right_32_signed<1>(e[i]); });
    const auto step = of_each<n>([&](I i) { return L::multiply_low_32(y0[i], half_e[i]); });
    meanwhile(2);
    const auto wide = of_each<n>([&](I i) { return L::template shift_left_32<15>(y0[i]); });
    const auto rounded = of_each<n>([&](I i) { return L::add_32(step[i], L::set_32(1 << 14)); });
    const auto taken = of_each<n>([&](I i) { return L::template shift_right_32_signed<15>(rounded[i]); });
    return of_each<n>([&](I i) { return L::subtract_32(wide[i], taken[i]); });
}

} // namespace
} // namespace lks
