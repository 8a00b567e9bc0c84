// Objects and colliders come and go while the game runs: deterministic, ids reused by generation, stale ones
// refused.
#include <doctest/doctest.h>

#include <set>
#include <utility>
#include <vector>

#include "support/scene.h"

using namespace support;

namespace {

// A minute of comings and goings, driven by a fixed sequence; the hash after each tick.
std::vector<std::uint64_t> busy_world(const SceneAssets& assets, std::uint64_t seed) {
    World world(world_def(60, 4));
    Random random(seed);
    std::vector<lks_object_id> objects;
    std::vector<lks_collider_id> colliders;
    std::vector<std::uint64_t> hashes;
    for (int tick = 0; tick < 150; ++tick) {
        switch (random.between(0, 5)) {
        case 0:
        case 1:
            if (objects.size() < 8) {
                const Asset* kinds[] = {&assets.net, &assets.mesh, &assets.rope};
                lks_object_def def =
                    object_def(*kinds[random.between(0, 2)],
                               at(lks_vec3{random.between(-LKS_FIXED(2), LKS_FIXED(2)), LKS_FIXED(2), 0}));
                def.record_forces = static_cast<std::uint32_t>(random.between(0, 1));
                objects.push_back(world.add(def));
                world.pin(objects.back(), static_cast<std::uint32_t>(random.between(0, 20)));
            }
            break;
        case 2:
            if (!objects.empty()) {
                const auto which = random.between(0, static_cast<std::int64_t>(objects.size()) - 1);
                REQUIRE(lks_world_remove_object(world, objects[static_cast<std::size_t>(which)]) == LKS_OK);
                objects.erase(objects.begin() + which);
            }
            break;
        case 3:
            if (colliders.size() < 8) {
                lks_collider_def def = lks_default_collider_def();
                def.transform = at(lks_vec3{random.between(-LKS_FIXED(2), LKS_FIXED(2)), LKS_FIXED(1), 0});
                colliders.push_back(world.add(def));
            }
            break;
        case 4:
            if (!colliders.empty()) {
                const auto which = random.between(0, static_cast<std::int64_t>(colliders.size()) - 1);
                REQUIRE(lks_world_remove_collider(world, colliders[static_cast<std::size_t>(which)]) ==
                        LKS_OK);
                colliders.erase(colliders.begin() + which);
            }
            break;
        default:
            break;
        }
        world.step();
        hashes.push_back(world.hash());
    }
    REQUIRE(lks_world_object_count(world) == objects.size());
    return hashes;
}

} // namespace

TEST_CASE("a world with comings and goings has the same hashes every time") {
    const SceneAssets assets;
    const std::vector<std::uint64_t> first = busy_world(assets, 5);
    CHECK(first == busy_world(assets, 5));
    CHECK(first == busy_world(SceneAssets(), 5));
    CHECK(first != busy_world(assets, 6));
}

TEST_CASE("a removed object's id is stale for ever and its place is taken again under another generation") {
    const SceneAssets assets;
    World world;
    const lks_object_id kept = world.add(assets.rope, at(0, 0, 0));
    lks_object_id object = world.add(assets.rope, at(0, 1, 0));
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (int i = 0; i < 50; ++i) {
        CHECK(object.generation != 0);
        CHECK(seen.insert({object.index, object.generation}).second);
        CHECK(lks_world_has_object(world, object) == 1);
        REQUIRE(lks_world_remove_object(world, object) == LKS_OK);
        CHECK(lks_world_has_object(world, object) == 0);
        CHECK(lks_world_remove_object(world, object) == LKS_ERROR_STALE_ID);
        const lks_object_id next = world.add(assets.rope, at(0, 1, 0));
        CHECK(next.index == object.index);
        CHECK(lks_world_has_object(world, object) == 0);
        CHECK(lks_object_hash(world, object) == 0);
        object = next;
    }
    CHECK(lks_world_has_object(world, kept) == 1);
}

TEST_CASE("objects and colliders take the lowest free index") {
    const SceneAssets assets;
    World world;
    std::vector<lks_object_id> objects;
    std::vector<lks_collider_id> colliders;
    for (std::uint32_t i = 0; i < 6; ++i) {
        objects.push_back(world.add(assets.rope, at(0, i, 0)));
        colliders.push_back(world.add(lks_default_collider_def()));
        CHECK(objects.back().index == i);
        CHECK(colliders.back().index == i);
    }
    for (const std::size_t i : {4u, 1u, 2u}) {
        REQUIRE(lks_world_remove_object(world, objects[i]) == LKS_OK);
        REQUIRE(lks_world_remove_collider(world, colliders[i]) == LKS_OK);
    }
    for (const std::uint32_t expected : {1u, 2u, 4u, 6u}) {
        CHECK(world.add(assets.rope, at(0, 0, 0)).index == expected);
        CHECK(world.add(lks_default_collider_def()).index == expected);
    }
}

TEST_CASE("objects are listed in index order and the count is that of the living") {
    const SceneAssets assets;
    World world;
    const lks_object_id first = world.add(assets.rope, at(0, 0, 0));
    const lks_object_id second = world.add(assets.net, at(0, 0, 0));
    const lks_object_id third = world.add(assets.mesh, at(0, 0, 0));
    REQUIRE(lks_world_remove_object(world, second) == LKS_OK);
    REQUIRE(lks_world_object_count(world) == 2);
    lks_object_id listed{};
    REQUIRE(lks_world_object_at(world, 0, &listed) == LKS_OK);
    CHECK(listed.index == first.index);
    REQUIRE(lks_world_object_at(world, 1, &listed) == LKS_OK);
    CHECK(listed.index == third.index);
    CHECK(listed.generation == third.generation);
    CHECK(lks_object_asset(world, third) == static_cast<const lks_asset*>(assets.mesh));
    CHECK(lks_object_asset(world, second) == nullptr);
}

TEST_CASE("an asset lives as long as somebody uses it") {
    World world;
    lks_object_id object{};
    {
        const Asset asset = Chain().build();
        object = world.add(asset, at(0, 0, 0));
    }
    world.step(10);
    CHECK(lks_asset_vertex_count(lks_object_asset(world, object)) == 20);
    REQUIRE(lks_world_remove_object(world, object) == LKS_OK);
    world.step();
}

TEST_CASE("objects and colliders may come and go in the tick hook and act from that tick on") {
    struct Director {
        const Asset* rope;
        lks_object_id object{};
        lks_collider_id collider{};
    };
    const SceneAssets assets;
    Director director{&assets.rope, {}, {}};
    lks_world_def def = world_def(60, 4);
    def.max_ticks_per_advance = 100;
    def.before_tick.user = &director;
    def.before_tick.call = [](void* user, lks_world* world, std::uint64_t tick) {
        auto& self = *static_cast<Director*>(user);
        if (tick % 10 == 0) {
            const lks_object_def object = object_def(*self.rope, at(0, 2, 0));
            CHECK(lks_world_add_object(world, &object, &self.object) == LKS_OK);
            CHECK(lks_object_pin(world, self.object, 0) == LKS_OK);
            const lks_collider_def collider = lks_default_collider_def();
            CHECK(lks_world_add_collider(world, &collider, &self.collider) == LKS_OK);
        } else if (tick % 10 == 9) {
            CHECK(lks_world_remove_object(world, self.object) == LKS_OK);
            CHECK(lks_world_remove_collider(world, self.collider) == LKS_OK);
        }
    };
    World stepped(def);
    std::vector<std::uint64_t> hashes{stepped.hash()};
    for (int tick = 1; tick <= 60; ++tick) {
        stepped.step();
        hashes.push_back(stepped.hash());
        CHECK(lks_world_object_count(stepped) == (tick % 10 == 0 ? 0 : 1));
        if (tick % 10 != 0) {
            CHECK(stepped.positions(director.object).back().y <
                  fixed(2)); // it moves in the tick that adds it
        }
    }
    World advanced(def);
    while (advanced.tick() < 60) {
        REQUIRE(lks_world_advance(advanced, 70000000, nullptr) == LKS_OK);
        if (advanced.tick() < hashes.size()) {
            CHECK(advanced.hash() == hashes[advanced.tick()]);
        }
    }
}
