// One direction in which a joint does not let b turn against a, as a row of a tree that is held
// (rigid/held_tree.h).
#pragma once

#include <cstdint>

#include "fixed/formats.h"
#include "fixed/vector.h"

namespace lks {

struct HeldRow {
    enum class Kind : std::uint8_t { turn, swing, most_twist, least_twist, drive };

    Kind kind;
    fixed::Direction axis; // in the world
    // World, radians: how far b is turned about the axis; beyond a limit it is less than zero.
    std::int64_t error;
    std::int64_t push; // of limits: what they have pushed by now, not less than zero

    bool is_limit() const { return kind != Kind::turn && kind != Kind::drive; }
};

// Radians, World: what is turned by no more is left to rows that go in turn. An eighth of a degree.
inline constexpr std::int64_t far_turned = world_one / 458;

// What is turned by more is turned back in several steps: a quarter.
inline constexpr std::int64_t most_turned_back = world_one / 4;

// Of a fixed joint, or of a hinge with its limit or its motor.
inline constexpr std::uint32_t most_held_rows = 3;

} // namespace lks
