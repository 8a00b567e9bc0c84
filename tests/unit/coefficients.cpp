// What solver/coefficients.h tells kernels of constraints whose ends move unlike: how many they are, where,
// and how the movement is shared out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/distance_task.h"
#include "solver/coefficients.h"
#include "support/builders.h"

using namespace lks;

namespace {

const lks_asset& inner(const support::Asset& asset) {
    return *static_cast<const lks_asset*>(asset);
}

// Counted anew, and within what the batch says.
void check_counts(const lks_asset& asset, const Coefficients& coefficients) {
    for (std::uint32_t b = 0; b < asset.batches.size(); ++b) {
        const Batch& batch = asset.batches[b];
        const BatchCoefficients& of_batch = coefficients.batches[b];
        std::uint32_t unequal = 0;
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            if (coefficients.parts_b[i] != half_part) {
                ++unequal;
                CHECK(is_in(of_batch.unequal_shares, i));
            }
        }
        CHECK(of_batch.unequal_count == unequal);
    }
}

} // namespace

TEST_CASE("coefficients: constraints with unlike ends are counted as particles are pinned and unpinned") {
    support::Net net;
    net.side = 12;
    const support::Asset sheet = net.build();
    const lks_asset& asset = inner(sheet);
    const StepRate rate = make_step_rate(60, 20, 1);
    Coefficients coefficients{lks_allocator{}};
    REQUIRE(coefficients.build(asset, rate));
    for (const BatchCoefficients& batch : coefficients.batches) {
        CHECK(batch.unequal_count == 0);
        CHECK(batch.unequal_shares.first == batch.unequal_shares.last);
    }
    const std::uint32_t pins[] = {5, 6}; // neighbours: the edge between them moves nothing
    coefficients.update_particle(asset, rate, {pins, 1}, pins[0]);
    coefficients.update_particle(asset, rate, {pins, 2}, pins[1]);
    check_counts(asset, coefficients);
    std::uint32_t incident = 0;
    for (const Constraint& ends : asset.constraints) {
        const bool a = std::find(std::begin(pins), std::end(pins), ends.a) != std::end(pins);
        const bool b = std::find(std::begin(pins), std::end(pins), ends.b) != std::end(pins);
        incident += a || b ? 1 : 0;
    }
    std::uint32_t counted = 0;
    for (const BatchCoefficients& batch : coefficients.batches) {
        counted += batch.unequal_count;
    }
    CHECK(counted == incident);
    CHECK(incident > 10);

    coefficients.update_particle(asset, rate, {pins + 1, 1}, pins[0]);
    coefficients.update_particle(asset, rate, {}, pins[1]);
    check_counts(asset, coefficients);
    for (const BatchCoefficients& batch : coefficients.batches) {
        CHECK(batch.unequal_count == 0);
    }
}

TEST_CASE("coefficients: movement is shared out by inverse masses, and pinned ends get nothing of it") {
    support::Net net;
    net.side = 4;
    std::vector<double> masses;
    for (int i = 0; i < 16; ++i) {
        masses.push_back(0.001 * (1 + i % 3));
    }
    const support::Asset sheet = net.build(masses);
    const lks_asset& asset = inner(sheet);
    const StepRate rate = make_step_rate(60, 20, 1);
    Coefficients coefficients{lks_allocator{}};
    REQUIRE(coefficients.build(asset, rate));
    check_counts(asset, coefficients);
    const auto is_pinned = [&](std::uint32_t particle) { return particle == 3; };
    const std::uint32_t pin = 3;
    coefficients.update_particle(asset, rate, {&pin, 1}, pin);
    check_counts(asset, coefficients);
    for (std::uint32_t i = 0; i < asset.constraints.size(); ++i) {
        const Constraint& ends = asset.constraints[i];
        // Inverse masses as doubles: mantissa and exponent.
        const auto weight = [&](std::uint32_t particle) {
            const fixed::Scaled& w = asset.inverse_masses[particle];
            return is_pinned(particle) ? 0.0 : static_cast<double>(w.times_power_of_two(-16).to_fixed(40));
        };
        const double a = weight(ends.a);
        const double b = weight(ends.b);
        const double part = static_cast<double>(coefficients.parts_b[i]) / direction_one;
        CHECK(part == doctest::Approx(b / (a + b)).epsilon(1e-8));
        CHECK((b != 0 || coefficients.parts_b[i] == 0));
        CHECK((a != 0 || coefficients.parts_b[i] == static_cast<std::uint32_t>(direction_one)));
        // Stiff: together all of it, alike half of it each.
        const std::uint32_t whole = a == b ? unit_one / 2 : unit_one - 1;
        CHECK(coefficients.shares[i] == whole);
    }
}
