#include "rigid/body_motion.h"

#include <algorithm>
#include <bit>

#include "collide/collider_motion.h"
#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/pair.h"

namespace lks {
namespace {

using fixed::Vec3;

// a / n to the nearest, ties away from zero.
std::int64_t divide_rounded(std::int64_t a, std::int64_t n) {
    return (a >= 0 ? a + n / 2 : a - n / 2) / n;
}

Vec3 to_spin(const Vec3& half_turn, const MotionRate& rate) {
    const auto part = [&](std::int64_t c) { return fixed::multiply_shift(c, rate.substeps_per_second, 19); };
    return {part(half_turn.x), part(half_turn.y), part(half_turn.z)};
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

// One factor in Turn format, the other and the result in any.
Vec3 cross_turn(const Vec3& a, const Vec3& b) {
    const auto m = multiply_turn;
    return {m(a.y, b.z) - m(a.z, b.y), m(a.z, b.x) - m(a.x, b.z), m(a.x, b.y) - m(a.y, b.x)};
}

std::int64_t greatest(const Vec3& v) {
    const auto size = [](std::int64_t c) { return c < 0 ? -c : c; };
    return std::max({size(v.x), size(v.y), size(v.z)});
}

// A milliradian a second changes nothing in an hour.
bool is_slow(const Vec3& spin) {
    return greatest(spin) < std::int64_t{1} << (world_fraction_bits - 10);
}

// I⁻¹(IΩ × hΩ/2), in body axes. Zero where it would be more than a quarter of Ω: half a substep is then too
// long to follow the motion, and would add energy. One of the two Ω has as many more bits as there is room
// for: of a slender body about its axis, or a slow one, next to nothing would be left in 2^-40.
Vec3 gyroscopic_change(const BodyDescription& body, const Vec3& spin, const MotionRate& rate) {
    const int up = std::max(std::countl_zero(static_cast<std::uint64_t>(greatest(spin))) - 6, 0);
    const std::int64_t lift = std::int64_t{1} << up;
    const Vec3 lifted{spin.x * lift, spin.y * lift, spin.z * lift};
    const Vec3 torque = cross_turn(multiply(body.properties.inertia, lifted), to_half_turn(spin, rate));
    const Vec3 change = multiply(body.properties.inverse_inertia, torque);
    const int shift = body.properties.inverse_shift - up;
    if (shifted(greatest(change), shift) > greatest(spin) >> 2) {
        return {0, 0, 0};
    }
    return {shifted(change.x, shift), shifted(change.y, shift), shifted(change.z, shift)};
}

// Ω_mid − Ω in world axes, by iterating on Ω_mid.
Vec3 change_to_middle(const Body& body, const BodyDescription& description, const MotionRate& rate) {
    constexpr int most_iterations = 10;
    const Vec3 spin = fixed::rotate_transposed(body.rotation, body.angular_velocity);
    // Nothing is left of it after an hour's substeps.
    const std::int64_t enough = (greatest(spin) >> 36) + 2;
    Vec3 change{0, 0, 0};
    for (int i = 0; i < most_iterations; ++i) {
        const Vec3 next = gyroscopic_change(description, spin + change, rate);
        const bool settled = greatest(next - change) <= enough;
        change = next;
        if (settled) {
            break;
        }
    }
    return fixed::rotate(body.rotation, change);
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
    if (!description.properties.round && !is_slow(body.angular_velocity)) {
        body.angular_velocity = body.angular_velocity + change_to_middle(body, description, rate);
    }
    limit_speeds(body, rate, speed_clamps);
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
    }
    if (!description.properties.round && !is_slow(body.angular_velocity)) {
        // From the middle of the substep to its end. Of what is left 2^-33 is lost, more than all roundings
        // could add.
        const Vec3 spin = fixed::rotate_transposed(body.rotation, body.angular_velocity);
        const Vec3 change = gyroscopic_change(description, spin, rate);
        const Vec3& w = body.angular_velocity;
        body.angular_velocity =
            w + fixed::rotate(body.rotation, change) - Vec3{w.x >> 33, w.y >> 33, w.z >> 33};
    }
}

Vec3 predicted_own_momentum(const Body& body, const BodyDescription& description, const MotionRate& rate) {
    const fixed::Matrix3 rotation = fixed::to_matrix(narrow(body.predicted_orientation));
    const Vec3 spin = fixed::rotate_transposed(rotation, body.predicted_spin);
    const Vec3 middle = multiply(description.properties.inertia, spin);
    const bool constant = description.properties.round || is_slow(body.predicted_spin);
    const Vec3 end = constant ? middle : middle + cross_turn(middle, to_half_turn(spin, rate));
    return fixed::rotate(rotation, end);
}

} // namespace lks
