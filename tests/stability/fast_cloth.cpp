// A cloth shot at 500 m/s at a pole, and at a plate: half a metre and eight metres a substep.
#include <doctest/doctest.h>

#include <string>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

struct Shot {
    std::string what;
    bool passes;         // the obstacle
    double stretch, end; // percent, worst and at the end
    double seconds = 3;  // until it has recovered; 0: it does not
    double off = 1;      // percent of the edges, at the end
    bool held = false;   // by two corners close to the obstacle
    bool tethered = false;
    bool clamped = false; // to the ends of its range
};

void shoot(const Shot& shot, const lks_collider_def& obstacle, std::uint32_t substeps) {
    Net net;
    net.side = 32;
    net.width = 2;
    net.particle_mass = 1.0 / 1024;
    net.radius = 0.01;
    if (shot.tethered) {
        net.anchors = {0, 31};
    }
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.world = world_def(60, substeps);
    subject.world.gravity = {};
    subject.transform = at(0.013, 0.01, shot.held ? -0.5 : -20);
    subject.velocity = {0, 0, 500};
    Trial trial(subject);
    if (shot.held) {
        trial.pin(0);
        trial.pin(31);
    }
    trial.add(obstacle);
    trial.run(200);
    const std::string scene = named(shot.tethered ? "tethered cloth" : "cloth", " 32 × 32",
                                    shot.held ? ", held by two corners," : "", " at 500 m/s into a ",
                                    shot.what, ", 60 Hz × ", substeps);
    expect_depth_at_most(scene, trial, 1e-5);
    expect_worst_stretch_at_most(scene, trial, shot.stretch);
    if (shot.seconds > 0) {
        expect_recovery_within(scene, trial, shot.seconds);
    }
    CHECK((trial.world().counters().position_clamps != 0) == shot.clamped);
    expect_last_off_at_most(scene, trial, shot.off);
    expect_last_stretch_at_most(scene, trial, shot.end);
    expect_gain_at_most(scene, trial, 1e-6);
    if (!shot.passes) {
        double beyond = -1e9, twin_beyond = -1e9;
        for (std::uint32_t i = 0; i < trial.size(); ++i) {
            beyond = std::max(beyond, trial.positions()[i].z - 20);
            twin_beyond = std::max(twin_beyond, trial.twin_position(i).z - 20);
        }
        expect_at_most(scene, "farthest particle, from the plate's middle", "m", -0.035 + 1e-5, beyond,
                       twin_beyond);
    }
}

lks_collider_def a_pole() {
    lks_collider_def pole = lks_default_collider_def();
    pole.shape = LKS_SHAPE_CAPSULE;
    pole.radius = fixed(0.05);
    pole.half_length = fixed(5);
    return pole;
}

} // namespace

TEST_CASE("a cloth at 500 m/s meets a pole and a plate and stays whole") {
    const lks_collider_def pole = a_pole();
    lks_collider_def plate = lks_default_collider_def();
    plate.shape = LKS_SHAPE_BOX;
    plate.half_extents = fixed(25, 25, 0.025);
    shoot({"pole of 10 cm", true, 2e4, 5}, pole, 20);
    shoot({"plate of 5 cm", false, 1e-6, 1e-6}, plate, 20);
    // With a single substep it stays stretched where it met the pole.
    shoot({"pole of 10 cm", true, 2e4, 150, 0, 30}, pole, 1);
    shoot({"plate of 5 cm", false, 1e-6, 1e-6}, plate, 1);
}

TEST_CASE("a cloth that is held by two corners and shot at 500 m/s at a pole stays whole, with and without "
          "tethers") {
    // In free space nothing unwinds what was slung around the pole. With a single substep, eight metres of
    // it, nothing but tethers keeps it from the ends of its range.
    shoot({"pole of 10 cm", true, 5e3, 300, 0, 5, true, false}, a_pole(), 20);
    shoot({"pole of 10 cm", true, 2e3, 300, 0, 5, true, true}, a_pole(), 20);
    shoot({"pole of 10 cm", true, 2e5, 2e4, 0, 90, true, false, true}, a_pole(), 1);
    shoot({"pole of 10 cm", true, 8e3, 150, 0, 13, true, true}, a_pole(), 1);
}
