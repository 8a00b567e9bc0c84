// Sine and cosine in integers, and the rotation about an axis.
//
// An angle is reduced exactly (degrees make a quarter turn an integer), folded to 0..45 degrees, turned into
// radians once, and summed by Taylor's series in Q2.62. Multiples of 90 degrees are exact.
#pragma once

#include "fixed/rotation.h"

namespace lks::fixed {

struct SineCosine {
    std::int64_t sine; // Q2.62
    std::int64_t cosine;
};

namespace detail {

// a * b in Q62, both in [0, 1].
constexpr std::int64_t multiply_q62(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(shift_right_rounded(multiply_signed(a, b), 62).lo);
}

// 1 - z/(n(n+1)) * (1 - z/((n+2)(n+3)) * (...)): sin(x)/x for n = 2 and cos(x) for n = 1 with z = x^2. Ten
// terms leave less than 2^-75 for x <= pi/4.
constexpr std::int64_t alternating_series(std::int64_t z, std::int64_t n) {
    constexpr std::int64_t one = std::int64_t{1} << 62;
    std::int64_t sum = one;
    for (std::int64_t k = n + 18; k >= n; k -= 2)
        sum = one - multiply_q62(z, sum) / (k * (k + 1));
    return sum;
}

} // namespace detail

// `degrees` with that many fraction bits, 8 to 53. Worst error of either: 2^-60.
constexpr SineCosine sine_cosine(std::int64_t degrees, int fraction_bits) {
    constexpr std::int64_t one = std::int64_t{1} << 62;
    constexpr std::uint64_t radians_per_degree = 10302605451487463598u; // pi / 180 in Q69
    const std::int64_t quarter = std::int64_t{90} << fraction_bits;
    std::int64_t rest = degrees % (4 * quarter);
    if (rest < 0)
        rest += 4 * quarter;
    const int quadrant = static_cast<int>(rest / quarter);
    std::int64_t angle = rest % quarter;
    const bool folded = angle > quarter / 2;
    if (folded)
        angle = quarter - angle;

    const UInt128 wide = multiply_unsigned(static_cast<std::uint64_t>(angle), radians_per_degree);
    const std::int64_t x = static_cast<std::int64_t>(shift_right_rounded(wide, fraction_bits + 7).lo);
    const std::int64_t z = detail::multiply_q62(x, x);
    std::int64_t sine = detail::multiply_q62(x, detail::alternating_series(z, 2));
    std::int64_t cosine = angle == 0 ? one : detail::alternating_series(z, 1);
    if (folded) {
        const std::int64_t other = sine;
        sine = cosine;
        cosine = other;
    }
    switch (quadrant) {
    case 0:
        return {sine, cosine};
    case 1:
        return {cosine, -sine};
    case 2:
        return {-sine, -cosine};
    default:
        return {-cosine, sine};
    }
}

// `degrees` (Q.40) about an axis of any length, right-handed. False for a zero axis. Any angle. Error of
// each component: 0.5 + 2^-27 units of 2^-30.
constexpr bool rotation_about_axis(Vec3 axis, std::int64_t degrees, Rotation& out) {
    UnitVector4 unit{};
    if (!normalise_wide({axis.x, axis.y, axis.z, 0}, unit))
        return false;
    const SineCosine half = sine_cosine(degrees, 41); // one more fraction bit: half the angle
    const auto product = [half](std::int64_t c) {
        return static_cast<std::int64_t>(shift_right_rounded(multiply_signed(c, half.sine), 62).lo);
    };
    out = {round_component(product(unit.component[0])), round_component(product(unit.component[1])),
           round_component(product(unit.component[2])), round_component(half.cosine)};
    return true;
}

} // namespace lks::fixed
