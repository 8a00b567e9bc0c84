// Particles of an object put where the game says, and its local frame with them.
#pragma once

#include "solver/object.h"

namespace lks {

// Vertices that are put somewhere.
struct Laid {
    std::uint32_t first;
    std::uint32_t count;
    const lks_vec3* positions; // each within ±world_position_limit on each axis

    bool contains(std::uint32_t vertex) const { return vertex - first < count; }
};

// From one particle to another no object reaches further on an axis, World; no asset does.
inline constexpr std::int64_t greatest_extent = std::int64_t{120} << world_fraction_bits;

// Where in the world all particles will be.
Bounds laid_bounds(const Object& object, const Laid& laid);
// Positions, pins with them; motions of the last substep stay. The origin goes in whole metres to the middle
// of the bounds, which are no further apart than greatest_extent, where they are out of its range. How many
// targets of other pins left the range by that and were clamped.
std::uint64_t lay(Object& object, const Laid& laid, const Bounds& bounds);

} // namespace lks
