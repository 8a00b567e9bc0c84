// A cloth shot at 500 m/s at a pole, and at a plate: half a metre and eight metres a substep.
#include <doctest/doctest.h>

#include <string>

#include "stability/support/table.h"
#include "stability/support/trial.h"

using namespace support;
using namespace stability;

namespace {

void shoot(const std::string& what, const lks_collider_def& obstacle, std::uint32_t substeps, bool passes,
           double stretch) {
    Net net;
    net.side = 32;
    net.width = 2;
    net.particle_mass = 1.0 / 1024;
    net.radius = 0.01;
    const Asset asset = net.build();
    Subject subject = subject_of(net, asset);
    subject.world = world_def(60, substeps);
    subject.world.gravity = {};
    subject.transform = at(0.013, 0.01, -20);
    subject.velocity = {0, 0, 500};
    Trial trial(subject);
    trial.add(obstacle);
    trial.run(200);
    const std::string scene = named("cloth 32 × 32 at 500 m/s into a ", what, ", 60 Hz × ", substeps);
    expect_depth_at_most(scene, trial, 1e-5);
    expect_stretch_at_most(scene, trial, stretch);
    if (substeps > 1) {
        expect_recovery_within(scene, trial, 3);
    }
    expect_last_stretch_at_most(scene, trial, substeps > 1 ? 5 : stretch);
    expect_gain_at_most(scene, trial, 1e-6);
    if (!passes) {
        double beyond = -1e9, twin_beyond = -1e9;
        for (std::uint32_t i = 0; i < trial.size(); ++i) {
            beyond = std::max(beyond, trial.positions()[i].z - 20);
            twin_beyond = std::max(twin_beyond, trial.twin_position(i).z - 20);
        }
        expect_at_most(scene, "farthest particle, from the plate's middle", "m", -0.035 + 1e-5, beyond,
                       twin_beyond);
    }
    CHECK(trial.world().counters().position_clamps == 0);
}

} // namespace

TEST_CASE("a cloth at 500 m/s meets a pole and a plate and stays whole") {
    lks_collider_def pole = lks_default_collider_def();
    pole.shape = LKS_SHAPE_CAPSULE;
    pole.radius = fixed(0.05);
    pole.half_length = fixed(5);
    lks_collider_def plate = lks_default_collider_def();
    plate.shape = LKS_SHAPE_BOX;
    plate.half_extents = fixed(25, 25, 0.025);
    for (const std::uint32_t substeps : {20u, 1u}) {
        shoot("pole of 10 cm", pole, substeps, true, 2e4);
        shoot("plate of 5 cm", plate, substeps, false, 1e-6);
    }
}
