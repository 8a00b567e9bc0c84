// The hashed grids against looking at every pair.
#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "rigid/overlaps.h"
#include "support/numbers.h"

using namespace support;

namespace {

std::int64_t within(Random& random, std::int64_t limit) {
    return static_cast<std::int64_t>(random.next() % (2 * static_cast<std::uint64_t>(limit) + 1)) - limit;
}

// Sizes from a millimetre to a kilometre, crowded or far apart.
std::vector<lks::Box> random_boxes(Random& random, std::size_t count, std::int64_t spread) {
    std::vector<lks::Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t size = std::int64_t{1} << (30 + random.next() % 20);
        lks::Box box{};
        box.low = {within(random, spread), within(random, spread), within(random, spread)};
        box.high = {box.low.x + static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(size)),
                    box.low.y + static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(size)),
                    box.low.z + static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(size))};
        boxes.push_back(box);
    }
    return boxes;
}

} // namespace

TEST_CASE("overlapping boxes of all sizes are found, each pair once, and no others") {
    Random random(5);
    for (const std::int64_t spread : {LKS_FIXED(1), LKS_FIXED(30), LKS_FIXED(2000), LKS_FIXED(4000000)}) {
        const std::vector<lks::Box> boxes = random_boxes(random, 400, spread);
        lks::Overlaps overlaps{lks_allocator{}};
        REQUIRE(overlaps.reserve(static_cast<std::uint32_t>(boxes.size())));
        for (int round = 0; round < 2; ++round) { // the second one over what the first has left
            overlaps.clear();
            for (const lks::Box& box : boxes) {
                overlaps.add(box);
            }
            std::multiset<std::pair<std::uint32_t, std::uint32_t>> found;
            overlaps.for_each_pair([&](std::uint32_t i, std::uint32_t j) { found.insert({i, j}); });
            std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected;
            for (std::uint32_t i = 0; i < boxes.size(); ++i) {
                for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
                    if (boxes[i].overlaps(boxes[j])) {
                        expected.insert({i, j});
                    }
                }
            }
            CHECK(found == expected);
            if (spread <= LKS_FIXED(30)) {
                CHECK(expected.size() > 100);
            }
        }
    }
}
