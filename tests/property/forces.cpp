// The force of a constraint, in newtons: what it carries when things hang, pulls when they stretch, and
// pushes when they stand.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

constexpr double gravity = 9.81;

struct Recorded {
    Asset asset;
    World world;
    lks_object_id object;
};

// A vertical chain with air to settle it, pinned at vertex `pin`, after `seconds`.
Recorded settled(const Chain& chain, std::uint32_t pin, double seconds, std::uint32_t iterations = 1) {
    Recorded result{chain.build(), World(world_def(60, 20, iterations)), {}};
    lks_object_def def = object_def(result.asset, at(0, 0, 0));
    def.record_forces = 1;
    def.linear_damping = fixed(8);
    result.object = result.world.add(def);
    result.world.pin(result.object, pin);
    result.world.step(static_cast<std::uint64_t>(60 * seconds));
    return result;
}

} // namespace

TEST_CASE("a hanging mass pulls with m g within 0.1 % however soft its spring is") {
    for (const double compliance : {0.0, 1e-6, 1e-3, 1e-2}) {
        for (const double mass : {0.001, 1.0, 20.0}) {
            if (compliance * mass > 0.05) {
                continue; // would hang further than a metre
            }
            for (const std::uint32_t iterations : {1u, 5u}) {
                Chain chain;
                chain.segments = 1;
                chain.length = 1;
                chain.particle_mass = mass;
                chain.direction = {0, -1, 0};
                chain.stretch = soft(compliance);
                const Recorded recorded = settled(chain, 0, 8, iterations);
                INFO(compliance << " m/N, " << mass << " kg, " << iterations << " iterations");
                CHECK(recorded.world.force(recorded.object, 0) ==
                      doctest::Approx(mass * gravity).epsilon(0.001));
            }
        }
    }
}

TEST_CASE("each link of a hanging chain carries what hangs below it within 0.1 %") {
    for (const double compliance : {0.0, 1e-4}) {
        Chain chain;
        chain.segments = 8;
        chain.particle_mass = 0.25;
        chain.direction = {0, -1, 0};
        chain.stretch = soft(compliance);
        const Recorded recorded = settled(chain, 0, 12);
        for (std::uint32_t i = 0; i < recorded.asset.constraint_count(); ++i) {
            const lks_constraint_info info = recorded.asset.constraints()[i];
            const double below = chain.segments - std::min(info.vertex_a, info.vertex_b);
            INFO(compliance << " m/N, link below vertex " << std::min(info.vertex_a, info.vertex_b));
            CHECK(recorded.world.force(recorded.object, i) ==
                  doctest::Approx(below * chain.particle_mass * gravity).epsilon(0.001));
        }
    }
}

TEST_CASE("a mass that stands on a post presses with m g and the sign of compression") {
    for (const double compliance : {0.0, 1e-3}) {
        Chain chain;
        chain.segments = 1;
        chain.length = 1;
        chain.direction = {0, 1, 0};
        chain.particle_mass = 2;
        chain.stretch = soft(compliance);
        const Recorded recorded = settled(chain, 0, 8);
        INFO(compliance << " m/N");
        CHECK(recorded.world.force(recorded.object, 0) == doctest::Approx(-2 * gravity).epsilon(0.001));
        CHECK(recorded.world.positions_from(recorded.object, {})[1].y ==
              doctest::Approx(1 - compliance * 2 * gravity).epsilon(1e-4));
    }
}

TEST_CASE("a swinging spring's force is its extension over its compliance") {
    Chain chain;
    chain.segments = 1;
    chain.length = 1;
    chain.stretch = soft(0.002);
    const Asset asset = chain.build();
    World world;
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.record_forces = 1;
    const lks_object_id object = world.add(def);
    world.pin(object, 0);
    for (int tick = 0; tick < 120; ++tick) {
        world.step();
        const std::vector<Vector> positions = world.positions_from(object, {});
        const double extension = (positions[1] - positions[0]).length() - 1;
        CHECK(std::abs(world.force(object, 0) - extension / 0.002) < 1e-4);
    }
}

TEST_CASE("a rope pulled apart by two pins has the force of its stretch in every link") {
    Chain chain;
    chain.segments = 5;
    chain.length = 1;
    chain.particle_mass = 0.05;
    chain.stretch = soft(1e-3);
    const Asset asset = chain.build();
    // With one iteration the links pull at their neighbours after these were solved: h²w/α, here 1.4 %.
    lks_world_def settings = world_def(60, 20, 8);
    settings.gravity = {};
    World world(settings);
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.record_forces = 1;
    def.linear_damping = fixed(10);
    const lks_object_id object = world.add(def);
    world.pin(object, 0);
    world.pin(object, 5);
    world.set_target(object, 5, fixed(1.25, 0, 0));
    world.step(600);
    for (std::uint32_t i = 0; i < asset.constraint_count(); ++i) {
        CHECK(world.force(object, i) == doctest::Approx(0.05 / 1e-3).epsilon(0.001));
    }
}

TEST_CASE("before the first tick there is no force and an object without a record says so") {
    const Asset asset = Chain().build();
    World world;
    lks_object_def def = object_def(asset, at(0, 0, 0));
    const lks_object_id silent = world.add(def);
    def.record_forces = 1;
    const lks_object_id recorded = world.add(def);
    lks_fixed force = 77;
    CHECK(lks_object_constraint_force(world, silent, 0, &force) == LKS_ERROR_UNSUPPORTED);
    CHECK(force == 77);
    CHECK(world.force(recorded, 0) == 0);
}

TEST_CASE("a force beyond the range saturates with its sign") {
    Chain chain;
    chain.segments = 1;
    chain.length = 1;
    chain.particle_mass = 1e6;
    chain.direction = {0, -1, 0};
    const Asset asset = chain.build();
    lks_world_def settings = world_def(60, 20);
    settings.gravity = fixed(0, -1000, 0);
    for (const std::uint32_t pin : {0u, 1u}) {
        World world(settings);
        lks_object_def def = object_def(asset, at(0, 0, 0));
        def.record_forces = 1;
        const lks_object_id object = world.add(def);
        world.pin(object, pin);
        world.step(2);
        CHECK(std::abs(world.force(object, 0)) == doctest::Approx(8388607).epsilon(1e-6));
        CHECK((world.force(object, 0) > 0) == (pin == 0));
    }
}

TEST_CASE("the force of the last tick stays the same when a pin is set or taken afterwards") {
    Chain chain;
    chain.segments = 3;
    chain.direction = {0, -1, 0};
    const Asset asset = chain.build();
    World world;
    lks_object_def def = object_def(asset, at(0, 0, 0));
    def.record_forces = 1;
    const lks_object_id object = world.add(def);
    world.pin(object, 0);
    world.step(20);
    const double before = world.force(object, 0);
    CHECK(before > 1);
    world.pin(object, 1);
    CHECK(world.force(object, 0) == doctest::Approx(before).epsilon(1e-6));
    REQUIRE(lks_object_unpin(world, object, 0) == LKS_OK);
    CHECK(world.force(object, 0) == doctest::Approx(before).epsilon(1e-6));
}
