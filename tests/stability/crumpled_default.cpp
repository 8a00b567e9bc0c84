// The default material, crumpled at random into a heap above the ground. Folds it can't get out of move for
// ever: nothing damps it. Where shear and bend are damped far beyond critical it comes to rest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

struct Bounds {
    double factor;     // of the critical damping of shear and bend
    double joules;     // kinetic, worst
    double end_joules; // after 20 s
    double off;        // percent of the edges, then
};

lks_distance_material damped(lks_distance_material material, double factor, double mass) {
    material.damping = factor * 2 * std::sqrt(mass / material.compliance);
    return material;
}

// A metre of 16 × 16 vertices and a kilogram.
Net default_net(double factor) {
    Net net = kilogram_net(16, 1);
    const lks_cloth_def def = lks_default_cloth_def();
    net.stretch = def.stretch;
    net.shear = damped(def.shear, factor, net.particle_mass);
    net.bend = damped(def.bend, factor, net.particle_mass);
    return net;
}

struct Heap {
    double reach; // m: of the places on each axis
    std::uint64_t seed;
};

// The worst of all starts.
void crumple(const std::vector<Heap>& heaps, int ticks, const Bounds& bounds) {
    const Net net = default_net(bounds.factor);
    const Asset asset = net.build();
    Worst energy, end_energy, off, stretch;
    for (const Heap& heap : heaps) {
        Subject subject = subject_of(net, asset);
        subject.transform = at(0, 1, 0);
        Trial trial(subject);
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        trial.add(ground);
        Random random(heap.seed);
        const auto axis = [&] {
            return heap.reach * static_cast<double>(random.between(-1000000, 1000000)) / 1e6;
        };
        std::vector<Vector> places(trial.size());
        for (Vector& place : places) {
            place = {axis(), axis(), axis()};
        }
        trial.put(places);
        trial.begin();
        trial.run(ticks);
        const auto add = [&](Worst& worst, const auto& figure) {
            worst.add(figure(trial.fixed()), figure(trial.single()));
        };
        add(energy, [](const Course& course) { return course.worst().kinetic_energy; });
        add(end_energy, [](const Course& course) { return course.last().kinetic_energy; });
        add(off, [](const Course& course) { return 100 * course.last().off; });
        add(stretch, [](const Course& course) { return 100 * course.worst().stretch; });
        expect_nothing_clamped(trial);
    }
    const std::string scene =
        named(heaps.size(), " default cloths 16 × 16, crumpled",
              bounds.factor > 0 ? named(", shear and bend damped, ", bounds.factor, " × critical") : "");
    expect_at_most(scene, "stretch, worst", "%", 5000, stretch.fixed, stretch.single);
    expect_at_most(scene, "kinetic energy, worst", "J", bounds.joules, energy.fixed, energy.single);
    expect_at_most(scene, "kinetic energy, after 20 s, the most", "J", bounds.end_joules, end_energy.fixed,
                   end_energy.single);
    expect_at_most(scene, "edges still off, the most", "%", bounds.off, off.fixed, off.single);
}

} // namespace

TEST_CASE("crumpled cloths of the default material keep moving within bounds, and rest where shear and bend "
          "are damped") {
    std::vector<Heap> heaps;
    for (const double reach : {0.1, 0.25, 0.5}) {
        for (std::uint64_t seed = 1; seed <= (sanitised ? 1u : long_runs() ? 8u : 2u); ++seed) {
            heaps.push_back({reach, seed});
        }
    }
    const int ticks = sanitised ? 240 : 1200;
    crumple(heaps, ticks, {0, 700, 200, 40});
    crumple(heaps, ticks, {10, 200, sanitised ? 50 : 0.01, 50});
    crumple(heaps, ticks, {100, 50, sanitised ? 10 : 1e-6, 60});
}
