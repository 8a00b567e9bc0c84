// Every instruction set finds the least and the greatest of some numbers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "wide_kernels.h"

using namespace lks;

TEST_CASE("kernels: every instruction set finds the least and the greatest of any numbers") {
    std::vector<const Kernels*> all = test::wide_kernels();
    all.push_back(&kernels_scalar);
    test::Random random(31);
    const std::uint64_t problems = test::sample_count() / 64; // of 64 numbers on the average
    std::uint64_t different = 0;
    for (std::uint64_t p = 0; p < problems; ++p) {
        const auto first = static_cast<std::uint32_t>(random.below(9));
        const auto count = static_cast<std::uint32_t>(1 + random.below(130));
        // Of all sizes; or so near each other that only the lower halves differ; or the ends of the range.
        const int bits = 1 + static_cast<int>(random.below(63));
        const std::int64_t around = random.below(2) == 0 ? 0 : random.any_signed(62);
        std::vector<std::int64_t> values(first + count);
        for (std::int64_t& value : values) {
            value = random.below(16) == 0 ? (random.below(2) == 0 ? INT64_MIN : INT64_MAX)
                    : bits < 62           ? around + random.any_signed(bits)
                                          : random.any_signed(63);
        }
        // What is not among them is beyond all of them.
        for (std::uint32_t i = 0; i < first; ++i) {
            values[i] = i % 2 == 0 ? INT64_MIN : INT64_MAX;
        }
        const auto [low, high] = std::minmax_element(values.begin() + first, values.end());
        for (const Kernels* kernels : all) {
            const CoordinateRange range = kernels->range(values.data() + first, count);
            different += range.low != *low || range.high != *high ? 1 : 0;
        }
    }
    CHECK(different == 0);
}
