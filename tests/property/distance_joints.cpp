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
    lks_vec3 force{};
    REQUIRE(lks_joint_load(world, id, &force, nullptr) == LKS_OK);
    CHECK(std::abs(metres(force.y) / (mass_of(world, load) * 9.81) - 1) < 1e-3);
    REQUIRE(lks_body_set_velocity(world, load, fixed(0, 3, 0), {}) == LKS_OK);
    world.step(12);
    CHECK(state_of(world, load).position.y > 1.4);
    CHECK(state_of(world, foot).velocity.length() < 1e-3);
}
