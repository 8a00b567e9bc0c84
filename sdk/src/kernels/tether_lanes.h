// The question of tether_task.h for L::half particles at a time.
#pragma once

#include "kernels/tether_scalar.h"

namespace lks {
namespace {

template <typename L>
inline std::uint64_t beyond_tether_lanes(const TetherTask& task, std::uint32_t first, std::uint32_t count) {
    using R = typename L::Register;
    std::uint64_t beyond = 0;
    std::uint32_t i = 0;
    for (; i + L::half <= count; i += L::half) {
        R square = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            const R apart = L::subtract(L::load(task.positions[axis] + first + i), L::set(task.anchor[axis]));
            const R upper = L::template shift_right<32>(apart);
            square = L::add(square, L::multiply_signed(upper, upper));
        }
        const R shorter = L::subtract(L::load_widened(task.lengths + first + i), L::set(2));
        const R room = L::subtract(L::template shift_right<1>(L::multiply_unsigned(shorter, shorter)),
                                   L::template shift_right<1>(square));
        beyond |= static_cast<std::uint64_t>(L::sign_bits(room)) << i;
    }
    return i == count ? beyond : beyond | beyond_tether_scalar(task, first + i, count - i) << i;
}

} // namespace
} // namespace lks
