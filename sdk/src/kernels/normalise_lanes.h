// fixed::normalise over lanes.
#pragma once

#include "kernels/mantissa_lanes.h"
#include "kernels/vector_lanes.h"

namespace lks {
namespace {

template <typename L>
struct NormaliseLanes : VectorLanes<L> {
    using V = VectorLanes<L>;
    using R = typename L::Register;
    using typename V::Vector;

    struct Unit {
        Vector direction; // in the low halves
        R length;         // of vectors within 2^59
        R tiny;           // negative where |v| is too small for all this: below 2 units
    };

    // |v| < 2^62
    LKS_FORCE_INLINE static Unit normalise(const Vector& v) {
        R x = V::absolute(v.x), y = V::absolute(v.y), z = V::absolute(v.z);
        R all = L::bit_or(L::bit_or(x, y), z);
        const R tiny = L::equal(L::template shift_right<1>(all), L::set(0));
        const R small = L::equal(L::template shift_right<32>(all), L::set(0));
        R raised = L::set(0);
        if (L::any(small)) {
            raised = L::bit_and(small, L::set(31));
            x = L::shift_left_each(x, raised);
            y = L::shift_left_each(y, raised);
            z = L::shift_left_each(z, raised);
            all = L::shift_left_each(all, raised);
        }
        const R down = L::subtract(L::set(33), L::template shift_right<32>(L::leading_zeros_32(all)));
        const R half = L::shift_left_each(L::set(1), L::subtract(down, L::set(1)));
        x = L::shift_right_each(L::add(x, half), down);
        y = L::shift_right_each(L::add(y, half), down);
        z = L::shift_right_each(L::add(z, half), down);
        const R squared = L::add(L::add(L::multiply_unsigned(x, x), L::multiply_unsigned(y, y)),
                                 L::multiply_unsigned(z, z));
        // 1 where the upper two bits are clear, or else 0.
        const R up = L::bit_and(L::equal(L::template shift_right<62>(squared), L::set(0)), L::set(1));
        const R m = L::shift_left_each(squared, L::add(up, up));
        const R reciprocal = MantissaLanes<L>::reciprocal_sqrt(L::template shift_right<32>(m));
        const R component_down = L::subtract(L::set(32), up);
        const R component_half = L::shift_left_each(L::set(1), L::subtract(L::set(31), up));
        const auto component = [&](R magnitude, R sign) {
            const R c = L::shift_right_each(
                L::add(L::multiply_unsigned(magnitude, reciprocal), component_half), component_down);
            return V::with_sign(L::minimum_signed(c, L::set(std::int64_t{1} << 30)), sign);
        };
        const R root = L::add(L::multiply_unsigned(L::template shift_right<32>(m), reciprocal),
                              L::template shift_right<32>(L::multiply_unsigned(m, reciprocal)));
        const R root_down = L::add(L::subtract(L::add(L::set(30), up), down), raised);
        const R root_half = L::shift_left_each(L::set(1), L::subtract(root_down, L::set(1)));
        return {{component(x, v.x), component(y, v.y), component(z, v.z)},
                L::shift_right_each(L::add(root, root_half), root_down),
                tiny};
    }
};

} // namespace
} // namespace lks
