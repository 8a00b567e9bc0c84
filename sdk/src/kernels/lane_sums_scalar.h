// Internal linkage, as kernels/distance_scalar.h says.
#pragma once

#include "kernels/lane_sums.h"
#include "memory/bytes.h"

namespace lks {
namespace {

// Compilers make vectors of it.
inline void sum_stripes_scalar(LaneSums& total, const unsigned char* bytes, std::size_t stripes) {
    LaneSums now = total;
    for (const unsigned char* const end = bytes + stripes * stripe_size; bytes != end; bytes += stripe_size) {
        for (std::uint32_t lane = 0; lane < sum_lanes; ++lane) {
            const std::uint64_t word = read_integer<std::uint64_t>(bytes + lane * 8);
            now.sums[lane] += word ^ (word >> 32);
            now.sums_of_sums[lane] += now.sums[lane];
        }
    }
    total = now;
}

} // namespace
} // namespace lks
