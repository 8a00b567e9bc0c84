// Particles from 10 µg to 10 t: alike in one cloth, where mass must not matter, and all of them in one.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

constexpr double milligram = 1e-6;
constexpr double ton = 1e3;

Net small_net(double mass) {
    Net net;
    net.side = 12;
    net.width = 1;
    net.particle_mass = mass;
    return net;
}

void hang(Trial& trial, std::uint32_t side, int ticks) {
    trial.pin(0);
    trial.pin(side - 1);
    trial.run(ticks);
}

lks_transform level() {
    return turned(lks_transform_identity(), 1, 0, 0, 90);
}

} // namespace

TEST_CASE("an inextensible cloth hangs alike whatever all its particles weigh") {
    std::vector<Vector> expected, twin_expected;
    for (const double mass : {0.01 * milligram, milligram, 1.0, 10 * ton}) {
        const Net net = small_net(mass);
        const Asset asset = net.build();
        Subject subject = subject_of(net, asset);
        subject.transform = level();
        Trial trial(subject);
        hang(trial, net.side, 120);
        const std::string name = named("cloth 12 × 12, particles of ", mass, " kg");
        expect_stretch_at_most(name, trial, 3);
        expect_gain_at_most(name, trial, 1);
        expect_nothing_clamped(trial);
        if (expected.empty()) {
            expected = trial.positions();
            twin_expected = trial.twin_positions();
        }
        expect_at_most(name, "away from that of 1e-08 kg", "m", 0, farthest(trial.positions(), expected),
                       farthest(trial.twin_positions(), twin_expected));
    }
}

TEST_CASE("particles of 10 µg to 10 t in one cloth stay together") {
    const Net net = small_net(1);
    Random random(7);
    std::vector<double> masses;
    for (std::uint32_t i = 0; i < net.side * net.side; ++i) {
        masses.push_back(std::pow(10.0, static_cast<double>(random.between(-8000, 4000)) / 1000));
    }
    masses[60] = 0.01 * milligram;
    masses[70] = 10 * ton;
    const Asset asset = net.build(masses);
    for (const std::uint32_t substeps : {20u, 100u}) {
        Subject subject = subject_of(net, asset);
        subject.masses = masses;
        subject.world = world_def(60, substeps);
        subject.transform = level();
        Trial trial(subject);
        hang(trial, net.side, 300);
        const std::string name = named("cloth 12 × 12, 10 µg to 10 t at random, ", substeps, " × 1");
        const double stretch = substeps == 20 ? 1e4 : 2e3;
        expect_stretch_at_most(name, trial, stretch, {0, substeps == 20 ? 82. : 70.});
        expect_last_stretch_at_most(name, trial, stretch);
        expect_gain_at_most(name, trial, 1);
        CHECK(trial.world().counters().position_clamps == 0);
    }
}

TEST_CASE("springs carry 10 µg and 10 t by the same law") {
    // Sag = compliance × weight. 1 mm each: the compliances span the same twelve decades as the masses.
    for (const double mass : {0.01 * milligram, milligram, 1.0, 10 * ton}) {
        const double compliance = 0.001 / (mass * 9.81);
        Chain spring;
        spring.segments = 1;
        spring.length = 1;
        spring.particle_mass = mass;
        spring.direction = {0, -1, 0};
        spring.stretch = soft(compliance, 2 * std::sqrt(mass / compliance));
        const Asset asset = spring.build();
        Trial trial(subject_of(spring, asset));
        trial.pin(0);
        trial.run(300);
        const std::string name = named("spring for 1 mm of sag, with ", mass, " kg");
        const auto error = [&](double y) { return std::abs(-y - 1.001) / 0.001; };
        expect_at_most(name, "sag off by", "%", 1e-2, 100 * error(trial.positions()[1].y),
                       100 * error(trial.twin_position(1).y));
        expect_nothing_clamped(trial);
    }
}
