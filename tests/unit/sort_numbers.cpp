// Sorting by digits against sorting by comparisons.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "memory/sort_numbers.h"
#include "support/numbers.h"

using support::Random;

TEST_CASE("numbers of any size and any likeness come out in ascending order") {
    Random random(17);
    for (const std::size_t count : {0u, 1u, 2u, 255u, 256u, 257u, 2047u, 2048u, 20000u}) {
        // All alike; names of a few figures; what differs in one byte, in the top bit, and everywhere.
        for (const std::uint64_t differing : {std::uint64_t{0}, std::uint64_t{0x7f800000fff},
                                              std::uint64_t{0xff0000}, std::uint64_t{1} << 63, UINT64_MAX}) {
            const std::uint64_t common = random.next() & ~differing;
            lks::Array<std::uint64_t> numbers{lks_allocator{}};
            lks::Array<std::uint64_t> room{lks_allocator{}};
            REQUIRE((numbers.reserve(count) && room.reserve(count)));
            std::vector<std::uint64_t> expected;
            for (std::size_t i = 0; i < count; ++i) {
                expected.push_back(common | (random.next() & differing));
                numbers.push_reserved(expected.back());
            }
            std::sort(expected.begin(), expected.end());
            for (int round = 0; round < 2; ++round) { // the second one is in order, over what the first left
                lks::sort_numbers(numbers, room);
                CHECK(std::equal(expected.begin(), expected.end(), numbers.begin(), numbers.end()));
            }
        }
    }
}
