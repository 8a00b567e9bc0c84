// What docs/accuracy.md promises of the settings that it recommends, and why it recommends substeps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>

#include "accuracy/particles.h"
#include "accuracy/stairs.h"
#include "support/handles.h"

using namespace lks_accuracy;
using reference::Engine;

namespace {

struct Promise {
    MeasuredScene scene;
    int substeps;
    double worst, mean; // stretch, %
};

const Row& row_of(const Experiment& experiment, const std::string& solver, int substeps) {
    const auto found = std::find_if(experiment.rows.begin(), experiment.rows.end(), [&](const Row& row) {
        return row.solver == solver && row.schedule.substeps == substeps;
    });
    REQUIRE(found != experiment.rows.end());
    return *found;
}

double error_of(const Experiment& experiment, const Row& row, const std::string& quantity) {
    const auto found = std::find_if(experiment.quantities.begin(), experiment.quantities.end(),
                                    [&](const Quantity& candidate) { return candidate.name == quantity; });
    REQUIRE(found != experiment.quantities.end());
    return row.errors[static_cast<std::size_t>(found - experiment.quantities.begin())];
}

} // namespace

TEST_CASE("ropes and cloths stretch as little as the table of substeps says") {
    const Promise promises[] = {
        {rope_swing(), 10, 20, 2.2},    {rope_swing(), 20, 5, 0.55},      {rope_swing(), 40, 1.25, 0.14},
        {rope_heavy_end(), 20, 9, 2.4}, {rope_heavy_end(), 40, 2.2, 0.6}, {rope_heavy_end(), 80, 0.5, 0.15},
        {cloth_hang(), 10, 25, 0.52},   {cloth_hang(), 20, 8, 0.19},      {cloth_hang(), 40, 2.3, 0.062},
        {cloth_drape(), 10, 15, 0.9},   {cloth_drape(), 20, 6.5, 0.42},   {cloth_drape(), 40, 5.5, 0.22},
    };
    for (const Promise& promise : promises) {
        const reference::Stretch stretch =
            stretch_over_time(promise.scene, Engine::fixed_point, {promise.substeps, 1});
        std::printf("%-14s %2d substeps: stretch %.2f %% worst, %.3f %% mean\n", promise.scene.name.c_str(),
                    promise.substeps, 100 * stretch.worst, 100 * stretch.mean);
        INFO(promise.scene.name << ", " << promise.substeps << " substeps");
        CHECK(100 * stretch.worst <= promise.worst);
        CHECK(100 * stretch.mean <= promise.mean);
        CHECK(stretch.mean > 0);
    }
}

TEST_CASE("ropes that are solved at once are as near as the table of substeps says") {
    const char* const quantities[] = {"stretch, worst", "stretch, mean", "deviation", "energy drift",
                                      "support force, a tick"};
    struct AtOnce {
        int substeps;
        double most[5]; // %, %, m, %, %
    };
    struct Rope {
        MeasuredScene scene;
        AtOnce settings[3];
    };
    const Rope ropes[] = {
        {rope_swing(),
         {{5, {0.06, 1e-4, 0.13, 7, 6}}, {10, {0.01, 2e-5, 0.085, 5, 4}}, {20, {1e-3, 2e-6, 0.055, 3, 2.7}}}},
        {rope_heavy_end(),
         {{5, {2e-4, 3e-6, 0.016, 1, 1.7}},
          {10, {1e-5, 3e-7, 0.008, 0.6, 1.1}},
          {20, {1e-6, 1e-7, 0.0045, 0.3, 0.65}}}}};
    for (const Rope& rope : ropes) {
        MeasuredScene scene = rope.scene;
        scene.reference_substeps = 640; // swept: of places, it knows nothing of the direct solve
        const Experiment found = measure_particles(scene, {{5, 10, 20}, {1}, 20}, [](const std::string&) {});
        for (const AtOnce& setting : rope.settings) {
            const Row& direct = row_of(found, "fixed-point, at once", setting.substeps);
            const Row& swept = row_of(found, "fixed-point", setting.substeps);
            std::printf("%-14s at once, %2d substeps:", scene.name.c_str(), setting.substeps);
            for (std::size_t i = 0; i < std::size(quantities); ++i) {
                const double error = error_of(found, direct, quantities[i]);
                std::printf("  %s %.1e", quantities[i], error);
                INFO(scene.name << ", " << setting.substeps << " substeps, " << std::string(quantities[i]));
                CHECK(error > 0);
                CHECK(error <= setting.most[i]);
                CHECK(error < error_of(found, swept, quantities[i]));
            }
            std::printf("\n");
        }
    }
}

TEST_CASE("automatic solves both measured ropes at once") {
    for (const MeasuredScene& rope : {rope_swing(), rope_heavy_end()}) {
        reference::ParticleScene automatic = rope.scene;
        automatic.solver = LKS_ROPE_AUTOMATIC;
        const auto chosen = simulate(Engine::fixed_point, automatic, {4, 1});
        const auto direct = simulate(Engine::fixed_point, at_once(rope).scene, {4, 1});
        const auto swept = simulate(Engine::fixed_point, rope.scene, {4, 1});
        for (int tick = 0; tick < 10; ++tick) {
            chosen->tick();
            direct->tick();
            swept->tick();
        }
        const auto end_of = [](const reference::Simulation& simulation) {
            return simulation.positions().back();
        };
        CHECK((end_of(*chosen) - end_of(*direct)).length() == 0);
        CHECK((end_of(*chosen) - end_of(*swept)).length() > 0.01);
    }
}

TEST_CASE("the same work leaves less stretch as substeps than as iterations") {
    for (const MeasuredScene& scene : measured_scenes()) {
        const double substeps = stretch_over_time(scene, Engine::fixed_point, {20, 1}).mean;
        const double both = stretch_over_time(scene, Engine::fixed_point, {5, 4}).mean;
        const double iterations = stretch_over_time(scene, Engine::fixed_point, {1, 20}).mean;
        std::printf("%-14s mean stretch at 20 passes: 20 x 1 %.3f %%, 5 x 4 %.3f %%, 1 x 20 %.3f %%\n",
                    scene.name.c_str(), 100 * substeps, 100 * both, 100 * iterations);
        INFO(scene.name);
        CHECK(substeps < 0.7 * both);
        CHECK(both < 0.7 * iterations);
    }
}

TEST_CASE("joints on the stairs are as near as the table of substeps says") {
    struct Promise {
        int substeps;
        double mean, worst; // mm
    };
    for (const Promise& promise : {Promise{1, 0.1, 15}, Promise{5, 0.003, 1.2}, Promise{8, 0.001, 0.5}}) {
        const Row row = fall_of_ours({promise.substeps, 1}, 120);
        std::printf("stairs, %d substeps: joints apart %.1e mm mean, %.3f mm worst; energy gained %.3f %%\n",
                    promise.substeps, row.errors[0], row.errors[1], row.errors[2]);
        INFO(promise.substeps << " substeps");
        CHECK(row.errors[0] <= promise.mean);
        CHECK(row.errors[1] <= promise.worst);
        CHECK(row.errors[2] <= 1);
    }
}

TEST_CASE("after 10 and 60 s a heavy rope is as near as docs/accuracy.md says" *
          doctest::skip(!support::long_runs())) {
    MeasuredScene scene = rope_heavy_end();
    scene.later_ticks = {600, 3600};
    const Experiment found = measure_particles(scene, {{5, 20}, {1}, 20}, [](const std::string&) {});
    struct Later {
        int substeps;
        double ten, sixty; // metres
    };
    for (const Later& later : {Later{5, 0.2, 1.6}, Later{20, 0.06, 0.1}}) {
        const Row& row = row_of(found, "fixed-point, at once", later.substeps);
        INFO(later.substeps << " substeps");
        CHECK(error_of(found, row, "deviation, 10 s") <= later.ten);
        CHECK(error_of(found, row, "deviation, 60 s") <= later.sixty);
        // Rounding does not grow with them.
        CHECK(error_of(found, row, "rounding, 10 s") <= 1e-8);
        CHECK(error_of(found, row, "rounding, 60 s") <= 1e-7);
        CHECK(error_of(found, row, "rounding, 60 s") > 0);
    }
}
