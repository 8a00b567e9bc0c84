// Lengths of edges over lanes, and how far they are from their rest lengths.
#pragma once

#include <type_traits>

#include "fixed/formats.h"
#include "kernels/factors.h"
#include "kernels/reciprocal_sqrt_lanes.h"
#include "kernels/shift_lanes.h"

namespace lks {
namespace {

// Lengths in one octave, of which clz(u) / 2 is k.
template <typename L>
class Octave {
    using R = typename L::Register;

public:
    explicit Octave(int k)
        : twice_k_(L::set(2 * in_range(k))), align_(2 * in_range(k)),
          lowest_(L::set_32(k == in_range(k) ? 1 << (30 - 2 * k) : INT32_MAX)),
          highest_(L::set_32(
              k == in_range(k) ? static_cast<std::int32_t>((std::int64_t{1} << (32 - 2 * k)) - 1) : -1)) {}

    // The sign bit of those words that are not the high half of such a u. Others are below 2^31.
    LKS_FORCE_INLINE R leaves(R high_u) const {
        return L::bit_or(L::subtract_32(high_u, lowest_), L::subtract_32(highest_, high_u));
    }
    // u·2^2k, high halves.
    LKS_FORCE_INLINE Numbers<L> align(const Group<L>& u) const { return align_(u); }
    LKS_FORCE_INLINE R twice_k() const { return twice_k_; }

private:
    // Beyond these, nothing is in it: u has a bit in its high half, and is below 2^62.
    static constexpr int in_range(int k) { return k < 1 || k > 15 ? 1 : k; }

    R twice_k_;
    HighShift<L> align_;
    R lowest_;
    R highest_;
};

// Where lanes shift by counts of their own nobody asks for it.
template <typename L>
using OctaveOf = std::conditional_t<L::has_shift_each, Needless, Octave<L>>;

// Of a group's squared lengths u.
template <typename L>
struct LengthLanes {
    Group<L> twice_k;
    Factors<L> m; // Q2.30
    Factors<L> y;
};

// Squared lengths, shifted to the left.
template <typename L, std::uint32_t n>
struct Aligned {
    Each<Numbers<L>, n> m; // u·2^2k, high half
    Each<Group<L>, n> twice_k;
};

template <typename L, std::uint32_t n, typename Squares>
LKS_SELDOM Aligned<L, n> align_each(const Squares& u) {
    using I = std::uint32_t;
    const auto high = of_each<n>([&](I i) { return L::high_halves(u[i].a, u[i].b); });
    const auto zeros = of_each<n>([&](I i) { return L::leading_zeros_32(high[i]); });
    const auto words = of_each<n>([&](I i) { return L::bit_and(zeros[i], L::set_32(~1)); });
    const auto even = of_each<n>([&](I i) { return L::bit_and(words[i], L::set(UINT32_MAX)); });
    const auto odd = of_each<n>([&](I i) { return L::template shift_right<32>(words[i]); });
    const auto a = of_each<n>([&](I i) { return L::shift_left_each(u[i].a, even[i]); });
    const auto b = of_each<n>([&](I i) { return L::shift_left_each(u[i].b, odd[i]); });
    return {of_each<n>([&](I i) {
                return high_numbers<L>({a[i], b[i]});
            }),
            of_each<n>([&](I i) {
                return Group<L>{even[i], odd[i]};
            })};
}

// min(L/len, 2) − 1 in Direction format from L/len times 2^(shift - k).
template <typename L>
LKS_SELDOM Factors<L> relative_error_each(const Group<L>& product, typename L::Register shift,
                                          const Group<L>& twice_k) {
    using R = typename L::Register;
    const auto limited = [&](R wide, R k2) {
        const R ratio = L::shift_right_each(wide, L::subtract(shift, L::template shift_right<1>(k2)));
        const R two = L::set(2 * std::int64_t{direction_one});
        if constexpr (L::has_minimum_64) {
            return L::minimum_64(ratio, two);
        } else {
            // Neither exceeds 2^63, so the sign of the difference decides.
            return L::select_by_sign(ratio, two, L::subtract(two, ratio));
        }
    };
    using F = FactorsOf<L>;
    return F::less(F::low({limited(product.a, twice_k.a), limited(product.b, twice_k.b)}),
                   F::constant(direction_one));
}

} // namespace
} // namespace lks
