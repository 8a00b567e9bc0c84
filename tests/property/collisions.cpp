// Colliders through the API: resting, friction, being pushed and carried.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

constexpr double gravity = 9.81;
constexpr double radius = 0.02;

lks_collider_def shape(lks_shape_kind kind, const lks_transform& transform) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = kind;
    def.transform = transform;
    return def;
}

lks_collider_def box(const lks_vec3& half_extents, const lks_transform& transform) {
    lks_collider_def def = shape(LKS_SHAPE_BOX, transform);
    def.half_extents = half_extents;
    return def;
}

Asset particle(double mass = 1) {
    return loose_points({{0, 0, 0}, {1000.0 / 64, 30, 0}}, {mass, mass},
                        radius); // the second one is far away
}

Vector where(const World& world, lks_object_id object) {
    return world.positions_from(object, {})[0];
}

// Distance from the surface of an axis-aligned box around the origin, outside it.
double distance_from_box(const Vector& point, const Vector& half) {
    const Vector outside{std::max(std::abs(point.x) - half.x, 0.0), std::max(std::abs(point.y) - half.y, 0.0),
                         std::max(std::abs(point.z) - half.z, 0.0)};
    return outside.length();
}

} // namespace

TEST_CASE("a particle comes to rest at its radius from each shape within 1e-5 m") {
    struct Case {
        const char* name;
        lks_collider_def def;
        double top;
    };
    lks_collider_def sphere = shape(LKS_SHAPE_SPHERE, at(0, 0, 0));
    sphere.radius = fixed(0.4);
    lks_collider_def standing = shape(LKS_SHAPE_CAPSULE, at(0, 0, 0));
    standing.radius = fixed(0.1);
    standing.half_length = fixed(0.3);
    lks_collider_def lying = standing;
    lying.transform = turned(at(0, 0, 0), 0, 0, 1, 90);
    const Case cases[] = {
        {"plane", shape(LKS_SHAPE_PLANE, at(0, 0, 0)), 0},
        {"sphere", sphere, 0.4},
        {"standing capsule", standing, 0.4},
        {"lying capsule", lying, 0.1},
        {"box", box(fixed(0.5, 0.25, 0.5), at(0, 0, 0)), 0.25},
        {"turned box", box(fixed(0.5, 0.5, 0.25), turned(at(0, 0, 0), 1, 0, 0, 90)), 0.25},
    };
    for (const Case& c : cases) {
        for (const std::uint32_t substeps : {4u, 20u}) {
            World world(world_def(60, substeps));
            world.add(c.def);
            const Asset asset = particle();
            const lks_object_id object = world.add(asset, at(0, c.top + 0.3, 0));
            world.step(120);
            INFO(c.name << ", " << substeps << " substeps");
            const double first = where(world, object).y;
            CHECK(std::abs(first - c.top - radius) <= 1e-5);
            world.step(60);
            CHECK(std::abs(where(world, object).y - first) <= 1e-6);
            CHECK(metres(world.velocities(object)[0]).length() < 1e-3);
        }
    }
}

TEST_CASE("a cloth that has come to rest touches nothing by more than 1e-5 m") {
    Net net;
    net.side = 24;
    net.width = 1.2;
    net.radius = radius;
    net.shear = soft(1e-6);
    net.bend = soft(1e-3);
    const Asset asset = net.build();
    World world;
    lks_collider_def sphere = shape(LKS_SHAPE_SPHERE, at(0.3, 0.4, 0));
    sphere.radius = fixed(0.25);
    world.add(sphere);
    world.add(box(fixed(0.2, 0.3, 0.2), at(-0.4, 0.3, 0)));
    world.add(shape(LKS_SHAPE_PLANE, at(0, 0, 0)));
    lks_object_def def = object_def(asset, turned(at(0, 0.9, 0), 1, 0, 0, 90));
    def.linear_damping = fixed(0.5);
    const lks_object_id object = world.add(def);
    for (int tick = 0; tick < 180; ++tick) {
        world.step();
        if (tick % 10 == 9) {
            double deepest = 1;
            for (const Vector& p : world.positions_from(object, {})) {
                deepest = std::min(deepest, p.y);
                deepest = std::min(deepest, (p - Vector{0.3, 0.4, 0}).length() - 0.25);
                deepest = std::min(deepest, distance_from_box(p - Vector{-0.4, 0.3, 0}, {0.2, 0.3, 0.2}));
            }
            INFO("tick " << tick);
            CHECK(deepest >= radius - 1e-5);
        }
    }
    // It lies on them: not everything has slid off.
    double highest = 0;
    for (const Vector& p : world.positions_from(object, {})) {
        highest = std::max(highest, p.y);
    }
    CHECK(highest > 0.6);
}

TEST_CASE("below the friction angle a particle stays and above it slides as Coulomb says") {
    constexpr double static_friction = 0.5;
    constexpr double dynamic_friction = 0.4;
    for (const double degrees : {5.0, 20.0, 26.0, 27.0, 30.0, 45.0}) {
        World world;
        lks_collider_def def = shape(LKS_SHAPE_PLANE, turned(at(0, 0, 0), 0, 0, 1, -degrees));
        def.static_friction = fixed(static_friction);
        def.dynamic_friction = fixed(dynamic_friction);
        world.add(def);
        const Asset asset = particle();
        const double angle = degrees * 3.14159265358979323846 / 180;
        // On the slope, which falls towards +x.
        const lks_object_id object =
            world.add(asset, at(radius * std::sin(angle), radius * std::cos(angle), 0));
        const Vector start = where(world, object);
        world.step(60);
        const double moved = (where(world, object) - start).length();
        INFO(degrees << " degrees");
        if (std::tan(angle) < static_friction) {
            CHECK(moved < 1e-5);
        } else {
            const double expected = 0.5 * gravity * (std::sin(angle) - dynamic_friction * std::cos(angle));
            CHECK(moved == doctest::Approx(expected).epsilon(0.02));
        }
    }
}

TEST_CASE("the asset's friction is a factor on the collider's") {
    for (const double factor : {0.0, 1.0, 2.0}) {
        std::vector<double> points{0, 0, 0, 10, 10, 0};
        const std::vector<double> masses{1, 1};
        lks_rope_def rope = lks_default_rope_def();
        rope.segments = 0;
        rope.length = 0;
        rope.point_count = 2;
        rope.points = points.data();
        rope.linear_density = 0;
        rope.vertex_masses = masses.data();
        rope.stretch = off;
        rope.bend = off;
        rope.particle_radius = radius;
        rope.friction = factor;
        const Asset asset(rope);
        World world;
        lks_collider_def def = shape(LKS_SHAPE_PLANE, at(0, 0, 0));
        def.static_friction = fixed(0.3);
        def.dynamic_friction = fixed(0.3);
        world.add(def);
        lks_object_def object_settings = object_def(asset, at(0, radius, 0));
        object_settings.velocity = fixed(4, 0, 0);
        const lks_object_id object = world.add(object_settings);
        world.step(30);
        INFO("factor " << factor);
        CHECK(metres(world.velocities(object)[0]).x ==
              doctest::Approx(4 - 0.3 * factor * gravity * 0.5).epsilon(0.01));
    }
}

TEST_CASE("a moving box pushes what is in its way and never passes it") {
    lks_world_def settings = world_def(60, 10);
    settings.gravity = {};
    World world(settings);
    const lks_collider_id pusher = world.add(box(fixed(0.1, 0.3, 0.3), at(-0.5, 0, 0)));
    const Asset asset = particle();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    for (int tick = 1; tick <= 90; ++tick) {
        const lks_vec3 place = fixed(-0.5, 0, 0) + lks_vec3{LKS_FIXED_ONE * tick / 60, 0, 0};
        REQUIRE(lks_collider_move_to(world, pusher, at(place)) == LKS_OK);
        world.step();
        const double face = metres(place.x) + 0.1;
        CHECK(where(world, object).x >= face + radius - 1e-5);
        lks_transform now{};
        REQUIRE(lks_collider_transform(world, pusher, &now) == LKS_OK);
        CHECK(same(now.position, place));
    }
    CHECK(where(world, object).x < 1.15);
    CHECK(metres(world.velocities(object)[0]).x == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("a moving plate carries what lies on it and leaves it when it stops") {
    World world;
    const lks_collider_id plate = world.add(box(fixed(1, 0.1, 1), at(0, 0, 0)));
    const Asset asset = particle();
    const lks_object_id object = world.add(asset, at(0, 0.1 + radius, 0));
    world.step(10);
    double carried = 0;
    for (int tick = 1; tick <= 60; ++tick) {
        carried += tick < 30 ? tick / 3600.0 : 30 / 3600.0; // gently to half a metre a second
        REQUIRE(lks_collider_move_to(world, plate, at(carried, 0, -carried)) == LKS_OK);
        world.step();
    }
    CHECK(where(world, object).x == doctest::Approx(carried).epsilon(0.01));
    CHECK(where(world, object).z == doctest::Approx(-carried).epsilon(0.01));
    CHECK(std::abs(where(world, object).y - 0.1 - radius) < 1e-5);
    // The plate rests: friction brings the particle to rest on it.
    world.step(60);
    CHECK(metres(world.velocities(object)[0]).length() < 1e-3);
}

TEST_CASE("a turning plate takes a particle round with it") {
    World world;
    const lks_collider_id plate = world.add(box(fixed(1, 0.1, 1), at(0, 0, 0)));
    const Asset asset = particle();
    const lks_object_id object = world.add(asset, at(0.3, 0.1 + radius, 0));
    world.step(10);
    double degrees = 0;
    while (degrees < 90) {
        degrees = std::min(90.0, degrees + std::min(1.0, 0.02 + degrees / 16)); // gently, or it slips
        REQUIRE(lks_collider_move_to(world, plate, turned(at(0, 0, 0), 0, 1, 0, degrees)) == LKS_OK);
        world.step();
    }
    // A quarter turn about +y takes +x to -z.
    const Vector place = where(world, object);
    CHECK(std::abs(place.x) < 0.005);
    CHECK(place.z == doctest::Approx(-0.3).epsilon(0.02));
}

TEST_CASE("a collider that is set to a place makes no motion") {
    World world;
    const lks_collider_id plate = world.add(box(fixed(1, 0.1, 1), at(0, 0, 0)));
    const Asset asset = particle();
    const lks_object_id object = world.add(asset, at(0, 0.1 + radius, 0));
    world.step(20);
    REQUIRE(lks_collider_set_transform(world, plate, at(0.5, 0, 0)) == LKS_OK);
    world.step(5);
    CHECK(std::abs(where(world, object).x) < 1e-5);
    REQUIRE(lks_world_remove_collider(world, plate) == LKS_OK);
    world.step(30);
    CHECK(where(world, object).y < -0.5);
}

TEST_CASE("a pinned vertex goes its way through a collider") {
    World world;
    const Asset asset = particle();
    lks_collider_def sphere = shape(LKS_SHAPE_SPHERE, at(0, 0, 0));
    world.add(sphere);
    const lks_object_id object = world.add(asset, at(0, 0.2, 0));
    world.pin(object, 0);
    world.step(10);
    CHECK(same(world.positions(object)[0], fixed(0, 0.2, 0)));
}

TEST_CASE("a rope hung over a thin bar stays on it") {
    World world;
    lks_collider_def bar = shape(LKS_SHAPE_CAPSULE, turned(at(0, 1, 0), 1, 0, 0, 90));
    bar.radius = fixed(0.05);
    bar.half_length = fixed(1);
    bar.static_friction = fixed(0.8);
    bar.dynamic_friction = fixed(0.7);
    world.add(bar);
    lks_rope_def def = lks_default_rope_def();
    def.length = 1.6;
    def.segments = 80;
    def.bend = soft(1e-2);
    const Asset asset(def);
    const lks_object_id object = world.add(asset, at(-0.8, 1.07, 0));
    for (int tick = 0; tick < 240; ++tick) {
        world.step();
        for (const Vector& p : world.positions_from(object, {})) {
            const double distance = Vector{p.x, p.y - 1, 0}.length() - 0.05;
            REQUIRE(distance >= 0.01 - 1e-5);
        }
    }
    double highest = -10;
    for (const Vector& p : world.positions_from(object, {})) {
        highest = std::max(highest, p.y);
    }
    CHECK(highest > 1.05);
}
