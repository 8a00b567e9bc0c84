// The integer angle against the C library's, all around and at its edges.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "fixed/arc_tangent.h"
#include "support/numbers.h"

namespace {

double error_of(std::int64_t y, std::int64_t x) {
    const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
    return std::abs(std::ldexp(static_cast<double>(lks::fixed::angle_of(y, x)), -40) - exact);
}

} // namespace

TEST_CASE("an angle is right to 2^-31 in every direction and at every length") {
    support::Random random(7);
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
        const double angle = 6.283185307179586 * static_cast<double>(random.next() >> 11) * 0x1p-53;
        const double length = std::ldexp(1.0, 8 + static_cast<int>(random.next() % 22));
        const auto y = static_cast<std::int64_t>(std::llround(length * std::sin(angle)));
        const auto x = static_cast<std::int64_t>(std::llround(length * std::cos(angle)));
        worst = std::max(worst, x == 0 && y == 0 ? 0 : error_of(y, x));
    }
    INFO("worst: " << worst);
    CHECK(worst < 0x1p-31);
}

TEST_CASE("angles at the edges: axes, diagonals, units, the longest vectors, no vector") {
    constexpr std::int64_t longest = (std::int64_t{1} << 31) - 1;
    for (const std::int64_t a : {std::int64_t{1}, std::int64_t{1} << 30, longest}) {
        for (const std::int64_t y : {-a, std::int64_t{0}, a}) {
            for (const std::int64_t x : {-a, std::int64_t{0}, a}) {
                CHECK((x == 0 && y == 0 ? 0 : error_of(y, x)) < 0x1p-31);
            }
        }
        CHECK(error_of(1, a) < 0x1p-31);
        CHECK(error_of(a, -1) < 0x1p-31);
    }
    CHECK(lks::fixed::angle_of(0, 0) == 0);
}
