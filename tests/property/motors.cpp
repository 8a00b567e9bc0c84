// What drives, damps, softens and breaks joints.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"

using namespace support;

namespace {

constexpr double g = 9.81;
const double pi = std::acos(-1.0);

double twist_of(const World& world, lks_joint_id joint) {
    lks_fixed twist = 0;
    REQUIRE(lks_joint_angles(world, joint, nullptr, &twist) == LKS_OK);
    return metres(twist);
}

// An arm of 10 kg, 1 m long, on a hinge about z at its end; level where the hinge is at 0.
struct Arm {
    explicit Arm(std::uint32_t substeps = 8, bool never_sleeps = false) : world(world_def(60, substeps)) {
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = never_sleeps ? 1 : 0;
        arm = add_body(world, box_shape(0.5, 0.05, 0.1), fixed(0.5, 0, 0), def);
        joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_HINGE;
        joint.frame_b.position = fixed(-0.5, 0, 0);
        joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90); // about z
        joint.body_a = anchor;
        joint.body_b = arm;
    }
    void attach() { id = add_joint(world, joint, joint.body_a, joint.body_b); }
    void drive(double torque, double degrees, double response = 0.05) {
        const lks_motor motor{fixed(torque), fixed(response), about(0, 1, 0, degrees)};
        REQUIRE(lks_joint_set_motor(world, id, &motor) == LKS_OK);
    }

    World world;
    lks_body_id arm{};
    lks_joint_def joint;
    lks_joint_id id{};
    static constexpr double mass = 0.5 * 0.05 * 0.1 * 8 * 1000;
    static constexpr double inertia = mass * (0.25 + 0.0025) / 3 + mass * 0.25; // about the hinge
};

} // namespace

TEST_CASE("a motor turns an arm to its target against gravity and holds it there") {
    Arm arm;
    arm.attach();
    arm.drive(200, 60);
    arm.world.step(90);
    CHECK(std::abs(twist_of(arm.world, arm.id) - 60) < 0.1);
    // What it takes to hold it.
    lks_vec3 torque{};
    REQUIRE(lks_joint_load(arm.world, arm.id, nullptr, &torque) == LKS_OK);
    CHECK(std::abs(metres(torque.z) - Arm::mass * g * 0.5 * std::cos(pi / 3)) < 0.5);
    double least = 60;
    for (int tick = 0; tick < 600; ++tick) {
        arm.world.step();
        least = std::min(least, twist_of(arm.world, arm.id));
    }
    CHECK(least > 59.9);
    CHECK(lks_body_is_awake(arm.world, arm.arm) == 0);
    // A target to the other side wakes it; the same one again does not.
    arm.drive(200, -20);
    CHECK(lks_body_is_awake(arm.world, arm.arm) == 1);
    arm.world.step(600);
    CHECK(std::abs(twist_of(arm.world, arm.id) + 20) < 0.1);
    CHECK(lks_body_is_awake(arm.world, arm.arm) == 0);
    arm.drive(200, -20);
    CHECK(lks_body_is_awake(arm.world, arm.arm) == 0);
}

TEST_CASE("a motor gets there in its response time") {
    for (const double response : {0.1, 0.4}) {
        Arm arm;
        REQUIRE(lks_world_set_gravity(arm.world, {0, 0, 0}) == LKS_OK);
        arm.attach();
        arm.drive(100000, 80, response);
        arm.world.step(24);
        // An exponential, in steps of the substep.
        const double left = 80 * std::pow(1 - 1 / (480 * response), 192);
        INFO("response " << response << " s");
        CHECK(std::abs(80 - twist_of(arm.world, arm.id) - left) < 0.8);
    }
}

TEST_CASE("a motor's torque is at most what it says") {
    Arm arm;
    REQUIRE(lks_world_set_gravity(arm.world, {0, 0, 0}) == LKS_OK);
    arm.attach();
    arm.drive(3, 170, 0);
    arm.world.step(60);
    const double expected = 3 / Arm::inertia; // rad/s after a second
    CHECK(std::abs(state_of(arm.world, arm.arm).spin.z / expected - 1) < 0.005);
    // Gravity's 49 N·m are too much for 20.
    Arm weak;
    weak.attach();
    weak.drive(20, 0);
    weak.world.step(20);
    CHECK(twist_of(weak.world, weak.id) < -20);
}

TEST_CASE("a ball joint's motor reaches a turn about any axis") {
    World world(world_def(60, 8));
    const lks_body_id anchor = add_anchor(world, {});
    const lks_body_id limb = add_body(world, capsule_shape(0.05, 0.2), fixed(0, -0.25, 0));
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_b.position = fixed(0, 0.25, 0);
    const lks_joint_id id = add_joint(world, joint, anchor, limb);
    const lks_motor motor{fixed(100), fixed(0.05), about(1, 2, -1, 75)};
    REQUIRE(lks_joint_set_motor(world, id, &motor) == LKS_OK);
    world.step(120);
    const lks_rotation now = state_of(world, limb).rotation;
    const double aligned = (1.0 * now.x * motor.target.x + 1.0 * now.y * motor.target.y +
                            1.0 * now.z * motor.target.z + 1.0 * now.w * motor.target.w) /
                           std::pow(2.0, 60);
    CHECK(2 * std::acos(std::min(1.0, std::abs(aligned))) * 180 / pi < 0.2);
    lks_motor read{};
    REQUIRE(lks_joint_motor(world, id, &read) == LKS_OK);
    CHECK(read.max_torque == motor.max_torque);
    CHECK(read.response == motor.response);
    CHECK(read.target.x == motor.target.x);
    // Off, it hangs.
    const lks_motor off{0, 0, motor.target};
    REQUIRE(lks_joint_set_motor(world, id, &off) == LKS_OK);
    REQUIRE(lks_body_set_velocity(world, limb, {0, 0, 0}, {0, 0, 0}) == LKS_OK);
    world.step(20);
    CHECK(state_of(world, limb).velocity.length() > 0.5);
}

TEST_CASE("angular damping slows a wheel as an exponential, at any strength") {
    for (const double damping : {0.5, 20.0, 1e5}) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.angular_velocity = fixed(0, 5, 0);
        const lks_body_id wheel = add_body(world, box_shape(0.5, 0.1, 0.5, 100), {}, def);
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_HINGE;
        joint.angular_damping = fixed(damping);
        add_joint(world, joint, anchor, wheel);
        const double inertia = 20 * (0.25 + 0.25) / 3;
        world.step(30);
        const double expected = 5 * std::pow(1 + damping / inertia / 480, -240);
        INFO("damping " << damping << " N·m·s");
        CHECK(std::abs(state_of(world, wheel).spin.y - expected) < 2e-3 * 5);
    }
}

TEST_CASE("a soft fixed joint bends by its angular compliance, and a soft point sags by its own") {
    Arm arm(20, true);
    arm.joint.kind = LKS_JOINT_FIXED;
    arm.joint.angular_compliance = fixed(0.002); // rad/(N·m)
    arm.joint.angular_damping = fixed(20);
    arm.attach();
    arm.world.step(600);
    // θ = α·m·g·l·cos θ.
    double bent = 0;
    for (int i = 0; i < 50; ++i) {
        bent = 0.002 * Arm::mass * g * 0.5 * std::cos(bent);
    }
    lks_vec3 torque{};
    REQUIRE(lks_joint_load(arm.world, arm.id, nullptr, &torque) == LKS_OK);
    const double sag = state_of(arm.world, arm.arm).position.y;
    INFO("sag " << sag << " m, of " << -0.5 * std::sin(bent));
    CHECK(std::abs(sag / (-0.5 * std::sin(bent)) - 1) < 2e-3);
    CHECK(std::abs(metres(torque.z) * 0.002 / bent - 1) < 2e-3);

    World world(world_def(60, 20));
    const lks_body_id anchor = add_anchor(world, {});
    const lks_body_id ball = add_body(world, ball_shape(0.1), {});
    lks_joint_def joint = lks_default_joint_def();
    joint.compliance = fixed(0.001);
    joint.damping = fixed(100);
    const lks_joint_id id = add_joint(world, joint, anchor, ball);
    double highest = 0;
    world.step(60);
    for (int tick = 0; tick < 300; ++tick) {
        world.step();
        highest = std::max(highest, std::abs(state_of(world, ball).velocity.y));
    }
    lks_fixed mass = 0;
    REQUIRE(lks_body_mass(world, ball, &mass) == LKS_OK);
    CHECK(std::abs(error_of(world, id) / (0.001 * metres(mass) * g) - 1) < 1e-3);
    CHECK(highest < 1e-3); // the damping has brought it to rest
}

TEST_CASE("a swing limit may be an ellipse, with hardly any way along one of its axes, too") {
    struct Case {
        bool towards_x;
        double along_x, along_z;
    };
    for (const Case& limits :
         {Case{true, 50, 20}, Case{false, 50, 20}, Case{true, 45, 0}, Case{false, 0, 45}}) {
        CAPTURE(limits.towards_x);
        World world(world_def(60, 8));
        const lks_body_id anchor = add_anchor(world, {});
        const lks_body_id limb = add_body(world, capsule_shape(0.05, 0.2), fixed(0, 0.25, 0));
        REQUIRE(lks_world_set_gravity(world, limits.towards_x ? fixed(5, -3, 0) : fixed(0, -3, 5)) == LKS_OK);
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_b.position = fixed(0, -0.25, 0);
        joint.swing_limit = fixed(limits.along_x);
        joint.swing_limit_z = fixed(limits.along_z);
        const lks_joint_id id = add_joint(world, joint, anchor, limb);
        world.step(300);
        lks_fixed swing = 0;
        REQUIRE(lks_joint_angles(world, id, &swing, nullptr) == LKS_OK);
        CHECK(std::abs(metres(swing) - (limits.towards_x ? limits.along_x : limits.along_z)) < 0.5);
    }
}

TEST_CASE("a joint breaks where it has to bear more than it can") {
    for (const double strength : {0.97, 1.03}) {
        World world(world_def(60, 8));
        const lks_body_id anchor = add_anchor(world, {});
        const lks_body_id ball = add_body(world, ball_shape(0.1), {});
        lks_fixed mass = 0;
        REQUIRE(lks_body_mass(world, ball, &mass) == LKS_OK);
        lks_joint_def joint = lks_default_joint_def();
        joint.break_force = fixed(strength * metres(mass) * g);
        const lks_joint_id id = add_joint(world, joint, anchor, ball);
        world.step(60);
        CHECK(lks_world_has_joint(world, id) == (strength > 1 ? 1u : 0u));
        CHECK((state_of(world, ball).position.y < -1) == (strength < 1));
    }
    for (const double strength : {0.97, 1.03}) {
        Arm arm;
        arm.joint.kind = LKS_JOINT_FIXED;
        arm.joint.break_torque = fixed(strength * Arm::mass * g * 0.5);
        arm.attach();
        arm.world.step(60);
        CHECK(lks_world_has_joint(arm.world, arm.id) == (strength > 1 ? 1u : 0u));
    }
}
