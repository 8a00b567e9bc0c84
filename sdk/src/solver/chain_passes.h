// What both passes along a chain of segments go by (solver/chain.cpp, chain_across.cpp).
#pragma once

#include <algorithm>
#include <cstdint>

#include "fixed/int128.h"
#include "kernels/chain_task.h"

namespace lks {

inline std::uint64_t upper_half(std::uint64_t a, std::uint64_t b) {
    return fixed::multiply_unsigned(a, b).hi;
}

// What is carried of a value, the lowest two bits rounded down.
inline std::int64_t carry(std::int64_t share, std::int64_t value) {
    return fixed::multiply_signed(share, value).hi * (std::int64_t{1} << (64 - carried_bits));
}

// Blocks of segments from the far end to the near one. All but the last begin and end at multiples of their
// size.
template <typename Use>
void each_block_back(std::uint32_t count, const Use& use) {
    for (std::uint32_t last = count; last > 0;) {
        const std::uint32_t first = (last - 1) / chain_block * chain_block;
        use(first, last - first);
        last = first;
    }
}
// And back.
template <typename Use>
void each_block(std::uint32_t count, const Use& use) {
    for (std::uint32_t first = 0; first < count; first += chain_block) {
        use(first, std::min(count - first, chain_block));
    }
}

} // namespace lks
