// Who collides with whom.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr std::uint32_t all = 0xffffffffu;

struct Case {
    std::string name;
    lks_filter a;
    lks_filter b;
    bool hit;
};

const Case cases[] = {
    {"one category, all masks", {1, all, 0}, {1, all, 0}, true},
    {"a's mask lacks b's category", {1, 2, 0}, {1, all, 0}, false},
    {"b's mask lacks a's category", {1, all, 0}, {1, 2, 0}, false},
    {"each is in the other's mask", {2, 4, 0}, {4, 2, 0}, true},
    {"one group below zero", {1, all, -3}, {1, all, -3}, false},
    {"two groups below zero", {1, all, -3}, {1, all, -4}, true},
    {"one group above zero, empty masks", {1, 0, 5}, {1, 0, 5}, true},
    {"two groups above zero, empty masks", {1, 0, 5}, {1, 0, 6}, false},
};

lks_collider_def ground(std::uint32_t shape, const lks_filter& filter) {
    lks_collider_def def = collider_below_origin(shape);
    def.filter = filter;
    return def;
}

// Whether two humanoids that drift into each other push each other.
bool meet(std::int32_t of_bones, std::int32_t of_first, std::int32_t of_second) {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    Humanoid human;
    for (lks_bone& bone : human.bones) {
        bone.body.filter.group = of_bones;
    }
    human.def.group = of_first;
    lks_body_id first[LKS_HUMANOID_BONES];
    REQUIRE(human.add(world, first) == LKS_OK);
    human.def.group = of_second;
    human.def.transform.position = fixed(0, 0, 0.6);
    human.def.velocity = fixed(0, 0, -3);
    REQUIRE(human.add(world) == LKS_OK);
    world.step(30);
    return state_of(world, first[LKS_HUMANOID_CHEST]).velocity.length() > 0.1;
}

} // namespace

TEST_CASE("categories, masks and groups say which bodies collide") {
    for (const Case& c : cases) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_body_def def = lks_default_body_def();
        def.filter = c.a;
        def.velocity = fixed(2, 0, 0);
        const lks_body_id a = add_body(world, ball_shape(0.1), fixed(-1, 0, 0), def);
        def.filter = c.b;
        def.velocity = fixed(-2, 0, 0);
        const lks_body_id b = add_body(world, ball_shape(0.1), fixed(1, 0, 0), def);
        world.step(60);
        INFO(c.name);
        const double from_a_to_b = state_of(world, b).position.x - state_of(world, a).position.x;
        CHECK((c.hit ? from_a_to_b > 0.199 : from_a_to_b < -1.999));
    }
}

TEST_CASE("categories, masks and groups say which bodies a collider stops") {
    for (const Case& c : cases) {
        for (const std::uint32_t shape : collider_shapes) {
            for (const bool body_is_a : {true, false}) {
                World world(world_def(60, 8));
                world.add(ground(shape, body_is_a ? c.b : c.a));
                lks_body_def def = lks_default_body_def();
                def.filter = body_is_a ? c.a : c.b;
                const lks_body_id ball = add_body(world, ball_shape(0.1), fixed(0, 0.5, 0), def);
                world.step(60);
                INFO(c.name << ", shape " << shape << (body_is_a ? ", body first" : ", collider first"));
                const double height = state_of(world, ball).position.y;
                CHECK((c.hit ? std::abs(height - 0.1) < 0.01 : height < -3));
            }
        }
    }
}

TEST_CASE("a moving collider pushes whom its filter meets, and passes others") {
    for (const bool meets : {true, false}) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        const lks_collider_def def = ground(LKS_SHAPE_BOX, {2, meets ? all : ~1u, 0});
        const lks_collider_id id = world.add(def);
        const lks_body_id ball = add_body(world, ball_shape(0.1), fixed(0, 0.5, 0));
        lks_transform place = def.transform;
        for (int tick = 0; tick < 60; ++tick) {
            place.position.y += fixed(1) / 30;
            REQUIRE(lks_collider_move_to(world, id, place) == LKS_OK);
            world.step();
        }
        CHECK(state_of(world, ball).position.y == doctest::Approx(meets ? 2.1 : 0.5).epsilon(0.05));
    }
}

TEST_CASE("a collider whose mask lacks the particles' category is not met by cloth and ropes") {
    const struct {
        lks_filter filter;
        bool hit;
    } filters[] = {{{1, all, 0}, true},
                   {{1, LKS_CATEGORY_PARTICLES, 0}, true},
                   {{2, LKS_CATEGORY_PARTICLES, -1}, true},
                   {{1, all & ~LKS_CATEGORY_PARTICLES, 0}, false},
                   {{LKS_CATEGORY_PARTICLES, 1, 0}, false},
                   {{1, 0, 5}, false}};
    Chain chain;
    chain.segments = 4;
    chain.length = 0.2;
    chain.particle_mass = 0.1;
    const Asset rope = chain.build();
    for (const auto& c : filters) {
        for (const std::uint32_t shape : collider_shapes) {
            // Ropes that are near a body go through the tick together with it.
            for (const bool beside_body : {false, true}) {
                World world(world_def(60, 8));
                lks_collider_def def = ground(shape, c.filter);
                def.static_friction = def.dynamic_friction = LKS_FIXED(10);
                world.add(def);
                if (beside_body) {
                    lks_body_def post = lks_default_body_def();
                    post.kind = LKS_BODY_KINEMATIC;
                    add_body(world, capsule_shape(0.1, 0.3), fixed(0, 0, 0.15), post);
                }
                const lks_object_id object = world.add(rope, at(-0.1, 0.3, 0));
                world.step(60);
                const double height = world.positions_from(object, {})[2].y;
                INFO("mask " << c.filter.mask << ", shape " << shape << ": " << height);
                CHECK((c.hit ? height > -0.1 : height < -3));
            }
        }
    }
}

TEST_CASE("the two bodies of a joint collide if it says so") {
    for (const bool collide : {false, true}) {
        // A rope of half a metre between two balls that fly at each other.
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_body_def def = lks_default_body_def();
        def.velocity = fixed(0.5, 0, 0);
        const lks_body_id a = add_body(world, ball_shape(0.1), fixed(-0.2, 0, 0), def);
        def.velocity = fixed(-0.5, 0, 0);
        const lks_body_id b = add_body(world, ball_shape(0.1), fixed(0.2, 0, 0), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = LKS_JOINT_DISTANCE;
        joint.distance_max = fixed(0.5);
        joint.bodies_collide = collide ? 1 : 0;
        add_joint(world, joint, a, b);
        world.step(30);
        const double from_a_to_b = state_of(world, b).position.x - state_of(world, a).position.x;
        CHECK((collide ? from_a_to_b > 0.199 : from_a_to_b < -0.05));
    }
}

TEST_CASE("the instance's group counts where it is not 0, and else each bone's own") {
    CHECK(meet(0, 0, 0));
    CHECK(!meet(-7, 0, 0));
    CHECK(!meet(0, -7, -7));
    CHECK(meet(0, -7, -8));
    CHECK(meet(-7, 0, -8));
    CHECK(meet(-7, 3, 3));
    CHECK(!meet(3, -7, -7));
}
