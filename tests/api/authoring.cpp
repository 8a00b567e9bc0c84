// Decimal numbers to fixed-point: the nearest unit for every double, ties away from zero, and what does not
// fit is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/numbers.h"

using namespace support;

TEST_CASE("known decimals have known bits") {
    const struct {
        double value;
        lks_fixed bits;
    } known[] = {{0, 0},
                 {-0.0, 0},
                 {1, LKS_FIXED_ONE},
                 {-1, -LKS_FIXED_ONE},
                 {9.81, 10786209068483},
                 {-0.1, -109951162778},
                 {std::ldexp(1, -40), 1},
                 {std::ldexp(1, -41), 1}, // half a unit: away from zero
                 {-std::ldexp(1, -41), -1},
                 {std::ldexp(3, -41), 2},
                 {std::nextafter(std::ldexp(1, -41), 0), 0}, // just below half
                 {5e-324, 0},
                 {8388607, LKS_FIXED(8388607)},
                 {-8388607, LKS_FIXED(-8388607)}};
    for (const auto& k : known) {
        lks_fixed bits = 77;
        INFO(k.value);
        CHECK(lks_fixed_from_double(k.value, &bits) == LKS_OK);
        CHECK(bits == k.bits);
    }
}

TEST_CASE("what does not fit is refused and leaves the result alone") {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                          -std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::signaling_NaN(),
                          std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(),
                          8388608,
                          -8388608,
                          std::nextafter(8388607.0, 1e9),
                          1e300};
    for (const double value : bad) {
        lks_fixed bits = 77;
        CHECK(lks_fixed_from_double(value, &bits) == LKS_ERROR_INVALID_ARGUMENT);
        CHECK(bits == 77);
        lks_vec3 vec{1, 2, 3};
        CHECK(lks_vec3_from_doubles(value, 0, 0, &vec) == LKS_ERROR_INVALID_ARGUMENT);
        CHECK(lks_vec3_from_doubles(0, value, 0, &vec) == LKS_ERROR_INVALID_ARGUMENT);
        CHECK(lks_vec3_from_doubles(0, 0, value, &vec) == LKS_ERROR_INVALID_ARGUMENT);
        CHECK(same(vec, {1, 2, 3}));
    }
}

TEST_CASE("every fixed-point value of up to 53 bits survives the way to a double and back") {
    Random random(1);
    bool kept = true;
    for (int i = 0; i < 1000000; ++i) {
        const std::int64_t bits =
            random.between(-(std::int64_t{1} << 53), std::int64_t{1} << 53) >> random.between(0, 52);
        lks_fixed back = 0;
        kept = kept && lks_fixed_from_double(lks_fixed_to_double(bits), &back) == LKS_OK && back == bits;
    }
    CHECK(kept);
    // Beyond that, to the nearest double.
    CHECK(lks_fixed_to_double((std::int64_t{1} << 60) + 1) == std::ldexp(1, 20));
    CHECK(lks_fixed_to_double((std::int64_t{1} << 60) + 129) ==
          std::ldexp((std::int64_t{1} << 60) + 256, -40));
    CHECK(lks_fixed_to_double(INT64_MIN) == -std::ldexp(1, 23));
}

TEST_CASE("rotations and sines are refused outside their ranges") {
    lks_rotation rotation{1, 2, 3, 4};
    const double nan_value = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    constexpr lks_result invalid = LKS_ERROR_INVALID_ARGUMENT;
    CHECK(lks_rotation_from_axis_angle(0, 0, 0, 10, &rotation) == invalid);
    CHECK(lks_rotation_from_axis_angle(nan_value, 0, 1, 10, &rotation) == invalid);
    CHECK(lks_rotation_from_axis_angle(0, infinity, 0, 10, &rotation) == invalid);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, nan_value, &rotation) == invalid);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, 36001, &rotation) == invalid);
    CHECK(lks_rotation_from_axis_angle_fixed({0, 0, 0}, 0, &rotation) == invalid);
    CHECK(lks_rotation_from_axis_angle_fixed({1, 0, 0}, LKS_FIXED(36001), &rotation) == invalid);
    CHECK(rotation.w == 4);
    lks_fixed sine = 5, cosine = 6;
    CHECK(lks_sin_cos(LKS_FIXED(-36001), &sine, &cosine) == invalid);
    CHECK(sine == 5);
    CHECK(cosine == 6);
    // An axis of any length, be it one unit.
    CHECK(lks_rotation_from_axis_angle_fixed({0, 0, 1}, LKS_FIXED(90), &rotation) == LKS_OK);
    CHECK(std::abs(rotation.z - std::lround(std::sqrt(0.5) * LKS_ROTATION_ONE)) <= 2);
    CHECK(lks_rotation_from_axis_angle(0, -1e-300, 0, 180, &rotation) == LKS_OK);
    CHECK(std::abs(rotation.y + LKS_ROTATION_ONE) <= 2);
}

TEST_CASE("rotations are within 2 units of 2^-30 and sines within 2^-39 of the exact ones") {
    Random random(2);
    constexpr long double pi = 3.14159265358979323846264338327950288L;
    long double worst_rotation = 0;
    long double worst_sine = 0;
    for (int i = 0; i < 200000; ++i) {
        const lks_fixed degrees = random.between(-LKS_FIXED(36000), LKS_FIXED(36000));
        const long double angle = std::ldexp(static_cast<long double>(degrees), -40) * pi / 180;
        lks_fixed sine = 0, cosine = 0;
        REQUIRE(lks_sin_cos(degrees, &sine, &cosine) == LKS_OK);
        worst_sine =
            std::max({worst_sine, std::abs(std::ldexp(static_cast<long double>(sine), -40) - std::sin(angle)),
                      std::abs(std::ldexp(static_cast<long double>(cosine), -40) - std::cos(angle))});

        const lks_vec3 axis{random.between(-LKS_FIXED(9), LKS_FIXED(9)),
                            random.between(-LKS_FIXED(9), LKS_FIXED(9)),
                            random.between(-LKS_FIXED(9), LKS_FIXED(9))};
        lks_rotation rotation{};
        REQUIRE(lks_rotation_from_axis_angle_fixed(axis, degrees, &rotation) == LKS_OK);
        const long double x = axis.x, y = axis.y, z = axis.z;
        const long double length = std::sqrt(x * x + y * y + z * z);
        const long double s = std::sin(angle / 2);
        long double expected[4] = {s * x / length, s * y / length, s * z / length, std::cos(angle / 2)};
        const std::int32_t found[4] = {rotation.x, rotation.y, rotation.z, rotation.w};
        // q and -q are the same rotation.
        long double dot = 0;
        for (int k = 0; k < 4; ++k) {
            dot += expected[k] * found[k];
        }
        for (int k = 0; k < 4; ++k) {
            const long double wanted = (dot < 0 ? -1 : 1) * expected[k] * LKS_ROTATION_ONE;
            worst_rotation = std::max(worst_rotation, std::abs(found[k] - wanted));
        }
    }
    MESSAGE("worst rotation component: " << static_cast<double>(worst_rotation)
                                         << " units, worst sine or cosine: "
                                         << static_cast<double>(std::ldexp(worst_sine, 40)) << " units");
    CHECK(worst_rotation <= 2);
    CHECK(worst_sine <= std::ldexp(1.0L, -39));
}
