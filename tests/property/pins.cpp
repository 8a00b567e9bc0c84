// Pins: exactly at their targets at the end of a tick, evenly on the way there, and free again with the
// velocity they had.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "reference/asset_model.h"
#include "reference/xpbd.h"
#include "support/builders.h"

using namespace support;

namespace {

bool raw_equals(const lks_raw_position& raw, const lks_vec3& target, const lks_vec3& origin) {
    const lks_vec3 local = target - origin;
    return raw.x == local.x << 16 && raw.y == local.y << 16 && raw.z == local.z << 16;
}

} // namespace

TEST_CASE("a pinned vertex is exactly at its target at the end of each tick") {
    for (const std::uint32_t substeps : {1u, 7u, 20u, 999u}) {
        World world(world_def(60, substeps));
        const Asset asset = Chain().build();
        const lks_object_id object = world.add(asset, at(0.1, 5, -3));
        world.pin(object, 0);
        world.pin(object, 19);
        Random random(substeps);
        lks_vec3 target = fixed(0.1, 5, -3);
        for (int tick = 0; tick < (substeps > 100 ? 3 : 60); ++tick) {
            const std::int64_t limit = LKS_FIXED_ONE / 5;
            target = target + lks_vec3{random.between(-limit, limit), random.between(-limit, limit),
                                       random.between(-limit, limit)};
            world.set_target(object, 0, target);
            world.step();
            INFO(substeps << " substeps, tick " << tick);
            CHECK(raw_equals(world.raw_positions(object)[0], target, world.origin(object)));
            CHECK(same(world.positions(object)[0], target));
            CHECK(same(world.positions(object)[19], fixed(2.1, 5, -3)));
        }
    }
}

TEST_CASE("a target stays until it is changed and holds to the bit under load") {
    World world;
    const Asset asset = Chain().build();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 0);
    world.set_target(object, 0, fixed(0.1, 0.2, 0.3));
    for (int tick = 0; tick < 60; ++tick) {
        world.step();
        CHECK(raw_equals(world.raw_positions(object)[0], fixed(0.1, 0.2, 0.3), world.origin(object)));
    }
}

TEST_CASE("a moving pin goes evenly through the substeps and drags a chain as double precision says") {
    Chain chain;
    const Asset asset = chain.build();
    World world(world_def(60, 20));
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    const std::vector<double> masses(chain.segments + 1, chain.particle_mass);
    const reference::Model model =
        reference::model_of(world, object, asset, {}, masses, {chain.stretch, off, off});
    reference::Solver<double> expected(model, reference::Settings());
    world.pin(object, 0);
    expected.pin(0);
    Vector target;
    double largest = 0;
    for (int tick = 0; tick < 30; ++tick) {
        // Up and aside, faster and faster: up to 3 m/s.
        target = target + Vector{0.0005 * tick, 0.001 * tick, -0.0015 * tick};
        const lks_vec3 exact = fixed(target.x, target.y, target.z);
        world.set_target(object, 0, exact);
        expected.set_target(0, metres(exact));
        world.step();
        expected.tick();
        const std::vector<Vector> positions = world.positions_from(object, {});
        for (std::size_t i = 0; i < positions.size(); ++i) {
            largest = std::max(largest, (positions[i] - expected.position(i)).length());
        }
        const Vector velocity = metres(world.velocities(object)[0]);
        CHECK((velocity - Vector{0.0005, 0.001, -0.0015} * (60.0 * tick)).length() < 1e-9);
    }
    MESSAGE("largest deviation behind a moving pin: " << largest << " m");
    CHECK(largest <= 3e-7);
}

TEST_CASE("a vertex that is unpinned keeps the velocity it had") {
    lks_world_def def = world_def(60, 8);
    def.gravity = {};
    World world(def);
    const Asset asset = loose_points({{0, 0, 0}, {1, 0, 0}}, {1, 1});
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 0);
    world.set_target(object, 0, fixed(0.05, -0.025, 0.0125));
    world.step();
    const lks_vec3 velocity = world.velocities(object)[0];
    CHECK((metres(velocity) - Vector{3, -1.5, 0.75}).length() < 1e-9);
    REQUIRE(lks_object_unpin(world, object, 0) == LKS_OK);
    CHECK(same(world.velocities(object)[0], velocity));
    world.step(60);
    CHECK((world.positions_from(object, {})[0] - Vector{3.05, -1.525, 0.7625}).length() < 1e-9);
    CHECK(same(world.positions(object)[1], fixed(1, 0, 0)));
}

TEST_CASE("pinning puts the target at the present place and pinning again changes nothing") {
    World world;
    const Asset asset = Chain().build();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.step(10);
    const lks_raw_position place = world.raw_positions(object)[5];
    world.pin(object, 5);
    CHECK(lks_object_pin_count(world, object) == 1);
    CHECK(lks_object_is_pinned(world, object, 5) == 1);
    CHECK(lks_object_is_pinned(world, object, 4) == 0);
    const lks_vec3 origin = world.origin(object);
    world.step();
    const lks_raw_position after = world.raw_positions(object)[5];
    const lks_vec3 moved = world.origin(object) - origin;
    CHECK(after.x + (moved.x << 16) == place.x);
    CHECK(after.y + (moved.y << 16) == place.y);
    CHECK(after.z + (moved.z << 16) == place.z);

    world.set_target(object, 5, world.positions(object)[5] + fixed(0.1, 0, 0));
    const std::uint64_t hash = world.hash();
    world.pin(object, 5);
    CHECK(world.hash() == hash);
    CHECK(lks_object_pin_count(world, object) == 1);

    REQUIRE(lks_object_unpin(world, object, 5) == LKS_OK);
    CHECK(lks_object_pin_count(world, object) == 0);
    CHECK(lks_object_is_pinned(world, object, 5) == 0);
}

TEST_CASE("a pinned vertex takes no impulse and refuses a velocity") {
    World world;
    const Asset asset = Chain().build();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 3);
    const std::uint64_t hash = world.hash();
    CHECK(lks_object_apply_impulse(world, object, 3, fixed(1, 2, 3)) == LKS_OK);
    CHECK(world.hash() == hash);
    CHECK(lks_object_set_velocity(world, object, 3, fixed(1, 2, 3)) != LKS_OK);
    CHECK(world.message().find("3") != std::string::npos);
    CHECK(world.hash() == hash);
}

TEST_CASE("a target out of the object's reach is clamped and counted") {
    World world;
    const Asset asset = Chain().build();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    world.pin(object, 0);
    CHECK(world.counters().target_clamps == 0);
    CHECK(lks_object_set_pin_target(world, object, 0, fixed(1000, 0, 0)) == LKS_OK);
    CHECK(world.counters().target_clamps == 1);
}

TEST_CASE("all vertices of a cloth may be pinned and it stays where it is") {
    World world;
    Net net;
    net.side = 8;
    const Asset asset = net.build();
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    const std::vector<lks_vec3> before = world.positions(object);
    for (std::uint32_t vertex = 0; vertex < asset.vertex_count(); ++vertex) {
        world.pin(object, vertex);
    }
    CHECK(lks_object_pin_count(world, object) == asset.vertex_count());
    world.step(30);
    const std::vector<lks_vec3> after = world.positions(object);
    bool unmoved = true;
    for (std::size_t i = 0; i < after.size(); ++i) {
        unmoved = unmoved && same(before[i], after[i]);
    }
    CHECK(unmoved);
    for (std::uint32_t vertex = 0; vertex < asset.vertex_count(); ++vertex) {
        REQUIRE(lks_object_unpin(world, object, vertex) == LKS_OK);
    }
    world.step(60);
    // Falling again, and all of it alike.
    for (const lks_vec3& velocity : world.velocities(object)) {
        CHECK(metres(velocity.y) == doctest::Approx(-9.81).epsilon(1e-6));
    }
}
