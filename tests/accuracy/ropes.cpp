// Ropes that are solved at once: how far segments stretch where sweeps leave metres, and how far the integers
// end from double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "reference/comparison.h"
#include "support/builders.h"
#include "support/ropes.h"

using namespace support;
using reference::Deviation;
using reference::Scenario;

namespace {

// 99 segments, 2 m, pinned at one end and let go level.
Chain long_rope(double ratio, std::uint32_t solver) {
    Chain chain;
    chain.segments = 99;
    chain.particle_mass = 0.01;
    chain.end_mass = 0.01 * ratio;
    chain.solver = solver;
    return chain;
}

// At the end of any tick of three seconds, in which it swings down and up and down.
double worst_stretch_of_a_swing(const Chain& chain, std::uint32_t substeps) {
    const Asset asset = chain.build();
    World world(world_def(60, substeps));
    const lks_object_id object = world.add(asset, lks_transform_identity());
    world.pin(object, 0);
    double worst = 0;
    for (int tick = 0; tick < 180; ++tick) {
        world.step();
        worst = std::max(worst, worst_stretch(world, object, chain));
    }
    CHECK(world.counters().position_clamps == 0);
    return worst;
}

Scenario scenario_of(const Asset& asset, const Chain& chain, int substeps, int ticks) {
    Scenario scenario;
    scenario.asset = &asset;
    scenario.masses = chain.masses();
    scenario.materials = {chain.stretch, off, chain.bend};
    scenario.pins = {0};
    scenario.settings.substeps = substeps;
    scenario.ticks = ticks;
    scenario.direct = true;
    return scenario;
}

void check_deviation(const char* name, const Scenario& scenario, double limit) {
    const Deviation deviation = deviation_of(scenario);
    std::printf("%-60s %12.2e %12.2e\n", name, deviation.fixed_point, deviation.single);
    INFO(name);
    CHECK(deviation.fixed_point <= limit);
    CHECK_FALSE(deviation.single <= deviation.fixed_point); // or no number
}

} // namespace

TEST_CASE("99 segments with 1 : 10,000 at the end stretch by less than 1e-4 at 10 substeps") {
    CHECK(worst_stretch_of_a_swing(long_rope(1e4, LKS_ROPE_AUTOMATIC), 10) <= 1e-4);
    CHECK(worst_stretch_of_a_swing(long_rope(1e4, LKS_ROPE_DIRECT), 20) <= 2e-6);
    CHECK(worst_stretch_of_a_swing(long_rope(1e4, LKS_ROPE_SWEPT), 10) > 1);
}

TEST_CASE("20 segments of a rope that chooses for itself stretch by less than 0.2 % at one substep") {
    Chain chain;
    chain.segments = 20;
    CHECK(worst_stretch_of_a_swing(chain, 1) <= 2e-3);
    chain.solver = LKS_ROPE_SWEPT;
    CHECK(worst_stretch_of_a_swing(chain, 1) > 2);
}

namespace {

// At the end of so long that it hangs still.
double stretch_at_rest(const Chain& chain, const lks_world_def& def) {
    const Asset asset = chain.build();
    World world(def);
    lks_object_def object_def = support::object_def(asset, lks_transform_identity());
    object_def.linear_damping = LKS_FIXED(3);
    const lks_object_id object = world.add(object_def);
    world.pin(object, 0);
    world.step(20 * std::uint64_t{def.tick_rate_hz});
    return worst_stretch(world, object, chain);
}

} // namespace

// What the choice between sweeping and solving at once is by.
TEST_CASE("a swept rope that hangs is stretched as the square of its substeps and as its iterations") {
    struct Row {
        std::uint32_t rate, substeps, iterations;
    };
    for (const Row& row : {Row{60, 20, 1}, {60, 5, 1}, {30, 20, 1}, {60, 20, 4}, {60, 5, 16}}) {
        for (const double end : {1.0, 30.0}) {
            Chain chain;
            chain.segments = 40;
            chain.direction = {0, -1, 0};
            chain.end_mass = end;
            chain.solver = LKS_ROPE_SWEPT;
            const double substeps_per_second = row.rate * row.substeps;
            const double load = 39 + end;
            const double expected =
                2 * 9.81 * load * 20 / (substeps_per_second * substeps_per_second * row.iterations);
            const double measured = stretch_at_rest(chain, world_def(row.rate, row.substeps, row.iterations));
            std::printf("%u Hz x %u x %u, 1:%g at the end: %.3e, expected %.3e\n", row.rate, row.substeps,
                        row.iterations, end, measured, expected);
            CHECK(measured == doctest::Approx(expected).epsilon(0.1));
        }
    }
}

TEST_CASE("stretch of a rope by mass ratio and substeps, solved at once and swept") {
    struct Row {
        double ratio;
        double limits[4]; // at 4, 10, 20, 40 substeps
    };
    constexpr std::uint32_t substeps[] = {4, 10, 20, 40};
    // Twice what was measured, so that a swing that comes to differ in its last bits stays within.
    const Row rows[] = {{1, {6e-4, 8e-4, 1e-3, 2e-4}},
                        {100, {3e-4, 3e-6, 2e-7, 6e-8}},
                        {1e4, {1.1e-3, 3e-5, 8e-7, 4e-8}},
                        {1e6, {1.3e-3, 1e-3, 5e-5, 2e-6}}};
    std::printf("worst stretch of 99 segments, 2 m, let go level, at once / swept\n%10s", "");
    for (const std::uint32_t n : substeps) {
        std::printf(" %12u substeps", n);
    }
    for (const Row& row : rows) {
        std::printf("\n1:%-8.0e", row.ratio);
        for (int i = 0; i < 4; ++i) {
            const double direct =
                worst_stretch_of_a_swing(long_rope(row.ratio, LKS_ROPE_DIRECT), substeps[i]);
            const double swept = worst_stretch_of_a_swing(long_rope(row.ratio, LKS_ROPE_SWEPT), substeps[i]);
            std::printf("    %8.1e / %6.1e", direct, swept);
            INFO("1:" << row.ratio << ", " << substeps[i] << " substeps");
            CHECK(direct <= row.limits[i]);
            CHECK(swept > 100 * direct);
        }
    }
    std::printf("\n");
}

TEST_CASE("a rope that is solved at once stays as near to double precision as one that is swept") {
    std::printf("%-60s %12s %12s\n", "largest deviation from double precision (m)", "fixed-point", "float32");
    for (const int substeps : {10, 20}) {
        Chain chain;
        chain.solver = LKS_ROPE_DIRECT;
        const Asset asset = chain.build();
        check_deviation("20 particles, tick 60", scenario_of(asset, chain, substeps, 60), 3e-7);
        chain.end_mass = 1e4;
        const Asset heavy = chain.build();
        check_deviation("same, 1:10,000", scenario_of(heavy, chain, substeps, 60), 3e-7);
    }
    {
        const Chain chain = long_rope(1e4, LKS_ROPE_DIRECT);
        const Asset asset = chain.build();
        check_deviation("99 segments, 1:10,000, 10 substeps, tick 30", scenario_of(asset, chain, 10, 30),
                        3e-7);
    }
    for (const std::uint32_t iterations : {1u, 5u}) {
        Chain chain;
        chain.solver = LKS_ROPE_DIRECT;
        chain.stretch = soft(1e-4, 50);
        const Asset asset = chain.build();
        Scenario scenario = scenario_of(asset, chain, 10, 60);
        scenario.settings.iterations = static_cast<int>(iterations);
        check_deviation("20 particles, 1e-4 m/N, 50 N·s/m", scenario, 3e-7);
    }
    {
        Chain chain;
        chain.solver = LKS_ROPE_DIRECT;
        chain.bend = soft(1e-3);
        chain.end_mass = 30;
        const Asset asset = chain.build();
        Scenario scenario = scenario_of(asset, chain, 10, 60);
        scenario.pins = {0, 7};
        check_deviation("20 particles, bend 1e-3 m/N, pinned within, 1:30", scenario, 3e-7);
    }
}

TEST_CASE("a free rope that spins under a great tension stays near double precision") {
    Chain chain;
    chain.solver = LKS_ROPE_DIRECT;
    chain.end_mass = 1000;
    const Asset asset = chain.build();
    Scenario scenario = scenario_of(asset, chain, 10, 20);
    scenario.pins = {};
    scenario.spin = 40;
    check_deviation("20 particles, 1:1000, free, 40 1/s, tick 20", scenario, 3e-7);
}

TEST_CASE("springs in a row hang by their analytic sag after a single iteration a substep") {
    for (const double compliance : {1e-5, 1e-3, 2e-2}) {
        for (const std::uint32_t substeps : {1u, 4u, 20u}) {
            Chain chain;
            chain.segments = 10;
            chain.particle_mass = 0.1;
            chain.direction = {0, -1, 0};
            chain.stretch = soft(compliance);
            chain.solver = LKS_ROPE_DIRECT;
            const Asset asset = chain.build();
            World world(world_def(60, substeps));
            lks_object_def def = object_def(asset, lks_transform_identity());
            def.linear_damping = fixed(6);
            const lks_object_id object = world.add(def);
            world.pin(object, 0);
            world.step(900);
            const double expected = compliance * 0.1 * 9.81 * 55;
            INFO(compliance << " m/N, " << substeps << " substeps");
            CHECK(-world.positions_from(object, {}).back().y - 2 == doctest::Approx(expected).epsilon(1e-4));
        }
    }
}
