// Prediction of a substep: x̃ = x + v + a·h² (XPBD algorithm 1), for one object.
//
// The velocity is not stored: it is the difference x − start of the substep before, in metres a substep, and
// exact.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/kernels.h"
#include "solver/step_rate.h"

namespace lks {

// One axis of all particles. Adds the velocity, damped to `kept` of itself (Unit), and `acceleration_motion`;
// each within the motion limit, and the position within the object's range.
void predict_axis(std::int64_t* x, std::int64_t* start, std::size_t count, std::int64_t acceleration_motion,
                  std::uint32_t kept, std::int64_t motion_limit, const Kernels& kernels,
                  PredictionClamps& clamps);

// Sets the velocity of one axis of one particle: x stays, the start moves. True where the limit clamped it.
bool set_motion(std::int64_t x, std::int64_t& start, std::int64_t motion, std::int64_t motion_limit);

} // namespace lks
