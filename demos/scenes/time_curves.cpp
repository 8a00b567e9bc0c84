#include "scenes/time_curves.h"

namespace lks_demo {
namespace {

// A whole number of turns changes nothing; the library takes up to a hundred of them.
lks_fixed degrees_of(lks_fixed turns) {
    return (turns & (LKS_FIXED_ONE - 1)) * 360;
}

} // namespace

lks_fixed seconds_at(std::uint64_t tick, std::uint32_t tick_rate_hz) {
    const std::uint64_t whole = tick / tick_rate_hz;
    const std::uint64_t rest = tick % tick_rate_hz;
    return static_cast<lks_fixed>(whole) * LKS_FIXED_ONE +
           LKS_FIXED_RATIO(static_cast<lks_fixed>(rest), static_cast<lks_fixed>(tick_rate_hz));
}

lks_fixed smooth_step(lks_fixed seconds, lks_fixed start, lks_fixed duration) {
    if (seconds <= start) {
        return 0;
    }
    if (seconds >= start + duration) {
        return LKS_FIXED_ONE;
    }
    const lks_fixed u = (((seconds - start) >> 20 << 20) / (duration >> 20)) << 20;
    return coarse_product(coarse_product(u, u), LKS_FIXED(3) - 2 * u);
}

lks_fixed mix(lks_fixed a, lks_fixed b, lks_fixed share) {
    return a + coarse_product(b - a, share);
}

lks_fixed sine_of_turns(lks_fixed turns) {
    lks_fixed sine = 0;
    lks_fixed cosine = 0;
    lks_sin_cos(degrees_of(turns), &sine, &cosine);
    return sine;
}

lks_rotation turn_about(lks_vec3 axis, lks_fixed turns) {
    lks_rotation rotation = {0, 0, 0, LKS_ROTATION_ONE};
    lks_rotation_from_axis_angle_fixed(axis, degrees_of(turns), &rotation);
    return rotation;
}

lks_rotation product(lks_rotation a, lks_rotation b) {
    const auto sum = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
        return static_cast<std::int32_t>((p + q + r + s) >> 30);
    };
    const std::int64_t ax = a.x, ay = a.y, az = a.z, aw = a.w;
    const std::int64_t bx = b.x, by = b.y, bz = b.z, bw = b.w;
    return {sum(aw * bx, ax * bw, ay * bz, -az * by), sum(aw * by, -ax * bz, ay * bw, az * bx),
            sum(aw * bz, ax * by, -ay * bx, az * bw), sum(aw * bw, -ax * bx, -ay * by, -az * bz)};
}

} // namespace lks_demo
