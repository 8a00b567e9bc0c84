// Where in the world a scene is changes no bit of how it moves.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/scene.h"

using namespace support;

namespace {

bool equal(const std::vector<lks_raw_position>& a, const std::vector<lks_raw_position>& b) {
    if (a.size() != b.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].x != b[i].x || a[i].y != b[i].y || a[i].z != b[i].z) {
            return false;
        }
    }
    return true;
}

void check_translated(const SceneAssets& assets, const lks_vec3& offset, int ticks) {
    Scene here(assets, {}, world_def(60, 5));
    Scene there(assets, offset, world_def(60, 5));
    INFO("offset in raw units: " << offset.x << " " << offset.y << " " << offset.z);
    for (int tick = 0; tick < ticks; ++tick) {
        REQUIRE(here.world.local_hash() == there.world.local_hash());
        here.tick();
        there.tick();
    }
    for (const lks_object_id object : {here.net, here.mesh, here.rope}) {
        CHECK(lks_object_hash(here.world, object) == lks_object_hash(there.world, object));
        CHECK(equal(here.world.raw_positions(object), there.world.raw_positions(object)));
        CHECK(same(there.world.origin(object), here.world.origin(object) + offset));
        const std::vector<lks_vec3> a = here.world.positions(object);
        const std::vector<lks_vec3> b = there.world.positions(object);
        bool moved = true;
        for (std::size_t i = 0; i < a.size(); ++i) {
            moved = moved && same(a[i] + offset, b[i]);
        }
        CHECK(moved);
    }
    CHECK(here.world.counters().target_clamps == 0);
    CHECK(there.world.counters().target_clamps == 0);
    CHECK(here.world.hash() != there.world.hash());
}

} // namespace

TEST_CASE("a scene with pins and colliders moved by any raw units has the same local bits") {
    const SceneAssets assets;
    Random random(42);
    const std::int64_t limit = LKS_FIXED(8000000);
    const int rounds = long_runs() ? 200 : 12;
    for (int round = 0; round < rounds; ++round) {
        check_translated(
            assets,
            {random.between(-limit, limit), random.between(-limit, limit), random.between(-limit, limit)},
            60);
    }
}

TEST_CASE("a scene moved by one raw unit or by 8000 km has the same local bits") {
    const SceneAssets assets;
    check_translated(assets, {1, 0, 0}, 90);
    check_translated(assets, {0, -1, 1}, 90);
    check_translated(assets, fixed(8000000, 0, -8000000), 90);
    check_translated(assets, fixed(-8000000, 8000000, 8000000), 90);
    check_translated(assets, {LKS_FIXED_ONE / 2, LKS_FIXED_ONE / 2 - 1, LKS_FIXED_ONE / 2 + 1}, 90);
}

TEST_CASE("an object that travels far keeps its place to the unit") {
    // Free points at 37 m/s for half a minute: their frame follows them in whole metres, and they must be
    // exactly where the sum of equal steps puts them.
    lks_world_def def = world_def(60, 4);
    def.gravity = {};
    World world(def);
    const Asset points = loose_points({{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0.3}}, {1, 2, 3});
    lks_object_def object = object_def(points, at(0.3, 0, 0));
    object.velocity = fixed(37, 0.25, -12.5);
    const lks_object_id id = world.add(object);
    const auto place = [&] {
        const lks_vec3 origin = world.origin(id);
        const lks_raw_position raw = world.raw_positions(id)[2];
        const auto sum = [](lks_fixed o, std::int64_t r) {
            return (static_cast<std::uint64_t>(o) << 16) + static_cast<std::uint64_t>(r);
        };
        return std::array<std::uint64_t, 3>{sum(origin.x, raw.x), sum(origin.y, raw.y), sum(origin.z, raw.z)};
    };
    const std::array<std::uint64_t, 3> start = place();
    world.step();
    const std::array<std::uint64_t, 3> second = place();
    world.step(1799);
    const std::array<std::uint64_t, 3> last = place();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(last[axis] - start[axis] == 1800 * (second[axis] - start[axis]));
    }
    CHECK(metres(world.origin(id).x) > 1000);
    CHECK(world.counters().position_clamps == 0);
    CHECK(world.counters().world_edge_hits == 0);
}

TEST_CASE("at the edge of the world an object stops following and the hits are counted") {
    lks_world_def def = world_def(60, 4);
    def.gravity = {};
    World world(def);
    const Asset rope = Chain().build();
    lks_object_def object = object_def(rope, at(8387990, 0, 0));
    object.velocity = fixed(50, 0, 0);
    const lks_object_id id = world.add(object);
    world.step(600);
    CHECK(world.counters().world_edge_hits > 0);
    CHECK(world.counters().position_clamps > 0);
    CHECK(world.origin(id).x <= LKS_FIXED(8388607));
    for (const lks_vec3& position : world.positions(id)) {
        CHECK(position.x > LKS_FIXED(8387000));
    }
    // It can still be taken away from there.
    REQUIRE(lks_object_add_velocity(world, id, fixed(-80, 0, 0)) == LKS_OK);
    world.step(60);
    CHECK(world.positions(id)[0].x < LKS_FIXED(8388000));
}
