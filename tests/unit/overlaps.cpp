// The hashed grids against looking at every pair.
#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
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
    struct Many {
        std::size_t count;
        std::int64_t spread;
    };
    std::vector<Many> cases;
    for (const std::int64_t spread : {LKS_FIXED(1), LKS_FIXED(30), LKS_FIXED(2000), LKS_FIXED(4000000)}) {
        cases.push_back({400, spread});
        for (std::size_t i = 0; i < 60; ++i) { // fewer than there are buckets: rows go on at the first one
            cases.push_back({2 + i % 7, spread});
        }
    }
    for (const auto& [count, spread] : cases) {
        const std::vector<lks::Box> boxes = random_boxes(random, count, spread);
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
            if (count == 400 && spread <= LKS_FIXED(30)) {
                CHECK(expected.size() > 100);
            }
        }
    }
}

TEST_CASE("looking for pairs takes as much work a box among twenty thousand as among a thousand") {
    // Balls of 0.4 m side by side on the ground, in a cube, in a row, and one in eight twice to eight times
    // as large.
    constexpr std::int64_t side = LKS_FIXED_RATIO(4, 10);
    struct Layout {
        std::string name;
        int dimensions;
        bool mixed;
        double most; // looks a box
    };
    for (const Layout& layout :
         {Layout{"row", 1, false, 5}, Layout{"square", 2, false, 12}, Layout{"cube", 3, false, 30},
          Layout{"square of several sizes", 2, true, 45}}) {
        double first = 0;
        for (const std::uint32_t count : {1250u, 2500u, 5000u, 10000u, 20000u}) {
            lks::Overlaps overlaps{lks_allocator{}};
            REQUIRE(overlaps.reserve(count));
            const double root = std::pow(count, 1.0 / layout.dimensions);
            const auto edge = static_cast<std::int64_t>(std::ceil(root - 1e-9));
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::int64_t x = i % edge;
                const std::int64_t y = i / edge % edge;
                const std::int64_t z = i / edge / edge;
                const std::int64_t size = layout.mixed && i % 8 == 0 ? side << (1 + i / 8 % 3) : side;
                const lks::fixed::Vec3 low{x * side, y * side, z * side};
                overlaps.add({low, {low.x + size, low.y + size, low.z + size}});
            }
            std::uint64_t pairs = 0;
            overlaps.for_each_pair([&](std::uint32_t, std::uint32_t) { ++pairs; });
            const double looks = static_cast<double>(overlaps.looks()) / count;
            first = first == 0 ? looks : first;
            INFO(layout.name << " of " << count << ": " << looks << " looks a box, "
                             << static_cast<double>(pairs) / count << " pairs");
            CHECK(pairs > count / 2);
            CHECK(looks < layout.most);
            CHECK(looks < 1.2 * first); // fewer of them are at the edge
        }
    }
}
