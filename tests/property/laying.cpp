// Vertices that are put where the game says.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/places.h"
#include "support/ropes.h"

using namespace support;

namespace {

Chain ten_metres(std::uint32_t solver) {
    Chain chain;
    chain.segments = 20;
    chain.length = 10;
    chain.particle_mass = 0.05;
    chain.solver = solver;
    return chain;
}

std::vector<lks_vec3> between(const lks_vec3& a, const lks_vec3& b, std::uint32_t segments) {
    std::vector<lks_vec3> places;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const auto part = [&](lks_fixed p, lks_fixed q) { return p + (q - p) / segments * i; };
        places.push_back({part(a.x, b.x), part(a.y, b.y), part(a.z, b.z)});
    }
    return places;
}

lks_world_def with_views(std::uint32_t substeps) {
    lks_world_def def = world_def(60, substeps);
    def.keep_previous_positions = 1;
    return def;
}

} // namespace

TEST_CASE("a rope that is laid between two places is there to the bit and hangs from them") {
    for (const std::uint32_t solver : {LKS_ROPE_SWEPT, LKS_ROPE_DIRECT}) {
        for (const double far : {0.0, 40.0, 1000000.0, -8387000.0}) {
            World world(with_views(10));
            const Chain chain = ten_metres(solver);
            const Asset asset = chain.build();
            const lks_object_id rope = world.add(asset, at(0, 0, 0));
            world.pin(rope, 0);
            world.pin(rope, 20);
            REQUIRE(lks_object_add_velocity(world, rope, fixed(0, 0, 1)) == LKS_OK);
            world.step(20);
            const std::vector<lks_vec3> velocities = world.velocities(rope);
            const std::vector<lks_vec3> places = between(fixed(far, 5, 1), fixed(far, 5, 11), 20);
            lay(world, rope, 0, places);
            CHECK(same(world.positions(rope), places));
            CHECK(same(world.velocities(rope), velocities));
            CHECK(drawn(world, rope, 0) == drawn(world, rope, LKS_VIEW_LAST_TICK));
            for (std::uint32_t i = 1; i < 20; ++i) {
                REQUIRE(lks_object_set_velocity(world, rope, i, {}) == LKS_OK);
            }
            double speed = 0;
            double stretch = 0;
            for (int tick = 0; tick < 60; ++tick) {
                world.step();
                for (const lks_vec3& velocity : world.velocities(rope)) {
                    speed = std::max(speed, metres(velocity).length());
                }
                stretch = std::max(stretch, worst_stretch(world, rope, chain));
            }
            INFO("solver " << solver << ", " << far << " m away: " << speed << " m/s, stretched by "
                           << stretch);
            CHECK(speed < 5); // it falls into its sag
            CHECK(stretch < 0.05);
            // Pins have gone with it.
            CHECK(same(world.positions(rope)[0], places[0]));
            CHECK(same(world.positions(rope)[20], places[20]));
            CHECK(world.counters().target_clamps == 0);
            CHECK(world.counters().position_clamps == 0);
        }
    }
}

TEST_CASE("where it is laid in the world changes no bit of how a rope moves") {
    const Chain chain = ten_metres(LKS_ROPE_AUTOMATIC);
    const Asset asset = chain.build();
    const auto hash_of = [&](const lks_vec3& offset) {
        World world(world_def(60, 10));
        const lks_object_id rope = world.add(asset, at(offset));
        world.pin(rope, 3);
        world.step(10);
        lay(world, rope, 0, between(offset + fixed(100, 0, 7), offset + fixed(107, 7, 7), 20));
        world.step(30);
        return lks_object_hash(world, rope);
    };
    const std::uint64_t here = hash_of({});
    CHECK(here == hash_of({1, -1, 12345}));
    CHECK(here == hash_of(fixed(-8000000, 7999999.3, 0.1)));
}

TEST_CASE("vertices that stay keep their place to the bit, and their pins, where the frame has to move") {
    // Two points near one end of their range, so that the third takes the frame along.
    World world(with_views(10));
    const Asset points = loose_points({{0, 0, 0}, {1, 0, 0}, {0.3, 0, 0}}, {1, 1, 1});
    const lks_object_id object = world.add(points, at(0.1, 0.2, 0.3));
    world.pin(object, 1);
    world.set_target(object, 1, fixed(1.7, 0, 0));
    REQUIRE(lks_object_add_velocity(world, object, fixed(0.1, 0.2, 0.3)) == LKS_OK);
    world.step(3);
    world.set_target(object, 1, fixed(1.9, 0.1, 0.2));
    const auto place = [&](std::uint32_t vertex) {
        const lks_vec3 origin = world.origin(object);
        const lks_raw_position raw = world.raw_positions(object)[vertex];
        const auto sum = [](lks_fixed o, std::int64_t r) {
            return (static_cast<std::uint64_t>(o) << 16) + static_cast<std::uint64_t>(r);
        };
        return std::vector<std::uint64_t>{sum(origin.x, raw.x), sum(origin.y, raw.y), sum(origin.z, raw.z)};
    };
    const std::vector<std::uint64_t> first = place(0);
    const std::vector<std::uint64_t> second = place(1);
    const std::vector<lks_vec3> velocities = world.velocities(object);
    const lks_vec3 origin = world.origin(object);
    const std::vector<float> before = drawn(world, object, 0);
    for (const double x : {100.0, 63.0, -110.0, 2.0}) {
        lay(world, object, 2, {fixed(x, -1, 3)});
        CHECK(same(world.positions(object)[2], fixed(x, -1, 3)));
        CHECK(place(0) == first);
        CHECK(place(1) == second);
        CHECK(same(world.velocities(object), velocities));
        const std::vector<float> after = drawn(world, object, 0);
        for (int i = 0; i < 6; ++i) {
            CHECK(std::abs(after[static_cast<std::size_t>(i)] - before[static_cast<std::size_t>(i)]) < 1e-6f);
        }
    }
    CHECK_FALSE(same(world.origin(object), origin));
    CHECK(world.counters().target_clamps == 0);
    world.step();
    CHECK(same(world.positions(object)[1], fixed(1.9, 0.1, 0.2)));
}

TEST_CASE("a target that the frame leaves behind is clamped and counted, one that is laid is not") {
    World world;
    const Asset points = loose_points({{0, 0, 0}, {1, 0, 0}}, {1, 1});
    const lks_object_id object = world.add(points, at(0, 0, 0));
    world.pin(object, 0);
    world.pin(object, 1);
    world.set_target(object, 0, fixed(-60, 0, 0));
    lay(world, object, 1, {fixed(70, 0, 0)});
    CHECK(world.counters().target_clamps == 1);
    world.step();
    CHECK(same(world.positions(object)[1], fixed(70, 0, 0)));
    lay(world, object, 0, {fixed(500000, 0, 0), fixed(500001, 0, 0)});
    CHECK(world.counters().target_clamps == 1);
    world.step();
    CHECK(same(world.positions(object)[0], fixed(500000, 0, 0)));
}

TEST_CASE("a free vertex that is laid goes on from there with its velocity") {
    World world(weightless(4));
    const Asset points = loose_points({{0, 0, 0}, {5, 0, 0}}, {1, 1});
    const lks_object_id object = world.add(points, at(0, 0, 0));
    REQUIRE(lks_object_set_velocity(world, object, 0, fixed(3, 0, -6)) == LKS_OK);
    world.step(6);
    lay(world, object, 0, {fixed(1, 1, 1)});
    CHECK(world.counters().speed_clamps == 0);
    world.step(60);
    const Vector end = metres(world.positions(object)[0]);
    CHECK((end - Vector{4, 1, -5}).length() < 1e-9);
    CHECK((metres(world.positions(object)[1]) - Vector{5, 0, 0}).length() == 0);
}
