// Whether an automatic rope is solved at once is its world's choice, by the length of its substeps and by its
// iterations.
#include <doctest/doctest.h>

#include <vector>

#include "solver/world.h"
#include "support/builders.h"

using support::Asset;
using support::World;

namespace {

// One kilogram a metre, half as much at both ends: 2 · segments² / length for the lightest.
lks_rope_def straight(std::uint32_t segments, double length) {
    lks_rope_def def = support::straight_rope(segments, length);
    def.linear_density = 1;
    if (segments == 1) {
        def.bend = support::off;
    }
    return def;
}

bool is_direct(World& world, const Asset& asset) {
    const lks_object_id id = world.add(asset, lks_transform_identity());
    const lks_world& inner = *static_cast<lks_world*>(world);
    return !inner.find_object(id)->coefficients().chain.empty();
}

bool is_direct(const lks_rope_def& def, std::uint32_t rate = 60, std::uint32_t substeps = 20,
               std::uint32_t iterations = 1) {
    const Asset asset(def);
    World world(support::world_def(rate, substeps, iterations));
    return is_direct(world, asset);
}

} // namespace

TEST_CASE("of itself a rope is solved at once where sweeps would leave more than about 1 %") {
    CHECK_FALSE(is_direct(straight(19, 2))); // 361 / m
    CHECK(is_direct(straight(21, 2)));       // 441 / m
    CHECK_FALSE(is_direct(straight(1, 0.0625)));
    lks_rope_def def = straight(10, 2);
    CHECK_FALSE(is_direct(def));
    std::vector<double> masses(11, 0.1);
    def.linear_density = 0;
    def.vertex_masses = masses.data();
    CHECK_FALSE(is_direct(def));
    masses[7] = 10;
    CHECK(is_direct(def));
    def.stretch = support::off;
    CHECK_FALSE(is_direct(def));
    CHECK(is_direct(straight(LKS_MAX_DIRECT_SEGMENTS, 59)));
    CHECK_FALSE(is_direct(straight(LKS_MAX_DIRECT_SEGMENTS + 1, 59)));
}

TEST_CASE("at 60 Hz × 20 the limit is 400 / m to the bit") {
    CHECK_FALSE(is_direct(straight(25, 3.125))); // eighths of a metre, 400 / m
    CHECK(is_direct(straight(26, 3.25)));        // 416 / m
    std::vector<double> masses(26, 0.125);
    masses.front() = masses.back() = 0.0625;
    masses[12] = 0.125 + 0x1p-40;
    lks_rope_def def = straight(25, 3.125);
    def.linear_density = 0;
    def.vertex_masses = masses.data();
    CHECK(is_direct(def));
}

TEST_CASE("twice the substeps sweep four times the load, twice the iterations twice") {
    struct Row {
        std::uint32_t rate, substeps, iterations;
        std::uint32_t segments; // the most that are swept
        double length;
    };
    for (const Row& row : {Row{60, 1, 1, 2, 10},       // 1 / m: 0.8 and 1.8
                           Row{60, 20, 1, 20, 2.1},    // 400 / m: 381 and 420
                           Row{60, 100, 1, 100, 2.01}, // 10,000 / m: 9950 and 10,150
                           Row{30, 20, 1, 10, 2.1},    // 100 / m: 95 and 115
                           Row{240, 4, 1, 16, 2.1},    // 256 / m: 244 and 275
                           Row{60, 20, 4, 40, 2.05},   // 1600 / m: 1561 and 1640
                           Row{60, 1, 100, 10, 2.1}}) {
        INFO(row.rate << " Hz x " << row.substeps << " x " << row.iterations);
        CHECK_FALSE(is_direct(straight(row.segments, row.length), row.rate, row.substeps, row.iterations));
        CHECK(is_direct(straight(row.segments + 1, row.length), row.rate, row.substeps, row.iterations));
    }
    // The shortest substeps that there are: 2.8e8 / m.
    CHECK_FALSE(is_direct(straight(8192, 1), 10000, 100));
    CHECK(is_direct(straight(16384, 1), 10000, 100));
}

TEST_CASE("worlds that share an asset choose for themselves, and in all of its objects alike") {
    const Asset asset(straight(15, 2)); // 225 / m
    World coarse(support::world_def(60, 10));
    World usual(support::world_def(60, 20));
    for (int i = 0; i < 2; ++i) {
        CHECK(is_direct(coarse, asset));
        CHECK_FALSE(is_direct(usual, asset));
    }
}

TEST_CASE("what a description asks for is done in any world") {
    for (const std::uint32_t substeps : {1u, 20u, 1000u}) {
        lks_rope_def def = straight(100, 2);
        def.solver = LKS_ROPE_SWEPT;
        CHECK_FALSE(is_direct(def, 60, substeps));
        def = straight(1, 50);
        def.solver = LKS_ROPE_DIRECT;
        CHECK(is_direct(def, 60, substeps));
    }
}
