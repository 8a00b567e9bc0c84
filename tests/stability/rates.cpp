// Ticks of 10 to 1000 Hz, with 1 to 100 substeps.
#include <doctest/doctest.h>

#include <string>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

struct Rate {
    std::uint32_t hz, substeps;
    double stretch; // percent
};

// Of 32 × 32, let go when it is level, for three seconds.
void hang(const Rate& rate) {
    Net net;
    net.side = 32;
    net.particle_mass = 1.0 / (32 * 32);
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.world = world_def(rate.hz, rate.substeps);
    subject.transform = turned(lks_transform_identity(), 1, 0, 0, 90);
    Trial trial(subject);
    trial.pin(0);
    trial.pin(net.side - 1);
    const double seconds = long_runs() ? 3 : rate.hz * rate.substeps > 20000 ? 0.1 : 1;
    trial.run(static_cast<int>(seconds * rate.hz));
    const std::string name = named("cloth 32 × 32, ", rate.hz, " Hz × ", rate.substeps);
    expect_stretch_at_most(name, trial, rate.stretch);
    // At 100,000 substeps a second the roundings of projections, 2^-31 m and more, are speeds.
    expect_gain_at_most(name, trial, rate.hz * rate.substeps > 20000 ? 20 : 1);
    expect_nothing_clamped(trial);
}

} // namespace

TEST_CASE("a cloth hangs at any tick rate and any number of substeps") {
    for (const Rate& rate :
         {Rate{10, 1, 6e4}, Rate{10, 10, 1e3}, Rate{10, 100, 30}, Rate{30, 1, 1e4}, Rate{60, 1, 2500},
          Rate{60, 5, 200}, Rate{60, 20, 20}, Rate{60, 100, 2}, Rate{240, 1, 300}, Rate{240, 20, 4},
          Rate{1000, 1, 25}, Rate{1000, 10, 1}, Rate{1000, 100, 0.25}}) {
        hang(rate);
    }
}
