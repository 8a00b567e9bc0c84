// What docs/accuracy.md promises of tethers: half of the stretch at the same cost, and the same motion.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "accuracy/particles.h"
#include "support/handles.h"

using namespace lks_accuracy;
using reference::Engine;

namespace {

constexpr int early = 30; // ticks, before the cloth is caught and its folds are chance

std::vector<support::Vector> early_positions(const MeasuredScene& measured, int substeps) {
    const auto simulation = simulate(Engine::double_precision, measured.scene, {substeps, 1});
    for (int tick = 0; tick < early; ++tick) {
        simulation->tick();
    }
    return simulation->positions();
}

double root_mean_square(const std::vector<support::Vector>& a, const std::vector<support::Vector>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += (a[i] - b[i]).dot(a[i] - b[i]) / static_cast<double>(a.size());
    }
    return std::sqrt(sum);
}

} // namespace

TEST_CASE("at the cost of 20 x 1 a tethered cloth of 64 x 64 stretches by less than half") {
    const auto stretch = [](const MeasuredScene& measured, int substeps) {
        const reference::Stretch found = stretch_over_time(measured, Engine::fixed_point, {substeps, 1});
        std::printf("%-19s %2d substeps: stretch %.2f %% worst, %.3f %% mean\n", measured.name.c_str(),
                    substeps, 100 * found.worst, 100 * found.mean);
        return found;
    };
    const reference::Stretch swept = stretch(cloth_fine(), 20);
    // Its tethers cost a tenth: 18 substeps with them as much as 20 without.
    const reference::Stretch held = stretch(tethered(cloth_fine()), 18);
    CHECK(held.worst < swept.worst / 5);
    CHECK(held.mean < 0.75 * swept.mean);
    CHECK(stretch(tethered(cloth_fine()), 10).worst < swept.worst / 3);
    CHECK(stretch(tethered(cloth_hang()), 10).worst < stretch(cloth_hang(), 20).worst);
}

TEST_CASE("tethers leave the converged motion as it is and bring others nearer to it") {
    const MeasuredScene plain = cloth_hang();
    const MeasuredScene held = tethered(plain);
    const std::vector<support::Vector> converged = early_positions(plain, support::long_runs() ? 1280 : 320);
    for (const int substeps : {10, 20, 80}) {
        const double without = root_mean_square(early_positions(plain, substeps), converged);
        const double with = root_mean_square(early_positions(held, substeps), converged);
        std::printf("%d substeps: off by %.4f m, with tethers by %.4f m\n", substeps, without, with);
        INFO(substeps << " substeps");
        CHECK(with < without);
    }
    CHECK(root_mean_square(early_positions(held, 160), converged) < 0.005);
}
