// Heavy and light side by side: along ropes, and across joints.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

constexpr double ratios[] = {10, 1e3, 1e6};

std::string ratio_name(double ratio) {
    return named("1:", ratio);
}

// A rope of 2 m, held at one end and let go when it is level.
void swing(const std::string& scene, const std::vector<double>& masses, double stretch, double end_stretch,
           const Aftermath& aftermath = {}) {
    std::vector<double> points;
    for (std::size_t i = 0; i < masses.size(); ++i) {
        points.insert(points.end(),
                      {2.0 * static_cast<double>(i) / static_cast<double>(masses.size() - 1), 0, 0});
    }
    lks_rope_def def = lks_default_rope_def();
    def.segments = 0;
    def.length = 0;
    def.point_count = static_cast<std::uint32_t>(masses.size());
    def.points = points.data();
    def.mass = 0;
    def.linear_density = 0;
    def.vertex_masses = masses.data();
    def.stretch = stiff();
    def.bend = off;
    const Asset rope(def);
    Subject subject;
    subject.asset = &rope;
    subject.masses = masses;
    subject.materials = {stiff(), off, off};
    subject.rope = true;
    Trial trial(subject);
    trial.pin(0);
    trial.run(300);
    expect_stretch_at_most(scene, trial, stretch, aftermath);
    expect_last_stretch_at_most(scene, trial, end_stretch);
    expect_gain_at_most(scene, trial, 0.1);
    expect_nothing_clamped(trial);
}

std::vector<double> alike(std::size_t count, double mass) {
    return std::vector<double>(count, mass);
}

std::string joints_name(std::uint32_t links, double ratio, std::uint32_t substeps) {
    return named(links, " links jointed, ", ratio_name(ratio), " at the end, ", substeps, " substeps");
}

// `gap` in millimetres.
void swing_joints(std::uint32_t links, double ratio, std::uint32_t substeps, double gap) {
    Jointed scene(world_def(60, substeps));
    scene.add_chain(links, ratio);
    const JointCourse course = run(scene, 300);
    const std::string name = joints_name(links, ratio, substeps);
    expect_at_most(name, "joints apart, worst", "mm", gap, 1000 * course.gap.fixed, 1000 * course.gap.single);
    expect_at_most(name, "energy gained, of the greatest motion", "%", 0.1, 100 * course.gained_share.fixed,
                   100 * course.gained_share.single);
}

} // namespace

TEST_CASE("ropes with a heavy end hold it, as well as their solver can") {
    // The lightest is swept, the others are solved at once.
    const double worst[] = {10, 1e-4, 1e-3};
    const double at_end[] = {1, 1e-4, 1e-3};
    for (int i = 0; i < 3; ++i) {
        std::vector<double> masses = alike(21, 0.01);
        masses.back() *= ratios[i];
        swing("rope of 20, " + ratio_name(ratios[i]) + " at the end", masses, worst[i], at_end[i],
              i == 0 ? Aftermath{4.5} : Aftermath{});
    }
}

TEST_CASE("ropes with a light end, and with heavy and light in turn, hold") {
    const double worst[] = {0.01, 0.2, 0.05};
    for (int k = 0; k < 3; ++k) {
        const double ratio = ratios[k];
        std::vector<double> masses = alike(21, 0.01 * ratio);
        masses.back() = 0.01;
        swing("rope of 20, " + ratio_name(ratio) + ", the end light", masses, 0.02, 1e-3);
        masses = alike(21, 0.01);
        for (std::size_t i = 1; i < masses.size(); i += 2) {
            masses[i] *= ratio;
        }
        swing("rope of 20, " + ratio_name(ratio) + " in turn", masses, worst[k], 1e-3);
    }
}

TEST_CASE("a rope of 99 whose masses are 1 : 10^6 at random holds") {
    Random random(5);
    std::vector<double> masses = alike(100, 0.01);
    for (double& mass : masses) {
        mass *= random.between(0, 4) < 2 ? ratios[2] : 1;
    }
    swing("rope of 99, " + ratio_name(ratios[2]) + " at random", masses, 0.2, 0.1);
}

TEST_CASE("a chain of jointed bodies holds a heavy end") {
    swing_joints(8, ratios[0], 20, 1e-4);
    swing_joints(8, ratios[1], 20, 1e-4);
    swing_joints(8, ratios[2], 4, 1e-4);
    swing_joints(8, ratios[2], 20, 1e-4);
}

// Its end swings over its anchor, where it goes slack and snaps tight.
TEST_CASE("three jointed links hold a heavy end that goes slack, with any number of substeps") {
    swing_joints(3, ratios[0], 20, 1e-4);
    swing_joints(3, ratios[1], 20, 1e-4);
    for (const std::uint32_t substeps : {8u, 20u, 50u, 100u}) {
        swing_joints(3, 1e4, substeps, 1e-4);
        swing_joints(3, 1e5, substeps, 1e-4);
    }
    swing_joints(3, ratios[2], 4, 1e-4);
    for (const std::uint32_t substeps : {8u, 20u, 50u, 100u, 400u}) {
        swing_joints(3, ratios[2], substeps, 1e-4);
    }
}
