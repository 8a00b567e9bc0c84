// Cloths of 2 × 2 to 512 × 512, with edges of a micrometre and of ten metres.
#include <doctest/doctest.h>

#include <string>

#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

struct Size {
    std::uint32_t side;
    double edge;
    std::uint32_t hz, substeps;
    int ticks;
    double stretch; // percent
    double tethered_stretch;
    Aftermath aftermath{};
    Aftermath tethered{};
};

void hang(const Size& size, bool tethered) {
    Net net;
    net.side = size.side;
    net.width = size.edge * (size.side - 1);
    net.particle_mass = 1.0 / (static_cast<double>(size.side) * size.side);
    if (tethered) {
        net.anchors = {0, size.side - 1};
    }
    HangingNet hanging(net, world_def(size.hz, size.substeps));
    Trial& trial = hanging.trial;
    trial.run(size.ticks);
    const std::string name =
        named(tethered ? "tethered cloth " : "cloth ", size.side, " × ", size.side, ", edges of ", size.edge,
              " m, ", size.hz, " Hz × ", size.substeps, ", ", size.ticks, " ticks");
    expect_stretch_at_most(name, trial, tethered ? size.tethered_stretch : size.stretch,
                           tethered ? size.tethered : size.aftermath);
    expect_gain_at_most(name, trial, 1);
    expect_nothing_clamped(trial);
}

void hang(const Size& size) {
    hang(size, false);
    hang(size, true);
}

} // namespace

TEST_CASE("cloths with edges of a centimetre hang whatever their number") {
    hang({2, 0.01, 60, 20, 60, 1e-4, 0.1});
    hang({3, 0.01, 60, 20, 60, 3, 2});
    hang({8, 0.01, 60, 20, 60, 6, 6});
    hang({64, 0.01, 60, 20, 60, 300, 30, {0, 3}, {1}});
    if (long_runs()) {
        hang({512, 0.01, 60, 20, 120, 1e4, 1e4, {0, 70}, {0, 10}});
    } else {
        hang({512, 0.01, 60, 20, 1, 2, 2});
    }
}

TEST_CASE("cloths with edges of a micrometre hang") {
    // In a substep of 1/1200 s gravity moves a particle by seven of their edges.
    hang({2, 1e-6, 60, 20, 60, 0.01, 40, {}, {0, 45}});
    hang({8, 1e-6, 60, 20, 60, 1e4, 300, {0, 95.5}, {0, 83}});
    if (!sanitised) {
        hang({64, 1e-6, 60, 20, 30, 1.5e6, 500, {0, 90}, {0, 80}});
    }
    hang({2, 1e-6, 1000, 100, 20, 0.01, 0.01});
    hang({8, 1e-6, 1000, 100, 20, 8, 8});
    hang({64, 1e-6, 1000, 100, 5, 500, 40, {0, 22}, {0, 6}});
    if (long_runs()) {
        hang({512, 1e-6, 1000, 100, 20, 2e4, 2e4, {0, 70}, {0, 20}});
    }
}

TEST_CASE("cloths with edges of ten metres hang") {
    hang({2, 10, 60, 20, 600, 1e-5, 1e-4});
    hang({4, 10, 60, 20, 600, 0.1, 0.1});
    if (!sanitised) {
        hang({8, 10, 60, 20, 600, 0.3, 0.3});
        hang({12, 10, 60, 20, 600, 0.4, 0.3});
    }
}

TEST_CASE("cloths as large as an object hang whatever their number") {
    hang({64, 1.75, 60, 20, sanitised ? 10 : 60, 3, 0.6});
    hang({512, 0.215, 60, 20, long_runs() ? 120 : 1, long_runs() ? 350 : 0.005, long_runs() ? 14 : 0.005});
}

TEST_CASE("cloths of 64 x 64 and 512 x 512 with edges of ten metres are larger than an object, and refused") {
    for (const std::uint32_t side : {64u, 512u}) {
        Net net;
        net.side = side;
        net.width = 10.0 * (side - 1);
        lks_cloth_def def = net.def();
        def.mass = 1;
        lks_asset* asset = nullptr;
        CHECK(lks_asset_create_cloth(&def, &asset) == LKS_ERROR_INVALID_ARGUMENT);
        lks_asset_release(asset);
    }
}
