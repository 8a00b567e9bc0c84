// Fixed-point's own rounding must not be what a game sees: in every setting that docs/accuracy.md recommends
// it is at most a tenth of what the method itself is off, or 1e-9 of a length, which no game sees.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "accuracy/paper.h"
#include "accuracy/particles.h"
#include "support/handles.h"

using namespace lks_accuracy;

namespace {

// Of what is told in metres, of scenes that are two metres long, and of what is told in percent.
constexpr double floor_metres = 1e-9;
constexpr double floor_percent = 1e-7;

// What is off to either side, and comes by zero: there a tenth of it is nothing by chance, and rounding is to
// be below a twentieth of what is seen in a game.
double floor_of(const Quantity& quantity) {
    const bool has_sides =
        quantity.name == "sag" || quantity.name == "support force, mean" || quantity.name == "energy drift";
    return has_sides ? quantity.seen / 20 : quantity.unit == "m" ? floor_metres : floor_percent;
}

const Row& row_of(const Experiment& experiment, const std::string& solver, int substeps) {
    const auto found = std::find_if(experiment.rows.begin(), experiment.rows.end(), [&](const Row& row) {
        return row.solver == solver && row.schedule.substeps == substeps;
    });
    REQUIRE(found != experiment.rows.end());
    return *found;
}

// Each error of fixed-point against that of the same method in double precision: what is between them is
// rounding.
void compare(const Experiment& experiment, const std::string& suffix, int substeps) {
    const Row& ours = row_of(experiment, "fixed-point" + suffix, substeps);
    const Row& twin = row_of(experiment, "double" + suffix, substeps);
    double greatest = 0;
    std::string where = "nothing";
    for (std::size_t i = 0; i < experiment.quantities.size(); ++i) {
        const Quantity& quantity = experiment.quantities[i];
        if (quantity.beside >= 0 || std::isnan(twin.errors[i])) {
            continue;
        }
        const double rounding = std::abs(ours.errors[i] - twin.errors[i]);
        const double least = floor_of(quantity);
        INFO(experiment.name << suffix << ", " << substeps << " substeps, " << quantity.name << ": "
                             << ours.errors[i] << " and " << twin.errors[i] << " " << quantity.unit);
        CHECK(rounding <= std::max(least, twin.errors[i] / 10));
        if (rounding > least && rounding / twin.errors[i] > greatest) {
            greatest = rounding / twin.errors[i];
            where = quantity.name;
        }
    }
    std::printf("%-14s %-10s %2d substeps: at most %.1e of the method's own error (%s)\n",
                experiment.name.c_str(), suffix.c_str(), substeps, greatest, where.c_str());
}

} // namespace

TEST_CASE("in every recommended setting rounding of places is below a tenth of the method's own error") {
    std::vector<MeasuredScene> scenes = measured_scenes();
    scenes.push_back(at_once(rope_swing()));
    scenes.push_back(at_once(rope_heavy_end()));
    MeasuredScene spring;
    spring.name = "spring";
    spring.scene = spring_scene();
    spring.recommended = {5, 20, 40};
    scenes.push_back(spring);
    scenes.push_back(tethered(cloth_hang()));
    for (MeasuredScene fine : {cloth_fine(), tethered(cloth_fine())}) {
        if (!support::long_runs()) {
            fine.recommended.resize(1);
        }
        scenes.push_back(fine);
    }
    for (MeasuredScene& measured : scenes) {
        REQUIRE(!measured.recommended.empty());
        if (!support::long_runs()) {
            // Of which the method's own error is a part.
            measured.reference_substeps = measured.scene.columns == 64 ? 160 : 320;
        }
        for (const int substeps : measured.recommended) {
            const Rounding rounding = rounding_of(measured, {substeps, 1});
            std::printf("%-23s %2d substeps: method %.1e m, fixed-point %.1e m, float32 %.1e m\n",
                        measured.name.c_str(), substeps, rounding.discretisation, rounding.fixed_point,
                        rounding.single_precision);
            INFO(measured.name << ", " << substeps << " substeps");
            CHECK(rounding.discretisation > 0);
            CHECK(rounding.fixed_point < rounding.discretisation / 10);
            // There is rounding: fixed-point has not been compared with itself.
            CHECK(rounding.fixed_point > 0);
        }
    }
}

TEST_CASE("in every recommended setting rounding of all that is measured is below a tenth, or 1e-9 of a "
          "length") {
    for (MeasuredScene measured : measured_scenes()) {
        if (!support::long_runs()) {
            measured.reference_substeps = 160;
        }
        std::vector<int> all = measured.recommended;
        const std::vector<int> direct = at_once(measured).recommended;
        if (measured.is_rope()) {
            all.insert(all.end(), direct.begin(), direct.end());
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
        }
        const Experiment found = measure_particles(measured, {all, {1}, 80}, [](const std::string&) {});
        for (const int substeps : measured.recommended) {
            compare(found, "", substeps);
            if (measured.may_be_tethered()) {
                compare(found, tethered_suffix, substeps);
            }
        }
        for (const int substeps : measured.is_rope() ? direct : std::vector<int>{}) {
            compare(found, at_once_suffix, substeps);
        }
    }
}
