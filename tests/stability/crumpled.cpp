// Cloths that begin where no cloth can be: mirrored, turned inside out, crumpled into a ball, blown up.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

struct Bounds {
    double seconds; // until it has recovered; 0: it may keep folds
    double off;     // percent of the edges, at the end
    double joules;  // kinetic, worst
};

// Hanging from its upper corners, which stay; everything else begins at place(vertex, where it was).
template <typename Place>
void start(const std::string& name, const lks_distance_material& material, const Place& place,
           const Bounds& bounds) {
    Net net;
    net.side = 16;
    net.width = 1.5;
    net.particle_mass = 1.0 / 256;
    net.stretch = net.shear = net.bend = material;
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
    expect_last_off_at_most(name, trial, bounds.off);
    expect_kinetic_energy_at_most(name, trial, bounds.joules);
    expect_last_kinetic_energy_at_most(name, trial, bounds.joules / 50);
    CHECK(trial.world().counters().position_clamps == 0);
}

void start_all(const std::string& kind, const lks_distance_material& material) {
    const bool soft_one = material.compliance > 0;
    Random random(11);
    const auto within = [&random](double reach) {
        const auto axis = [&] {
            return reach * static_cast<double>(random.between(-1000000, 1000000)) / 1e6;
        };
        return Vector{axis(), axis(), axis()};
    };
    start(kind + ", mirrored", material,
          [](std::size_t, const Vector& p) {
              return Vector{-p.x, -p.y, p.z};
          },
          {soft_one ? 0 : 1.5, soft_one ? 40.0 : 1, 1e4});
    start(kind + ", inside out row by row", material,
          [](std::size_t, const Vector& p) {
              return Vector{p.x, std::fmod(std::abs(p.y), 0.2), 0};
          },
          {1.5, 1, 1500});
    start(kind + ", crumpled into 20 cm", material, [&](std::size_t, const Vector&) { return within(0.1); },
          {soft_one ? 0 : 1.5, soft_one ? 20.0 : 1, 2000});
    start(kind + ", crumpled into 2 mm", material, [&](std::size_t, const Vector&) { return within(0.001); },
          {soft_one ? 1.5 : 0, soft_one ? 1.0 : 12, 2000});
    start(kind + ", thrown about over 20 m", material, [&](std::size_t, const Vector&) { return within(10); },
          {5, 1, 2e4});
}

} // namespace

TEST_CASE("a cloth recovers from wherever its particles begin") {
    start_all("inextensible cloth 16 × 16", stiff());
    start_all("soft cloth 16 × 16, 1e-4 m/N", soft(1e-4, 1));
}
