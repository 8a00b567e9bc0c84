// How far bodies go in a part of a second, and what room that takes.
#pragma once

#include "collide/saturation.h"
#include "fixed/formats.h"
#include "solver/step_rate.h"

namespace lks {

// How far a speed takes it in a tick.
constexpr std::int64_t per_tick(std::int64_t speed, const StepRate& rate) {
    return speed / static_cast<std::int64_t>(rate.ticks_per_second);
}

// A velocity over one of n parts of a second, rounded away from zero.
inline fixed::Vec3 way_in(const fixed::Vec3& velocity, std::int64_t n) {
    const auto along = [n](std::int64_t v) {
        return fixed::saturating_add(v / n, v > 0 ? 1 : v < 0 ? -1 : 0);
    };
    return {along(velocity.x), along(velocity.y), along(velocity.z)};
}

// Half the size of a box that holds both, and `more` on each side.
inline fixed::Vec3 room_around(const fixed::Vec3& extent_a, const fixed::Vec3& extent_b, std::int64_t more) {
    return extent_a + extent_b + fixed::Vec3{more, more, more};
}

// How far what it hits on its way may turn it aside. (Figures that are thrown at a fence pass it more often
// without that.)
constexpr std::int64_t aside(std::int64_t way) {
    return way / 4;
}

} // namespace lks
