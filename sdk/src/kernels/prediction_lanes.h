// Prediction, 2·L::half particles at a time: kernels/prediction_scalar.h over lanes. Where a lane would be
// clamped, all of its group go the plain way.
#pragma once

#include "kernels/prediction_scalar.h"

namespace lks {
namespace {

template <typename L, bool damped>
class PredictionLanes {
    using R = typename L::Register;

public:
    explicit PredictionLanes(const PredictionTask& task)
        : task_(task), limit_(L::set(task.motion_limit)), twice_limit_(L::set(2 * task.motion_limit)),
          acceleration_(L::set(task.acceleration_motion)), kept_(L::set(task.kept)) {}

    PredictionClamps run() const {
        PredictionClamps clamps;
        constexpr std::size_t lanes = 2 * L::half;
        std::size_t i = 0;
        for (; i + lanes <= task_.count; i += lanes) {
            const Prediction first = predict(i);
            const Prediction second = predict(i + L::half);
            if (L::sign_bits(L::bit_or(first.outside, second.outside)) != 0) {
                predict_in_turn<damped>(task_, i, i + lanes, clamps);
                continue;
            }
            store(i, first);
            store(i + L::half, second);
        }
        predict_in_turn<damped>(task_, i, task_.count, clamps);
        return clamps;
    }

private:
    struct Prediction {
        R start, x;
        R outside; // negative where something would be clamped
    };

    Prediction predict(std::size_t i) const {
        const R x = L::load(task_.x + i);
        R motion = L::subtract(x, L::load(task_.start + i));
        R outside = beyond(motion, limit_, twice_limit_);
        if constexpr (damped) {
            motion = damp_lanes(motion);
        }
        const R accelerated = L::add(motion, acceleration_);
        outside = L::bit_or(outside, beyond(accelerated, limit_, twice_limit_));
        const R edge = L::set(coordinate_limit);
        const R twice_edge = L::set(2 * coordinate_limit);
        const R predicted = L::add(x, accelerated);
        outside =
            L::bit_or(outside, L::bit_or(beyond(x, edge, twice_edge), beyond(predicted, edge, twice_edge)));
        return {x, predicted, outside};
    }

    // Negative where the value, or what it wrapped from, lies outside ±limit.
    static R beyond(R value, R limit, R twice_limit) {
        const R lifted = L::add(value, limit);
        return L::bit_or(lifted, L::subtract(twice_limit, lifted));
    }

    // Within the limit (2^60 at most) the high part has 30 bits, so its sign may be lost above.
    R damp_lanes(R motion) const {
        const R high = L::template shift_right<unit_fraction_bits>(motion);
        const R low = L::bit_and(motion, L::set(unit_one - 1));
        return L::add(L::multiply_signed(high, kept_),
                      L::template shift_right<unit_fraction_bits>(
                          L::add(L::multiply_unsigned(low, kept_), L::set(unit_one >> 1))));
    }

    void store(std::size_t i, const Prediction& prediction) const {
        L::store(task_.start + i, prediction.start);
        L::store(task_.x + i, prediction.x);
    }

    const PredictionTask& task_;
    R limit_;
    R twice_limit_;
    R acceleration_;
    R kept_;
};

template <typename L>
inline PredictionClamps predict_lanes(const PredictionTask& task) {
    return task.kept == unit_one ? PredictionLanes<L, false>(task).run()
                                 : PredictionLanes<L, true>(task).run();
}

} // namespace
} // namespace lks
