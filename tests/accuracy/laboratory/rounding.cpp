// Fixed-point's own rounding must not be what a game sees: in every setting that docs/accuracy.md recommends
// it is at most a tenth of what the method itself is off.
#include <doctest/doctest.h>

#include <cstdio>

#include "accuracy/paper.h"
#include "accuracy/particles.h"
#include "support/handles.h"

using namespace lks_accuracy;

TEST_CASE("in every recommended setting rounding is below a tenth of the method's own error") {
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
