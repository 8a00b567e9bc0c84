// lane_sums.h over lanes. Little-endian ones, as all of them are.
#pragma once

#include "kernels/lane_sums.h"

namespace lks {
namespace {

template <typename L>
inline void sum_stripes_lanes(LaneSums& total, const unsigned char* bytes, std::size_t stripes) {
    using R = typename L::Register;
    constexpr std::uint32_t registers = sum_lanes / L::half;
    R sums[registers], sums_of_sums[registers];
    // As the sums stand in memory: 64-bit numbers, whose signs don't matter here.
    auto* const from = reinterpret_cast<std::int64_t*>(total.sums);
    auto* const from_sums = reinterpret_cast<std::int64_t*>(total.sums_of_sums);
    for (std::uint32_t i = 0; i < registers; ++i) {
        sums[i] = L::load(from + i * L::half);
        sums_of_sums[i] = L::load(from_sums + i * L::half);
    }
    const auto* word = reinterpret_cast<const std::int64_t*>(bytes);
    for (const auto* const end = word + stripes * sum_lanes; word != end; word += sum_lanes) {
        for (std::uint32_t i = 0; i < registers; ++i) {
            const R words = L::load(word + i * L::half);
            sums[i] = L::add(sums[i], L::exclusive_or(words, L::template shift_right<32>(words)));
            sums_of_sums[i] = L::add(sums_of_sums[i], sums[i]);
        }
    }
    for (std::uint32_t i = 0; i < registers; ++i) {
        L::store(from + i * L::half, sums[i]);
        L::store(from_sums + i * L::half, sums_of_sums[i]);
    }
}

} // namespace
} // namespace lks
