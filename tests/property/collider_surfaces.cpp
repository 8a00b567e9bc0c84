// What colliders do to bodies by their restitution.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr double fall = 2;
constexpr double radius = 0.25;

std::string name_of(std::uint32_t shape) {
    return "shape " + std::to_string(shape);
}

// How high over the place where it lies the body is at the top of its first bounce.
double height_of_bounce(World& world, lks_body_id body, double rest) {
    double highest = 0;
    bool bounced = false;
    for (int tick = 0; tick < 200; ++tick) {
        world.step();
        const BodyState state = state_of(world, body);
        const bool rises = state.velocity.y > 0.01;
        bounced = bounced || rises;
        if (bounced) {
            highest = std::max(highest, state.position.y - rest);
        }
        if (bounced && !rises) {
            break;
        }
    }
    return highest;
}

void check_height(double height, double restitution, const std::string& what) {
    const double expected = fall * restitution * restitution;
    INFO(what << ", restitution " << restitution << ": " << height << " m of " << expected);
    // A tick sees the top within half of it, and a substep the impact.
    CHECK(std::abs(height - expected) < 0.015 * expected + 1e-4);
}

double bounce(const lks_collider_def& on, const lks_body_shape& shape, double rest, std::uint32_t substeps,
              lks_fixed own_restitution = 0) {
    World world(world_def(60, substeps));
    world.add(on);
    lks_body_def def = lks_default_body_def();
    def.restitution = own_restitution;
    return height_of_bounce(world, add_body(world, shape, fixed(0, rest + fall, 0), def), rest);
}

} // namespace

TEST_CASE("a ball bounces on each shape to the height that the collider's restitution gives it") {
    for (const std::uint32_t shape : collider_shapes) {
        for (const std::uint32_t substeps : {8u, 20u}) {
            for (const double restitution : {0.0, 0.3, 0.5, 0.9}) {
                lks_collider_def def = collider_below_origin(shape);
                def.restitution = fixed(restitution);
                check_height(bounce(def, ball_shape(radius), radius, substeps), restitution, name_of(shape));
            }
        }
    }
}

TEST_CASE("of a body's and a collider's restitution the greater one counts, whosever it is") {
    lks_body_shape lying = capsule_shape(0.1, 0.3);
    lying.transform.rotation = about(0, 0, 1, 90);
    const struct {
        lks_body_shape shape;
        double rest;
    } bodies[] = {{ball_shape(radius), radius}, {lying, 0.1}, {box_shape(0.3, 0.2, 0.25), 0.2}};
    for (const std::uint32_t shape : collider_shapes) {
        lks_collider_def dull = collider_below_origin(shape);
        dull.restitution = fixed(0.3);
        lks_collider_def lively = collider_below_origin(shape);
        lively.restitution = fixed(0.75);
        for (const auto& body : bodies) {
            const double by_body = bounce(dull, body.shape, body.rest, 20, fixed(0.75));
            CHECK(by_body > 0.1);
            CHECK(by_body == bounce(lively, body.shape, body.rest, 20, fixed(0.3)));
            CHECK(by_body == bounce(collider_below_origin(shape), body.shape, body.rest, 20, fixed(0.75)));
        }
    }
}

TEST_CASE("capsules and boxes that come down flat bounce as high, and do not begin to spin") {
    lks_body_shape lying = capsule_shape(0.1, 0.3);
    lying.transform.rotation = about(0, 0, 1, 90);
    for (const std::uint32_t shape : {LKS_SHAPE_PLANE, LKS_SHAPE_BOX}) {
        for (const std::uint32_t substeps : {8u, 20u}) {
            for (const double restitution : {0.3, 0.5, 0.9}) {
                lks_collider_def def = collider_below_origin(shape);
                def.restitution = fixed(restitution);
                check_height(bounce(def, box_shape(0.3, 0.2, 0.25), 0.2, substeps), restitution, "box");
                check_height(bounce(def, lying, 0.1, substeps), restitution, "capsule");
            }
        }
    }
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(0.5);
    const lks_body_id box = add_body(world, box_shape(0.3, 0.2, 0.25), fixed(0, 1, 0), def);
    world.step(30);
    CHECK(state_of(world, box).velocity.y > 0);
    CHECK(state_of(world, box).spin.length() < 1e-6);
}

TEST_CASE("a bat that gives back all speed throws a resting ball at twice its own") {
    World world(world_def(60, 20));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    lks_collider_def def = collider_below_origin(LKS_SHAPE_BOX);
    def.restitution = LKS_FIXED_ONE;
    const lks_collider_id bat = world.add(def);
    const lks_body_id ball = add_body(world, ball_shape(radius), fixed(0, radius + 0.21, 0));
    lks_transform place = def.transform;
    for (int tick = 0; tick < 30; ++tick) {
        place.position.y += fixed(3) / 60;
        REQUIRE(lks_collider_move_to(world, bat, place) == LKS_OK);
        world.step();
    }
    CHECK(std::abs(state_of(world, ball).velocity.y - 6) < 0.01);
}

TEST_CASE("cloth and ropes do not bounce, whatever a collider's restitution") {
    const auto run = [](lks_fixed restitution) {
        World world(world_def(60, 8));
        lks_collider_def def = collider_below_origin(LKS_SHAPE_PLANE);
        def.restitution = restitution;
        world.add(def);
        Net net;
        net.side = 6;
        net.width = 0.5;
        net.radius = 0.02;
        const lks_object_id cloth = world.add(net.build(), at(0, 0.5, 0));
        world.step(90);
        return lks_object_hash(world, cloth);
    };
    CHECK(run(0) == run(LKS_FIXED_ONE));
}
