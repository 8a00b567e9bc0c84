// Every instruction set finds the least and the greatest of some numbers, and the greatest gap of pairs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

// Of all sizes; or so near each other that only the lower halves differ; and now and then the ends of the
// range.
std::vector<std::int64_t> any_values(test::Random& random, std::size_t count) {
    const int bits = 1 + static_cast<int>(random.below(63));
    const std::int64_t around = random.below(2) == 0 ? 0 : random.any_signed(62);
    std::vector<std::int64_t> values(count);
    for (std::int64_t& value : values) {
        value = random.below(16) == 0 ? (random.below(2) == 0 ? INT64_MIN : INT64_MAX)
                : bits < 62           ? around + random.any_signed(bits)
                                      : random.any_signed(63);
    }
    return values;
}

} // namespace

TEST_CASE("kernels: every instruction set finds the least and the greatest of any numbers") {
    const std::vector<const Kernels*> all = test::all_kernels();
    test::Random random(31);
    const std::uint64_t problems = test::sample_count() / 192; // of 192 numbers on the average
    std::uint64_t different = 0;
    for (std::uint64_t p = 0; p < problems; ++p) {
        const std::size_t count = 1 + random.below(130);
        const std::size_t stride = count + random.below(9);
        const std::size_t first = random.below(9);
        std::vector<std::int64_t> values = any_values(random, first + 3 * stride);
        // What is not among them is beyond all of them.
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (i < first || (i - first) % stride >= count) {
                values[i] = i % 2 == 0 ? INT64_MIN : INT64_MAX;
            }
        }
        for (const Kernels* kernels : all) {
            const CoordinateRanges ranges = kernels->ranges(values.data() + first, stride, count);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first + axis * stride);
                const auto [low, high] =
                    std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(count));
                const CoordinateRange& range = ranges.axes[axis];
                different += range.low != *low || range.high != *high ? 1 : 0;
            }
        }
    }
    CHECK(different == 0);
}

TEST_CASE("kernels: every instruction set finds the greatest gap of any pairs") {
    const std::vector<const Kernels*> all = test::all_kernels();
    test::Random random(32);
    const std::uint64_t problems = test::sample_count() / 64; // of 64 pairs on the average
    std::uint64_t different = 0;
    for (std::uint64_t p = 0; p < problems; ++p) {
        const auto first = static_cast<std::uint32_t>(random.below(9));
        const auto count = static_cast<std::uint32_t>(1 + random.below(130));
        std::vector<std::int64_t> a = any_values(random, first + count);
        std::vector<std::int64_t> b = any_values(random, first + count);
        std::uint64_t expected = 0;
        for (std::uint32_t i = 0; i < first + count; ++i) {
            if (i < first) { // what is not among them is further apart than all of them
                a[i] = INT64_MIN;
                b[i] = INT64_MAX;
            } else {
                const auto high = static_cast<std::uint64_t>(std::max(a[i], b[i]));
                expected = std::max(expected, high - static_cast<std::uint64_t>(std::min(a[i], b[i])));
            }
        }
        for (const Kernels* kernels : all) {
            different += kernels->greatest_gap(a.data() + first, b.data() + first, count) != expected ? 1 : 0;
        }
    }
    CHECK(different == 0);
}
