// What tethers must not make worse: fine cloths, pins torn apart, masses of all sizes, single substeps.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

void hang(std::uint32_t side, std::uint32_t substeps, int ticks, double stretch,
          const Aftermath& aftermath = {}) {
    Net net;
    net.side = side;
    net.particle_mass = 1.0 / (static_cast<double>(side) * side);
    net.anchors = {0, side - 1};
    HangingNet hanging(net, world_def(60, substeps));
    Trial& trial = hanging.trial;
    trial.run(ticks);
    const std::string scene =
        named("tethered cloth ", side, " × ", side, ", ", substeps, " × 1, ", ticks, " ticks");
    expect_stretch_at_most(scene, trial, stretch, aftermath);
    expect_gain_at_most(scene, trial, 0.1);
    expect_nothing_clamped(trial);
}

} // namespace

TEST_CASE("tethered cloths of 64 x 64 and 256 x 256 never explode") {
    hang(64, 1, long_runs() ? 300 : 60, 300, {0, 82});
    hang(64, 5, long_runs() ? 300 : 60, 100, {0, 35});
    hang(64, 20, long_runs() ? 300 : 40, 12);
    if (sanitised) {
        return;
    }
    hang(256, 5, long_runs() ? 300 : 8, 300, {0, long_runs() ? 80. : 6});
    hang(256, 20, long_runs() ? 300 : 2, 50, {0, long_runs() ? 23. : 0});
}

TEST_CASE("tethered cloths whose pins are torn apart by 100 m in a tick recover") {
    for (const std::uint32_t substeps : {20u, 1u}) {
        Net net;
        net.side = 12;
        net.width = 1;
        net.particle_mass = 1.0 / 144;
        net.anchors = {0, 11, 132, 143};
        const Asset asset = net.build();
        Subject subject = subject_of(net, asset);
        subject.world = world_def(60, substeps);
        Trial trial(subject);
        const std::vector<Vector> start = trial.positions();
        for (const std::uint32_t pin : net.anchors) {
            trial.pin(pin);
        }
        trial.run(60);
        for (std::size_t i = 0; i < 4; ++i) {
            trial.set_target(net.anchors[i], {i % 2 == 0 ? -50.0 : 50.0, 0, 0});
        }
        trial.begin();
        trial.run(60);
        const std::string scene = named("tethered cloth 12 × 12, ", substeps, " × 1");
        expect_worst_stretch_at_most(scene + ", torn apart", trial, substeps == 1 ? 1e5 : 6e4);
        expect_kinetic_energy_at_most(scene + ", torn apart", trial, 1e6);
        for (const std::uint32_t pin : net.anchors) {
            trial.set_target(pin, start[pin]);
        }
        trial.begin();
        trial.run(900);
        if (substeps > 1) {
            expect_recovery_within(scene + ", brought back", trial, 1);
        } else {
            expect_last_off_at_most(scene + ", brought back", trial, 24);
        }
        expect_last_stretch_at_most(scene + ", brought back", trial, substeps == 1 ? 100 : 1);
        expect_last_kinetic_energy_at_most(scene + ", brought back", trial, 0.1);
    }
}

TEST_CASE("a tethered cloth of vertices from 10 ug to 1 kg side by side") {
    Net net;
    net.side = 16;
    net.width = 1;
    net.anchors = {0, 15};
    std::vector<double> masses(256);
    for (std::size_t i = 0; i < masses.size(); ++i) {
        masses[i] = std::pow(10.0, -static_cast<double>(i % 6) * 1.6);
    }
    const Asset asset = net.build(masses);
    Subject subject = subject_of(net, asset);
    subject.masses = masses;
    subject.world = world_def(60, 20);
    Trial trial(subject);
    trial.pin(0);
    trial.pin(15);
    trial.run(300);
    expect_stretch_at_most("tethered cloth, vertices of 10 µg … 1 kg", trial, 3000, {0, 75});
    expect_gain_at_most("tethered cloth, vertices of 10 µg … 1 kg", trial, 1);
}
