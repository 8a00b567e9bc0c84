// Time and motion in integers, for the inputs of a tick: the same on every machine.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>

namespace lks_demo {

constexpr lks_fixed millimetres(std::int64_t n) {
    return LKS_FIXED_RATIO(n, 1000);
}

constexpr lks_vec3 millimetres(std::int64_t x, std::int64_t y, std::int64_t z) {
    return {millimetres(x), millimetres(y), millimetres(z)};
}

// Seconds from the start at which a tick begins; no drift, whatever the rate.
lks_fixed seconds_at(std::uint64_t tick, std::uint32_t tick_rate_hz);

// The product, to 20 fraction bits; |a · b| < 2^23. Fine enough for inputs, and never out of 64 bits.
constexpr lks_fixed coarse_product(lks_fixed a, lks_fixed b) {
    return (a >> 20) * (b >> 20);
}

// 0 before `start`, 1 after `start + duration`, 3u² - 2u³ between.
lks_fixed smooth_step(lks_fixed seconds, lks_fixed start, lks_fixed duration);

// a at share 0, b at share 1.
lks_fixed mix(lks_fixed a, lks_fixed b, lks_fixed share);

// The sine of so many whole turns, whatever their number.
lks_fixed sine_of_turns(lks_fixed turns);

// A rotation of so many whole turns about an axis.
lks_rotation turn_about(lks_vec3 axis, lks_fixed turns);

// First b, then a.
lks_rotation product(lks_rotation a, lks_rotation b);

} // namespace lks_demo
