// Every instruction set's prediction kernel against plain integers: the same bits and the same counts.
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
    std::vector<std::int64_t> x, start;

    bool operator==(const Particles&) const = default;
};

// Mostly within all limits; now and then at or beyond them.
Particles make_particles(test::Random& random, std::size_t count, std::int64_t limit) {
    Particles particles;
    for (std::size_t i = 0; i < count; ++i) {
        std::int64_t x = random.any_signed(61);
        std::int64_t motion = random.any_signed(20) * (limit >> 21);
        switch (random.below(64)) {
        case 0:
            x = static_cast<std::int64_t>(random.bits());
            break;
        case 1:
            x = (random.bits() & 1) != 0 ? coordinate_limit : -coordinate_limit;
            x += static_cast<std::int64_t>(random.below(3)) - 1;
            break;
        case 2:
            motion = (random.bits() & 1) != 0 ? limit : -limit;
            motion += static_cast<std::int64_t>(random.below(3)) - 1;
            break;
        case 3:
            motion = static_cast<std::int64_t>(random.bits());
            break;
        default:
            break;
        }
        particles.x.push_back(x);
        particles.start.push_back(
            static_cast<std::int64_t>(static_cast<std::uint64_t>(x) - static_cast<std::uint64_t>(motion)));
    }
    return particles;
}

} // namespace

TEST_CASE("kernels: every instruction set predicts as plain integers do and counts the same clamps") {
    const std::uint64_t problems = test::sample_count() / 100; // of 100 particles on the average
    for (const Kernels* kernels : test::wide_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        test::Random random(7);
        std::uint64_t different = 0;
        std::uint64_t clamps = 0;
        for (std::uint64_t p = 0; p < problems; ++p) {
            const std::int64_t limit = substep_motion_limit >> random.below(20);
            Particles expected = make_particles(random, 1 + random.below(200), limit);
            Particles actual = expected;
            const auto kept =
                random.below(3) == 0 ? unit_one : static_cast<std::uint32_t>(random.bits() >> 33);
            const std::int64_t acceleration =
                random.below(8) == 0 ? limit : random.any_signed(20) * (limit >> 24);
            const PredictionClamps a = kernels_scalar.predict(
                {expected.x.data(), expected.start.data(), expected.x.size(), acceleration, kept, limit});
            const PredictionClamps b = kernels->predict(
                {actual.x.data(), actual.start.data(), actual.x.size(), acceleration, kept, limit});
            different += !(expected == actual) || a.positions != b.positions || a.speeds != b.speeds ? 1 : 0;
            clamps += a.positions + a.speeds;
        }
        CHECK(different == 0);
        CHECK(clamps > problems);
    }
}
