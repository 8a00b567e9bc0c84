// Cloths that begin where no cloth can be: mirrored, turned inside out, crumpled into a ball, blown up.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

struct Bounds {
    double seconds; // until it has recovered; 0: it may keep folds
    double off;     // percent of the edges, at the end
    double joules;  // kinetic, worst
};

struct Kind {
    lks_distance_material material;
    bool tethered;
};

// Hanging from its upper corners, which stay; everything else begins at place(vertex, where it was).
// `stretch`: percent, the worst, which is how they begin.
template <typename Place>
void start(const std::string& name, const Kind& kind, double stretch, const Place& place,
           const Bounds& bounds) {
    Net net;
    net.side = 16;
    net.width = 1.5;
    net.particle_mass = 1.0 / 256;
    net.stretch = net.shear = net.bend = kind.material;
    if (kind.tethered) {
        net.anchors = {0, 15};
    }
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.tolerance = 0.05;
    Trial trial(subject);
    trial.pin(0);
    trial.pin(15);
    std::vector<Vector> places = trial.positions();
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i] = place(i, places[i]);
    }
    trial.put(places);
    trial.run(400);
    if (bounds.seconds > 0) {
        expect_recovery_within(name, trial, bounds.seconds);
    }
    expect_worst_stretch_at_most(name, trial, stretch);
    expect_last_off_at_most(name, trial, bounds.off);
    expect_kinetic_energy_at_most(name, trial, bounds.joules);
    expect_last_kinetic_energy_at_most(name, trial, bounds.joules / 50);
    CHECK(trial.world().counters().position_clamps == 0);
}

// Of the five starts.
struct AllBounds {
    Bounds mirrored, inside_out, into_20_cm, into_2_mm, thrown_about;
};

void start_all(const std::string& name, const Kind& kind, const AllBounds& bounds) {
    Random random(11);
    const auto within = [&random](double reach) {
        const auto axis = [&] {
            return reach * static_cast<double>(random.between(-1000000, 1000000)) / 1e6;
        };
        return Vector{axis(), axis(), axis()};
    };
    if (!sanitised) {
        start(
            name + ", mirrored", kind, 5000,
            [](std::size_t, const Vector& p) {
                return Vector{-p.x, -p.y, p.z};
            },
            bounds.mirrored);
        start(
            name + ", inside out row by row", kind, 1500,
            [](std::size_t, const Vector& p) {
                return Vector{p.x, std::fmod(std::abs(p.y), 0.2), 0};
            },
            bounds.inside_out);
    }
    start(
        name + ", crumpled into 20 cm", kind, 2500, [&](std::size_t, const Vector&) { return within(0.1); },
        bounds.into_20_cm);
    start(
        name + ", crumpled into 2 mm", kind, 2500, [&](std::size_t, const Vector&) { return within(0.001); },
        bounds.into_2_mm);
    start(
        name + ", thrown about over 20 m", kind, 7e4, [&](std::size_t, const Vector&) { return within(10); },
        bounds.thrown_about);
}

} // namespace

TEST_CASE("a cloth recovers from wherever its particles begin, or keeps a few folds") {
    start_all("inextensible cloth 16 × 16", {stiff(), false},
              {{1.5, 1, 1e4}, {1.5, 1, 1500}, {1.5, 1, 2000}, {0, 12, 2000}, {5, 1, 2e4}});
    if (!sanitised) {
        start_all("soft cloth 16 × 16, 1e-4 m/N", {soft(1e-4, 1), false},
                  {{0, 40, 5000}, {1.5, 1, 1000}, {0, 20, 2000}, {1.5, 1, 2000}, {5, 1, 2e4}});
    }
}

// At other starts than without tethers. Those pull all of it into shape at once, so that what is close
// together is shot harder, and what is far away not as hard.
TEST_CASE("so does a tethered one") {
    if (!sanitised) {
        start_all("tethered inextensible cloth 16 × 16", {stiff(), true},
                  {{0, 15, 1500}, {1.5, 1, 4000}, {1.5, 1, 6000}, {1.5, 1, 6000}, {0, 20, 4000}});
    }
    start_all("tethered soft cloth 16 × 16, 1e-4 m/N", {soft(1e-4, 1), true},
              {{1.5, 1, 2000}, {0, 20, 3000}, {1.5, 1, 6000}, {1.5, 1, 6000}, {5, 1, 4000}});
}
