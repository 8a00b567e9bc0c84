// authoring.h: doubles into fixed-point, exactly rounded; what is refused; and no dependence on the rounding
// mode.
#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "api/authoring_number.h"
#include "big_integer.h"
#include "fixed_samples.h"
#include "lockstitch/authoring.h"

using lks::test::Big;
using lks::test::Random;
using lks::test::Tally;

namespace {

constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

double double_of(std::uint64_t bits) {
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
}

// The nearest integer to |value| * 2^fraction_bits, halves up, from the bits of the double by shifts alone.
Big<40> nearest(double value, int fraction_bits) {
    const std::uint64_t bits = lks::bits_of(value);
    const std::uint64_t fraction = bits & 0xfffffffffffffu;
    const int biased = static_cast<int>((bits >> 52) & 0x7ff);
    const std::uint64_t whole = biased == 0 ? fraction : fraction | 0x10000000000000u;
    const int shift = (biased == 0 ? 1 : biased) - 1075 + fraction_bits;
    if (shift < -100)
        return {};
    const Big<40> wide = Big<40>::from_u64(whole);
    return shift >= 0 ? wide << shift : shift_right_half_up(wide, -shift);
}

double any_double(Random& random) {
    const std::uint64_t bits = random.bits();
    const std::uint64_t exponent = random.below(4) == 0 ? random.below(2048) : 960 + random.below(100);
    std::uint64_t fraction = bits & 0xfffffffffffffu;
    if (random.below(4) == 0)
        fraction &= ~std::uint64_t{0} << random.below(52); // ties
    return double_of((bits & (std::uint64_t{1} << 63)) | (exponent << 52) | fraction);
}

bool same(lks_rotation a, lks_rotation b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

} // namespace

TEST_CASE("authoring: doubles are rounded to the nearest unit, ties away from zero") {
    Tally tally;
    Random random(71);
    const auto check = [&tally](double value, int fraction_bits) {
        std::int64_t raw = 77;
        const bool done = lks::to_coordinate(value, fraction_bits, raw);
        const std::uint64_t where = lks::bits_of(value);
        if (!std::isfinite(value)) {
            tally.expect(!done && raw == 77, where);
            return;
        }
        const Big<40> expected = nearest(value, fraction_bits);
        const bool fits = expected <= Big<40>::from_i64(INT64_MAX);
        tally.expect(done == fits, where, static_cast<std::uint64_t>(fraction_bits));
        if (!fits)
            tally.expect(raw == 77, where);
        if (fits)
            tally.expect(Big<40>::from_i64(raw) == (std::signbit(value) ? -expected : expected), where);
    };
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        check(any_double(random), (i & 1) != 0 ? 40 : 56);
    }
    for (const double value :
         {0.0, -0.0, 9.81, -9.81, 0x1p-41, -0x1p-41, 0x1.fffffffffffffp-42, 0x1.8p-40, 0x1p-57, 4.9e-324,
          0x1p23, -0x1p23, 0x1.fffffffffffffp22, 0x1p7, 1e300, quiet_nan, infinity, -infinity}) {
        check(value, 40);
        check(value, 56);
    }
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("authoring: lks_fixed_from_double") {
    lks_fixed out = 5;
    CHECK(lks_fixed_from_double(0.05, &out) == LKS_OK);
    CHECK(out == 54975581389); // 0.05 * 2^40 = 54975581388.8
    CHECK(lks_fixed_from_double(-0.05, &out) == LKS_OK);
    CHECK(out == -54975581389);
    CHECK(lks_fixed_from_double(0x1p-41, &out) == LKS_OK);
    CHECK(out == 1);
    CHECK(lks_fixed_from_double(-0x1p-41, &out) == LKS_OK);
    CHECK(out == -1);
    CHECK(lks_fixed_from_double(-0.0, &out) == LKS_OK);
    CHECK(out == 0);
    CHECK(lks_fixed_from_double(8388607.0, &out) == LKS_OK);
    CHECK(out == LKS_FIXED(8388607));
    CHECK(lks_fixed_from_double(-8388607.0, &out) == LKS_OK);
    CHECK(out == LKS_FIXED(-8388607));
    out = 5;
    for (const double bad : {std::nextafter(8388607.0, 1e9), -std::nextafter(8388607.0, 1e9), 1e300,
                             quiet_nan, -quiet_nan, infinity, -infinity}) {
        CHECK(lks_fixed_from_double(bad, &out) == LKS_ERROR_INVALID_ARGUMENT);
        CHECK(out == 5);
    }
    CHECK(lks_fixed_from_double(1.0, nullptr) == LKS_ERROR_NULL_ARGUMENT);
}

TEST_CASE("authoring: vectors are taken whole or not at all") {
    lks_vec3 out{1, 2, 3};
    CHECK(lks_vec3_from_doubles(1.0, quiet_nan, 2.0, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_vec3_from_doubles(1.0, 2.0, 9e6, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK((out.x == 1 && out.y == 2 && out.z == 3));
    CHECK(lks_vec3_from_doubles(1.0, -2.0, 0.5, &out) == LKS_OK);
    CHECK((out.x == LKS_FIXED(1) && out.y == LKS_FIXED(-2) && out.z == LKS_FIXED_ONE / 2));
    CHECK(lks_vec3_from_doubles(0, 0, 0, nullptr) == LKS_ERROR_NULL_ARGUMENT);
}

TEST_CASE("authoring: classes of doubles") {
    using lks::NumberClass;
    CHECK(lks::classify_double(4.9e-324) == NumberClass::finite);
    CHECK(lks::classify_double(1.7976931348623157e308) == NumberClass::finite);
    CHECK(lks::classify_double(-infinity) == NumberClass::infinite);
    CHECK(lks::classify_double(-quiet_nan) == NumberClass::not_a_number);
    CHECK(lks::classify_double(double_of(std::uint64_t{0x7ff0000000000001})) == NumberClass::not_a_number);
    lks::SignedScaled number;
    CHECK(lks::decode_double(-0.0, number));
    CHECK_FALSE(number.negative);
    CHECK(lks::decode_double(-0.75, number));
    CHECK(number.negative);
    CHECK(number.magnitude == lks::fixed::Scaled::ratio(3, 4));
    CHECK_FALSE(lks::decode_double(quiet_nan, number));
    CHECK(number.magnitude == lks::fixed::Scaled::ratio(3, 4));
}

TEST_CASE("authoring: rotations from an axis and an angle") {
    const std::int32_t root_half = 759250125, half = 1 << 29;
    lks_rotation out{};
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, 90, &out) == LKS_OK);
    CHECK(same(out, {0, root_half, 0, root_half}));
    CHECK(lks_rotation_from_axis_angle(1, 1, 1, 120, &out) == LKS_OK);
    CHECK(same(out, {half, half, half, half}));
    CHECK(lks_rotation_from_axis_angle(0, 0, -3, 180, &out) == LKS_OK);
    CHECK(same(out, {0, 0, -(1 << 30), 0}));
    CHECK(lks_rotation_from_axis_angle(1, 2, 3, 0, &out) == LKS_OK);
    CHECK(same(out, {0, 0, 0, 1 << 30}));

    // The axis' length does not matter, down to subnormals and up to the largest double.
    lks_rotation expected{};
    REQUIRE(lks_rotation_from_axis_angle(0.25, -0.5, 1, 33.3, &expected) == LKS_OK);
    for (const int power : {-1070, -1000, -52, 3, 60, 1000, 1023}) {
        const double unit = std::ldexp(1.0, power);
        CHECK(lks_rotation_from_axis_angle(0.25 * unit, -0.5 * unit, unit, 33.3, &out) == LKS_OK);
        CHECK(same(out, expected));
    }
    CHECK(lks_rotation_from_axis_angle(1e300, 1e-300, 0, 180, &out) == LKS_OK);
    CHECK(same(out, {1 << 30, 0, 0, 0}));

    // The same from fixed-point.
    lks_fixed degrees = 0;
    REQUIRE(lks_fixed_from_double(33.3, &degrees) == LKS_OK);
    CHECK(lks_rotation_from_axis_angle_fixed({1, -2, 4}, degrees, &out) == LKS_OK);
    CHECK(same(out, expected));
    CHECK(lks_rotation_from_axis_angle_fixed({LKS_FIXED(1), LKS_FIXED(-2), LKS_FIXED(4)}, degrees, &out) ==
          LKS_OK);
    CHECK(same(out, expected));
    CHECK(lks_rotation_from_axis_angle_fixed({INT64_MIN, 0, 0}, LKS_FIXED(180), &out) == LKS_OK);
    CHECK(same(out, {-(1 << 30), 0, 0, 0}));

    const lks_rotation kept = out;
    CHECK(lks_rotation_from_axis_angle(0, 0, 0, 90, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle(0, quiet_nan, 1, 90, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle(infinity, 0, 0, 90, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, quiet_nan, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, 36000.001, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, -36000.001, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle_fixed({0, 0, 0}, 0, &out) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle_fixed({0, 1, 0}, LKS_FIXED(36000) + 1, &out) ==
          LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, 90, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_rotation_from_axis_angle_fixed({0, 1, 0}, 0, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(same(out, kept));
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, 36000, &out) == LKS_OK);
    CHECK(lks_rotation_from_axis_angle(0, 1, 0, -36000, &out) == LKS_OK);
}

TEST_CASE("authoring: the identity transform") {
    const lks_transform t = lks_transform_identity();
    CHECK((t.position.x == 0 && t.position.y == 0 && t.position.z == 0));
    CHECK(same(t.rotation, {0, 0, 0, LKS_ROTATION_ONE}));
}

TEST_CASE("authoring: the rounding mode has no say") {
    Tally tally;
    const int before = std::fegetround();
    Random random(72);
    for (std::uint64_t i = 0; i < lks::test::sample_count() / 100; ++i) {
        const double value = any_double(random), x = any_double(random), y = any_double(random);
        lks_fixed expected = 7;
        lks_rotation expected_rotation{};
        const lks_result result = lks_fixed_from_double(value, &expected);
        const lks_result rotation_result = lks_rotation_from_axis_angle(x, y, 1, value, &expected_rotation);
        for (const int mode : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
            lks_fixed out = 7;
            lks_rotation rotation{};
            std::fesetround(mode);
            const lks_result again = lks_fixed_from_double(value, &out);
            const lks_result rotation_again = lks_rotation_from_axis_angle(x, y, 1, value, &rotation);
            std::fesetround(before);
            tally.expect(again == result && out == expected, lks::bits_of(value));
            tally.expect(rotation_again == rotation_result && same(rotation, expected_rotation),
                         lks::bits_of(value));
        }
    }
    LKS_CHECK_TALLY(tally);
}
