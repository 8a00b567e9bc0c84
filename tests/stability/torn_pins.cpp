// Pins torn apart by 100 m within a tick, and brought back within one.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

struct Bounds {
    double stretch;           // percent, torn apart
    double seconds;           // until it has recovered; 0: it does not
    double end;               // percent, brought back
    double joules = 1e6;      // torn apart: of a kilogram at a thousand metres a second, twice
    double back_joules = 1e6; // brought back
    double rest_joules = 0.1; // at the end
    double off = 1;           // percent of the edges, at the end
};

void tear(const std::string& scene, Trial& trial, const std::vector<std::uint32_t>& pins,
          const Bounds& bounds) {
    const std::vector<Vector> start = trial.positions();
    for (const std::uint32_t pin : pins) {
        trial.pin(pin);
    }
    trial.run(60);
    for (std::size_t i = 0; i < pins.size(); ++i) {
        trial.set_target(pins[i], {i % 2 == 0 ? -50.0 : 50.0, 0, 0});
    }
    trial.begin();
    trial.run(60);
    expect_worst_stretch_at_most(scene + ", torn apart", trial, bounds.stretch);
    expect_kinetic_energy_at_most(scene + ", torn apart", trial, bounds.joules);
    for (const std::uint32_t pin : pins) {
        trial.set_target(pin, start[pin]);
    }
    trial.begin();
    trial.run(900);
    if (bounds.seconds > 0) {
        expect_recovery_within(scene + ", brought back", trial, bounds.seconds);
    } else {
        expect_last_off_at_most(scene + ", brought back", trial, bounds.off);
    }
    expect_last_stretch_at_most(scene + ", brought back", trial, bounds.end);
    expect_kinetic_energy_at_most(scene + ", brought back", trial, bounds.back_joules);
    expect_last_kinetic_energy_at_most(scene + ", brought back", trial, bounds.rest_joules);
    tell(scene, "positions clamped", "", static_cast<double>(trial.world().counters().position_clamps),
         "it clamps nothing");
    CHECK(trial.world().counters().target_clamps == 0);
    tell(scene, "speeds clamped", "", static_cast<double>(trial.world().counters().speed_clamps),
         "it clamps nothing");
}

} // namespace

TEST_CASE("cloths and ropes whose pins are torn apart by 100 m in a tick recover") {
    for (const std::uint32_t substeps : {20u, 1u}) {
        const bool one = substeps == 1;
        Net net;
        net.side = 12;
        net.width = 1;
        net.particle_mass = 1.0 / 144;
        const Asset cloth = net.build();
        Subject subject = subject_of(net, cloth);
        subject.world = world_def(60, substeps);
        Trial trial(subject);
        tear(named("inextensible cloth 12 × 12, ", substeps, " × 1"), trial, {0, 11, 132, 143},
             one ? Bounds{1e5, 0, 100, 1e6, 1e6, 0.1, 80} : Bounds{6e4, 0.2, 1});

        net.stretch = net.shear = net.bend = soft(1e-3, 1);
        const Asset soft_cloth = net.build();
        subject = subject_of(net, soft_cloth);
        subject.world = world_def(60, substeps);
        Trial soft_trial(subject);
        tear(named("cloth of 1e-3 m/N, ", substeps, " × 1"), soft_trial, {0, 11, 132, 143},
             one ? Bounds{1e5, 0, 100, 1e6, 1e6, 0.1, 80} : Bounds{6e4, 1, 3});

        Chain chain;
        chain.segments = 30;
        chain.particle_mass = 0.01;
        const Asset rope = chain.build();
        subject = subject_of(chain, rope);
        subject.world = world_def(60, substeps);
        Trial rope_trial(subject);
        tear(named("rope of 30, ", substeps, " × 1"), rope_trial, {0, 30},
             one ? Bounds{6e4, 0.4, 1, 1e6, 20} : Bounds{6e4, 0.1, 1, 3e5, 20});
    }
}

TEST_CASE("ropes whose pins are torn apart recover in long substeps and with a heavy end") {
    struct Row {
        double end;
        std::uint32_t hz, substeps;
        std::vector<std::uint32_t> pins;
        Bounds bounds;
    };
    const Row rows[] = {{1, 10, 1, {0}, {8e4, 5, 1, 1e4, 1e4}},
                        {1e3, 60, 10, {0, 20}, {6e4, 0.1, 1, 6e6, 1000, 50}},
                        {1e6, 60, 10, {0, 20}, {6e4, 4, 1, 1e7, 5e6, 2e5}}};
    for (const Row& row : rows) {
        Chain chain;
        chain.segments = 40;
        chain.particle_mass = 0.01;
        chain.end_mass = 0.01 * row.end;
        const Asset rope = chain.build();
        Subject subject = subject_of(chain, rope);
        subject.masses = chain.masses();
        subject.world = world_def(row.hz, row.substeps);
        Trial trial(subject);
        const std::string heavy = row.end > 1 ? named(", 1:", row.end, " at the end") : "";
        tear(named("rope of 40", heavy, ", ", row.hz, " Hz × ", row.substeps), trial, row.pins, row.bounds);
    }
}
