// Which part of the rest of a way is free: collide/trace.h, one by one and over lanes.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace lks {

// distance / closing, Q30, rounded down; distance < closing.
static constexpr std::int32_t way_share(std::uint64_t distance, std::uint64_t closing) {
    const int shift = std::max(0, 32 - std::countl_zero(closing));
    return static_cast<std::int32_t>(((distance >> shift) << 30) / ((closing >> shift) + 1));
}

} // namespace lks
