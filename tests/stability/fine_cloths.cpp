// Fine inextensible cloths don't explode, at any number of substeps; the same constraints in index order do,
// even in double precision. The order is what does it (docs/numbers.md).
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "reference/asset_model.h"
#include "reference/xpbd.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr double gravity = 9.81;

struct Extremes {
    double kinetic_energy = 0; // joules, largest at any tick
    double final_energy = 0;
    double stretch = 0; // |length / rest - 1|, largest at any tick
    double final_stretch = 0;
    double surplus = 0; // most of (kinetic energy) / (what gravity has given), at any tick
};

double stretch_of(const std::vector<lks_constraint_info>& constraints, const std::vector<Vector>& positions) {
    double worst = 0;
    for (const lks_constraint_info& info : constraints) {
        const double length = (positions[info.vertex_a] - positions[info.vertex_b]).length();
        worst = std::max(worst, std::abs(length / metres(info.rest_length) - 1));
    }
    return worst;
}

double energy_of(const World& world, lks_object_id object, double mass) {
    double energy = 0;
    for (const lks_vec3& velocity : world.velocities(object)) {
        const Vector v = metres(velocity);
        energy += 0.5 * mass * v.dot(v);
    }
    return energy;
}

// Released at height 0.
double energy_given(const std::vector<Vector>& positions, double mass) {
    double given = 0;
    for (const Vector& position : positions) {
        given -= mass * gravity * position.y;
    }
    return given;
}

// A cloth of one kilogram, released horizontally, hanging from two corners.
Extremes hang(std::uint32_t side, std::uint32_t substeps, int ticks) {
    Net net;
    net.side = side;
    net.particle_mass = 1.0 / (static_cast<double>(side) * side);
    const Asset asset = net.build();
    World world(world_def(60, substeps));
    const lks_object_id object = world.add(asset, turned(lks_transform_identity(), 1, 0, 0, 90));
    world.pin(object, 0);
    world.pin(object, side - 1);
    const std::vector<lks_constraint_info> constraints = asset.constraints();
    Extremes extremes;
    for (int tick = 0; tick < ticks; ++tick) {
        world.step();
        extremes.final_energy = energy_of(world, object, net.particle_mass);
        extremes.kinetic_energy = std::max(extremes.kinetic_energy, extremes.final_energy);
        const std::vector<Vector> positions = world.positions_from(object, {});
        extremes.surplus =
            std::max(extremes.surplus, extremes.final_energy / energy_given(positions, net.particle_mass));
        extremes.final_stretch = stretch_of(constraints, positions);
        extremes.stretch = std::max(extremes.stretch, extremes.final_stretch);
    }
    const lks_world_counters counters = world.counters();
    CHECK(counters.position_clamps == 0);
    CHECK(counters.speed_clamps == 0);
    return extremes;
}

struct Bound {
    std::uint32_t side;
    std::uint32_t substeps;
    int ticks;
    double stretch; // the most that is allowed at any tick
};

void check(const Bound& bound) {
    const auto start = std::chrono::steady_clock::now();
    const Extremes extremes = hang(bound.side, bound.substeps, bound.ticks);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("cloth %3u x %-3u  %2u x 1  %4.1f s  stretch max %7.2f %% end %7.2f %%  energy max %6.2f J "
                "end %6.2f J"
                "  of given %3.0f %%  (%.1f s)\n",
                bound.side, bound.side, bound.substeps, bound.ticks / 60.0, 100 * extremes.stretch,
                100 * extremes.final_stretch, extremes.kinetic_energy, extremes.final_energy,
                100 * extremes.surplus, seconds.count());
    INFO(bound.side << " x " << bound.side << ", " << bound.substeps << " x 1");
    CHECK(extremes.stretch <= bound.stretch);
    // An inextensible cloth between fixed pins stores nothing: motion beyond what gravity has given would
    // come from nowhere. (Discrete free fall itself is ahead by one part in the number of substeps so far.)
    CHECK(extremes.surplus <= 1 + 1.0 / bound.substeps);
}

} // namespace

TEST_CASE("a cloth of 64 x 64 never explodes at 5 x 1 and 20 x 1 and 80 x 1") {
    check({64, 5, 300, 8.0});
    check({64, 20, 300, 1.0});
    check({64, 80, long_runs() ? 600 : 90, 0.15});
}

TEST_CASE("a cloth of 256 x 256 never explodes at 5 x 1 and 20 x 1 and 80 x 1") {
    check({256, 5, long_runs() ? 300 : 45, 400.0});
    check({256, 20, long_runs() ? 300 : 20, 30.0});
    check({256, 80, long_runs() ? 300 : 5, 3.0});
}

TEST_CASE("the same cloth in index order explodes in double precision and in colour order does not") {
    Net net;
    net.side = 64;
    net.particle_mass = 1.0 / (64.0 * 64.0);
    const Asset asset = net.build();
    World world(world_def(60, 20));
    const lks_object_id object = world.add(asset, turned(lks_transform_identity(), 1, 0, 0, 90));
    const std::vector<double> masses(asset.vertex_count(), net.particle_mass);
    const reference::Materials materials{net.stretch, net.shear, net.bend};
    reference::Settings settings;
    settings.substeps = 20;

    double energy[2] = {};
    double stretch[2] = {};
    for (const reference::EdgeOrder order : {reference::EdgeOrder::canonical, reference::EdgeOrder::index}) {
        const bool sorted = order == reference::EdgeOrder::index;
        const reference::Model model = model_of(world, object, asset, {}, masses, materials, order);
        reference::Solver<double> solver(model, settings);
        solver.pin(0);
        solver.pin(net.side - 1);
        for (int tick = 0; tick < 120 && std::isfinite(stretch[sorted]); ++tick) {
            solver.tick();
            energy[sorted] = std::max(energy[sorted], solver.kinetic_energy());
            stretch[sorted] = std::max(stretch[sorted], solver.worst_stretch());
        }
        std::printf(
            "cloth 64 x 64, 20 x 1, 2 s, double precision, %-13s: energy max %9.2e J, stretch max %9.2e %%\n",
            sorted ? "index order" : "colour order", energy[sorted], 100 * stretch[sorted]);
    }
    CHECK(energy[0] < 20);
    CHECK(stretch[0] < 1);
    CHECK(energy[1] > 1e5); // a kilogram of cloth faster than sound
}
