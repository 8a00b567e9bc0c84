// How far bodies go in a part of a second, and what room that takes.
#pragma once

#include <algorithm>

#include "collide/collider_motion.h"
#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/body_motion.h"
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

// What is kinematic goes to its target however far that is; the velocity that it has on its way stops at the
// limit.
inline fixed::Vec3 way_in_tick(const Body& body, const StepRate& rate) {
    return body.is_dynamic() ? way_in(body.velocity, rate.ticks_per_second)
                             : saturating_subtract(body.target_position, body.tick_position);
}

// Of b against a.
inline fixed::Vec3 way_in_substep(const Body& a, const Body& b, const StepRate& rate) {
    const auto n = static_cast<std::int64_t>(rate.substeps_per_second);
    if (a.is_dynamic() && b.is_dynamic()) {
        return way_in(saturating_subtract(b.velocity, a.velocity), n);
    }
    const auto way = [&rate, n](const Body& body) {
        return body.is_dynamic() ? way_in(body.velocity, n) : way_in(way_in_tick(body, rate), rate.substeps);
    };
    return saturating_subtract(way(b), way(a));
}

// How far a spin carries points that are `radius` from the middle, in one of n parts of a second.
inline std::int64_t turn_in(const Body& body, std::int64_t radius, std::int64_t n, const StepRate& rate) {
    const auto limit = static_cast<std::uint64_t>(body_spin_limit(rate));
    const bool limited = fixed::greatest_magnitude(body.angular_velocity) >= limit;
    const std::int64_t turn = spin_speed(body.angular_velocity, radius) / n;
    // What is kinematic turns by a quarter at most in a tick.
    return limited && !body.is_dynamic() ? std::max(turn, saturating_double(radius)) : turn;
}

// How far points of a collider go by its turning: by a quarter at most in a tick.
inline std::int64_t quarter_turn(const ColliderState& collider) {
    const Shape& shape = collider.shape;
    const bool plane = shape.kind == LKS_SHAPE_PLANE;
    return 2 * (plane ? LKS_FIXED(64) : world_from_coordinate(bounding_radius(shape, 0)));
}

// What gravity adds to the way of a tick.
inline fixed::Vec3 fall_in_tick(const BodyTick& tick, const StepRate& rate) {
    const auto along = [&rate](std::int64_t step) {
        const std::int64_t speed =
            fixed::saturate_to_int64(fixed::multiply_signed(step, static_cast<std::int64_t>(rate.substeps)));
        return per_tick(speed, rate);
    };
    const fixed::Vec3& g = tick.gravity_step;
    return {along(g.x), along(g.y), along(g.z)};
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
