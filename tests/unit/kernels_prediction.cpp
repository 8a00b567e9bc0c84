// Every instruction set's prediction kernel against one particle after the other: the same bits and the same
// counts.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "fixed/formats.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "kernels/kernels.h"
#include "kernels/prediction_scalar.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

// Of some objects in a row, each as an object has them: x, y, z, then where each began.
struct Particles {
    std::size_t count, stride;
    std::vector<std::ptrdiff_t> places;
    std::vector<std::int64_t> values;

    PredictionTask task(const std::int64_t (&accelerations)[3], std::uint32_t kept, std::int64_t limit) {
        return {values.data(),
                stride,
                count,
                places.size() == 1 ? nullptr : places.data(),
                static_cast<std::uint32_t>(places.size()),
                kept,
                {accelerations[0], accelerations[1], accelerations[2]},
                limit};
    }
};

// Mostly within all limits; now and then at or beyond them. What is behind the last particle must not change.
Particles make_particles(test::Random& random, std::size_t count, std::size_t objects, std::int64_t limit) {
    constexpr std::size_t axes = 3;
    const std::size_t stride = count + random.below(9);
    Particles particles{count, stride, {}, std::vector<std::int64_t>(objects * 2 * axes * stride + 1, limit)};
    for (std::size_t object = 0; object < objects; ++object) {
        particles.places.push_back(static_cast<std::ptrdiff_t>(object * 2 * axes * stride));
    }
    for (std::size_t i = 0; i < objects * axes * count; ++i) {
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
        const std::size_t axis = i / count % axes;
        const auto place = static_cast<std::size_t>(particles.places[i / count / axes]) + i % count;
        particles.values[place + axis * stride] = x;
        particles.values[place + (axis + axes) * stride] =
            static_cast<std::int64_t>(static_cast<std::uint64_t>(x) - static_cast<std::uint64_t>(motion));
    }
    return particles;
}

PredictionClamps predict_in_turn(const PredictionTask& task) {
    PredictionClamps clamps;
    for_each_axis(task, [&](const PredictionAxis& axis) {
        if (task.kept == unit_one) {
            predict_in_turn<false>(task, axis, 0, task.count, clamps);
        } else {
            predict_in_turn<true>(task, axis, 0, task.count, clamps);
        }
    });
    return clamps;
}

} // namespace

TEST_CASE(
    "kernels: every instruction set predicts as one particle after the other and counts the same clamps") {
    const std::uint64_t problems = test::sample_count() / 400; // of 400 coordinates on the average
    for (const Kernels* kernels : test::all_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        test::Random random(7);
        std::uint64_t different = 0;
        std::uint64_t clamps = 0;
        for (std::uint64_t p = 0; p < problems; ++p) {
            const std::int64_t limit = substep_motion_limit >> random.below(20);
            const std::size_t objects = random.below(4) == 0 ? 1 + random.below(4) : 1;
            Particles expected = make_particles(random, 1 + random.below(200), objects, limit);
            Particles actual = expected;
            const auto kept =
                random.below(3) == 0 ? unit_one : static_cast<std::uint32_t>(random.bits() >> 33);
            std::int64_t accelerations[3];
            for (std::int64_t& acceleration : accelerations) {
                acceleration = random.below(16) == 0 ? limit : random.any_signed(20) * (limit >> 24);
            }
            const PredictionClamps a = predict_in_turn(expected.task(accelerations, kept, limit));
            const PredictionClamps b = kernels->predict(actual.task(accelerations, kept, limit));
            different +=
                expected.values != actual.values || a.positions != b.positions || a.speeds != b.speeds ? 1
                                                                                                       : 0;
            clamps += a.positions + a.speeds;
        }
        CHECK(different == 0);
        CHECK(clamps > problems);
    }
}
