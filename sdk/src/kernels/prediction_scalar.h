// Prediction in plain integers: the specification of what every kernel computes (solver/prediction.h).
#pragma once

#include <algorithm>

#include "fixed/formats.h"
#include "kernels/force_inline.h"
#include "kernels/prediction_task.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

// motion · kept, rounded half up; split, as the whole product needs 92 bits.
inline std::int64_t damp(std::int64_t motion, std::uint32_t kept) {
    const std::int64_t high = motion >> unit_fraction_bits;
    const std::int64_t low = motion & static_cast<std::int64_t>(unit_one - 1);
    const auto share = static_cast<std::int64_t>(kept);
    return high * share + ((low * share + (unit_one >> 1)) >> unit_fraction_bits);
}

template <bool damped>
LKS_SHORT_LOOPS void predict_in_turn(const PredictionTask& task, std::size_t first, std::size_t last,
                                     PredictionClamps& clamps) {
    const std::int64_t limit = task.motion_limit;
    LKS_SHORT_LOOP
    for (std::size_t i = first; i < last; ++i) {
        const std::int64_t x = task.x[i];
        std::int64_t motion = wrapping_subtract(x, task.start[i]);
        if constexpr (damped) {
            motion = damp(motion, task.kept);
        }
        // Clamped before the sum too, which then has room.
        const std::int64_t inertial = std::clamp(motion, -limit, limit);
        const std::int64_t accelerated = inertial + task.acceleration_motion;
        const std::int64_t limited = std::clamp(accelerated, -limit, limit);
        clamps.speeds += static_cast<std::uint64_t>(inertial != motion || limited != accelerated);
        const std::int64_t here = std::clamp(x, -coordinate_limit, coordinate_limit);
        task.start[i] = here;
        const std::int64_t predicted = std::clamp(here + limited, -coordinate_limit, coordinate_limit);
        clamps.positions += static_cast<std::uint64_t>(here != x || predicted != here + limited);
        task.x[i] = predicted;
    }
}

inline PredictionClamps predict_scalar(const PredictionTask& task) {
    PredictionClamps clamps;
    if (task.kept == unit_one) {
        predict_in_turn<false>(task, 0, task.count, clamps);
    } else {
        predict_in_turn<true>(task, 0, task.count, clamps);
    }
    return clamps;
}

} // namespace
} // namespace lks
