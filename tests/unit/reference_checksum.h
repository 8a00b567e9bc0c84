// The checksum of an image as kernels/lane_sums.h has it, word by word.
#pragma once

#include <cstddef>
#include <cstdint>

#include "state/hash.h"

namespace lks::test {

inline std::uint64_t reference_checksum(const unsigned char* bytes, std::size_t size) {
    std::uint64_t sums[8]{}, sums_of_sums[8]{};
    const std::size_t words = (size + 63) / 64 * 8;
    for (std::size_t i = 0; i < words; ++i) {
        std::uint64_t word = 0;
        for (std::size_t k = 8; k-- > 0;) {
            word = word << 8 | (8 * i + k < size ? bytes[8 * i + k] : 0u);
        }
        sums[i % 8] += word ^ (word >> 32);
        sums_of_sums[i % 8] += sums[i % 8];
    }
    Hash hash;
    for (std::size_t lane = 0; lane < 8; ++lane) {
        hash.add_u64(sums[lane]);
        hash.add_u64(sums_of_sums[lane]);
    }
    hash.add_u64(size);
    return hash.finish();
}

} // namespace lks::test
