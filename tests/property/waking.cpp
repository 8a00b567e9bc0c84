// What takes a support away, or comes from nowhere, wakes who sleeps there.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "support/bodies.h"

using namespace support;

namespace {

lks_body_def kinematic() {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    return def;
}

bool is_awake(const World& world, lks_body_id body) {
    return lks_body_is_awake(world, body) == 1;
}

double height(const World& world, lks_body_id body) {
    return state_of(world, body).position.y;
}

// A box asleep on the ground, and a kinematic one.
struct OnGround {
    OnGround() : world(world_def(60, 8)) {
        add_ground(world);
        box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0));
        other = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 3));
        wall = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(5, 0.2, 0), kinematic());
        world.step(200);
        REQUIRE(lks_world_awake_body_count(world) == 0);
    }

    double overlap(lks_body_id with) const {
        return 0.4 - std::abs(state_of(world, box).position.x - state_of(world, with).position.x);
    }

    World world;
    lks_body_id box{};
    lks_body_id other{};
    lks_body_id wall{};
};

} // namespace

TEST_CASE("who hangs asleep on a kinematic body follows where it is put") {
    for (const std::uint32_t kind : {LKS_JOINT_BALL, LKS_JOINT_HINGE, LKS_JOINT_FIXED, LKS_JOINT_DISTANCE}) {
        for (const bool by_pose : {false, true}) {
            World world(world_def(60, 8));
            const lks_body_id anchor = add_anchor(world, fixed(0, 3, 0));
            const lks_body_id bob = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 2, 0));
            lks_joint_def def = lks_default_joint_def();
            def.kind = kind;
            if (kind == LKS_JOINT_DISTANCE) {
                def.distance_max = fixed(1);
            } else {
                def.frame_b = at(0, 1, 0);
            }
            const lks_joint_id joint = add_joint(world, def, anchor, bob);
            world.step(200);
            REQUIRE_FALSE(is_awake(world, bob));
            const lks_transform place = at(0.3, 3.5, 0);
            REQUIRE((by_pose ? lks_ragdoll_set_pose(world, &anchor, 1, &place, nullptr)
                             : lks_body_set_transform(world, anchor, place)) == LKS_OK);
            CHECK(is_awake(world, bob));
            world.step(60);
            CHECK(error_of(world, joint) < 0.01);
        }
    }
}

TEST_CASE("a kinematic body that comes from nowhere wakes whom it touches, and pushes him out") {
    for (const double depth : {0.01, 0.2, 0.35}) {
        for (const int how : {0, 1, 2}) {
            OnGround scene;
            lks_transform place = at(-0.4 + depth, 0.2, 0);
            lks_body_id wall = scene.wall;
            if (how == 0) {
                wall = add_body(scene.world, box_shape(0.2, 0.2, 0.2), place.position, kinematic());
            } else if (how == 1) {
                REQUIRE(lks_body_set_transform(scene.world, wall, place) == LKS_OK);
            } else {
                REQUIRE(lks_ragdoll_set_pose(scene.world, &wall, 1, &place, nullptr) == LKS_OK);
            }
            CHECK(is_awake(scene.world, scene.box));
            CHECK_FALSE(is_awake(scene.world, scene.other));
            scene.world.step(300);
            CHECK(scene.overlap(wall) < 0.002);
            CHECK(lks_world_awake_body_count(scene.world) == 0);
        }
    }
}

TEST_CASE("a kinematic body wakes nobody beside it, nor whom its filter excludes") {
    OnGround scene;
    REQUIRE(lks_body_set_transform(scene.world, scene.wall, at(-0.41, 0.2, 0)) == LKS_OK);
    lks_body_def excluded = kinematic();
    excluded.filter.mask = LKS_CATEGORY_PARTICLES;
    add_body(scene.world, box_shape(0.2, 0.2, 0.2), fixed(0.2, 0.2, 0), excluded);
    scene.world.step();
    CHECK(lks_world_awake_body_count(scene.world) == 0);
}

TEST_CASE("who slept on a kinematic body, or leaned on it, wakes when it is put elsewhere") {
    OnGround scene;
    const lks_body_id above = add_body(scene.world, box_shape(0.1, 0.1, 0.1), fixed(5, 0.5, 0));
    scene.world.step(200);
    REQUIRE_FALSE(is_awake(scene.world, above));
    REQUIRE(lks_body_set_transform(scene.world, scene.wall, at(10, 0.2, 0)) == LKS_OK);
    scene.world.step(60);
    CHECK(height(scene.world, above) < 0.15);
    CHECK_FALSE(is_awake(scene.world, scene.box));
}
