// What joints hold, and what they leave free.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/ring.h"
#include "support/spun_limb.h"

using namespace support;

namespace {

constexpr double g = 9.81;
const double pi = std::acos(-1.0);

struct Angles {
    double swing, twist;
};

Angles angles_of(const World& world, lks_joint_id joint) {
    lks_fixed swing = 0;
    lks_fixed twist = 0;
    REQUIRE(lks_joint_angles(world, joint, &swing, &twist) == LKS_OK);
    return {metres(swing), metres(twist)};
}

} // namespace

TEST_CASE("a pendulum has its period") {
    World world(world_def(60, 20));
    const lks_body_id anchor = add_anchor(world, {});
    const double angle = 0.1;
    lks_body_def def = lks_default_body_def();
    def.transform.rotation = about(0, 0, 1, angle * 180 / pi);
    const lks_body_id rod = add_body(world, box_shape(0.05, 0.5, 0.05),
                                     fixed(0.5 * std::sin(angle), -0.5 * std::cos(angle), 0), def);
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_b.position = fixed(0, 0.5, 0);
    const lks_joint_id id = add_joint(world, joint, anchor, rod);
    double first = 0, last = 0, before = 1;
    int swings = 0;
    for (int tick = 1; tick <= 1800; ++tick) {
        world.step();
        const double x = state_of(world, rod).position.x;
        if (before < 0 && x >= 0) {
            last = tick - x / (x - before);
            first = swings == 0 ? last : first;
            ++swings;
        }
        before = x;
    }
    const double inertia = (0.05 * 0.05 + 0.5 * 0.5) / 3 + 0.25;
    const double expected = 2 * pi * std::sqrt(inertia / (g * 0.5)) * (1 + angle * angle / 16);
    const double period = (last - first) / 60 / (swings - 1);
    INFO(period << " s of " << expected);
    CHECK(std::abs(period / expected - 1) < 1e-3);
    CHECK(error_of(world, id) < 1e-6);
    // At rest it would carry its weight; swinging a little it carries nearly that.
    lks_vec3 force{};
    REQUIRE(lks_joint_load(world, id, &force, nullptr) == LKS_OK);
    CHECK(std::abs(metres(force.y) - 10 * g) < 2);
}

TEST_CASE("a hinge turns about its axis only, and between its limits") {
    World world(world_def(60, 8));
    const lks_body_id anchor = add_anchor(world, {});
    const lks_body_id arm = add_body(world, box_shape(0.5, 0.05, 0.1), fixed(0.5, 0, 0));
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_HINGE;
    joint.frame_b.position = fixed(-0.5, 0, 0);
    joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90); // about z
    joint.twist_min = fixed(-45);
    joint.twist_max = fixed(30);
    const lks_joint_id id = add_joint(world, joint, anchor, arm);
    double deepest = 0;
    for (int tick = 0; tick < 300; ++tick) {
        world.step();
        const Angles angles = angles_of(world, id);
        CHECK(angles.swing < 0.1);
        CHECK(angles.twist > -50);
        deepest = std::min(deepest, angles.twist);
    }
    CHECK(deepest < -44);
    CHECK(std::abs(angles_of(world, id).twist + 45) < 0.5);
    CHECK(error_of(world, id) < 1e-4);
    // Turned up by force, it stops at the other limit.
    REQUIRE(lks_world_set_gravity(world, fixed(0, 9.81, 0)) == LKS_OK);
    world.step(300);
    CHECK(std::abs(angles_of(world, id).twist - 30) < 0.5);
}

TEST_CASE("a ball joint's cone and twist hold a limb that is thrown about") {
    World world(world_def(60, 8));
    const lks_body_id anchor = add_anchor(world, {});
    lks_body_def def = lks_default_body_def();
    def.angular_velocity = fixed(25, 14, 18);
    const lks_body_id limb = add_body(world, capsule_shape(0.05, 0.2), fixed(0, -0.25, 0), def);
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_b.position = fixed(0, 0.25, 0);
    joint.swing_limit = fixed(40);
    joint.twist_min = fixed(-20);
    joint.twist_max = fixed(35);
    const lks_joint_id id = add_joint(world, joint, anchor, limb);
    double swing = 0, twist = 0;
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        const Angles angles = angles_of(world, id);
        swing = std::max(swing, angles.swing);
        twist = std::max({twist, angles.twist - 35, -20 - angles.twist});
    }
    INFO("swing " << swing << ", twist beyond its limits " << twist);
    CHECK(swing > 35);
    CHECK(swing < 45);
    CHECK(twist < 5);
}

TEST_CASE("a limb that has come to its limit has no speed left") {
    for (const Spin& spin : {Spin{LKS_JOINT_HINGE, fixed(0, 4, 0)}, Spin{LKS_JOINT_BALL, fixed(0, 4, 0)},
                             Spin{LKS_JOINT_BALL, fixed(0, 0, 4)}}) {
        lks_joint_def def = lks_default_joint_def();
        def.swing_limit = fixed(40);
        def.twist_min = fixed(-30);
        def.twist_max = fixed(30);
        SpunLimb spun(spin, def, 8);
        spun.world.step(60);
        INFO("kind " << spin.kind << ", spin " << metres(spin.of.y) << ", " << metres(spin.of.z));
        CHECK(state_of(spun.world, spun.limb).spin.length() < 0.01);
        const Angles angles = angles_of(spun.world, spun.joint);
        CHECK(std::abs(spin.twists() ? angles.twist - 30 : angles.swing - 40) < 0.5);
    }
}

TEST_CASE("a fixed joint makes two bodies one") {
    World world(world_def(60, 20));
    const lks_body_id anchor = add_anchor(world, {});
    const lks_body_id beam = add_body(world, box_shape(0.5, 0.1, 0.1, 200), fixed(0.6, 0, 0));
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_FIXED;
    joint.frame_a.position = fixed(0.1, 0, 0);
    joint.frame_b.position = fixed(-0.5, 0, 0);
    const lks_joint_id id = add_joint(world, joint, anchor, beam);
    world.step(600);
    CHECK(angles_of(world, id).swing < 0.2);
    CHECK(error_of(world, id) < 1e-4);
    CHECK(std::abs(state_of(world, beam).position.y) < 5e-3);
}

TEST_CASE("what flies on a hinge or a fixed joint gains no energy, and its momentum stays") {
    for (const lks_joint_kind kind : {LKS_JOINT_HINGE, LKS_JOINT_FIXED, LKS_JOINT_BALL}) {
        for (const double mass : {1.0, 30.0}) {
            lks_world_def world_definition = world_def(60, 8);
            world_definition.gravity = {};
            World world(world_definition);
            lks_body_def def = lks_default_body_def();
            def.never_sleeps = 1;
            def.mass = fixed(1);
            def.angular_velocity = fixed(0, 0, 2);
            const lks_body_id a = add_body(world, capsule_shape(0.1, 0.2), fixed(0, 3, 0), def);
            def.mass = fixed(mass);
            def.velocity = fixed(-1.4, 0, 0);
            def.angular_velocity = fixed(0.6, 1, 2);
            const lks_body_id b = add_body(world, capsule_shape(0.1, 0.3), fixed(0, 3.7, 0), def);
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = kind;
            joint.frame_a.position = fixed(0, 0.3, 0);
            joint.frame_b.position = fixed(0, -0.4, 0);
            add_joint(world, joint, a, b);
            const auto velocity = [&] {
                return (state_of(world, a).velocity + state_of(world, b).velocity * mass) * (1 / (1 + mass));
            };
            world.step(2); // what it is given does not fit the joint
            const double energy = energy_of(world);
            const Vector before = velocity();
            double most = energy;
            for (int tick = 0; tick < 600; ++tick) {
                world.step();
                most = std::max(most, energy_of(world));
            }
            const double last = energy_of(world);
            const double drift = (velocity() - before).length();
            INFO("kind " << kind << ", 1:" << mass << ": gained " << most / energy - 1 << ", lost "
                         << 1 - last / energy << " of its energy, drifts by " << drift << " m/s");
            CHECK(most < 1.01 * energy);
            CHECK(last > 0.9 * energy);
            CHECK(drift < 1e-6);
        }
    }
}

TEST_CASE("a chain of ten stays together, up to ten thousand to one") {
    struct Case {
        double mass;
        std::uint32_t substeps;
    };
    for (const Case& expected : {Case{3, 8}, Case{300, 8}, Case{3000, 20}, Case{30000, 8}, Case{30000, 40}}) {
        World world(world_def(60, expected.substeps));
        lks_body_id last = add_anchor(world, {});
        std::vector<lks_joint_id> joints;
        for (int i = 0; i < 10; ++i) {
            lks_body_def def = lks_default_body_def();
            def.mass = fixed(i == 9 ? expected.mass : 3);
            def.transform.rotation = about(0, 0, 1, 90);
            const lks_body_id body =
                add_body(world, capsule_shape(0.05, 0.15), fixed(0.2 + 0.4 * i, 0, 0), def);
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_a.position = i == 0 ? lks_vec3{} : fixed(0, -0.2, 0);
            joint.frame_b.position = fixed(0, 0.2, 0);
            joints.push_back(add_joint(world, joint, last, body));
            last = body;
        }
        double worst = 0;
        for (int tick = 0; tick < 600; ++tick) {
            world.step();
            for (const lks_joint_id joint : joints) {
                worst = std::max(worst, error_of(world, joint));
            }
        }
        INFO("end of " << expected.mass << " kg: " << worst << " m");
        CHECK(worst < 1e-5);
        CHECK(world.counters().speed_clamps == 0);
    }
}

TEST_CASE("joints that close a loop are held with those of their tree") {
    World world(world_def(60, 8));
    const std::vector<lks_joint_id> joints = hang_ring(world, 8);
    double first = 0;
    double late = 0;
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        for (const lks_joint_id joint : joints) {
            const double error = error_of(world, joint);
            first = std::max(first, error);
            late = tick > 300 ? std::max(late, error) : late;
        }
    }
    INFO(first << " m at first, " << late << " m after five seconds");
    CHECK(late < 2e-3);
    CHECK(world.counters().speed_clamps == 0);
}

TEST_CASE("joint friction brings a turning body to rest as its torque says") {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    const lks_body_id anchor = add_anchor(world, {});
    lks_body_def def = lks_default_body_def();
    def.angular_velocity = fixed(0, 5, 0);
    const lks_body_id wheel = add_body(world, box_shape(0.5, 0.1, 0.5, 100), {}, def);
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_HINGE;
    joint.friction = fixed(2);
    add_joint(world, joint, anchor, wheel);
    const double inertia = 20 * (0.25 + 0.25) / 3;
    world.step(60);
    CHECK(std::abs(state_of(world, wheel).spin.y - (5 - 2 / inertia)) < 0.01);
    world.step(1200);
    CHECK(std::abs(state_of(world, wheel).spin.y) < 1e-4);
}

TEST_CASE("a top that is held at one end of its axis precesses as its spin says") {
    World world(world_def(60, 20));
    const lks_body_id anchor = add_anchor(world, {});
    const double arm = 0.2, spin = 100, half = 0.3;
    const double rate = g * arm / (2 * half * half / 3 * spin); // m·g·r / (I·ω)
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    def.transform.rotation = about(0, 0, 1, -90); // its axis, local y, along x
    def.angular_velocity = fixed(spin, rate, 0);
    def.velocity = fixed(0, 0, -rate * arm);
    const lks_body_id top = add_body(world, box_shape(half, 0.02, half), fixed(arm, 0, 0), def);
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_b.position = fixed(0, -arm, 0);
    add_joint(world, joint, anchor, top);
    double lowest = 0, highest = 0, turned = 0, before = 0;
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        const Vector p = state_of(world, top).position;
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
        const double angle = std::atan2(-p.z, p.x);
        turned += std::remainder(angle - before, 2 * pi);
        before = angle;
    }
    INFO(turned << " rad of " << rate * 10 << ", from " << lowest << " to " << highest << " m");
    CHECK(std::abs(turned / (rate * 10) - 1) < 0.01);
    // It sinks by 15° in these ten seconds: the joint's corrections take something from the spin.
    CHECK(lowest > -0.06);
    CHECK(highest < 0.01);
}

TEST_CASE("what lies on a limit far from its joint comes to rest there, and loads it by its weight") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        World world(world_def(60, substeps));
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.filter.mask = 0;
        const lks_body_id body = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(1, 0, 0), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_HINGE;
        joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90);
        joint.frame_b.position = fixed(-1, 0, 0);
        joint.twist_min = fixed(-30);
        joint.twist_max = fixed(30);
        const lks_joint_id hinge = add_joint(world, joint, anchor, body);
        const double expected = mass_of(world, body) * 9.81 * std::sqrt(0.75);
        world.step(900);
        lks_vec3 torque{};
        REQUIRE(lks_joint_load(world, hinge, nullptr, &torque) == LKS_OK);
        const double found = metres(torque).length();
        INFO(substeps << " substeps: " << found << " of " << expected << " N·m");
        CHECK(std::abs(found / expected - 1) < 0.02);
        CHECK(lks_body_is_awake(world, body) == 0);
    }
}

TEST_CASE("a ball joint knows nothing of angular compliance") {
    const auto end_of = [](double compliance) {
        World world(world_def(60, 8));
        lks_body_id last = add_anchor(world, {});
        for (int i = 0; i < 6; ++i) {
            lks_body_def def = lks_default_body_def();
            def.mass = fixed(i == 5 ? 50 : 1);
            const lks_body_id link =
                add_body(world, capsule_shape(0.04, 0.1), fixed(0.3 * i + 0.15, 0, 0), def);
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_a.position = i == 0 ? lks_vec3{} : fixed(0.15, 0, 0);
            joint.frame_b.position = fixed(-0.15, 0, 0);
            joint.angular_compliance = fixed(compliance);
            add_joint(world, joint, last, link);
            last = link;
        }
        world.step(200);
        return state_of(world, last).position;
    };
    const Vector without = end_of(0);
    const Vector with = end_of(1e-6);
    CHECK((with - without).length() == 0);
}
