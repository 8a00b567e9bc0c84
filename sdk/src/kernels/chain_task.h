// Some segments of a rope that follow each other, for a kernel that measures them. Plain data, as
// distance_task.h.
#pragma once

#include <cstdint>

namespace lks {

inline constexpr std::uint32_t chain_block = 64;

struct ChainSegments {
    std::uint32_t count; // up to chain_block
    // Of the points, one more than segments, Coordinate.
    std::int64_t points[3][chain_block + 1];
    // Of segment i, from point i to point i + 1. Of directions the low halves count. The one at `count` is
    // given.
    std::int64_t directions[3][chain_block + 1];
    std::int64_t lengths[chain_block]; // Coordinate; 0: it has no direction, all zero
    // One less the cosine between segments i and i + 1, two at most, 60 fraction bits: exact where a rope is
    // nearly straight.
    std::int64_t versines[chain_block];
};

inline constexpr int cosine_fraction_bits = 60;

} // namespace lks
