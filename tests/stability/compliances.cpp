// Rigid and limp side by side in one cloth: stretch, shear and bend each from 0 to 1000 m/N.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "stability/support/nets.h"
#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

lks_distance_material material(double compliance) {
    return compliance > 0 ? soft(compliance) : stiff();
}

struct Worst {
    double gained = 0, reach = 0, stretch = 0, off = 0;

    void add(const Course& course) {
        gained = course.gained_share() <= gained ? gained : course.gained_share();
        reach = course.worst().reach <= reach ? reach : course.worst().reach;
        off = course.last().off <= off ? off : course.last().off;
        stretch = course.worst().stretch <= stretch ? stretch : course.worst().stretch;
    }
};

void hang(Worst& fixed, Worst& single, bool tethered, double stretch, double shear, double bend) {
    Net net = small_net(tethered);
    net.stretch = material(stretch);
    net.shear = material(shear);
    net.bend = material(bend);
    HangingNet hanging(net);
    Trial& trial = hanging.trial;
    trial.run(long_runs() ? 240 : 60);
    CHECK(trial.fixed().is_finite());
    fixed.add(trial.fixed());
    single.add(trial.single());
}

constexpr double values[] = {0, 1e-9, 1e-5, 1e-2, 1, 1e3};

// The worst of all shears and bends, percent and metres.
struct Bounds {
    double stretch, reach;
    double off = 0; // 0: the threads themselves are limp
};

void hang_all(double stretch, bool tethered, const Bounds& bounds) {
    Worst fixed, single;
    for (const double other : values) {
        if (!sanitised) {
            hang(fixed, single, tethered, stretch, other, stretch);
        }
        hang(fixed, single, tethered, stretch, other, other);
    }
    const std::string name = named(tethered ? "tethered cloth" : "cloth", " 12 × 12, stretch ", stretch,
                                   " m/N, shear and bend 0 to 1000");
    expect_at_most(name, "energy gained, of the greatest motion", "%", 1, 100 * fixed.gained,
                   100 * single.gained);
    expect_at_most(name, "stretch, worst", "%", bounds.stretch, 100 * fixed.stretch, 100 * single.stretch);
    if (bounds.off > 0) {
        expect_at_most(name, "edges still off, at the end", "%", bounds.off, 100 * fixed.off,
                       100 * single.off);
    }
    // Held by two corners. With all of it limp it falls for a second, or for four.
    expect_at_most(name, "reach, worst", "m", bounds.reach, fixed.reach, single.reach);
}

} // namespace

TEST_CASE("compliances from 0 to 1000 m/N side by side gain no energy") {
    for (const bool tethered : {false, true}) {
        if (tethered && sanitised) {
            continue;
        }
        // What is limp may come together: that counts as 100 %.
        const double stiff_stretch = long_runs() ? 200 : tethered ? 60 : 100;
        hang_all(0, tethered, {stiff_stretch, 2, tethered ? 7.5 : 30});
        hang_all(1e-9, tethered, {stiff_stretch, 2, tethered ? 7.5 : 30});
        hang_all(1e-5, tethered, {stiff_stretch, 2, tethered ? 15. : 32});
        hang_all(1e-2, tethered, {400, 2, 82});
        // In a second it falls by 4.9 m, in four by 78.
        hang_all(1, tethered, {long_runs() ? 5e4 : 5e3, long_runs() ? 100. : 10});
        hang_all(1e3, tethered, {long_runs() ? 2e5 : 1.2e4, long_runs() ? 100. : 10});
    }
}
