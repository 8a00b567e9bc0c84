// Which differences of coordinates fit into the 31 bits of a projection, up to the longest there are.
#include <doctest/doctest.h>

#include <cstdint>

#include "kernels/distance_scalar.h"

TEST_CASE("differences fit from -2^30 to 2^30 - 1 on each axis, and nothing overflows beyond") {
    constexpr std::int64_t one = lks::direction_one;
    const auto fits_on_each_axis = [](std::int64_t d) {
        const bool x = lks::fit_differences({d, 0, 0});
        CHECK(lks::fit_differences({0, d, 0}) == x);
        CHECK(lks::fit_differences({0, 0, d}) == x);
        return x;
    };
    for (const std::int64_t d : {std::int64_t{0}, std::int64_t{-1}, one - 1, -one}) {
        CAPTURE(d);
        CHECK(fits_on_each_axis(d));
    }
    for (const std::int64_t d : {one, -one - 1, INT64_MAX, INT64_MAX - 1, INT64_MAX - one,
                                 INT64_MAX - one + 1, INT64_MIN, INT64_MIN + 1, INT64_MIN + one}) {
        CAPTURE(d);
        CHECK_FALSE(fits_on_each_axis(d));
    }
}
