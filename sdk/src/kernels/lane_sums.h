// What an image's checksum is made of: of its little-endian 64-bit words, eight lanes of them, sums and sums
// of those sums, modulo 2^64 (Fletcher, "An arithmetic checksum for serial transmissions", 1982). In a lane
//
//     sum += word ^ (word >> 32)
//     sum_of_sums += sum
//
// Carries fall off the top, where two signs that change would cancel out; so upper halves are in the lower
// ones, too. A change of one word is always seen.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lks {

inline constexpr std::uint32_t sum_lanes = 8;
inline constexpr std::size_t stripe_size = sum_lanes * sizeof(std::uint64_t); // a word a lane

struct LaneSums {
    std::uint64_t sums[sum_lanes];
    std::uint64_t sums_of_sums[sum_lanes];
};

} // namespace lks
