// A million ticks of motion: nothing grows, and what is to be kept is kept. Every tick is looked at.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
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
    trial.run(ticks_of_motion());
    const std::string scene = scene_of("pendulum of 1 m");
    expect_stretch_at_most(scene, trial, 1e-5);
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
    trial.run(ticks_of_motion());
    Vector centre, twin_centre;
    for (std::uint32_t i = 0; i < trial.size(); ++i) {
        centre = centre + trial.positions()[i] * (1.0 / 36);
        twin_centre = twin_centre + trial.twin_position(i) * (1.0 / 36);
    }
    const std::string scene = scene_of("net in free space, turning at 2 rad/s");
    expect_stretch_at_most(scene, trial, 0.01);
    expect_gain_at_most(scene, trial, 1e-3);
    expect_at_most(scene, "centre off", "m", 1e-9, centre.length(), twin_centre.length());
    tell(scene, "kinetic energy left", "%",
         100 * trial.fixed().last().kinetic_energy / trial.fixed().start().kinetic_energy,
         100 * trial.single().last().kinetic_energy / trial.single().start().kinetic_energy);
}

TEST_CASE("a rope with a weight that is led in a circle stays whole") {
    Chain chain;
    chain.segments = 20;
    chain.length = 2;
    chain.particle_mass = 0.01;
    chain.end_mass = 1;
    chain.direction = {0, -1, 0};
    const Asset asset = chain.build();
    Subject subject = moving(subject_of(chain, asset));
    Trial trial(subject);
    trial.pin(0);
    double angle = 0;
    for (int tick = 0; tick < ticks_of_motion(); ++tick) {
        // Faster than it would swing by itself, and slower.
        angle += tick / 600 % 2 == 0 ? 0.05 : 0.02;
        trial.set_target(0, {0.2 * (std::cos(angle) - 1), 0, 0.2 * std::sin(angle)});
        trial.run(1);
    }
    const std::string scene = scene_of("rope of 20, 1:100 at the end, led in a circle");
    expect_stretch_at_most(scene, trial, 1e-3);
    expect_kinetic_energy_at_most(scene, trial, 10);
    expect_nothing_clamped(trial);
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
        trial.run(1);
    }
    const std::string scene = scene_of("cloth led in a circle over a ball at 3 m/s");
    expect_worst_stretch_at_most(scene, trial, 1e3);
    expect_kinetic_energy_at_most(scene, trial, 1e3);
    expect_depth_at_most(scene, trial, 1e-5);
    expect_nothing_clamped(trial);
}

TEST_CASE("a body that turns freely keeps its energy") {
    lks_world_def settings = world_def(60, 10);
    settings.gravity = {};
    Jointed scene(settings);
    lks_body_def def = lks_default_body_def();
    def.angular_velocity = support::fixed(0.05, 5, 0.02);
    const std::size_t body = scene.add(box_shape(0.2, 0.3, 0.5), def);
    const double start = scene.kinetic_energy();
    const double twin_start = scene.twin_kinetic_energy();
    Worst highest{start, twin_start};
    for (int tick = 0; tick < ticks_of_motion(); ++tick) {
        scene.step();
        highest.add(scene.kinetic_energy(), scene.twin_kinetic_energy());
    }
    const std::string name = scene_of("box that turns about its middle axis");
    expect_at_most(name, "energy gained, of the start's", "%", 1e-6, 100 * (highest.fixed / start - 1),
                   100 * (highest.single / twin_start - 1));
    expect_at_least(name, "energy left, of the start's", "%", 99, 100 * scene.kinetic_energy() / start,
                    100 * scene.twin_kinetic_energy() / twin_start);
    expect_at_most(name, "centre off", "m", 1e-9, scene.position(body).length(),
                   scene.twin_position(body).length());
}

TEST_CASE("a ragdoll that is driven to and fro stays in one piece") {
    Jointed scene(world_def(60, 10));
    scene.add_ground(0.5, true);
    Humanoid humanoid;
    lks_body_id bodies[LKS_HUMANOID_BONES];
    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
        lks_body_def def = humanoid.bones[i].body;
        def.transform.position = def.transform.position + support::fixed(0, 0.2, 0);
        bodies[i] = scene.id(scene.add(humanoid.shapes[i], def));
        if (i > 0) {
            scene.join(reference::joint_of_bone(humanoid.bones, i), humanoid.bones[i].parent, i);
        }
    }
    lks_transform standing[LKS_HUMANOID_BONES];
    REQUIRE(lks_ragdoll_pose(scene.world(), bodies, LKS_HUMANOID_BONES, standing) == LKS_OK);
    lks_transform bent[LKS_HUMANOID_BONES];
    std::copy(std::begin(standing), std::end(standing), bent);
    for (const int bone : {LKS_HUMANOID_LOWER_ARM_LEFT, LKS_HUMANOID_UPPER_LEG_RIGHT, LKS_HUMANOID_CHEST}) {
        bent[bone] = turned(standing[bone], 1, 0, 0, -40);
    }
    Worst apart, energy;
    for (int tick = 0; tick < ticks_of_motion(); ++tick) {
        if (tick % 30 == 0) {
            REQUIRE(lks_ragdoll_drive(scene.world(), &humanoid.def, scene.joints().data(),
                                      tick % 60 == 0 ? standing : bent, LKS_FIXED(1),
                                      LKS_FIXED_RATIO(1, 10)) == LKS_OK);
            scene.follow_motors();
        }
        scene.step();
        energy.add(scene.kinetic_energy(), scene.twin_kinetic_energy());
        apart.add(scene.gap(), scene.twin_gap());
    }
    const std::string name = scene_of("ragdoll driven to and fro");
    expect_at_most(name, "joints apart, worst", "mm", 0.2, 1000 * apart.fixed, 1000 * apart.single);
    expect_at_most(name, "kinetic energy, worst", "J", 3e3, energy.fixed, energy.single);
}
