// The state is a value: saved in mid-motion and loaded into a fresh or a dirty world, it has the same future.
#include <doctest/doctest.h>

#include <deque>
#include <utility>
#include <vector>

#include "support/scene.h"

using namespace support;

namespace {

constexpr std::uint64_t continued_ticks = 120;

lks_world_def small_steps(std::uint32_t iterations = 1) {
    return world_def(60, 6, iterations);
}

// A world that knows the assets and has nothing in it.
World empty_world(const SceneAssets& assets, const lks_world_def& def) {
    World world(def);
    for (const Asset* asset : {&assets.net, &assets.mesh, &assets.rope}) {
        REQUIRE(lks_world_register_asset(world, *asset) == LKS_OK);
    }
    return world;
}

// Both run on with the same inputs and must agree after every tick.
void check_same_future(Scene& original, Scene& loaded) {
    for (std::uint64_t i = 0; i < continued_ticks; ++i) {
        REQUIRE(original.world.tick() == loaded.world.tick());
        REQUIRE(original.world.hash() == loaded.world.hash());
        original.tick();
        loaded.tick();
    }
    CHECK(original.world.hash() == loaded.world.hash());
    CHECK(original.world.local_hash() == loaded.world.local_hash());
    CHECK(original.world.save() == loaded.world.save());
}

// The ids of an image are valid again wherever it is loaded.
void take_ids(Scene& to, const Scene& from) {
    to.net = from.net;
    to.mesh = from.mesh;
    to.rope = from.rope;
    to.ground = from.ground;
    to.ball = from.ball;
    to.bar = from.bar;
    to.crate = from.crate;
}

} // namespace

TEST_CASE("an image loaded into a fresh world continues with the same bits") {
    const SceneAssets assets;
    for (const std::uint32_t iterations : {1u, 3u}) {
        Scene original(assets, {}, small_steps(iterations));
        original.tick(40);
        const Image image = original.world.save();

        Scene loaded(assets, {}, small_steps(iterations));
        loaded.world = empty_world(assets, small_steps(iterations));
        REQUIRE(lks_world_object_count(loaded.world) == 0);
        REQUIRE(lks_world_load(loaded.world, image.data(), image.size()) == LKS_OK);
        CHECK(loaded.world.save() == image);
        check_same_future(original, loaded);
    }
}

TEST_CASE("an image loaded into a world with a different past continues with the same bits") {
    const SceneAssets assets;
    Scene original(assets, {}, small_steps());
    original.tick(40);
    const Image image = original.world.save();

    // Other pins, velocities, gravity, objects, colliders, generations, forces recorded, and another clock.
    Scene dirty(assets, fixed(1000, -20, 3.5), small_steps(), Scene::Order::reversed);
    dirty.tick(25);
    REQUIRE(lks_world_set_gravity(dirty.world, fixed(1, 2, 3)) == LKS_OK);
    REQUIRE(lks_world_remove_object(dirty.world, dirty.mesh) == LKS_OK);
    for (int i = 0; i < 5; ++i) {
        const lks_object_id extra = dirty.world.add(assets.rope, at(0, 5 + i, 0));
        dirty.world.pin(extra, 3);
        dirty.world.add(lks_default_collider_def());
    }
    for (std::uint32_t vertex = 0; vertex < 30; ++vertex) {
        dirty.world.pin(dirty.net, vertex);
    }
    REQUIRE(lks_world_remove_collider(dirty.world, dirty.bar) == LKS_OK);
    dirty.world.step(10);
    REQUIRE(lks_world_advance(dirty.world, 5000000, nullptr) == LKS_OK);
    const std::uint32_t interpolation = lks_world_interpolation(dirty.world);
    REQUIRE(dirty.world.hash() != original.world.hash());

    REQUIRE(lks_world_load(dirty.world, image.data(), image.size()) == LKS_OK);
    CHECK(lks_world_interpolation(dirty.world) == interpolation);
    CHECK(dirty.world.save() == image);
    Scene loaded(assets, {}, small_steps()); // for its inputs only
    loaded.world = std::move(dirty.world);
    take_ids(loaded, original);
    check_same_future(original, loaded);
}

TEST_CASE("a saved world that was never loaded is not disturbed by saving") {
    const SceneAssets assets;
    Scene saved(assets, {}, small_steps());
    Scene plain(assets, {}, small_steps());
    for (int i = 0; i < 30; ++i) {
        (void)saved.world.save();
        saved.tick();
        plain.tick();
        REQUIRE(saved.world.hash() == plain.world.hash());
    }
}

TEST_CASE("every tick rolled back by up to 12 ticks and simulated again has the same hashes") {
    constexpr std::uint64_t window = 12;
    const SceneAssets assets;
    Scene scene(assets, {}, small_steps());
    std::deque<Image> images;
    std::vector<std::uint64_t> hashes{scene.world.hash()};
    images.push_back(scene.world.save());
    Random random(3);
    while (scene.world.tick() < 150) {
        scene.tick();
        hashes.push_back(scene.world.hash());
        images.push_back(scene.world.save());
        if (images.size() > window + 1) {
            images.pop_front();
        }
        const auto back =
            static_cast<std::uint64_t>(random.between(0, static_cast<std::int64_t>(images.size()) - 1));
        const Image& image = images[images.size() - 1 - back];
        const std::uint64_t now = scene.world.tick();
        REQUIRE(lks_world_load(scene.world, image.data(), image.size()) == LKS_OK);
        REQUIRE(scene.world.tick() == now - back);
        REQUIRE(scene.world.hash() == hashes[now - back]);
        while (scene.world.tick() < now) {
            scene.tick();
            REQUIRE(scene.world.hash() == hashes[scene.world.tick()]);
        }
    }
}

TEST_CASE("pinning and unpinning leaves nothing behind that a load would not bring back") {
    // A world may keep caches for pinned objects; a world that never had the pin must go on with the same
    // bits.
    const SceneAssets assets;
    Scene original(assets, {}, small_steps(2));
    original.tick(5);
    for (const std::uint32_t vertex : {17u, 40u, 41u, 100u}) {
        original.world.pin(original.net, vertex);
    }
    original.tick(5);
    for (const std::uint32_t vertex : {41u, 17u, 100u, 40u}) {
        REQUIRE(lks_object_unpin(original.world, original.net, vertex) == LKS_OK);
    }
    const Image image = original.world.save();
    Scene loaded(assets, {}, small_steps(2));
    REQUIRE(lks_world_load(loaded.world, image.data(), image.size()) == LKS_OK);
    check_same_future(original, loaded);
}

TEST_CASE("the hash sees every part of the state") {
    const SceneAssets assets;
    std::vector<std::uint64_t> hashes;
    const auto variant = [&](auto change) {
        Scene scene(assets, {}, small_steps());
        scene.tick(3);
        change(scene);
        hashes.push_back(scene.world.hash());
    };
    variant([](Scene&) {});
    variant([](Scene& s) { CHECK(lks_world_set_gravity(s.world, {0, 0, 1}) == LKS_OK); });
    variant(
        [](Scene& s) { CHECK(lks_object_set_gravity_factor(s.world, s.net, LKS_FIXED_ONE + 1) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_object_set_linear_damping(s.world, s.net, 1) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_object_pin(s.world, s.net, 60) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_object_unpin(s.world, s.net, 0) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_object_set_velocity(s.world, s.net, 77, {0, 0, 100}) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_object_add_velocity(s.world, s.rope, {0, 100, 0}) == LKS_OK); });
    variant(
        [](Scene& s) { CHECK(lks_collider_set_transform(s.world, s.ball, at(0.1, 0.5, 0.2001)) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_collider_move_to(s.world, s.ball, at(0.1, 0.5, 0.2001)) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_world_remove_collider(s.world, s.bar) == LKS_OK); });
    variant([](Scene& s) { CHECK(lks_world_remove_object(s.world, s.rope) == LKS_OK); });
    variant([](Scene& s) { s.world.step(); });
    variant([](Scene& s) { s.world.set_target(s.net, 11, fixed(0.55, 1.95, 0.11)); });
    variant([](Scene& s) {
        // The same collider under a later generation: what an old id means has changed.
        lks_collider_def def = lks_default_collider_def();
        CHECK(lks_world_remove_collider(s.world, s.world.add(def)) == LKS_OK);
    });
    // The same collider with another surface, and another filter.
    const auto collider_variant = [&](auto change) {
        variant([&](Scene& s) {
            lks_collider_def def = lks_default_collider_def();
            change(def);
            s.world.add(def);
        });
    };
    collider_variant([](lks_collider_def&) {});
    collider_variant([](lks_collider_def& def) { def.restitution = 1; });
    collider_variant([](lks_collider_def& def) { def.restitution = LKS_FIXED_ONE; });
    collider_variant([](lks_collider_def& def) { def.filter.category = 3; });
    collider_variant([](lks_collider_def& def) { def.filter.mask -= 1; });
    collider_variant([](lks_collider_def& def) { def.filter.group = 1; });
    collider_variant([](lks_collider_def& def) { def.filter.group = -1; });
    for (std::size_t i = 0; i < hashes.size(); ++i) {
        for (std::size_t j = i + 1; j < hashes.size(); ++j) {
            INFO("variants " << i << " and " << j);
            CHECK(hashes[i] != hashes[j]);
        }
    }
}

TEST_CASE("images of equal states are equal byte for byte") {
    const SceneAssets assets;
    const SceneAssets again; // other addresses, the same fingerprints
    Scene first(assets, {}, small_steps());
    Scene second(again, {}, small_steps());
    first.tick(20);
    second.tick(20);
    CHECK(first.world.save() == second.world.save());
    const Image image = first.world.save();
    REQUIRE(lks_world_load(second.world, image.data(), image.size()) == LKS_OK);
    check_same_future(first, second);
}
