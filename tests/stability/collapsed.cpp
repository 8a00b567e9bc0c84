// Edges without length: built so (refused), or made so while the game runs.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

constexpr std::uint32_t side = 12;

// What is to come of it.
struct Outcome {
    double seconds;             // until it has recovered; 0: it does not
    double stretch;             // percent, at the end
    double joules;              // kinetic, worst
    double worst_stretch = 400; // percent
};

// All particles are moved, within a tick, to shape(where they were), and let go there without speed.
// Tethered: to two corners that are pinned and stay where they are.
template <typename Shape>
void collapse(const std::string& what, const Shape& shape, const Outcome& outcome, bool tethered = false) {
    Net net;
    net.side = side;
    net.width = 1.1;
    net.particle_mass = 1.0 / (side * side);
    if (tethered) {
        net.anchors = {0, side - 1};
    }
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.world.gravity = {};
    Trial trial(subject);
    for (const std::uint32_t anchor : net.anchors) {
        trial.pin(anchor);
    }
    std::vector<Vector> places;
    for (const Vector& position : trial.positions()) {
        places.push_back(shape(position));
    }
    trial.put(places);
    trial.run(300);
    const std::string scene = named(tethered ? "tethered cloth 12 × 12 " : "cloth 12 × 12 ", what,
                                    outcome.seconds > 0 ? "" : " (stays so)");
    if (outcome.seconds > 0) {
        expect_recovery_within(scene, trial, outcome.seconds);
    }
    expect_worst_stretch_at_most(scene, trial, outcome.worst_stretch);
    expect_last_stretch_at_most(scene, trial, outcome.stretch);
    expect_kinetic_energy_at_most(scene, trial, outcome.joules);
    expect_nothing_clamped(trial);
    CHECK(trial.fixed().is_finite());
}

} // namespace

// Two particles in the same place have no direction in which to part, and where all that pulls at them is the
// same they move as one for ever. The least difference is enough: a particle's distance doubles with each
// projection.
TEST_CASE("a cloth that was brought into a point, a line or a plane recovers or stays finite") {
    collapse("in one point", [](const Vector&) { return Vector{0, 0, 0}; }, {0, 100, 0});
    collapse("at a thousandth of its size", [](const Vector& p) { return p * 1e-3; }, {0.3, 1, 3000});
    collapse("at a millionth of its size", [](const Vector& p) { return p * 1e-6; }, {0.3, 1, 6000});
    collapse("with its columns in one line",
             [](const Vector& p) {
                 return Vector{p.x, 0, 0};
             },
             {0, 100, 300});
    collapse("with its diagonals in one line",
             [](const Vector& p) {
                 return Vector{p.x + p.y, 0, 0};
             },
             {0, 100, 10});
    collapse("in one point but for two corners",
             [](const Vector& p) {
                 return p.y > 0.5 && std::abs(p.x) > 0.5 ? p : Vector{0, 0, 0};
             },
             {0, 300, 4000, 1700});
    collapse("half of it in one point",
             [](const Vector& p) {
                 return p.x < 0 ? p : Vector{0, 0, 0};
             },
             {0.3, 1, 600, 1200});
}

TEST_CASE("a tethered cloth that was brought into a point but for its pins recovers or stays finite") {
    collapse(
        "in one point",
        [](const Vector&) {
            return Vector{0, 0, 0};
        },
        {0.3, 1, 4000, 1700}, true);
    collapse(
        "at a thousandth of its size", [](const Vector& p) { return p * 1e-3; }, {0.3, 1, 3000, 1700}, true);
    collapse(
        "at a millionth of its size", [](const Vector& p) { return p * 1e-6; }, {0.3, 1, 6000, 1700}, true);
    collapse(
        "half of it in one point",
        [](const Vector& p) {
            return p.x < 0 ? p : Vector{0, 0, 0};
        },
        {0.3, 1, 4000, 1700}, true);
}
