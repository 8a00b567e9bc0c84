// Limits of joints that the game changes while they hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"
#include "support/refusals.h"

using namespace support;

namespace {

constexpr unsigned substep_numbers[] = {1, 4, 8, 20};

lks_limits limits_of(const World& world, lks_joint_id joint) {
    lks_limits limits{};
    REQUIRE(lks_joint_limits(world, joint, &limits) == LKS_OK);
    return limits;
}

void set_limits(const World& world, lks_joint_id joint, const lks_limits& limits) {
    const lks_result result = lks_joint_set_limits(world, joint, &limits);
    INFO(world.message());
    REQUIRE(result == LKS_OK);
}

void set_longest(const World& world, lks_joint_id rope, double length) {
    lks_limits limits = limits_of(world, rope);
    limits.distance_max = fixed(length);
    set_limits(world, rope, limits);
}

void set_twist(const World& world, lks_joint_id joint, double least, double most) {
    lks_limits limits = limits_of(world, joint);
    limits.twist_min = fixed(least);
    limits.twist_max = fixed(most);
    set_limits(world, joint, limits);
}

double twist_of(const World& world, lks_joint_id joint) {
    lks_fixed twist = 0;
    REQUIRE(lks_joint_angles(world, joint, nullptr, &twist) == LKS_OK);
    return metres(twist);
}

double swing_of(const World& world, lks_joint_id joint) {
    lks_fixed swing = 0;
    REQUIRE(lks_joint_angles(world, joint, &swing, nullptr) == LKS_OK);
    return metres(swing);
}

double pull_of(const World& world, lks_joint_id joint) {
    lks_vec3 force{};
    REQUIRE(lks_joint_load(world, joint, &force, nullptr) == LKS_OK);
    return metres(force.y);
}

lks_joint_def rope_of(double length) {
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_DISTANCE;
    joint.distance_max = fixed(length);
    return joint;
}

struct HungBall {
    lks_body_id load;
    lks_joint_id rope;
};

// From two metres up, by a rope of one.
HungBall hang_ball(const World& world, const lks_vec3& place) {
    const lks_body_id load = add_body(world, ball_shape(0.1), place);
    return {load, add_joint(world, rope_of(1), add_anchor(world, fixed(0, 2, 0)), load)};
}

lks_joint_def hinge(double least, double most) {
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_HINGE;
    joint.twist_min = fixed(least);
    joint.twist_max = fixed(most);
    return joint;
}

} // namespace

TEST_CASE("a winch pulls its load up with its weight, holds it, and lets it down") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(world_def(60, substeps));
        const lks_body_id hook = add_anchor(world, fixed(0, 10, 0));
        lks_body_def def = lks_default_body_def();
        def.mass = fixed(80);
        const lks_body_id load = add_body(world, box_shape(0.2, 0.2, 0.2), {}, def);
        const lks_joint_id rope = add_joint(world, rope_of(10), hook, load);
        constexpr double weight = 80 * 9.81;
        world.step(60);
        double length = 10;
        const auto run = [&](double speed, int ticks) {
            double sum = 0;
            double most = 0;
            for (int tick = 0; tick < ticks; ++tick) {
                length -= speed / 60;
                set_longest(world, rope, length);
                world.step();
                sum += pull_of(world, rope);
                most = std::max(most, pull_of(world, rope));
            }
            CHECK(std::abs(sum / ticks / weight - 1) < 0.02);
            // Let down, it falls behind its rope until that stops it, and begins anew.
            const double above = state_of(world, load).position.y - (10 - length);
            CHECK(above > -2e-3);
            CHECK(above < (speed < 0 ? 0.03 : 2e-3));
            return most;
        };
        CHECK(run(0.6, 300) < 1.1 * weight);
        CHECK(run(0, 120) < 1.1 * weight);
        run(-0.6, 300);
    }
}

TEST_CASE("a door that is opened by its limits comes along without being thrown, and stays between them") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(weightless(substeps));
        const lks_body_id frame = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.linear_damping = def.angular_damping = 0;
        const lks_body_id door = add_body(world, box_shape(0.5, 1, 0.02, 500), fixed(0.5, 0, 0), def);
        lks_joint_def joint = hinge(0, 0);
        joint.frame_b.position = fixed(-0.5, 0, 0);
        const lks_joint_id id = add_joint(world, joint, frame, door);
        world.step(10);
        set_twist(world, id, 30, 40);
        double fastest = 0;
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            fastest = std::max(fastest, state_of(world, door).velocity.length());
        }
        CHECK(fastest < 0.02);
        CHECK(twist_of(world, id) > 29.9);
        CHECK(twist_of(world, id) < 40.1);
        // Pushed, it now stops there.
        REQUIRE(lks_body_set_velocity(world, door, {}, fixed(0, 2, 0)) == LKS_OK);
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            CHECK(twist_of(world, id) < 40.5);
        }
        CHECK(twist_of(world, id) > 35);
    }
}

TEST_CASE("a cone that is narrowed brings in what hangs in it, and one that is opened lets it out") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(world_def(60, substeps));
        const lks_body_id anchor = add_anchor(world, {});
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_b.position = fixed(0, 0.5, 0);
        joint.frame_a.rotation = about(0, 0, 1, 50); // the cone's axis
        joint.swing_limit = fixed(40);
        lks_body_def def = lks_default_body_def();
        def.transform.rotation = about(0, 0, 1, 50);
        const lks_body_id arm = add_body(world, capsule_shape(0.1, 0.4), {}, def);
        REQUIRE(lks_body_set_transform(world, arm,
                                       turned(at(0.5 * std::sin(50 * 3.14159265358979 / 180),
                                                 -0.5 * std::cos(50 * 3.14159265358979 / 180), 0),
                                              0, 0, 1, 50)) == LKS_OK);
        const lks_joint_id id = add_joint(world, joint, anchor, arm);
        world.step(240);
        CHECK(std::abs(swing_of(world, id) - 40) < 0.6); // it hangs at the edge
        lks_limits limits = limits_of(world, id);
        limits.swing_limit = fixed(10);
        set_limits(world, id, limits);
        double fastest = 0;
        for (int tick = 0; tick < 240; ++tick) {
            world.step();
            fastest = std::max(fastest, state_of(world, arm).velocity.length());
        }
        CHECK(fastest < 0.3);
        CHECK(std::abs(swing_of(world, id) - 10) < 0.6);
        limits.swing_limit = fixed(30);
        set_limits(world, id, limits);
        world.step(600);
        CHECK(std::abs(swing_of(world, id) - 30) < 0.6);
        limits.swing_limit = fixed(180);
        set_limits(world, id, limits);
        world.step(20);
        CHECK(swing_of(world, id) > 32);
    }
}

TEST_CASE("a hatch that its hinge has held falls when that has no limit any more") {
    World world(world_def(60, 8));
    const lks_body_id frame = add_anchor(world, {});
    const lks_body_id hatch = add_body(world, box_shape(0.5, 0.02, 0.3), fixed(0.5, 0, 0));
    lks_joint_def joint = hinge(-5, 5);
    joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90); // its axis along z
    joint.frame_b.position = fixed(-0.5, 0, 0);
    const lks_joint_id id = add_joint(world, joint, frame, hatch);
    world.step(240);
    CHECK(std::abs(std::abs(twist_of(world, id)) - 5) < 0.6);
    set_twist(world, id, -180, 180);
    world.step(20);
    CHECK(std::abs(twist_of(world, id)) > 20);
}

TEST_CASE("other limits wake the bodies, the same ones don't") {
    World world(world_def(60, 8));
    const HungBall hung = hang_ball(world, fixed(0, 1, 0));
    const lks_body_id load = hung.load;
    const lks_joint_id rope = hung.rope;
    world.step(600);
    REQUIRE(lks_body_is_awake(world, load) == 0);
    const std::uint64_t hash = world.hash();
    set_limits(world, rope, limits_of(world, rope));
    CHECK(lks_body_is_awake(world, load) == 0);
    CHECK(world.hash() == hash);
    set_longest(world, rope, 1.5);
    CHECK(lks_body_is_awake(world, load) == 1);
    CHECK(world.hash() != hash);
    world.step(600);
    CHECK(std::abs(state_of(world, load).position.y - 0.5) < 1e-4);
}

TEST_CASE("changed limits are part of the state") {
    World world(world_def(60, 8));
    const lks_joint_id rope = hang_ball(world, fixed(0.6, 1.2, 0)).rope;
    world.step(30);
    set_longest(world, rope, 0.8);
    const Image image = world.save();
    world.step(60);
    const std::uint64_t hash = world.hash();
    World fresh(world_def(60, 8));
    REQUIRE(lks_world_load(fresh, image.data(), image.size()) == LKS_OK);
    CHECK(metres(limits_of(fresh, rope).distance_max) == doctest::Approx(0.8));
    fresh.step(60);
    CHECK(fresh.hash() == hash);
}

TEST_CASE("limits out of their ranges are refused and change nothing") {
    World world(world_def(60, 8));
    const lks_body_id hook = add_anchor(world, fixed(0, 2, 0));
    const lks_body_id load = add_body(world, ball_shape(0.1), fixed(0, 1, 0));
    const lks_joint_id id = add_joint(world, hinge(-20, 30), hook, load);
    const auto refuse = [&](const char* value, void (*change)(lks_limits&)) {
        lks_limits limits = limits_of(world, id);
        change(limits);
        check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, value,
                           [&] { return lks_joint_set_limits(world, id, &limits); });
    };
    refuse("31", [](lks_limits& l) { l.twist_min = fixed(31); });
    refuse("181", [](lks_limits& l) { l.twist_max = fixed(181); });
    refuse("-1", [](lks_limits& l) { l.swing_limit = fixed(-1); });
    refuse("200", [](lks_limits& l) { l.swing_limit_z = fixed(200); });
    refuse("65", [](lks_limits& l) { l.distance_max = fixed(65); });
    refuse("2", [](lks_limits& l) {
        l.distance_max = fixed(1);
        l.distance_min = fixed(2);
    });
    lks_limits limits = limits_of(world, id);
    CHECK(lks_joint_set_limits(nullptr, id, &limits) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_joint_set_limits(world, id, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_joint_limits(nullptr, id, &limits) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_joint_limits(world, id, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    REQUIRE(lks_world_remove_joint(world, id) == LKS_OK);
    CHECK(lks_joint_set_limits(world, id, &limits) == LKS_ERROR_STALE_ID);
    CHECK(lks_joint_limits(world, id, &limits) == LKS_ERROR_STALE_ID);
}
