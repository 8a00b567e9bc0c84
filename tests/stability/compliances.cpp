// Rigid and limp side by side in one cloth: stretch, shear and bend each from 0 to 1000 m/N.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

lks_distance_material material(double compliance) {
    return compliance > 0 ? soft(compliance) : stiff();
}

struct Worst {
    double gained = 0, reach = 0;

    void add(const Course& course) {
        gained = course.gained_share() <= gained ? gained : course.gained_share();
        reach = course.worst().reach <= reach ? reach : course.worst().reach;
    }
};

void hang(Worst& fixed, Worst& single, double stretch, double shear, double bend) {
    Net net;
    net.side = 12;
    net.width = 1;
    net.particle_mass = 0.01;
    net.stretch = material(stretch);
    net.shear = material(shear);
    net.bend = material(bend);
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.transform = turned(lks_transform_identity(), 1, 0, 0, 90);
    Trial trial(subject);
    trial.pin(0);
    trial.pin(net.side - 1);
    trial.run(long_runs() ? 240 : 60);
    CHECK(trial.fixed().is_finite());
    fixed.add(trial.fixed());
    single.add(trial.single());
}

} // namespace

TEST_CASE("compliances from 0 to 1000 m/N side by side gain no energy") {
    const double values[] = {0, 1e-9, 1e-5, 1e-2, 1, 1e3};
    for (const double stretch : values) {
        Worst fixed, single;
        for (const double other : values) {
            hang(fixed, single, stretch, other, stretch);
            hang(fixed, single, stretch, other, other);
        }
        const std::string name = named("cloth 12 × 12, stretch ", stretch, " m/N, shear and bend 0 to 1000");
        expect_at_most(name, "energy gained, of the greatest motion", "%", 1, 100 * fixed.gained,
                       100 * single.gained);
        // Held by two corners. With all of it limp it falls for four seconds.
        expect_at_most(name, "reach, worst", "m", stretch < 1 ? 2 : 100, fixed.reach, single.reach);
    }
}
