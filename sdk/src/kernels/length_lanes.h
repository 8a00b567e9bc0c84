// Lengths of edges over lanes, and how far they are from their rest lengths.
#pragma once

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
        : twice_k_(L::set(2 * in_range(k))), align_(2 * in_range(k)), motion_(in_range(k)),
          lowest_(L::set_32(k == in_range(k) ? 1 << (30 - 2 * k) : INT32_MAX)),
          highest_(L::set_32(
              k == in_range(k) ? static_cast<std::int32_t>((std::int64_t{1} << (32 - 2 * k)) - 1) : -1)) {}

    // The sign bit of those words that are not the high half of such a u. Others are below 2^31.
    LKS_FORCE_INLINE R leaves(R high_u) const {
        return L::bit_or(L::subtract_32(high_u, lowest_), L::subtract_32(highest_, high_u));
    }
    LKS_FORCE_INLINE R lowest() const { return lowest_; }
    LKS_FORCE_INLINE R highest() const { return highest_; }
    // u·2^2k, high halves.
    LKS_FORCE_INLINE Numbers<L> align(const Group<L>& u) const { return align_(u); }
    // |v| ≤ u: v·2^(2k − 2), high halves to the nearest.
    LKS_FORCE_INLINE Factors<L> align_signed(const Group<L>& v) const {
        const Group<L> rounded{L::add(v.a, motion_.half), L::add(v.b, motion_.half)};
        using F = FactorsOf<L>;
        if constexpr (L::has_signed_shift) {
            return F::low({L::shift_right_signed(rounded.a, motion_.right),
                           L::shift_right_signed(rounded.b, motion_.right)});
        } else if constexpr (L::has_quick_shift) {
            return F::high({L::shift_left(rounded.a, motion_.left), L::shift_left(rounded.b, motion_.left)});
        } else {
            // What this leaves of the sign is shifted out.
            return align_({L::template shift_right<2>(rounded.a), L::template shift_right<2>(rounded.b)})
                .factors;
        }
    }
    LKS_FORCE_INLINE R twice_k() const { return twice_k_; }

private:
    // Beyond these, nothing is in it: u has a bit in its high half, and is below 2^62.
    static constexpr int in_range(int k) { return k < 1 || k > 15 ? 1 : k; }

    struct SignedAlignment {
        explicit SignedAlignment(int k)
            : half(L::set(std::int64_t{1} << (33 - 2 * k))), right(L::make_shift(34 - 2 * k)),
              left(L::make_shift(2 * k - 2)) {}
        R half;
        typename L::Shift right;
        typename L::Shift left;
    };

    R twice_k_;
    HighShift<L> align_;
    SignedAlignment motion_;
    R lowest_;
    R highest_;
};

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

// min(L/len, 2) in Direction format from L/len times 2^(shift - k).
template <typename L>
LKS_SELDOM Factors<L> limited_ratio_each(const Group<L>& product, typename L::Register shift,
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
    return FactorsOf<L>::low({limited(product.a, twice_k.a), limited(product.b, twice_k.b)});
}

} // namespace
} // namespace lks
