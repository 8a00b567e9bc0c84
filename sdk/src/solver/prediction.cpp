#include "solver/prediction.h"

#include <algorithm>

#include "fixed/formats.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

// motion · kept, rounded half up; split, as the whole product needs 92 bits.
std::int64_t damp(std::int64_t motion, std::uint32_t kept) {
    const std::int64_t high = motion >> unit_fraction_bits;
    const std::int64_t low = motion & static_cast<std::int64_t>(unit_one - 1);
    const auto share = static_cast<std::int64_t>(kept);
    return high * share + ((low * share + (unit_one >> 1)) >> unit_fraction_bits);
}

template <bool damped>
void predict(std::int64_t* x, std::int64_t* start, std::size_t count, std::int64_t acceleration_motion,
             std::uint32_t kept, std::int64_t motion_limit, PredictionClamps& clamps) {
    std::uint64_t speeds = 0;
    std::uint64_t positions = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::int64_t motion = wrapping_subtract(x[i], start[i]);
        if constexpr (damped) {
            motion = damp(motion, kept);
        }
        // Clamped before the sum too, which then has room.
        const std::int64_t inertial = std::clamp(motion, -motion_limit, motion_limit);
        const std::int64_t limited = std::clamp(inertial + acceleration_motion, -motion_limit, motion_limit);
        speeds += static_cast<std::uint64_t>(inertial != motion || limited != inertial + acceleration_motion);
        const std::int64_t here = std::clamp(x[i], -coordinate_limit, coordinate_limit);
        start[i] = here;
        const std::int64_t predicted = std::clamp(here + limited, -coordinate_limit, coordinate_limit);
        positions += static_cast<std::uint64_t>(here != x[i] || predicted != here + limited);
        x[i] = predicted;
    }
    clamps.speeds += speeds;
    clamps.positions += positions;
}

} // namespace

void predict_axis(std::int64_t* x, std::int64_t* start, std::size_t count, std::int64_t acceleration_motion,
                  std::uint32_t kept, std::int64_t motion_limit, PredictionClamps& clamps) {
    const std::int64_t acceleration = std::clamp(acceleration_motion, -motion_limit, motion_limit);
    if (kept == unit_one) {
        predict<false>(x, start, count, acceleration, kept, motion_limit, clamps);
    } else {
        predict<true>(x, start, count, acceleration, kept, motion_limit, clamps);
    }
}

bool set_motion(std::int64_t x, std::int64_t& start, std::int64_t motion, std::int64_t motion_limit) {
    const std::int64_t limited = std::clamp(motion, -motion_limit, motion_limit);
    start = wrapping_subtract(x, limited);
    return limited != motion;
}

} // namespace lks
