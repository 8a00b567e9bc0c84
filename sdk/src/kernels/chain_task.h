// Some segments of a rope that follow each other, for kernels that look at them side by side. Plain data, as
// distance_task.h. What each of them does is said in kernels/chain_scalar.h.
#pragma once

#include <cstdint>

namespace lks {

inline constexpr std::uint32_t chain_block = 64;
// Arrays of a whole rope go on so far behind its end, and what is there does no harm.
inline constexpr std::uint32_t chain_padding = 8;

inline constexpr int cosine_fraction_bits = 60;

struct ChainSegments {
    std::uint32_t count; // up to chain_block
    // Of the points, one more than segments, Coordinate.
    std::int64_t points[3][chain_block + 1];
    // Of segment i, from point i to point i + 1. Of directions the low halves count. The one at `count` is
    // given.
    std::int64_t directions[3][chain_block + 1];
    std::int64_t lengths[chain_block]; // Coordinate; 0: it has no direction, all zero
    // One less the cosine between segments i and i + 1, less than two, 60 fraction bits: exact where a rope
    // is nearly straight. One where either has no direction.
    std::int64_t versines[chain_block];
    const std::int64_t* rest_lengths; // Coordinate
    const std::int64_t* slacks;       // longer by more than this it is torn
    // How much longer segments are to become: twice as long or nothing at most, and no more than particles
    // move in a substep. In units of 2^side_shift coordinate units, rounded down.
    std::int64_t changes[chain_block];
};
inline constexpr int side_shift = 6;

// Inverse masses of particles: w/R = weights · 2^-(31 + weight_shifts), with 31 significant bits, or 0 and
// greatest_weight_shift where one is pinned.
struct ChainWeights {
    const std::uint32_t* weights;
    const std::uint32_t* weight_shifts;
};
inline constexpr int chain_weight_bits = 31;
inline constexpr int greatest_weight_shift = 60;

// Of inverse masses and the compliance as shares of R.
inline constexpr int chain_share_bits = 63;
// Of a row's x.
inline constexpr int chain_x_bits = 60;
// Of what multipliers are carried with.
inline constexpr int carried_bits = 62;

// The rows of the elimination; `near` are the particles at the near ends.
struct ChainRows {
    std::uint32_t count;
    ChainWeights near;
    std::uint64_t softness;
    int exponent; // of multipliers
    const std::int64_t* versines;
    std::int64_t turns[chain_block];       // σ + w·s² between segments i and i + 1
    std::int64_t scales[chain_block + 1];  // q, 2^62 .. 2^63 − 1; the one at `count` is given
    std::int64_t shifts[chain_block];      // by which they were shifted up to be that
    std::int64_t ratios[chain_block];      // of the scale behind to this: 1/d is that · 2^(shift − 31)
    std::int64_t shares[chain_block + 1];  // x; the one at `count` is given
    std::int64_t carried[chain_block + 1]; // from 1 to `count`: x·cosine
    std::int64_t sides[chain_block];       // b, less than 2^62
    std::int64_t multipliers[chain_block]; // b/d
};
// Products of multipliers by directions and weights fit.
inline constexpr std::int64_t multiplier_limit = (std::int64_t{1} << 60) - 1;

// How particles move by multipliers.
struct ChainMoves {
    std::uint32_t count; // of particles
    int exponent;        // of multipliers
    ChainWeights near;
    const std::int64_t* directions[3];
    const std::int64_t* multipliers;
    std::int64_t pushes[3][chain_block + 1]; // by the segment before; those at 0 are given
    std::int64_t* movements[3];
};

// How much tensions stiffen segments beyond what is stable by itself.
struct ChainTensions {
    std::uint32_t count;
    std::int64_t stable;
    const std::int64_t* tensions;
    const std::uint32_t* stiffness;
    const std::uint32_t* near_shares;
    const std::uint32_t* far_shares;
    std::int64_t* near;
    std::int64_t* far;
};

// What of movements neighbours share, from how the system for it was eliminated.
struct ChainShares {
    std::uint32_t count;
    std::int64_t scales[chain_block]; // 2^63 and more, read as unsigned
    std::int64_t parts[chain_block];  // of the scale, at most all of it
    std::int64_t fars[chain_block];   // of the part, at most all of it
    std::int64_t* takes; // what a particle takes of what is behind: one less part over scale, carried_bits
    std::int64_t* gives; // what what is behind takes of it: far over part
};

// Where a segment's ends moved against each other by more than 2^-turned_shift of its length, or the second
// pass changed its length by more than 2^-error_shift, it is left off its length.
inline constexpr int turned_shift = 5;
inline constexpr int error_shift = 11;
// Where a rope folds back by more than 176 degrees there is no "along"; of half the sum of two directions.
inline constexpr std::uint64_t least_tangent_squared = std::uint64_t{1} << 50;
inline constexpr std::int64_t tangent_one = std::int64_t{1} << 60;
// Up to a turn of 29 degrees, which makes the square a sixteenth less than one, a series finds its
// reciprocal.
inline constexpr int greatest_turn_bits = 26;
inline constexpr std::int64_t greatest_turn = std::int64_t{1} << greatest_turn_bits;

// Of what the second pass changed, the part across the rope.
struct ChainAcross {
    std::uint32_t count;               // of particles: all of the rope
    const std::int64_t* directions[3]; // with one before the first and one behind the last
    const std::int64_t* rest_lengths;
    std::int64_t* movements[3]; // without the pass; becomes what is left with it
    std::int64_t* changes[3];   // with the pass; becomes by how much more that is
};

// One of each for every instruction set.
struct ChainKernels {
    void (*measure)(ChainSegments& segments); // lengths, directions and versines
    bool (*stretch)(ChainSegments& segments); // changes, from lengths; false: one is torn
    void (*turn)(ChainRows& rows);            // turns, from versines
    void (*divide)(ChainRows& rows);          // ratios, shares and what is carried, from scales and shifts
    void (*solve)(ChainRows& rows);           // multipliers, from sides
    void (*push)(ChainMoves& moves);
    bool (*stiffen)(ChainTensions& tensions); // whether any is
    void (*share)(ChainShares& shares);
    bool (*cross)(ChainAcross& task); // whether a segment is left off its length
};

} // namespace lks
