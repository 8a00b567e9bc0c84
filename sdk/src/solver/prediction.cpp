#include "solver/prediction.h"

#include <algorithm>

#include "solver/wrapping.h"

namespace lks {

void predict_axis(std::int64_t* x, std::int64_t* start, std::size_t count, std::int64_t acceleration_motion,
                  std::uint32_t kept, std::int64_t motion_limit, const Kernels& kernels,
                  PredictionClamps& clamps) {
    const std::int64_t acceleration = std::clamp(acceleration_motion, -motion_limit, motion_limit);
    const PredictionClamps more =
        kernels.predict(PredictionTask{x, start, count, acceleration, kept, motion_limit});
    clamps.positions += more.positions;
    clamps.speeds += more.speeds;
}

bool set_motion(std::int64_t x, std::int64_t& start, std::int64_t motion, std::int64_t motion_limit) {
    const std::int64_t limited = std::clamp(motion, -motion_limit, motion_limit);
    start = wrapping_subtract(x, limited);
    return limited != motion;
}

} // namespace lks
