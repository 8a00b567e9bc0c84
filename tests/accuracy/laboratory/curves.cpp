// What every experiment of speed against error shows: whose curves it has, and which settings it calls the
// best.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "accuracy/particles.h"
#include "accuracy/spring.h"
#include "accuracy/stairs.h"

using namespace lks_accuracy;

namespace {

const auto silent = [](const std::string&) {};
const Grid single_step{{1}, {1}, 1};

Experiment at_a_single_step(MeasuredScene scene) {
    scene.ticks = scene.deviation_tick = 3;
    scene.reference_substeps = 2;
    return measure_particles(scene, single_step, silent);
}

void check_curves(const Experiment& experiment, std::set<std::string> expected, bool bullet) {
    if (bullet && has_bullet_curves()) {
        expected.insert("Bullet");
    }
    std::set<std::string> found;
    for (const Row& row : experiment.rows) {
        found.insert(row.solver);
    }
    INFO(experiment.name);
    CHECK(found == expected);
}

} // namespace

TEST_CASE("every experiment has the curves that it can have") {
    const std::set<std::string> ours{"fixed-point", "float32", "double"};
    std::set<std::string> rope = ours;
    std::set<std::string> cloth = ours;
    for (const std::string& solver : ours) {
        rope.insert(solver + at_once_suffix);
        cloth.insert(solver + tethered_suffix);
    }
    cloth.insert("PBD");
    std::set<std::string> free_cloth = ours;
    free_cloth.insert("PBD");
    // Where nothing is soft PBD is XPBD.
    check_curves(at_a_single_step(rope_swing()), rope, true);
    check_curves(at_a_single_step(rope_heavy_end()), rope, true);
    check_curves(at_a_single_step(cloth_hang()), cloth, true);
    check_curves(at_a_single_step(cloth_fine()), cloth, true);
    check_curves(at_a_single_step(cloth_drape()), free_cloth, true);
    // Bullet's links know no compliance, and joints have none.
    check_curves(measure_spring(single_step, {1}, silent), free_cloth, false);
    check_curves(measure_stairs(single_step, 3, silent), ours, true);
}

TEST_CASE("the best setting is not the one that stretches least and moves wrongly") {
    for (MeasuredScene rope : {rope_swing(), rope_heavy_end()}) {
        rope.reference_substeps = 320;
        const Experiment found = measure_particles(rope, {{1, 5}, {1, 4}, 5}, silent);
        const Row* best = best_within(found, std::string("fixed-point") + at_once_suffix, 5);
        REQUIRE(best != nullptr);
        INFO(rope.name << ": " << label_of(best->schedule));
        CHECK(best->schedule.substeps == 5);
        for (const Row& row : found.rows) {
            if (row.solver == best->solver) {
                CHECK(worst_seen(found, row) >= worst_seen(found, *best));
            }
        }
    }
}
