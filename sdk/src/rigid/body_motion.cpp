#include "rigid/body_motion.h"

#include <algorithm>

#include "collide/collider_motion.h"
#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/free_spin.h"

namespace lks {
namespace {

using fixed::Vec3;

// a / n to the nearest, ties away from zero.
std::int64_t divide_rounded(std::int64_t a, std::int64_t n) {
    return (a >= 0 ? a + n / 2 : a - n / 2) / n;
}

// What moves from a to b in a substep has it exactly.
Vec3 velocity_between(const Vec3& a, const Vec3& b, const MotionRate& rate) {
    const auto part = [&](std::int64_t c) { return fixed::multiply_shift(c, rate.substeps_per_second, 0); };
    const Vec3 moved = saturating_subtract(b, a);
    return {part(moved.x), part(moved.y), part(moved.z)};
}

std::int64_t keep(std::int64_t value, std::uint32_t kept) {
    return fixed::multiply_shift(value, kept, unit_fraction_bits);
}

Vec3 keep(const Vec3& value, std::uint32_t kept) {
    return kept == unit_one ? value : Vec3{keep(value.x, kept), keep(value.y, kept), keep(value.z, kept)};
}

} // namespace

MotionRate::MotionRate(const StepRate& rate)
    : substeps_per_second(static_cast<std::int64_t>(rate.substeps_per_second)),
      half_turn_factor((std::int64_t{1} << 59) / substeps_per_second), speed_limit(body_speed_limit(rate)),
      spin_limit(body_spin_limit(rate)), greatest_recovery(rate.greatest_recovery) {}

std::int64_t body_speed_limit(const StepRate& rate) {
    const auto n = static_cast<std::int64_t>(rate.substeps_per_second);
    return std::min<std::int64_t>(1000, 16 * n) << world_fraction_bits;
}

std::int64_t body_spin_limit(const StepRate& rate) {
    const auto n = static_cast<std::int64_t>(rate.substeps_per_second);
    return std::min<std::int64_t>(1000, n) << world_fraction_bits;
}

Vec3 to_half_turn(const Vec3& spin, const MotionRate& rate) {
    const auto part = [&](std::int64_t c) { return fixed::multiply_shift(c, rate.half_turn_factor, 40); };
    return {part(spin.x), part(spin.y), part(spin.z)};
}

Vec3 to_spin(const Vec3& half_turn, const MotionRate& rate) {
    const auto part = [&](std::int64_t c) { return fixed::multiply_shift(c, rate.substeps_per_second, 19); };
    return {part(half_turn.x), part(half_turn.y), part(half_turn.z)};
}

std::int64_t spin_speed(const Vec3& spin, std::int64_t radius) {
    return fixed::saturate_to_int64(fixed::multiply_signed(sum_of_magnitudes(spin), radius) >>
                                    world_fraction_bits);
}

std::int64_t greatest_speed(const Speeds& speeds, std::int64_t radius) {
    return fixed::saturating_add(sum_of_magnitudes(speeds.velocity), spin_speed(speeds.spin, radius));
}

BodyTick make_body_tick(const BodyDescription& description, const StepRate& rate, const Vec3& gravity) {
    const auto step = [&](std::int64_t g) {
        return divide_rounded(fixed::multiply_shift(g, description.gravity_factor, world_fraction_bits),
                              static_cast<std::int64_t>(rate.substeps_per_second));
    };
    return {{step(gravity.x), step(gravity.y), step(gravity.z)},
            kept_share(rate, description.linear_damping),
            kept_share(rate, description.angular_damping)};
}

void predict_body(Body& body, const BodyDescription& description, const BodyTick& tick,
                  const MotionRate& rate, std::uint64_t& speed_clamps) {
    body.start_position = body.position;
    body.start_orientation = body.orientation;
    body.velocity = keep(body.velocity + tick.gravity_step, tick.linear_kept);
    body.angular_velocity = keep(body.angular_velocity, tick.angular_kept);
    if (spins_evenly(description, body.angular_velocity)) {
        limit_speeds(body, rate, speed_clamps);
    } else {
        speed_clamps += clamp_vector(body.velocity, rate.speed_limit) ? 1u : 0u;
        speed_clamps += limit_free_spin(body.angular_velocity, rate) ? 1u : 0u;
        body.angular_velocity = middle_spin(body, description, rate);
    }
    const std::int64_t n = rate.substeps_per_second;
    body.position =
        body.position + Vec3{divide_rounded(body.velocity.x, n), divide_rounded(body.velocity.y, n),
                             divide_rounded(body.velocity.z, n)};
    clamp_vector(body.position, world_position_limit);
    if (!(body.angular_velocity == Vec3{0, 0, 0})) {
        body.orientation = turned(body.orientation, to_half_turn(body.angular_velocity, rate));
        body.follow_orientation();
    }
    body.predicted_position = body.position;
    body.predicted_orientation = body.orientation;
    body.predicted_spin = body.angular_velocity;
    body.world_inverse =
        description.properties.round ? body.inverse_inertia : rotated(body.inverse_inertia, body.rotation);
}

void aim_kinematic(Body& body, const MotionRate& rate, std::uint32_t substeps) {
    const Vec3 way = velocity_between(body.position, body.target_position, rate);
    const Vec3 turn = to_spin(half_turn_between(body.orientation, body.target_orientation), rate);
    const auto n = static_cast<std::int64_t>(substeps);
    body.velocity = {way.x / n, way.y / n, way.z / n};
    body.angular_velocity = {turn.x / n, turn.y / n, turn.z / n};
    clamp_vector(body.velocity, rate.speed_limit);
    clamp_vector(body.angular_velocity, rate.spin_limit);
}

void place_kinematic(Body& body, std::uint32_t substep, std::uint32_t substeps, const MotionRate& rate) {
    body.start_position = body.position;
    body.start_orientation = body.orientation;
    const auto along = [&](std::int64_t a, std::int64_t b) {
        return interpolate_position(a, b, substep, substeps);
    };
    const Vec3& a = body.tick_position;
    const Vec3& b = body.target_position;
    body.position = {along(a.x, b.x), along(a.y, b.y), along(a.z, b.z)};
    if (!(body.tick_orientation == body.target_orientation)) {
        body.orientation = widen(fixed::interpolate(narrow(body.tick_orientation),
                                                    narrow(body.target_orientation), substep, substeps));
        if (substep == substeps) {
            body.orientation = body.target_orientation;
        }
        body.follow_orientation();
    }
    body.predicted_position = body.position;
    body.predicted_orientation = body.orientation;
    body.velocity = velocity_between(body.start_position, body.position, rate);
    body.angular_velocity = to_spin(half_turn_between(body.start_orientation, body.orientation), rate);
    clamp_vector(body.velocity, rate.speed_limit);
    clamp_vector(body.angular_velocity, rate.spin_limit);
}

void limit_speeds(Body& body, const MotionRate& rate, std::uint64_t& speed_clamps) {
    speed_clamps += clamp_vector(body.velocity, rate.speed_limit) ? 1u : 0u;
    speed_clamps += clamp_vector(body.angular_velocity, rate.spin_limit) ? 1u : 0u;
}

void finish_body(Body& body, const BodyDescription& description, const MotionRate& rate,
                 std::uint64_t& speed_clamps) {
    clamp_vector(body.position, world_position_limit);
    body.velocity =
        saturating_add(body.velocity, velocity_between(body.predicted_position, body.position, rate));
    speed_clamps += clamp_vector(body.velocity, rate.speed_limit) ? 1u : 0u;
    if (!(body.orientation == body.predicted_orientation)) {
        body.orientation = normalise(body.orientation);
        body.follow_orientation();
        body.angular_velocity = to_spin(half_turn_between(body.start_orientation, body.orientation), rate);
        speed_clamps += clamp_vector(body.angular_velocity, rate.spin_limit) ? 1u : 0u;
        body.angular_velocity = moved_spin_at_end(body, description, rate);
    } else {
        body.angular_velocity = free_spin_at_end(body.angular_velocity, body.rotation, description, rate);
    }
    speed_clamps += limit_free_spin(body.angular_velocity, rate) ? 1u : 0u;
}

} // namespace lks
