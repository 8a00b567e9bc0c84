// Fine inextensible cloths don't explode, at any number of substeps; the same constraints in index order do,
// even in double precision. The order is what does it (docs/numbers.md).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "reference/asset_model.h"
#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

struct Bound {
    std::uint32_t side;
    std::uint32_t substeps;
    int ticks;
    double stretch; // percent, at any tick
    Aftermath aftermath{};
};

// A cloth of one kilogram, released horizontally, hanging from two corners. An inextensible cloth between
// fixed pins stores nothing: motion beyond what gravity has given would come from nowhere.
void hang(const Bound& bound) {
    Net net;
    net.side = bound.side;
    net.particle_mass = 1.0 / (static_cast<double>(bound.side) * bound.side);
    HangingNet hanging(net, world_def(60, bound.substeps));
    Trial& trial = hanging.trial;
    trial.run(bound.ticks);
    const std::string scene =
        named("cloth ", bound.side, " × ", bound.side, ", ", bound.substeps, " × 1, ", bound.ticks, " ticks");
    expect_stretch_at_most(scene, trial, bound.stretch, bound.aftermath);
    expect_gain_at_most(scene, trial, 0.1);
    expect_nothing_clamped(trial);
}

} // namespace

TEST_CASE("a cloth of 64 x 64 never explodes at 5 x 1 and 20 x 1 and 80 x 1") {
    hang({64, 5, long_runs() ? 300 : 60, 800, {0, 64}});
    hang({64, 20, long_runs() ? 300 : 40, 100, {0, 4.5}});
    hang({64, 80, long_runs() ? 600 : 8, 15});
}

TEST_CASE("a cloth of 256 x 256 never explodes at 5 x 1 and 20 x 1 and 80 x 1") {
    const bool whole = long_runs();
    hang({256, 5, whole ? 300 : 8, whole ? 40000. : 400, {0, whole ? 86. : 0}});
    hang({256, 20, whole ? 300 : 2, whole ? 3000. : 7, {0, whole ? 62. : 0}});
    hang({256, 80, whole ? 300 : 1, whole ? 300. : 0.6, {0, whole ? 1. : 0}});
}

TEST_CASE("the same cloth in index order explodes in double precision and in colour order does not") {
    Net net;
    net.side = 64;
    net.particle_mass = 1.0 / (64.0 * 64.0);
    const Asset asset = net.build();
    World world(world_def(60, 20));
    const lks_object_id object = world.add(asset, turned(lks_transform_identity(), 1, 0, 0, 90));
    const std::vector<double> masses(asset.vertex_count(), net.particle_mass);
    const reference::Materials materials{net.stretch, net.shear, net.bend};
    reference::Settings settings;
    settings.substeps = 20;

    double energy[2] = {};
    double stretch[2] = {};
    double single_energy[2] = {};
    double single_stretch[2] = {};
    const auto hang_in = [&](auto& solver, double& most_energy, double& most_stretch) {
        solver.pin(0);
        solver.pin(net.side - 1);
        for (int tick = 0; tick < (sanitised ? 20 : 120) && std::isfinite(most_stretch); ++tick) {
            solver.tick();
            most_energy = std::max(most_energy, solver.kinetic_energy());
            most_stretch = std::max(most_stretch, solver.worst_stretch());
        }
    };
    for (const reference::EdgeOrder order : {reference::EdgeOrder::canonical, reference::EdgeOrder::index}) {
        const bool sorted = order == reference::EdgeOrder::index;
        const reference::Model model = model_of(world, object, asset, {}, masses, materials, order);
        reference::Solver<double> solver(model, settings);
        hang_in(solver, energy[sorted], stretch[sorted]);
        reference::Solver<float> single(model, settings);
        hang_in(single, single_energy[sorted], single_stretch[sorted]);
    }
    const std::string scene = "cloth 64 × 64, 20 × 1, 2 s, double precision";
    expect_at_most(scene, "kinetic energy, in the order of colours", "J", 20, energy[0], single_energy[0]);
    expect_at_most(scene, "stretch, in the order of colours", "%", 100, 100 * stretch[0],
                   100 * single_stretch[0]);
    // A kilogram of cloth faster than sound. (Later than what a sanitizer has the time for.)
    expect_at_least(scene, "kinetic energy, in the order of indices", "J", sanitised ? 0 : 1e5, energy[1],
                    single_energy[1]);
}
