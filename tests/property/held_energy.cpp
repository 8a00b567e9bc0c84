// A figure that is held takes no energy out of nothing (sdk/src/rigid/held_energy.h), and all that it is
// given.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"
#include "support/hanging_figure.h"

using namespace support;

namespace {

struct Stops {
    double most;  // J gained
    double apart; // m
    int risen;    // by more than 20 J
};

// Led at a speed by a bone for so long, and so much longer; then it stops dead.
Stops stop_dead(int bone, double speed, std::uint32_t substeps, int step) {
    Stops all{};
    for (int ticks = 150; ticks < 350; ticks += step) {
        World world(world_def(60, substeps));
        HangingFigure hanging(world, bone, about(0, 1, 0, 0));
        hanging.lead(speed, ticks);
        for (int tick = 0; tick < 60; ++tick) {
            hanging.step();
        }
        all = {std::max(all.most, hanging.rise()), std::max(all.apart, hanging.apart()),
               all.risen + (hanging.rise() > 20 ? 1 : 0)};
    }
    return all;
}

// Two rods of which one hangs on a kinematic body and hardly swings against it, the other one on the first,
// as freely as `second_swing` lets it.
struct TwoRods {
    TwoRods(double first, double second, double second_swing = 170) : world(world_def(60, 8)) {
        anchor = add_anchor(world, {});
        rods[0] = add_rod(-0.25, first);
        rods[1] = add_rod(-0.75, second);
        lks_joint_def def = lks_default_joint_def();
        def.swing_limit = fixed(2);
        def.twist_min = fixed(-2);
        def.twist_max = fixed(2);
        def.frame_b.position = fixed(0, 0.25, 0);
        joints[0] = add_joint(world, def, anchor, rods[0]);
        def.frame_a.position = fixed(0, -0.25, 0);
        def.swing_limit = fixed(second_swing);
        joints[1] = add_joint(world, def, rods[0], rods[1]);
    }
    lks_body_id add_rod(double height, double density) {
        return add_body(world, box_shape(0.05, 0.25, 0.05, density), fixed(0, height, 0));
    }
    double swing(int joint) const {
        lks_fixed swing = 0;
        REQUIRE(lks_joint_angles(world, joints[joint], &swing, nullptr) == LKS_OK);
        return metres(swing);
    }

    World world;
    lks_body_id anchor{};
    lks_body_id rods[2]{};
    lks_joint_id joints[2]{};
};

} // namespace

// An arm that whips straight between the hand that is held and 78 kg.
TEST_CASE("a figure that is led by a bone which stops dead gains nothing") {
    struct Led {
        int bone;
        double speed;
        std::uint32_t substeps;
        int step;
    };
    for (const Led& led : {Led{LKS_HUMANOID_HAND_LEFT, 6, 4, 8}, Led{LKS_HUMANOID_HAND_RIGHT, 6, 4, 8},
                           Led{LKS_HUMANOID_HAND_LEFT, 6, 8, 16}, Led{LKS_HUMANOID_HAND_LEFT, 6, 20, 20},
                           Led{LKS_HUMANOID_FOOT_RIGHT, 12, 4, 20}}) {
        const Stops stops = stop_dead(led.bone, led.speed, led.substeps, led.step);
        MESSAGE("bone " << led.bone << ", " << led.speed << " m/s, " << led.substeps << " substeps: "
                        << stops.most << " J gained at the most, " << 1e3 * stops.apart << " mm apart");
        CHECK(stops.risen == 0); // of 4 to 9.5 kJ
        CHECK(stops.apart < 15e-3);
    }
}

// Faster and faster, by three radians a second in a tick.
TEST_CASE("what holds a figure turns it along") {
    TwoRods arm(200, 4000, 2);
    REQUIRE(lks_world_set_gravity(arm.world, {}) == LKS_OK);
    double beyond = 0;
    int tick = 0;
    for (; tick <= 10; ++tick) {
        const lks_transform to{{}, about(0, 0, 1, 1.5 * tick * tick)};
        REQUIRE(lks_body_move_to(arm.world, arm.anchor, to) == LKS_OK);
        arm.world.step();
        beyond = std::max(beyond, arm.swing(0) - 2);
    }
    const double spin = 1.5 * (100 - 81) * 60 * std::acos(-1.0) / 180; // of the holder, rad/s
    const double own = (0.05 * 0.05 + 0.25 * 0.25) / 3;
    const double expected = spin * spin * (1 * (own + 0.25 * 0.25) + 20 * (own + 0.75 * 0.75)) / 2;
    MESSAGE("turned along: " << beyond << " degrees beyond, energy " << energy_of(arm.world) / expected
                             << " of what it is at the holder's spin");
    CHECK(beyond < 0.2);
    CHECK(std::abs(energy_of(arm.world) / expected - 1) < 0.2);
}

TEST_CASE("a motor in a figure that strains against its limits gives it all of its work") {
    TwoRods arm(200, 4000);
    REQUIRE(lks_world_set_gravity(arm.world, {}) == LKS_OK);
    const lks_motor motor{fixed(400), fixed(0.02), about(0, 0, 1, 160)};
    REQUIRE(lks_joint_set_motor(arm.world, arm.joints[1], &motor) == LKS_OK);
    arm.world.step(12);
    MESSAGE("motor: " << arm.swing(1) << " degrees, " << energy_of(arm.world) << " J");
    CHECK(arm.swing(1) > 150); // 100 without what it has done
}

TEST_CASE("a ball that strikes a figure at its limit gives it its momentum") {
    TwoRods arm(200, 4000);
    REQUIRE(lks_world_set_gravity(arm.world, {}) == LKS_OK);
    const lks_body_id ball = add_body(arm.world, ball_shape(0.1, 5000), fixed(-1, -0.97, 0));
    REQUIRE(lks_body_set_velocity(arm.world, ball, fixed(20, 0, 0), {}) == LKS_OK);
    arm.world.step(6);
    MESSAGE("struck: " << arm.swing(1) << " degrees, " << energy_of(arm.world) << " J, ball "
                       << state_of(arm.world, ball).velocity.x);
    CHECK(arm.swing(1) > 90); // 81 were the ball not known
}
