// Prediction in plain integers: the specification of what every kernel computes (solver/prediction.h).
#pragma once

#include <algorithm>

#include "fixed/formats.h"
#include "kernels/force_inline.h"
#include "kernels/prediction_task.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

// One axis of one object of a task.
struct PredictionAxis {
    std::int64_t* x;
    std::int64_t* start; // where the particles were at the start of the substep before
    std::int64_t acceleration;
};

template <typename Use>
inline void for_each_axis(const PredictionTask& task, const Use& use) {
    constexpr std::size_t axes = 3;
    for (std::uint32_t object = 0; object < task.object_count; ++object) {
        std::int64_t* const x = task.x + (task.objects == nullptr ? 0 : task.objects[object]);
        for (std::size_t i = 0; i < axes; ++i) {
            use(PredictionAxis{x + i * task.axis_stride, x + (i + axes) * task.axis_stride,
                               task.accelerations[i]});
        }
    }
}

// motion · kept, rounded half up; split, as the whole product needs 92 bits.
inline std::int64_t damp(std::int64_t motion, std::uint32_t kept) {
    const std::int64_t high = motion >> unit_fraction_bits;
    const std::int64_t low = motion & static_cast<std::int64_t>(unit_one - 1);
    const auto share = static_cast<std::int64_t>(kept);
    return high * share + ((low * share + (unit_one >> 1)) >> unit_fraction_bits);
}

template <bool damped>
LKS_SHORT_LOOPS void predict_in_turn(const PredictionTask& task, const PredictionAxis& axis,
                                     std::size_t first, std::size_t last, PredictionClamps& clamps) {
    const std::int64_t limit = task.motion_limit;
    LKS_SHORT_LOOP
    for (std::size_t i = first; i < last; ++i) {
        const std::int64_t x = axis.x[i];
        std::int64_t motion = wrapping_subtract(x, axis.start[i]);
        if constexpr (damped) {
            motion = damp(motion, task.kept);
        }
        // Clamped before the sum too, which then has room.
        const std::int64_t inertial = std::clamp(motion, -limit, limit);
        const std::int64_t accelerated = inertial + axis.acceleration;
        const std::int64_t limited = std::clamp(accelerated, -limit, limit);
        clamps.speeds += static_cast<std::uint64_t>(inertial != motion || limited != accelerated);
        const std::int64_t here = std::clamp(x, -coordinate_limit, coordinate_limit);
        axis.start[i] = here;
        const std::int64_t predicted = std::clamp(here + limited, -coordinate_limit, coordinate_limit);
        clamps.positions += static_cast<std::uint64_t>(here != x || predicted != here + limited);
        axis.x[i] = predicted;
    }
}

} // namespace
} // namespace lks
