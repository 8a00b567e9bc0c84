// Free motion, gravity, damping, impulses and velocities against their exact discrete solutions.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

World world_with_gravity(const lks_vec3& gravity, std::uint32_t substeps = 10) {
    lks_world_def def = world_def(60, substeps);
    def.gravity = gravity;
    return World(def);
}

Asset two_points(double first_mass = 1, double second_mass = 1) {
    return loose_points({{0, 0, 0}, {1, 0, 0}}, {first_mass, second_mass});
}

} // namespace

TEST_CASE("free fall follows the discrete solution of the method") {
    // x_k = x_0 + v h k + g h² k (k + 1) / 2 after k substeps.
    for (const std::uint32_t substeps : {1u, 10u, 37u}) {
        World world = world_with_gravity(fixed(0.5, -9.81, 3), substeps);
        const Asset asset = two_points();
        lks_object_def def = object_def(asset, at(0, 0, 0));
        def.velocity = fixed(1, 4, -2);
        const lks_object_id object = world.add(def);
        world.step(120);
        const double h = 1.0 / (60.0 * substeps);
        const double k = 120.0 * substeps;
        const Vector expected =
            Vector{1, 4, -2} * (h * k) + Vector{0.5, -9.81, 3} * (h * h * k * (k + 1) / 2);
        const Vector found = world.positions_from(object, {})[0];
        INFO(substeps << " substeps");
        // Only g·h² is rounded, to half a unit of 2^-56 m: the error grows with k² / 4 units.
        CHECK((found - expected).length() < std::ldexp(k * (k + 1), -56) + 1e-12);
        const Vector velocity = metres(world.velocities(object)[0]);
        CHECK((velocity - (Vector{1, 4, -2} + Vector{0.5, -9.81, 3} * 2.0)).length() < 1e-9);
    }
}

TEST_CASE("gravity is the world's times the object's factor and changes with the next tick") {
    World world = world_with_gravity(fixed(0, -10, 0));
    const Asset asset = two_points();
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.gravity_factor = fixed(0.5);
    const lks_object_id half = world.add(def);
    def.gravity_factor = fixed(-2);
    const lks_object_id balloon = world.add(def);
    def.gravity_factor = 0;
    const lks_object_id weightless = world.add(def);
    world.step(60);
    CHECK(metres(world.velocities(half)[0].y) == doctest::Approx(-5).epsilon(1e-10));
    CHECK(metres(world.velocities(balloon)[0].y) == doctest::Approx(20).epsilon(1e-10));
    CHECK(world.velocities(weightless)[0].y == 0);
    CHECK(world.raw_positions(weightless)[0].y == 0);

    REQUIRE(lks_world_set_gravity(world, fixed(3, 0, 0)) == LKS_OK);
    REQUIRE(lks_object_set_gravity_factor(world, half, fixed(1)) == LKS_OK);
    lks_vec3 gravity{};
    REQUIRE(lks_world_gravity(world, &gravity) == LKS_OK);
    CHECK(same(gravity, fixed(3, 0, 0)));
    world.step(60);
    CHECK(metres(world.velocities(half)[0].x) == doctest::Approx(3).epsilon(1e-10));
    CHECK(metres(world.velocities(half)[0].y) == doctest::Approx(-5).epsilon(1e-10));
    CHECK(metres(world.velocities(balloon)[0].x) == doctest::Approx(-6).epsilon(1e-10));
}

TEST_CASE("linear damping takes its share of the velocity a second at any number of substeps") {
    for (const std::uint32_t substeps : {5u, 20u, 50u}) {
        for (const double damping : {0.1, 1.0, 5.0}) {
            World world = world_with_gravity({}, substeps);
            const Asset asset = two_points();
            lks_object_def def = object_def(asset, at(0, 0, 0));
            def.velocity = fixed(8, 0, 0);
            def.linear_damping = fixed(damping);
            const lks_object_id object = world.add(def);
            world.step(60);
            const double h = 1.0 / (60.0 * substeps);
            // The method's own discrete decay, and what it stands for.
            const double expected = 8 * std::pow(1 - damping * h, 60.0 * substeps);
            const double found = metres(world.velocities(object)[0].x);
            INFO(substeps << " substeps, damping " << damping << "/s");
            CHECK(found == doctest::Approx(expected).epsilon(2e-6));
            CHECK(found == doctest::Approx(8 * std::exp(-damping)).epsilon(damping * damping * h));
        }
    }
}

TEST_CASE("damping of more than a substep allows stops the motion and never reverses it") {
    lks_world_def world_settings = world_def(10, 1);
    world_settings.gravity = {};
    World world(world_settings);
    const Asset asset = two_points();
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.velocity = fixed(1, -1, 0.5);
    const lks_object_id object = world.add(def);
    REQUIRE(lks_object_set_linear_damping(world, object, fixed(1000)) == LKS_OK);
    world.step();
    CHECK(same(world.velocities(object)[0], {}));
}

TEST_CASE("an impulse changes the velocity by J / m within 1e-9") {
    for (const double mass : {1e-8, 3e-4, 0.7, 1.0, 123.0, 1e6}) {
        World world = world_with_gravity({});
        const Asset asset = two_points(mass, 1);
        const lks_object_id object = world.add(asset, at(0, 0, 0));
        // About 1, -7 and 0.3 m/s, as near as the impulse's own unit allows.
        const lks_vec3 impulse = fixed(mass, -7 * mass, 0.3 * mass);
        REQUIRE(lks_object_apply_impulse(world, object, 0, impulse) == LKS_OK);
        const Vector expected = metres(impulse) * (1 / mass);
        INFO("mass " << mass);
        for (int tick = 0; tick < 2; ++tick) {
            const Vector found = metres(world.velocities(object)[0]);
            // Velocities are read out in units of 2^-40 m/s.
            CHECK(std::abs(found.x - expected.x) <= 1e-9 * std::abs(expected.x) + 1e-12);
            CHECK(std::abs(found.y - expected.y) <= 1e-9 * std::abs(expected.y) + 1e-12);
            CHECK(std::abs(found.z - expected.z) <= 1e-9 * std::abs(expected.z) + 1e-12);
            CHECK(same(world.velocities(object)[1], {}));
            world.step();
        }
    }
}

TEST_CASE("an impulse and its opposite leave no bit behind") {
    World world;
    const Asset asset = two_points(0.123, 1);
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.step(5);
    const std::uint64_t before = world.hash();
    const lks_vec3 impulse{123456789, -987654321, 5};
    REQUIRE(lks_object_apply_impulse(world, object, 0, impulse) == LKS_OK);
    CHECK(world.hash() != before);
    REQUIRE(lks_object_apply_impulse(world, object, 0, {-impulse.x, -impulse.y, -impulse.z}) == LKS_OK);
    CHECK(world.hash() == before);
}

TEST_CASE("velocities read back as they were set and add_velocity changes every free vertex alike") {
    World world = world_with_gravity({});
    const Asset asset = loose_points({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {1, 5, 0.01});
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    REQUIRE(lks_object_set_velocity(world, object, 1, fixed(3, -4.5, 0.001)) == LKS_OK);
    world.pin(object, 2);
    CHECK(same(world.velocities(object)[1], fixed(3, -4.5, 0.001)));
    REQUIRE(lks_object_add_velocity(world, object, fixed(1, 1, 1)) == LKS_OK);
    const std::vector<lks_vec3> velocities = world.velocities(object);
    CHECK((metres(velocities[0]) - Vector{1, 1, 1}).length() < 1e-11);
    CHECK((metres(velocities[1]) - Vector{4, -3.5, 1.001}).length() < 1e-11);
    CHECK(same(velocities[2], {}));
    world.step(60);
    const std::vector<Vector> positions = world.positions_from(object, {});
    CHECK((positions[0] - Vector{1, 1, 1}).length() < 1e-10);
    CHECK((positions[2] - Vector{2, 0, 0}).length() == 0);
}

TEST_CASE("the speed limit clamps and counts and never silently") {
    World world = world_with_gravity({}, 20);
    const Asset asset = two_points(0.001, 1);
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    const double limit = metres(lks_world_speed_limit(world));
    CHECK(limit == doctest::Approx(1000).epsilon(1e-9));
    CHECK(world.counters().speed_clamps == 0);
    for (int i = 0; i < 3; ++i) {
        REQUIRE(lks_object_apply_impulse(world, object, 0, fixed(0.6, 0, 0)) == LKS_OK);
    }
    CHECK(metres(world.velocities(object)[0].x) == doctest::Approx(limit).epsilon(1e-9));
    CHECK(world.counters().speed_clamps > 0);
}

TEST_CASE("the speed limit is 1000 m/s or 16 m a substep whichever is lower") {
    struct Case {
        std::uint32_t tick_rate, substeps;
        double limit;
    };
    for (const Case& c :
         {Case{1, 1, 16}, Case{10, 2, 320}, Case{60, 1, 960}, Case{63, 1, 1000}, Case{60, 20, 1000}}) {
        const World world(world_def(c.tick_rate, c.substeps));
        CHECK(metres(lks_world_speed_limit(world)) == doctest::Approx(c.limit).epsilon(1e-9));
    }
}

TEST_CASE("positions are rounded to the nearest unit half up from the raw ones") {
    World world;
    const Asset asset = Net().build();
    const lks_object_id object = world.add(asset, turned(at(0.1, 0.2, 0.3), 1, 1, 0, 33));
    world.step(3);
    const lks_vec3 origin = world.origin(object);
    const std::vector<lks_vec3> positions = world.positions(object);
    const std::vector<lks_raw_position> raw = world.raw_positions(object);
    const auto rounded = [](std::int64_t value) { return (value + (std::int64_t{1} << 15)) >> 16; };
    bool agree = true;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        agree = agree && same(positions[i],
                              origin + lks_vec3{rounded(raw[i].x), rounded(raw[i].y), rounded(raw[i].z)});
    }
    CHECK(agree);
    // Any part of the vertices, in the same numbering.
    std::vector<lks_vec3> part(5);
    REQUIRE(lks_object_positions(world, object, 100, 5, part.data()) == LKS_OK);
    for (std::size_t i = 0; i < part.size(); ++i) {
        CHECK(same(part[i], positions[100 + i]));
    }
    REQUIRE(lks_object_positions(world, object, asset.vertex_count(), 0, part.data()) == LKS_OK);
}
