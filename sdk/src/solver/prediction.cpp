#include "solver/prediction.h"

#include <algorithm>

#include "solver/wrapping.h"

namespace lks {

PredictionTask make_prediction(const StepRate& rate, const fixed::Vec3& gravity, Object& object) {
    const std::int64_t limit = rate.motion_limit;
    const auto motion = [&](std::int64_t acceleration) {
        return std::clamp(motion_from_acceleration(rate, acceleration, object.gravity_factor), -limit, limit);
    };
    return {object.axis(0),
            object.axis_stride(),
            object.count(),
            nullptr,
            1,
            kept_share(rate, object.linear_damping),
            {motion(gravity.x), motion(gravity.y), motion(gravity.z)},
            limit};
}

bool moves_alike(const PredictionTask& a, const PredictionTask& b) {
    return a.kept == b.kept && std::equal(a.accelerations, a.accelerations + 3, b.accelerations);
}

bool set_motion(std::int64_t x, std::int64_t& start, std::int64_t motion, std::int64_t motion_limit) {
    const std::int64_t limited = std::clamp(motion, -motion_limit, motion_limit);
    start = wrapping_subtract(x, limited);
    return limited != motion;
}

} // namespace lks
