// Sine and cosine against a reference with 92 fraction bits, and rotations about axes.
#include <doctest/doctest.h>

#include "big_integer.h"
#include "fixed/trigonometry.h"
#include "fixed_samples.h"
#include "fixed_unit_vectors.h"
#include "lockstitch/authoring.h"

using namespace lks::fixed;
using lks::test::Big;
using lks::test::Random;
using lks::test::Tally;

namespace {

constexpr int reference_bits = 92;
using Q92 = Big<6>;

Q92 product(const Q92& a, const Q92& b) {
    return shift_right_half_up(a * b, reference_bits);
}

Q92 quotient(const Q92& a, std::uint32_t n) {
    Q92 r;
    std::uint64_t rest = 0;
    const Q92 size = a.absolute();
    for (int i = 5; i >= 0; --i) {
        rest = (rest << 32) | size.digit[i];
        r.digit[i] = static_cast<std::uint32_t>(rest / n);
        rest %= n;
    }
    return a.negative() ? -r : r;
}

struct Point {
    Q92 sine, cosine;
};

// pi = 3.243f6a8885a308d313198a2e0 in hexadecimal, 92 bits behind the point.
Q92 pi() {
    return (Q92::from_u64(0x3243f6a8885u) << 52) + Q92::from_u64(0xa308d313198a3u);
}

// Taylor's series of |angle| <= 180 degrees without any folding: terms reach 5.2, and their products with the
// angle still fit into 192 bits.
Point reference(std::int64_t degrees, int fraction_bits) {
    const std::int64_t half_turn = std::int64_t{180} << fraction_bits;
    std::int64_t rest = degrees % (2 * half_turn);
    if (rest > half_turn)
        rest -= 2 * half_turn;
    if (rest < -half_turn)
        rest += 2 * half_turn;
    const Q92 x = shift_right_half_up(quotient(Q92::from_i64(rest) * pi(), 180), fraction_bits);
    Point sum;
    Q92 term = Q92::power_of_two(reference_bits);
    for (std::uint32_t n = 0; n < 60; ++n) {
        const bool minus = (n & 2) != 0;
        Q92& target = (n & 1) != 0 ? sum.sine : sum.cosine;
        target = minus ? target - term : target + term;
        term = quotient(product(term, x), n + 1);
    }
    return sum;
}

// The next point of a walk round the circle. Errors of 2^-90 a step add up to less than 2^-66.
Point turned(const Point& p, const Point& step) {
    return {product(p.sine, step.cosine) + product(p.cosine, step.sine),
            product(p.cosine, step.cosine) - product(p.sine, step.sine)};
}

// The difference in units of 2^-fraction_bits.
long double error_in_units(std::int64_t value, int fraction_bits, const Q92& exact) {
    const Q92 difference = (Q92::from_i64(value) << (reference_bits - fraction_bits)) - exact;
    return std::ldexp(difference.approximate(), fraction_bits - reference_bits);
}

// Walks over all angles from -36000 to 36000 degrees that the C API takes, and calls check(degrees,
// reference).
template <typename Check>
void walk(std::uint64_t count, Check check) {
    const std::int64_t range = std::int64_t{72000} << 40;
    const std::int64_t step = range / static_cast<std::int64_t>(count) | 1;
    std::int64_t degrees = -(range / 2);
    const Point step_point = reference(step, 40);
    Point point = reference(degrees, 40);
    while (degrees <= range / 2) {
        check(degrees, point);
        degrees += step;
        point = turned(point, step_point);
    }
}

} // namespace

TEST_CASE("fixed: the reference itself: known angles and the unit circle") {
    const Q92 one = Q92::power_of_two(reference_bits), tiny = Q92::power_of_two(reference_bits - 80);
    for (std::int64_t degrees = -360; degrees <= 360; degrees += 30) {
        const Point p = reference(degrees << 40, 40);
        CHECK((product(p.sine, p.sine) + product(p.cosine, p.cosine) - one).absolute() < tiny);
    }
    CHECK((reference(std::int64_t{30} << 40, 40).sine - (one >> 1)).absolute() < tiny);
    CHECK((reference(std::int64_t{-300} << 40, 40).cosine - (one >> 1)).absolute() < tiny);
    CHECK((reference(std::int64_t{180} << 40, 40).cosine + one).absolute() < tiny);
}

TEST_CASE("fixed: sine and cosine are within 2^-60, with 40 and 41 fraction bits of a degree") {
    Tally tally;
    const auto check = [&tally](std::int64_t degrees, const Point& exact, SineCosine r) {
        const long double sine = error_in_units(r.sine, 62, exact.sine);
        const long double cosine = error_in_units(r.cosine, 62, exact.cosine);
        tally.expect(std::fabs(sine) <= 4 && std::fabs(cosine) <= 4, static_cast<std::uint64_t>(degrees));
        tally.measure(sine);
        tally.measure(cosine);
    };
    walk(lks::test::sample_count(),
         [&](std::int64_t degrees, const Point& exact) { check(degrees, exact, sine_cosine(degrees, 40)); });
    Random random(61);
    for (std::uint64_t i = 0; i < lks::test::sample_count() / 100; ++i) {
        const std::int64_t degrees = random.any_signed(56);
        check(degrees, reference(degrees, 41), sine_cosine(degrees, 41));
    }
    // Around every fold.
    for (std::int64_t fold = -720; fold <= 720; fold += 45) {
        for (std::int64_t d = -20; d <= 20; ++d) {
            const std::int64_t degrees = (fold << 40) + d;
            check(degrees, reference(degrees, 40), sine_cosine(degrees, 40));
        }
    }
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst error ", static_cast<double>(tally.worst), " units of 2^-62");
}

TEST_CASE("fixed: multiples of 90 degrees are exact, and angles repeat after 360") {
    const std::int64_t one = std::int64_t{1} << 62;
    const std::int64_t sines[] = {0, one, 0, -one};
    for (std::int64_t quarter = -400; quarter <= 400; ++quarter) {
        const SineCosine r = sine_cosine((quarter * 90) << 40, 40);
        CHECK(r.sine == sines[quarter & 3]);
        CHECK(r.cosine == sines[(quarter + 1) & 3]);
    }
    Tally tally;
    Random random(62);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const std::int64_t degrees = random.any_signed(50);
        const SineCosine a = sine_cosine(degrees, 40);
        const SineCosine b = sine_cosine(degrees + (std::int64_t{360} << 40), 40),
                         c = sine_cosine(-degrees, 40);
        const std::uint64_t where = static_cast<std::uint64_t>(degrees);
        tally.expect(a.sine == b.sine && a.cosine == b.cosine, where);
        tally.expect(a.sine == -c.sine && a.cosine == c.cosine, where);
    }
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: lks_sin_cos is the nearest unit of 2^-40") {
    Tally tally;
    walk(lks::test::sample_count(), [&](std::int64_t degrees, const Point& exact) {
        lks_fixed sine = 0, cosine = 0;
        const bool good = lks_sin_cos(degrees, &sine, &cosine) == LKS_OK;
        const long double sine_error = error_in_units(sine, 40, exact.sine);
        const long double cosine_error = error_in_units(cosine, 40, exact.cosine);
        const long double bound = 0.5L + 0x1p-19L;
        tally.expect(good && std::fabs(sine_error) <= bound && std::fabs(cosine_error) <= bound,
                     static_cast<std::uint64_t>(degrees));
        tally.measure(sine_error);
        tally.measure(cosine_error);
    });
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst error ", static_cast<double>(tally.worst), " units of 2^-40");

    lks_fixed sine = 7, cosine = 7;
    CHECK(lks_sin_cos(LKS_FIXED(30), &sine, &cosine) == LKS_OK);
    CHECK(sine == LKS_FIXED_ONE / 2);
    CHECK(lks_sin_cos(LKS_FIXED(36000), &sine, &cosine) == LKS_OK);
    CHECK(cosine == LKS_FIXED_ONE);
    sine = cosine = 7;
    CHECK(lks_sin_cos(LKS_FIXED(36000) + 1, &sine, &cosine) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_sin_cos(-LKS_FIXED(36000) - 1, &sine, &cosine) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_sin_cos(INT64_MIN, &sine, &cosine) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_sin_cos(0, nullptr, &cosine) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_sin_cos(0, &sine, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK((sine == 7 && cosine == 7));
}

TEST_CASE("fixed: rotations about axes of any length are within 0.51 units") {
    // sin(half) * axis / |axis| by exact squares: sine^2 axis^2 against (component -+ 0.51)^2 |axis|^2.
    using Wide = Big<13>;
    Tally tally, angle_tally;
    Random random(63);
    const auto square = [](const Wide& a) { return a * a; };
    walk(2 * lks::test::slow_sample_count(), [&](std::int64_t half_degrees, const Point& exact) {
        if (half_degrees > (std::int64_t{18000} << 40) || half_degrees < -(std::int64_t{18000} << 40))
            return;
        const Vec3 axis{random.any_signed(), random.any_signed(), random.any_signed()};
        Rotation r{};
        const bool found = rotation_about_axis(axis, 2 * half_degrees, r);
        if (axis == Vec3{0, 0, 0}) {
            tally.expect(!found);
            return;
        }
        const Wide squared =
            square(Wide::from_i64(axis.x)) + square(Wide::from_i64(axis.y)) + square(Wide::from_i64(axis.z));
        const std::int64_t component[3] = {axis.x, axis.y, axis.z};
        const std::int32_t result[3] = {r.x, r.y, r.z};
        Wide sine = Wide::from_u64(exact.sine.absolute().low64());
        for (int i = 2; i < 6; ++i)
            sine.digit[i] = exact.sine.absolute().digit[i];
        for (int i = 0; i < 3; ++i) {
            // In units of 2^-38: the sine's 92 bits are cut to 70 to stay inside 416.
            const std::int64_t size = magnitude(result[i]) & 0xffffffff;
            const Wide target = square((sine >> 22) * Wide::from_i64(component[i]));
            const Wide above = (square(Wide::from_i64(256 * size + 131)) * squared) << 64;
            const Wide below = (square(Wide::from_i64(256 * size - 131)) * squared) << 64;
            bool good = target <= above && (256 * size <= 131 || below <= target);
            if (size > 1)
                good = good && ((result[i] < 0) == ((component[i] < 0) != exact.sine.negative()));
            tally.expect(good, static_cast<std::uint64_t>(axis.x), static_cast<std::uint64_t>(axis.y),
                         static_cast<std::uint64_t>(axis.z), static_cast<std::uint64_t>(half_degrees));
        }
        const long double cosine_error = error_in_units(r.w, 30, exact.cosine);
        angle_tally.expect(std::fabs(cosine_error) <= 0.51L, static_cast<std::uint64_t>(half_degrees));
        angle_tally.measure(cosine_error);
        tally.expect(is_nearly_unit(r));
    });
    LKS_CHECK_TALLY(tally);
    LKS_CHECK_TALLY(angle_tally);
}

TEST_CASE("fixed: a positive angle turns by the right-hand rule") {
    Rotation r{};
    REQUIRE(rotation_about_axis({0, 0, 5}, std::int64_t{90} << 40, r));
    CHECK(rotate(to_matrix(r), Vec3{1000, 0, 0}) == Vec3{0, 1000, 0});
    REQUIRE(rotation_about_axis({3, 0, 0}, std::int64_t{90} << 40, r));
    CHECK(rotate(to_matrix(r), Vec3{0, 1000, 0}) == Vec3{0, 0, 1000});
    CHECK_FALSE(rotation_about_axis({0, 0, 0}, std::int64_t{90} << 40, r));
}
