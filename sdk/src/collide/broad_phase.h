// Which colliders an object has to do with in a tick.
#pragma once

#include <cstdint>

#include "collide/collider_motion.h"

namespace lks {

// False only where the collider, on its way through the whole tick, stays further than `margin` from
// everything within `bounds` (Coordinate, around `origin`; any 64-bit values). Exact in integers, so that no
// rounding can lose a contact.
bool may_touch(const ColliderState& collider, const fixed::Vec3& origin, const Bounds& bounds,
               std::int64_t margin);

// Writes the indices of those slots that particles may touch, in ascending order, and returns their number. A
// slot has `used` and `collider`; `indices` has room for all.
template <typename Slot>
std::uint32_t collect_candidates(const Slot* slots, std::uint32_t count, const fixed::Vec3& origin,
                                 const Bounds& bounds, std::int64_t margin, std::uint32_t* indices) {
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const ColliderState& collider = slots[i].collider;
        if (slots[i].used && meets_particles(collider.filter) &&
            may_touch(collider, origin, bounds, margin)) {
            indices[found++] = i;
        }
    }
    return found;
}

} // namespace lks
