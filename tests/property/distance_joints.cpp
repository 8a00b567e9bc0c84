// A distance joint is a rope, a rod or a strut.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"

using namespace support;

namespace {

lks_joint_def distance(double least, double most) {
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_DISTANCE;
    joint.distance_min = fixed(least);
    joint.distance_max = fixed(most);
    return joint;
}

lks_world_def without_gravity(unsigned substeps) {
    lks_world_def def = world_def(60, substeps);
    def.gravity = {};
    return def;
}

double kinetic_energy(const World& world) {
    lks_fixed energy = 0;
    REQUIRE(lks_world_kinetic_energy(world, &energy) == LKS_OK);
    return metres(energy);
}

double pull_of(const World& world, lks_joint_id id) {
    lks_vec3 force{};
    REQUIRE(lks_joint_load(world, id, &force, nullptr) == LKS_OK);
    return metres(force.y);
}

struct Range {
    double least, most, error;
};

// How far a ball is from what it is tied to, for ten seconds.
Range swing(const lks_joint_def& joint, const lks_vec3& start) {
    World world(world_def(60, 20));
    const lks_body_id anchor = add_anchor(world, {});
    const lks_body_id ball = add_body(world, ball_shape(0.1), start);
    const lks_joint_id id = add_joint(world, joint, anchor, ball);
    Range range{1000, 0, 0};
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        const double length = state_of(world, ball).position.length();
        range.least = std::min(range.least, length);
        range.most = std::max(range.most, length);
        range.error = std::max(range.error, error_of(world, id));
    }
    return range;
}

constexpr unsigned substep_numbers[] = {1, 2, 4, 8, 20, 32};

lks_body_shape light_box() {
    return box_shape(0.25, 0.25, 0.25, 200);
}

struct Undone {
    double energy, error; // the most in two seconds, and what is left
};

Undone undo(World& world, lks_joint_id id) {
    Undone undone{0, 0};
    for (int tick = 0; tick < 120; ++tick) {
        world.step();
        undone.energy = std::max(undone.energy, kinetic_energy(world));
    }
    undone.error = error_of(world, id);
    return undone;
}

// Two boxes of 25 kg in weightlessness that are that far apart, their joint at corners or at their middles.
Undone undo_apart(unsigned substeps, double apart, lks_joint_def joint, const lks_vec3& corner) {
    World world(without_gravity(substeps));
    const lks_body_id a = add_body(world, light_box(), {});
    const lks_body_id b = add_body(world, light_box(), fixed(apart, 0, 0));
    joint.frame_b.position = corner;
    return undo(world, add_joint(world, joint, a, b));
}

} // namespace

TEST_CASE("a rope is slack until it is as long as it may be") {
    const Range range = swing(distance(0, 1), fixed(0.3, 0, 0));
    CHECK(range.least < 0.31);
    CHECK(range.most < 1.003);
    CHECK(range.most > 0.999);
    CHECK(range.error < 2e-3);
}

TEST_CASE("a rod keeps its length while what it holds goes all the way round") {
    const Range range = swing(distance(1, 1), fixed(0.6, 0.8, 0));
    INFO(range.least << " .. " << range.most << " m");
    CHECK(range.least > 1 - 1e-8);
    CHECK(range.most < 1 + 1e-8);
    CHECK(range.error < 1e-8);
}

TEST_CASE("a strut bears what presses on it, and lets it go away") {
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id foot = add_body(world, box_shape(0.3, 0.1, 0.3), fixed(0, 0.1, 0));
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    const lks_body_id load = add_body(world, box_shape(0.3, 0.1, 0.3), fixed(0, 1.1, 0), def);
    const lks_joint_id id = add_joint(world, distance(1, 2), foot, load);
    world.step(20);
    CHECK(error_of(world, id) < 1e-9);
    CHECK(std::abs(pull_of(world, id) / (mass_of(world, load) * 9.81) - 1) < 1e-3);
    REQUIRE(lks_body_set_velocity(world, load, fixed(0, 3, 0), {}) == LKS_OK);
    world.step(12);
    CHECK(state_of(world, load).position.y > 1.4);
    CHECK(state_of(world, foot).velocity.length() < 1e-3);
}

TEST_CASE("limits that are exceeded from the start are undone without speed") {
    for (const unsigned substeps : substep_numbers) {
        for (const lks_vec3& corner : {lks_vec3{}, fixed(-0.25, 0.25, 0.25)}) {
            const bool middle = corner.x == 0;
            const double between = middle ? 0 : std::sqrt(3) / 4;
            for (const double beyond : {0.01, 0.1, 0.5}) {
                CAPTURE(substeps);
                CAPTURE(middle);
                CAPTURE(beyond);
                // Too long for a rope, too long for a rod, too short for a strut.
                const double reach = 1.5 - between;
                const Undone results[] = {undo_apart(substeps, 1.5, distance(0, reach - beyond), corner),
                                          undo_apart(substeps, 1.5, distance(0.5, 0.5), corner),
                                          undo_apart(substeps, 1.5, distance(1.5 + beyond, 3), corner)};
                for (const Undone& undone : results) {
                    CHECK(undone.energy < 1e-3);
                    CHECK(undone.error < 1e-6);
                }
            }
        }
    }
}

TEST_CASE("a body that was put beyond its rope comes back without speed") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(without_gravity(substeps));
        const lks_body_id a = add_body(world, light_box(), {});
        const lks_body_id b = add_body(world, light_box(), fixed(1, 0, 0));
        const lks_joint_id id = add_joint(world, distance(0, 1), a, b);
        world.step(10);
        REQUIRE(lks_body_set_transform(world, b, at(1.1, 0, 0)) == LKS_OK);
        const Undone undone = undo(world, id);
        CHECK(undone.energy < 1e-3);
        CHECK(undone.error < 1e-6);
        CHECK(state_of(world, b).position.x - state_of(world, a).position.x > 0.999);
    }
}

TEST_CASE("a load that was put below the end of its rope is back there without being thrown") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(world_def(60, substeps));
        const lks_body_id hook = add_anchor(world, {});
        const lks_body_id load = add_body(world, light_box(), fixed(0, -1, 0));
        const lks_joint_id id = add_joint(world, distance(0, 1), hook, load);
        world.step(10);
        REQUIRE(lks_body_set_transform(world, load, at(0, -1.1, 0)) == LKS_OK);
        double fastest = 0;
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            fastest = std::max(fastest, state_of(world, load).velocity.length());
        }
        // What its rope's push moved it by in a substep is made up for with speed.
        CHECK(fastest < 1.01 * 9.81 / (60 * substeps));
        CHECK(error_of(world, id) < 1e-6);
    }
}

TEST_CASE(
    "a winch, a joint that is made anew each tick with a shorter rope, pulls with the weight of its load") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(world_def(60, substeps));
        const lks_body_id hook = add_anchor(world, fixed(0, 10, 0));
        lks_body_def def = lks_default_body_def();
        def.mass = fixed(80);
        const lks_body_id load = add_body(world, box_shape(0.2, 0.2, 0.2), {}, def);
        double length = 10;
        double sum = 0;
        double most = 0;
        lks_joint_id rope = add_joint(world, distance(0, length), hook, load);
        constexpr int ticks = 300;
        for (int tick = 0; tick < ticks; ++tick) {
            REQUIRE(lks_world_remove_joint(world, rope) == LKS_OK);
            length -= 0.01; // 0.6 m/s
            rope = add_joint(world, distance(0, length), hook, load);
            world.step();
            sum += pull_of(world, rope);
            most = std::max(most, pull_of(world, rope));
        }
        constexpr double weight = 80 * 9.81;
        CHECK(std::abs(sum / ticks / weight - 1) < 0.01);
        CHECK(most < 1.1 * weight);
        CHECK(std::abs(state_of(world, load).position.y - (10 - length)) < 1e-3);
        CHECK(state_of(world, load).velocity.length() < 0.05);
    }
}

TEST_CASE("what undoes an exceeded limit is no load, and breaks nothing") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(without_gravity(substeps));
        const lks_body_id a = add_body(world, light_box(), {});
        const lks_body_id b = add_body(world, light_box(), fixed(1.2, 0, 0));
        lks_joint_def def = distance(0, 1);
        def.break_force = fixed(0.01);
        const lks_joint_id id = add_joint(world, def, a, b);
        world.step(10);
        REQUIRE(lks_world_has_joint(world, id) == 1);
        CHECK(error_of(world, id) < 1e-6);
    }
}

TEST_CASE("a slack rope stops what comes to its end there, and no earlier") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(without_gravity(substeps));
        const lks_body_id anchor = add_anchor(world, {});
        const lks_body_id ball = add_body(world, ball_shape(0.1), fixed(0.5, 0, 0));
        REQUIRE(lks_body_set_velocity(world, ball, fixed(3.7, 0, 0), {}) == LKS_OK);
        const lks_joint_id id = add_joint(world, distance(0, 1), anchor, ball);
        double most = 0;
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            most = std::max(most, state_of(world, ball).position.x);
        }
        CHECK(std::abs(most - 1) < 1e-7);
        CHECK(error_of(world, id) < 1e-7);
        CHECK(state_of(world, ball).velocity.length() < 1e-5);
    }
}

TEST_CASE("ten links with a load of as much, ten or a hundred times hang still and pull with their weight") {
    struct Bound {
        double load, error, pull; // kg, m, relative
    };
    for (const Bound& bound : {Bound{1, 5e-4, 1e-3}, Bound{10, 1e-3, 2e-3}, Bound{100, 1e-2, 0.1}}) {
        for (const bool rods : {false, true}) {
            CAPTURE(bound.load);
            CAPTURE(rods);
            World world(world_def(60, 8));
            lks_body_id before = add_anchor(world, {});
            lks_joint_id first{};
            for (int i = 1; i <= 10; ++i) {
                lks_body_def def = lks_default_body_def();
                def.mass = fixed(i == 10 ? bound.load : 1);
                const lks_body_id link = add_body(world, ball_shape(0.05), fixed(0, -0.3 * i, 0), def);
                const lks_joint_id id = add_joint(world, distance(rods ? 0.3 : 0, 0.3), before, link);
                first = i == 1 ? id : first;
                before = link;
            }
            world.step(100);
            double most = 0;
            for (int tick = 0; tick < 500; ++tick) {
                world.step();
                most = std::max(most, error_of(world, first));
            }
            CHECK(most < bound.error);
            CHECK(std::abs(pull_of(world, first) / ((9 + bound.load) * 9.81) - 1) < bound.pull);
            CHECK(kinetic_energy(world) < 1e-9);
        }
    }
}

TEST_CASE("a rope without length bears its load, says so, and breaks of it") {
    for (const unsigned substeps : substep_numbers) {
        CAPTURE(substeps);
        World world(world_def(60, substeps));
        const lks_body_id hook = add_anchor(world, {});
        const lks_body_id load = add_body(world, light_box(), {});
        const lks_joint_id id = add_joint(world, distance(0, 0), hook, load);
        const double weight = mass_of(world, load) * 9.81;
        world.step(60);
        for (int tick = 0; tick < 4; ++tick) {
            world.step();
            CHECK(std::abs(pull_of(world, id) / weight - 1) < 0.01);
        }
        CHECK(error_of(world, id) < 1e-6);
        for (const double share : {0.95, 1.05}) {
            World other(world_def(60, substeps));
            lks_joint_def def = distance(0, 0);
            def.break_force = fixed(share * weight);
            const lks_body_id post = add_anchor(other, {});
            const lks_joint_id breaking = add_joint(other, def, post, add_body(other, light_box(), {}));
            other.step(60);
            CHECK(lks_world_has_joint(other, breaking) == (share > 1 ? 1u : 0u));
        }
    }
}
