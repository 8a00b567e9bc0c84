// The questions of contact_task.h for 2·L::half particles at a time.
#pragma once

#include "kernels/contact_scalar.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

// Upper halves of 2·L::half coordinates: even lanes the first ones, odd lanes the others.
template <typename L>
LKS_FORCE_INLINE typename L::Register upper_halves(const std::int64_t* x) {
    return L::high_halves(L::load(x), L::load(x + L::half));
}

template <typename L>
inline std::uint64_t near_box_lanes(const BoxTask& task, std::uint32_t first, std::uint32_t count) {
    using R = typename L::Register;
    constexpr std::uint32_t lanes = 2 * L::half;
    std::uint64_t near = 0;
    std::uint32_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        R apart = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            const R x = upper_halves<L>(task.positions[axis] + first + i);
            const R start = upper_halves<L>(task.starts[axis] + first + i);
            const R low = L::set_32(task.low[axis]);
            const R high = L::set_32(task.high[axis]);
            apart = L::bit_or(apart, L::bit_and(L::greater_32(x, high), L::greater_32(start, high)));
            apart = L::bit_or(apart, L::bit_and(L::greater_32(low, x), L::greater_32(low, start)));
        }
        const std::uint64_t bits = L::sign_bits(L::template shift_left<32>(apart)) |
                                   static_cast<std::uint64_t>(L::sign_bits(apart)) << L::half;
        near |= (~bits & ((std::uint64_t{1} << lanes) - 1)) << i;
    }
    return i == count ? near : near | near_box_scalar(task, first + i, count - i) << i;
}

template <typename L>
LKS_FORCE_INLINE typename L::Register height_above(const PlaneTask& task, std::uint32_t i) {
    using R = typename L::Register;
    R height = L::set(-task.level);
    for (int axis = 0; axis < 3; ++axis) {
        const R x = L::template shift_right<32>(L::load(task.positions[axis] + i));
        height = L::add(height, L::multiply_signed(x, L::set(task.normal[axis])));
    }
    return height;
}

template <typename L>
inline std::uint64_t near_plane_lanes(const PlaneTask& task, std::uint32_t first, std::uint32_t count) {
    std::uint64_t near = 0;
    std::uint32_t i = 0;
    for (; i + L::half <= count; i += L::half) {
        near |= static_cast<std::uint64_t>(L::sign_bits(height_above<L>(task, first + i))) << i;
    }
    return i == count ? near : near | near_plane_scalar(task, first + i, count - i) << i;
}

} // namespace
} // namespace lks
