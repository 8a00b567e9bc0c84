// How far the fixed-point solver ends from the same method in double precision, and float32 beside it.
#include <doctest/doctest.h>

#include <cstdio>

#include "reference/comparison.h"
#include "support/builders.h"

using namespace support;
using reference::Deviation;
using reference::Materials;
using reference::Scenario;

namespace {

void print_header() {
    std::printf("%-52s %12s %12s %14s\n", "largest deviation from double precision (m)", "fixed-point",
                "float32", "float32 @100m");
}

void print(const char* scene, const Deviation& deviation) {
    std::printf("%-52s %12.2e %12.2e %14.2e\n", scene, deviation.fixed_point, deviation.single,
                deviation.single_at_100_metres);
}

Chain swept() {
    Chain chain;
    chain.solver = LKS_ROPE_SWEPT;
    return chain;
}

Scenario chain_scenario(const Asset& asset, const Chain& chain, int substeps) {
    Scenario scenario;
    scenario.asset = &asset;
    scenario.masses.assign(chain.segments + 1, chain.particle_mass);
    scenario.materials = Materials{chain.stretch, off, off};
    scenario.pins = {0};
    scenario.settings.substeps = substeps;
    return scenario;
}

} // namespace

TEST_CASE("a chain of 20 particles stays within 3e-7 m of double precision for a second") {
    print_header();
    const Chain chain = swept();
    const Asset asset = chain.build();
    for (const int substeps : {10, 20}) {
        const Deviation deviation = deviation_of(chain_scenario(asset, chain, substeps));
        char name[96];
        std::snprintf(name, sizeof name, "20-particle chain, %d substeps, tick 60", substeps);
        print(name, deviation);
        INFO(name);
        CHECK(deviation.fixed_point <= 3e-7);
        CHECK(deviation.single > deviation.fixed_point);
        CHECK(deviation.single_at_100_metres > deviation.single);
    }
}

TEST_CASE("a chain with many iterations and a soft damped one stay as near") {
    print_header();
    const Chain stiff_chain = swept();
    const Asset stiff_asset = stiff_chain.build();
    Scenario scenario = chain_scenario(stiff_asset, stiff_chain, 4);
    scenario.settings.iterations = 5;
    const Deviation iterated = deviation_of(scenario);
    print("20-particle chain, 4 substeps of 5 iterations, tick 60", iterated);
    CHECK(iterated.fixed_point <= 3e-7);
    CHECK(iterated.single > iterated.fixed_point);

    Chain soft_chain = swept();
    soft_chain.stretch = soft(1e-4, 50);
    const Asset soft_asset = soft_chain.build();
    for (const int iterations : {1, 6}) {
        scenario = chain_scenario(soft_asset, soft_chain, 10);
        scenario.settings.iterations = iterations;
        const Deviation damped = deviation_of(scenario);
        char name[96];
        std::snprintf(name, sizeof name, "same, 1e-4 m/N, 50 N·s/m, 10 substeps of %d", iterations);
        print(name, damped);
        INFO(name);
        CHECK(damped.fixed_point <= 3e-7);
        CHECK(damped.single > damped.fixed_point);
    }
}

namespace {

// Held by the corners of its first row, 10 substeps.
Scenario scenario_of(const Net& net, const Asset& asset, int ticks) {
    Scenario scenario;
    scenario.asset = &asset;
    scenario.masses.assign(std::size_t{net.side} * net.side, net.particle_mass);
    scenario.materials = Materials{net.stretch, net.shear, net.bend};
    scenario.pins = {0, net.side - 1};
    scenario.settings.substeps = 10;
    scenario.ticks = ticks;
    return scenario;
}

} // namespace

TEST_CASE("a cloth of 64 x 64 stays within 2e-6 m of double precision for ten ticks") {
    print_header();
    const Net net;
    const Asset asset = net.build();
    const Deviation deviation = deviation_of(scenario_of(net, asset, 10));
    print("cloth 64 x 64, two corners pinned, 10 substeps, tick 10", deviation);
    CHECK(deviation.fixed_point <= 2e-6);
    CHECK(deviation.single > deviation.fixed_point);
    CHECK(deviation.single_at_100_metres > deviation.single);
}

TEST_CASE(
    "a tethered cloth with a hundred times its critical damping stays within 1e-6 m of double precision") {
    print_header();
    Net net;
    net.side = 16;
    net.width = 1;
    net.stretch = net.shear = net.bend = soft(1e-6, 2e4);
    net.particle_mass = 0.01;
    net.anchors = {0, 15};
    const Asset asset = net.build();
    Scenario scenario = scenario_of(net, asset, 60);
    scenario.transform = turned(lks_transform_identity(), 1, 0, 0, 90);
    const Deviation deviation = deviation_of(scenario);
    print("tethered cloth 16 x 16, 100 x critical, 10 substeps, tick 60", deviation);
    CHECK(deviation.fixed_point <= 1e-6);
    CHECK(deviation.single > deviation.fixed_point);
    CHECK(deviation.single_at_100_metres > deviation.single);
}

TEST_CASE("springs of any compliance and mass stay within 3e-7 m of double precision for a second") {
    // Released from the horizontal: a pendulum and a spring at once. Softer ones swing further than their
    // length.
    std::printf("springs of 1 m from the horizontal, 10 substeps, tick 60\n");
    print_header();
    double worst = 0;
    double worst_single = 0;
    for (const double compliance : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        Deviation row;
        for (const double mass : {1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0}) {
            Chain spring;
            spring.segments = 1;
            spring.length = 1;
            spring.particle_mass = mass;
            spring.stretch = soft(compliance);
            const Asset asset = spring.build();
            const Deviation deviation = deviation_of(chain_scenario(asset, spring, 10));
            INFO("compliance " << compliance << " m/N, mass " << mass << " kg");
            CHECK(deviation.fixed_point <= 3e-7);
            CHECK(deviation.single > deviation.fixed_point);
            row.fixed_point = std::max(row.fixed_point, deviation.fixed_point);
            row.single = std::max(row.single, deviation.single);
            row.single_at_100_metres = std::max(row.single_at_100_metres, deviation.single_at_100_metres);
        }
        char name[96];
        std::snprintf(name, sizeof name, "%.0e m/N, worst of 1e-4 .. 10 kg", compliance);
        print(name, row);
        worst = std::max(worst, row.fixed_point);
        worst_single = std::max(worst_single, row.single);
    }
    CHECK(worst <= 3e-7);
    CHECK(worst_single > 100 * worst);
}

TEST_CASE("springs of unequal masses and with strong damping stay within 1e-6 m") {
    // Light between heavy, damped to a thousand times its momentum a step: the hardest case for a
    // correction's 30 bits.
    print_header();
    for (int i = 0; i < 6; ++i) {
        const double damping = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 1000;
        const bool direct = i >= 3;
        Chain spring;
        spring.segments = 2;
        spring.length = 1;
        spring.stretch = soft(1e-3, damping);
        std::vector<double> points{0, 0, 0, 0.5, 0, 0, 1, 0, 0};
        const std::vector<double> masses{1, 0.01, 2};
        lks_rope_def def = lks_default_rope_def();
        def.segments = 0;
        def.length = 0;
        def.point_count = 3;
        def.points = points.data();
        def.mass = 0;
        def.linear_density = 0;
        def.vertex_masses = masses.data();
        def.stretch = spring.stretch;
        def.bend = off;
        def.solver = direct ? LKS_ROPE_DIRECT : LKS_ROPE_SWEPT;
        const Asset asset(def);
        Scenario scenario = chain_scenario(asset, spring, 10);
        scenario.masses = masses;
        scenario.settings.iterations = 4;
        scenario.direct = direct;
        const Deviation deviation = deviation_of(scenario);
        char name[96];
        std::snprintf(name, sizeof name, "1 : 0.01 : 2 kg, 1e-3 m/N, %g N·s/m, 10 x 4%s", damping,
                      direct ? ", at once" : "");
        print(name, deviation);
        INFO(name);
        CHECK(deviation.fixed_point <= 1e-6);
        CHECK(deviation.single > 100 * deviation.fixed_point);
    }
}

TEST_CASE("a thrown rope of unequal masses far from the origin is as near as one at the origin") {
    Chain chain = swept();
    chain.segments = 9;
    chain.length = 1;
    const Asset asset = chain.build();
    Scenario scenario = chain_scenario(asset, chain, 10);
    scenario.pins.clear();
    scenario.velocity = fixed(3, 4, -2);
    scenario.settings.linear_damping = 0.5;
    scenario.transform = turned(at(7000000.25, -100.5, 3.75), 1, 2, 3, 40);
    const Deviation deviation = deviation_of(scenario);
    print_header();
    print("thrown rope, damped by air, 7,000 km away", deviation);
    CHECK(deviation.fixed_point <= 3e-7);
    CHECK(deviation.single > deviation.fixed_point);
}
