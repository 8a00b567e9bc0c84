// How far a substep's corrections go, and how fine they are.
#pragma once

#include <cstdint>

#include "fixed/formats.h"

namespace lks {

// What a constraint pushes at most in a substep, World (1024 m): one that can't be satisfied would otherwise
// carry ever more on.
inline constexpr std::int64_t greatest_push = std::int64_t{1} << 50;

// In trees of which a body has a hundred times the mass of another, and more (rigid/uneven_tree.h), 262 km:
// what a heavy body pulls with counts as the length that it would move the lightest one by.
inline constexpr std::int64_t greatest_uneven_push = std::int64_t{1} << 58;
// Of all substeps of a tick.
inline constexpr std::int64_t greatest_pushed = std::int64_t{1} << 62;

// What a move or a turn in other units saturates at.
inline constexpr std::int64_t greatest_shifted = std::int64_t{1} << 50;

// Errors beyond this are taken in several substeps: a bone that was torn 10 m away comes back at a bounded
// speed.
inline constexpr std::int64_t greatest_step = std::int64_t{1} << (world_fraction_bits - 1);

// Half turns of corrections, as fine as positions are: with 2^-33 what rests crept by its roundings, ten
// boxes by a quarter of a millimetre in a minute.
inline constexpr int half_turn_fraction_bits = 40;
// A quarter an axis at most.
inline constexpr std::int64_t greatest_half_turn = std::int64_t{1} << (half_turn_fraction_bits - 2);
// Beyond this a turn takes more than its first order.
inline constexpr std::int64_t small_half_turn = std::int64_t{1} << (half_turn_fraction_bits - 8);

} // namespace lks
