// Which particles colliders and tethers may hold, asked at the ends of all ranges: every kernel, plain
// integers too, answers as the same question does in integers that have no limit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "exact_kernels.h"
#include "fixed/formats.h"
#include "fixed/int128.h"
#include "kernels/kernels.h"
#include "wide_kernels.h"

using namespace lks;
using namespace lks::test::exact;

namespace {

constexpr std::uint32_t particles = 64;

// value · 2^32, and less than half of that more or one unit less, within 64 bits.
std::int64_t about(test::Random& random, std::int64_t value) {
    const std::int64_t offsets[] = {-1, 0, 1, std::int64_t{1} << 31};
    const B exact = (big(value) << 32) + big(one_of(random, offsets));
    return low(between(exact, big(INT64_MIN), big(INT64_MAX)));
}

} // namespace

TEST_CASE("kernels: heights above planes at the ends of the range are what integers without limits give") {
    const std::int64_t places[] = {-INT64_MAX - 1, -coordinate_limit, -1, 0, coordinate_limit, INT64_MAX};
    const std::int32_t components[] = {-direction_one, -1, 0, 1, direction_one};
    test::Random random(8);
    std::uint64_t different = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        std::vector<std::int64_t> axes[3];
        PlaneTask task{};
        for (int axis = 0; axis < 3; ++axis) {
            for (std::uint32_t particle = 0; particle < particles; ++particle) {
                axes[axis].push_back(one_of(random, places));
            }
            task.positions[axis] = axes[axis].data();
            task.normal[axis] = components[random.below(std::size(components))];
        }
        std::uint64_t below = 0;
        const auto height = [&](std::size_t particle) {
            B sum{};
            for (int axis = 0; axis < 3; ++axis) {
                sum = sum + big(task.normal[axis]) * floored(big(axes[axis][particle]), 32);
            }
            return sum;
        };
        // At the height of one of them, or an end of the range that planes have.
        constexpr std::int64_t end = (std::int64_t{1} << 61) - 1;
        task.level = std::clamp(low(height(random.below(particles))), -end, end);
        for (std::size_t particle = 0; particle < particles; ++particle) {
            below |= std::uint64_t{height(particle) < big(task.level)} << particle;
        }
        for (const Kernels* kernels : test::all_kernels()) {
            different += kernels->near_plane(task, 0, particles) == below ? 0 : 1;
        }
    }
    CHECK(different == 0);
}

TEST_CASE(
    "kernels: boxes that particles miss at the ends of the range are what integers without limits give") {
    const std::int64_t places[] = {INT32_MIN,
                                   INT32_MIN + 1,
                                   -1,
                                   0,
                                   1,
                                   INT32_MAX / 2,
                                   INT32_MAX - 1,
                                   INT32_MAX,
                                   -7,
                                   -coordinate_limit >> 32,
                                   coordinate_limit >> 32};
    test::Random random(9);
    std::uint64_t different = 0, missed = 0;
    constexpr std::uint64_t boxes = 20000;
    for (std::uint64_t i = 0; i < boxes; ++i) {
        std::vector<std::int64_t> axes[6];
        BoxTask task{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t one = one_of(random, places), other = one_of(random, places);
            task.low[axis] = static_cast<std::int32_t>(std::min(one, other));
            task.high[axis] = static_cast<std::int32_t>(std::max(one, other));
            // Most are within it, or on an end: a way that one axis decides is to be found.
            const std::int64_t ends[] = {
                one, other, one, other, one, other, one - 1, other + 1, other, one, one_of(random, places)};
            for (std::uint32_t particle = 0; particle < particles; ++particle) {
                axes[axis].push_back(about(random, one_of(random, ends)));
                axes[axis + 3].push_back(about(random, one_of(random, ends)));
            }
            task.positions[axis] = axes[axis].data();
            task.starts[axis] = axes[axis + 3].data();
        }
        std::uint64_t near = 0;
        for (std::uint32_t particle = 0; particle < particles; ++particle) {
            bool misses = false;
            for (int axis = 0; axis < 3; ++axis) {
                const B end = big(axes[axis][particle]), start = big(axes[axis + 3][particle]);
                const B least = big(task.low[axis]) << 32;
                const B above = (big(task.high[axis]) + big(1)) << 32;
                misses = misses || (end < least && start < least) || (end >= above && start >= above);
            }
            near |= std::uint64_t{misses ? 0u : 1u} << particle;
            missed += misses ? 1 : 0;
        }
        for (const Kernels* kernels : test::all_kernels()) {
            different += kernels->near_box(task, 0, particles) == near ? 0 : 1;
        }
    }
    CHECK(different == 0);
    CHECK(missed > boxes * particles / 16);
    CHECK(missed < boxes * particles / 8 * 7);
}

TEST_CASE(
    "kernels: tethers at the ends of the range hold whom integers without limits say, and nobody goes") {
    const std::int64_t places[] = {
        -coordinate_limit,    1 - coordinate_limit, -(std::int64_t{1} << 32), -1, 0, 1,
        coordinate_limit - 1, coordinate_limit};
    test::Random random(10);
    std::uint64_t different = 0, left_out = 0, beyond = 0;
    constexpr std::uint64_t problems = 20000;
    for (std::uint64_t i = 0; i < problems; ++i) {
        std::vector<std::int64_t> axes[3];
        TetherTask task{};
        for (int axis = 0; axis < 3; ++axis) {
            task.anchor[axis] = one_of(random, places);
            for (std::uint32_t particle = 0; particle < particles; ++particle) {
                axes[axis].push_back(random.below(3) == 0 ? task.anchor[axis] : one_of(random, places));
            }
            task.positions[axis] = axes[axis].data();
        }
        std::vector<std::uint32_t> lengths;
        std::uint64_t expected = 0;
        for (std::uint32_t particle = 0; particle < particles; ++particle) {
            B upper{}, exact{};
            for (int axis = 0; axis < 3; ++axis) {
                const B apart = big(axes[axis][particle]) - big(task.anchor[axis]);
                upper = upper + (apart >> 32) * (apart >> 32);
                exact = exact + apart * apart;
            }
            // About as long as the distance, or anything.
            const std::uint64_t distance = fixed::square_root(fixed::UInt128{0, upper.low64()});
            const std::uint64_t any[] = {3, 4, 1u << 31, UINT32_MAX, distance + random.below(9)};
            const std::uint64_t length =
                std::clamp<std::uint64_t>(any[std::min<std::uint64_t>(random.below(9), 4)], 3, UINT32_MAX);
            lengths.push_back(static_cast<std::uint32_t>(length));
            const B shorter = B::from_u64(length - 2);
            const bool may = ((shorter * shorter) >> 1) < (upper >> 1);
            const bool is = (B::from_u64(length) * B::from_u64(length) << 64) < exact;
            expected |= std::uint64_t{may ? 1u : 0u} << particle;
            left_out += is && !may ? 1 : 0;
            beyond += may ? 1 : 0;
        }
        task.lengths = lengths.data();
        for (const Kernels* kernels : test::all_kernels()) {
            different += kernels->beyond_tether(task, 0, particles) == expected ? 0 : 1;
        }
    }
    CHECK(different == 0);
    CHECK(left_out == 0);
    CHECK(beyond > problems * particles / 8);
    CHECK(beyond < problems * particles / 8 * 7);
}
