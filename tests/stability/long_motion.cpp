// A million ticks of motion: nothing grows, and what is to be kept is kept.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stability/support/table.h"
#include "stability/support/trial.h"
#include "support/bodies.h"

using namespace support;
using namespace stability;

namespace {

int ticks_of_motion() {
    return long_runs() ? 1000000 : 3000;
}

std::string scene_of(const std::string& what) {
    return named(what, ", ", ticks_of_motion(), " ticks");
}

Subject moving(Subject subject) {
    subject.world = world_def(60, 10);
    return subject;
}

} // namespace

TEST_CASE("a pendulum swings on and gains nothing") {
    Chain chain;
    chain.segments = 1;
    chain.length = 1;
    const Asset asset = chain.build();
    Trial trial(moving(subject_of(chain, asset)));
    trial.pin(0);
    for (int look = 0; look < 1000; ++look) {
        trial.skip(ticks_of_motion() / 1000 - 1);
        trial.run(1);
    }
    const std::string scene = scene_of("pendulum of 1 m");
    expect_stretch_at_most(scene, trial, 1);
    expect_gain_at_most(scene, trial, 1e-3);
    tell(scene, "energy at the end, below the start's", "J",
         trial.fixed().start().energy - trial.fixed().last().energy,
         trial.single().start().energy - trial.single().last().energy);
}

TEST_CASE("a free net turns and keeps its place") {
    Net net;
    net.side = 6;
    net.width = 1;
    net.particle_mass = 0.1;
    const Asset asset = net.build();
    Subject subject = moving(subject_of(net, asset));
    subject.world.gravity = {};
    Trial trial(subject);
    for (std::uint32_t i = 0; i < trial.size(); ++i) {
        const Vector p = trial.positions()[i];
        trial.set_velocity(i, {-2 * p.y, 2 * p.x, 0});
    }
    trial.begin();
    for (int look = 0; look < 1000; ++look) {
        trial.skip(ticks_of_motion() / 1000 - 1);
        trial.run(1);
    }
    Vector centre, twin_centre;
    for (std::uint32_t i = 0; i < trial.size(); ++i) {
        centre = centre + trial.positions()[i] * (1.0 / 36);
        twin_centre = twin_centre + trial.twin_position(i) * (1.0 / 36);
    }
    const std::string scene = scene_of("net in free space, turning at 2 rad/s");
    expect_stretch_at_most(scene, trial, 1);
    expect_gain_at_most(scene, trial, 1e-3);
    expect_at_most(scene, "centre off", "m", 1e-9, centre.length(), twin_centre.length());
    tell(scene, "kinetic energy left", "%",
         100 * trial.fixed().last().kinetic_energy / trial.fixed().start().kinetic_energy,
         100 * trial.single().last().kinetic_energy / trial.single().start().kinetic_energy);
}

TEST_CASE("a cloth that is led in a circle over a ball stays whole") {
    Net net;
    net.side = 10;
    net.width = 1;
    net.particle_mass = 0.01;
    net.radius = 0.01;
    const Asset asset = net.build();
    Subject subject = moving(subject_of(net, asset));
    subject.transform = at(0, 1, 0);
    Trial trial(subject);
    trial.pin(0);
    trial.pin(9);
    lks_collider_def ball = lks_default_collider_def();
    ball.radius = fixed(0.3);
    ball.transform.position = fixed(0, 0.7, 0);
    trial.add(ball);
    trial.skip(12); // it begins with the ball in it
    trial.begin();
    for (int tick = 0; tick < ticks_of_motion(); ++tick) {
        const double angle = 0.05 * tick;
        const double x = std::cos(angle) - 1, z = std::sin(angle);
        trial.set_target(0, {x - 0.5, 0.5, z});
        trial.set_target(9, {x + 0.5, 0.5, z});
        if (tick % (ticks_of_motion() / 1000) == 0) {
            trial.run(1);
        } else {
            trial.skip(1);
        }
    }
    const std::string scene = scene_of("cloth led in a circle over a ball at 3 m/s");
    expect_stretch_at_most(scene, trial, 1e3);
    expect_kinetic_energy_at_most(scene, trial, 1e3);
    expect_depth_at_most(scene, trial, 1e-5);
    expect_nothing_clamped(trial);
}

TEST_CASE("a body that turns freely keeps its energy") {
    lks_world_def world_settings = world_def(60, 10);
    world_settings.gravity = {};
    World world(world_settings);
    lks_body_def def = lks_default_body_def();
    def.angular_velocity = support::fixed(0.05, 5, 0.02);
    def.never_sleeps = 1;
    const lks_body_id body = add_body(world, box_shape(0.2, 0.3, 0.5), support::fixed(0, 0, 0), def);
    const double start = energy_of(world);
    double highest = start;
    for (int look = 0; look < 1000; ++look) {
        world.step(static_cast<std::uint64_t>(ticks_of_motion() / 1000));
        highest = std::max(highest, energy_of(world));
    }
    const std::string scene = scene_of("box that turns about its middle axis");
    expect_at_most(scene, "energy gained, of the start's", "%", 1e-6, 100 * (highest / start - 1));
    expect_at_least(scene, "energy left, of the start's", "%", 99, 100 * energy_of(world) / start);
    expect_at_most(scene, "centre off", "m", 1e-9, state_of(world, body).position.length());
}

TEST_CASE("a ragdoll that is driven to and fro stays in one piece") {
    World world(world_def(60, 10));
    add_ground(world);
    Humanoid humanoid;
    humanoid.def.transform.position = support::fixed(0, 0.2, 0);
    lks_body_id bodies[LKS_HUMANOID_BONES];
    lks_joint_id joints[LKS_HUMANOID_BONES - 1];
    REQUIRE(humanoid.add(world, bodies, joints) == LKS_OK);
    lks_transform standing[LKS_HUMANOID_BONES];
    REQUIRE(lks_ragdoll_pose(world, bodies, LKS_HUMANOID_BONES, standing) == LKS_OK);
    lks_transform bent[LKS_HUMANOID_BONES];
    std::copy(std::begin(standing), std::end(standing), bent);
    for (const int bone : {LKS_HUMANOID_LOWER_ARM_LEFT, LKS_HUMANOID_UPPER_LEG_RIGHT, LKS_HUMANOID_CHEST}) {
        bent[bone] = turned(standing[bone], 1, 0, 0, -40);
    }
    double apart = 0, energy = 0;
    for (int tick = 0; tick < ticks_of_motion() / 5; ++tick) {
        if (tick % 30 == 0) {
            REQUIRE(lks_ragdoll_drive(world, &humanoid.def, joints, tick % 60 == 0 ? standing : bent,
                                      LKS_FIXED(1), LKS_FIXED_RATIO(1, 10)) == LKS_OK);
        }
        world.step();
        energy = std::max(energy, energy_of(world));
        for (const lks_joint_id joint : joints) {
            lks_fixed error = 0;
            REQUIRE(lks_joint_error(world, joint, &error) == LKS_OK);
            apart = std::max(apart, metres(error));
        }
    }
    const std::string scene = named("ragdoll driven to and fro, ", ticks_of_motion() / 5, " ticks");
    expect_at_most(scene, "joints apart, worst", "mm", 1, 1000 * apart);
    expect_at_most(scene, "kinetic energy, worst", "J", 3e3, energy);
}
