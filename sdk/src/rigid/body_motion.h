// How a body moves by itself: the prediction at the start of a substep, and the velocities at its end.
//
// Where no constraint has moved a body its velocities are what they were predicted to be, to the bit. Its
// spin follows the implicit midpoint rule (rigid/free_spin.h).
#pragma once

#include <algorithm>

#include "rigid/body.h"
#include "solver/step_rate.h"

namespace lks {

// What is the same for all bodies in a tick.
struct MotionRate {
    explicit MotionRate(const StepRate& rate);

    std::int64_t substeps_per_second; // n = 1/h
    std::int64_t half_turn_factor;    // 2^59 / n: World rad/s to Turn half turns, with 40 bits more
    std::int64_t speed_limit;         // World, m/s an axis
    std::int64_t spin_limit;          // World, rad/s an axis
    std::int64_t greatest_recovery;   // of particles inside of a body: as StepRate has it
};

// World: the lower of 1000 m/s and 16 m a substep; the lower of 1000 rad/s and one rad a substep.
std::int64_t body_speed_limit(const StepRate& rate);
std::int64_t body_spin_limit(const StepRate& rate);

// Of one body in one tick.
struct BodyTick {
    fixed::Vec3 gravity_step;  // World: the velocity that gravity adds in a substep
    std::uint32_t linear_kept; // Unit: what damping leaves in a substep
    std::uint32_t angular_kept;
};

BodyTick make_body_tick(const BodyDescription& description, const StepRate& rate, const fixed::Vec3& gravity);

// Dynamic bodies: start of a substep. Clamped speeds are counted.
void predict_body(Body& body, const BodyDescription& description, const BodyTick& tick,
                  const MotionRate& rate, std::uint64_t& speed_clamps);
// Kinematic bodies, at the start of a tick: as fast as it takes them to their target.
void aim_kinematic(Body& body, const MotionRate& rate, std::uint32_t substeps);
// Kinematic bodies: to where they are at the end of this substep, 1 .. substeps.
void place_kinematic(Body& body, std::uint32_t substep, std::uint32_t substeps, const MotionRate& rate);
// End of a substep.
void finish_body(Body& body, const BodyDescription& description, const MotionRate& rate,
                 std::uint64_t& speed_clamps);

// Velocity and spin within their limits; what was not is counted.
void limit_speeds(Body& body, const MotionRate& rate, std::uint64_t& speed_clamps);

// How fast any point within `radius` of the centre of mass may be, World m/s; generous: by the spin alone,
// and altogether.
std::int64_t spin_speed(const fixed::Vec3& spin, std::int64_t radius);
std::int64_t greatest_speed(const Speeds& speeds, std::int64_t radius);
inline std::int64_t greatest_speed(const Body& body, std::int64_t radius) {
    return greatest_speed(body.speeds(), radius);
}

// World rad/s to the half turn of a substep, Turn, and back.
fixed::Vec3 to_half_turn(const fixed::Vec3& spin, const MotionRate& rate);
fixed::Vec3 to_spin(const fixed::Vec3& half_turn, const MotionRate& rate);

// Of a body's point at a lever from its centre of mass, World m/s; by the spin within a million m/s an axis.
inline fixed::Vec3 velocity_at(const Speeds& speeds, const fixed::Vec3& lever) {
    // Spins to 22 bits behind the point and levers to 24: far out on a plane they are very long.
    const auto m = [](std::int64_t spin, std::int64_t arm) {
        constexpr std::int64_t most = std::int64_t{1} << (world_fraction_bits + 19);
        return std::clamp(fixed::saturate_to_int64(fixed::multiply_signed(spin >> 18, arm >> 16) >> 6), -most,
                          most);
    };
    const fixed::Vec3& w = speeds.spin;
    return speeds.velocity + fixed::Vec3{m(w.y, lever.z) - m(w.z, lever.y), m(w.z, lever.x) - m(w.x, lever.z),
                                         m(w.x, lever.y) - m(w.y, lever.x)};
}

inline fixed::Vec3 velocity_at(const Body& body, const fixed::Vec3& lever) {
    return velocity_at(body.speeds(), lever);
}

// Each axis within ±limit; true where one was not.
inline bool clamp_vector(fixed::Vec3& value, std::int64_t limit) {
    const fixed::Vec3 before = value;
    value = {std::clamp(value.x, -limit, limit), std::clamp(value.y, -limit, limit),
             std::clamp(value.z, -limit, limit)};
    return !(value == before);
}

} // namespace lks
