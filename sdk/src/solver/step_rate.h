// The length of a substep, and the conversions between the API's values per second and the solver's per
// substep.
#pragma once

#include <cstdint>

#include "fixed/int128.h"
#include "fixed/scaled.h"

namespace lks {

// h = 1 / substeps_per_second.
struct StepRate {
    std::uint32_t ticks_per_second = 0;
    std::uint32_t substeps = 0;
    std::uint32_t iterations = 0;
    std::uint64_t substeps_per_second = 0;
    // Coordinate units an axis moves at most in one substep: 1000 m/s or 16 m, whichever is less.
    std::int64_t motion_limit = 0;
    // How much of an old overlap with a collider is undone in one substep: 3 m/s.
    std::int64_t greatest_recovery = 0;

    fixed::Scaled inverse_h() const { return fixed::Scaled::from_u64(substeps_per_second); }
};

StepRate make_step_rate(std::uint32_t ticks_per_second, std::uint32_t substeps, std::uint32_t iterations);

// World m/s to Coordinate metres a substep, nearest, ties away from zero; not clamped, saturates at int64.
std::int64_t motion_from_velocity(const StepRate& rate, std::int64_t velocity);
// The inverse, to the nearest World unit.
std::int64_t velocity_from_motion(const StepRate& rate, std::int64_t motion);
// World m/s² times a World factor to the Coordinate metres by which a substep's prediction moves: a·h².
std::int64_t motion_from_acceleration(const StepRate& rate, std::int64_t acceleration, std::int64_t factor);
// World N·s on a particle of inverse mass w: J·w·h.
std::int64_t motion_from_impulse(const StepRate& rate, std::int64_t impulse,
                                 const fixed::Scaled& inverse_mass);
// 1 - damping·h in Unit format, not below zero.
std::uint32_t kept_share(const StepRate& rate, std::int64_t damping);

} // namespace lks
