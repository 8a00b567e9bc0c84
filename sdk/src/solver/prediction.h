// Prediction of a substep: x̃ = x + v + a·h² (XPBD algorithm 1), for one object.
//
// The velocity is not stored: it is the difference x − start of the substep before, in metres a substep, and
// exact.
#pragma once

#include <cstdint>

#include "fixed/vector.h"
#include "kernels/prediction_task.h"
#include "solver/object.h"
#include "solver/step_rate.h"

namespace lks {

// What a substep does to all particles of an object: adds the velocity, damped, and gravity's a·h², each
// within the motion limit, and keeps the position within the object's range.
PredictionTask make_prediction(const StepRate& rate, const fixed::Vec3& gravity, Object& object);

// Whether both add the same to motions, and keep the same of them.
bool moves_alike(const PredictionTask& a, const PredictionTask& b);

// Sets the velocity of one axis of one particle: x stays, the start moves. True where the limit clamped it.
bool set_motion(std::int64_t x, std::int64_t& start, std::int64_t motion, std::int64_t motion_limit);

} // namespace lks
