// Every instruction set finds the particles that a collider may touch, and leaves out none.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "fixed/formats.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "kernels/kernels.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

struct Particles {
    std::vector<std::int64_t> values[6]; // x, y, z, and where they were

    // Around ±2^reach, and now and then anywhere.
    Particles(test::Random& random, std::uint32_t count, int reach) {
        for (std::vector<std::int64_t>& axis : values) {
            for (std::uint32_t i = 0; i < count; ++i) {
                axis.push_back(random.below(50) == 0
                                   ? static_cast<std::int64_t>(random.bits())
                                   : static_cast<std::int64_t>(random.bits()) >> (63 - reach));
            }
        }
    }
};

std::int32_t direction(test::Random& random) {
    return static_cast<std::int32_t>(random.bits() >> 33) / 2 - direction_one / 4;
}

} // namespace

TEST_CASE("kernels: every instruction set finds the particles that may touch a collider") {
    const std::uint64_t problems = test::sample_count() / 32; // of 32 particles on the average
    for (const Kernels* kernels : test::wide_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        test::Random random(3);
        std::uint64_t different = 0;
        std::uint64_t near = 0;
        for (std::uint64_t p = 0; p < problems; ++p) {
            const auto first = static_cast<std::uint32_t>(random.below(9));
            const auto count = static_cast<std::uint32_t>(1 + random.below(64));
            const Particles particles(random, first + count, 50 + static_cast<int>(random.below(13)));
            BoxTask box{};
            PlaneTask plane{};
            for (int axis = 0; axis < 3; ++axis) {
                box.positions[axis] = plane.positions[axis] = particles.values[axis].data();
                box.starts[axis] = particles.values[axis + 3].data();
                box.low[axis] = static_cast<std::int32_t>(random.any_signed(30));
                box.high[axis] = box.low[axis] + static_cast<std::int32_t>(random.any_magnitude(29));
                plane.normal[axis] = direction(random);
            }
            plane.level = random.any_signed(61);
            const std::uint64_t expected = kernels_scalar.near_box(box, first, count);
            different += kernels->near_box(box, first, count) != expected ? 1 : 0;
            different +=
                kernels->near_plane(plane, first, count) != kernels_scalar.near_plane(plane, first, count)
                    ? 1
                    : 0;
            near += expected != 0 ? 1 : 0;
        }
        CHECK(different == 0);
        CHECK(near > problems / 100);
        CHECK(near < problems);
    }
}
