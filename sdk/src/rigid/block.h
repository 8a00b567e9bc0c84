// Two points that are brought together in all three directions at once: K·p = −C with the 3×3 matrix
// K = Σ wᵢ(1 − r̂ᵢ Ĵᵢ r̂ᵢ) of rigid/pair.h, and XPBD's compliance and damping for it.
#pragma once

#include "fixed/scaled.h"
#include "rigid/inertia.h"
#include "rigid/pair.h"
#include "solver/step_rate.h"

namespace lks {

// K⁻¹ = matrix · 2^shift
struct BlockInverse {
    SymmetricMatrix matrix;
    std::int32_t shift;
};

// Of a symmetric positive matrix with 30 fraction bits. Where it is too flat to be inverted in 32 bits, that
// of its trace serves, which falls short but never goes too far.
BlockInverse invert_block(const std::int64_t (&k)[6]);
fixed::Vec3 solve(const BlockInverse& inverse, const fixed::Vec3& error);

// XPBD eq. 26 divided by 1 + γ: the shares of the error and of the substep's motion, and α̃ / (1 + γ).
struct Softness {
    std::int64_t softness = 0; // softness_of
    std::int32_t error_share = direction_one;
    std::int32_t motion_share = 0;
};

// What a constraint gives way by counts in the greater inverse mass of its sides, 30 fraction bits. Beyond
// 2^30 it makes no difference any more: a spring of such a softness swings once in 172 s at 1200 substeps a
// second.
inline constexpr std::int64_t greatest_softness = std::int64_t{1} << 60;
std::int64_t softness_of(const fixed::Scaled& value);

// World m/N and N·s/m.
Softness make_softness(std::int64_t compliance, std::int64_t damping,
                       const fixed::Scaled& greater_inverse_mass, const StepRate& rate);
// What a soft constraint leaves to be made up for, within `greatest_left` (World, 32 km), for which `divide`
// has room (rigid/pair.h). Without damping C + α̃·λ:
inline constexpr std::int64_t greatest_left = std::int64_t{1} << (world_fraction_bits + 15);
std::int64_t soften(std::int64_t softness, std::int64_t error, std::int64_t push);
// with damping c·C + α̃/(1+γ)·λ + γ/(1+γ)·Δ.
std::int64_t soften(const Softness& s, std::int64_t error, std::int64_t motion, std::int64_t push);
fixed::Vec3 soften(const Softness& s, const fixed::Vec3& error, const fixed::Vec3& motion,
                   const fixed::Vec3& push);

// How much of that is taken at once: so much that it moves what it pushes as far as a rigid one does. What it
// gives way by is no error, however far that is.
std::int64_t greatest_step_of(const Softness& s);
// What is made up for at once: of a rigid constraint its error, of a soft one what it leaves; within that.
fixed::Vec3 left_of(const Softness& s, const fixed::Vec3& error, const fixed::Vec3& motion,
                    const fixed::Vec3& push);

// The most that the pushes of a tick's substeps may add up to where a force, or torque, that pushes by
// `push_of_one` a substep must not exceed the limit, World; 0: no limit.
std::int64_t greatest_sum(std::int64_t limit, const fixed::Scaled& push_of_one, const StepRate& rate);
// Whether the pushes of a tick's substeps add up to more than that.
bool exceeds(const fixed::Vec3& sum, std::int64_t greatest_sum);
// What such a sum is worth: newtons a metre.
fixed::Scaled force_of_push(const StepRate& rate, const fixed::Scaled& greater_inverse_mass);

// The push that follows `push` where the points are apart by `error`, and by `motion` since the substep
// began.
fixed::Vec3 next_push(const BlockInverse& inverse, const Softness& softness, const fixed::Vec3& error,
                      const fixed::Vec3& motion, const fixed::Vec3& push);

} // namespace lks
