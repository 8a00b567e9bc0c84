// Where the order of calls matters and where it does not, as the headers document it.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "support/scene.h"

using namespace support;

TEST_CASE("objects move the same whatever the order in which they were added") {
    const SceneAssets assets;
    Scene usual(assets, {}, world_def(60, 6));
    Scene reversed(assets, {}, world_def(60, 6), Scene::Order::reversed);
    CHECK(usual.net.index != reversed.net.index);
    CHECK(usual.world.hash() != reversed.world.hash()); // the indices are part of the state
    for (int i = 0; i < 120; ++i) {
        usual.tick();
        reversed.tick();
        REQUIRE(lks_object_hash(usual.world, usual.net) == lks_object_hash(reversed.world, reversed.net));
        REQUIRE(lks_object_hash(usual.world, usual.mesh) == lks_object_hash(reversed.world, reversed.mesh));
        REQUIRE(lks_object_hash(usual.world, usual.rope) == lks_object_hash(reversed.world, reversed.rope));
    }
}

TEST_CASE("an object moves the same alone and among others") {
    const SceneAssets assets;
    Scene crowded(assets, {}, world_def(60, 6));
    Scene alone(assets, {}, world_def(60, 6));
    REQUIRE(lks_world_remove_object(alone.world, alone.mesh) == LKS_OK);
    REQUIRE(lks_world_remove_object(alone.world, alone.rope) == LKS_OK);
    for (std::uint64_t tick = 0; tick < 60; ++tick) {
        crowded.tick();
        // The inputs of the net and the crate only; the removed ones would be refused.
        Scene& s = alone;
        lks_fixed sine = 0, cosine = 0;
        REQUIRE(lks_sin_cos(LKS_FIXED(static_cast<std::int64_t>(tick * 6 % 360)), &sine, &cosine) == LKS_OK);
        s.world.set_target(s.net, 0, fixed(-0.55, 1.95, 0.1) + lks_vec3{sine / 8, cosine / 16, sine / 4});
        lks_transform pose{};
        pose = at(fixed(-0.6, 0.6, 0.3) + lks_vec3{sine / 4, 0, cosine / 4});
        REQUIRE(lks_rotation_from_axis_angle_fixed(lks_vec3{LKS_FIXED(1), LKS_FIXED(2), 0},
                                                   LKS_FIXED(static_cast<std::int64_t>(tick * 4 % 360)),
                                                   &pose.rotation) == LKS_OK);
        REQUIRE(lks_collider_move_to(s.world, s.crate, pose) == LKS_OK);
        s.world.step();
        REQUIRE(lks_object_hash(crowded.world, crowded.net) == lks_object_hash(alone.world, alone.net));
    }
}

TEST_CASE("inputs on different vertices may be given in any order") {
    const SceneAssets assets;
    std::vector<std::uint32_t> vertices(assets.net.vertex_count());
    std::iota(vertices.begin(), vertices.end(), 0u);
    const auto run = [&](bool backwards) {
        Scene scene(assets, {}, world_def(60, 6));
        std::vector<std::uint32_t> order = vertices;
        if (backwards) {
            std::reverse(order.begin(), order.end());
        }
        for (const std::uint32_t vertex : order) {
            if (vertex % 5 == 1) {
                scene.world.pin(scene.net, vertex);
            } else if (vertex % 5 == 2) {
                REQUIRE(lks_object_apply_impulse(scene.world, scene.net, vertex, {vertex * 1000, -5, 7}) ==
                        LKS_OK);
            } else if (vertex % 5 == 3) {
                REQUIRE(lks_object_set_velocity(scene.world, scene.net, vertex, {0, vertex * 100000000, 1}) ==
                        LKS_OK);
            }
        }
        scene.tick(20);
        return scene.world.hash();
    };
    CHECK(run(false) == run(true));
}

TEST_CASE("impulses on one vertex add up to the same bits in any order") {
    const SceneAssets assets;
    Random random(11);
    std::vector<lks_vec3> impulses;
    for (int i = 0; i < 40; ++i) {
        const std::int64_t limit = LKS_FIXED_ONE / 1000;
        impulses.push_back(
            {random.between(-limit, limit), random.between(-limit, limit), random.between(-limit, limit)});
    }
    const auto run = [&](const std::vector<lks_vec3>& order) {
        Scene scene(assets, {}, world_def(60, 6));
        for (const lks_vec3& impulse : order) {
            REQUIRE(lks_object_apply_impulse(scene.world, scene.rope, 7, impulse) == LKS_OK);
        }
        CHECK(scene.world.counters().speed_clamps == 0);
        scene.tick(3);
        return scene.world.hash();
    };
    const std::uint64_t expected = run(impulses);
    std::vector<lks_vec3> order = impulses;
    std::reverse(order.begin(), order.end());
    CHECK(run(order) == expected);
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::swap(order[i], order[static_cast<std::size_t>(random.between(0, 39))]);
    }
    CHECK(run(order) == expected);
    order[0].x += LKS_FIXED_ONE / 1000000;
    CHECK(run(order) != expected);
}

namespace {

// Two boxes or spheres and a net that falls on them; the hash of the net after a second, with the colliders
// added in either order.
std::uint64_t net_over(const std::vector<lks_collider_def>& colliders, const Asset& asset, bool backwards) {
    World world(world_def(60, 10));
    std::vector<lks_collider_def> order = colliders;
    if (backwards) {
        std::reverse(order.begin(), order.end());
    }
    for (const lks_collider_def& def : order) {
        world.add(def);
    }
    const lks_object_id net = world.add(asset, turned(at(0, 1, 0), 1, 0, 0, 90));
    world.step(60);
    return lks_object_hash(world, net);
}

} // namespace

TEST_CASE("colliders that never touch the same particle may be added in any order") {
    Net net;
    net.side = 16;
    net.width = 2;
    net.radius = 0.01;
    const Asset asset = net.build();
    lks_collider_def left = lks_default_collider_def();
    left.radius = fixed(0.2);
    left.transform = at(-0.5, 0.6, 0);
    lks_collider_def right = left;
    right.transform = at(0.5, 0.6, 0.1);
    CHECK(net_over({left, right}, asset, false) == net_over({left, right}, asset, true));
    CHECK(net_over({left, right}, asset, false) != net_over({left}, asset, false));
}

TEST_CASE("a collider that nothing touches changes no bit however near or far it is") {
    Net net;
    net.side = 16;
    net.width = 1;
    net.radius = 0.01;
    const Asset asset = net.build();
    lks_collider_def sphere = lks_default_collider_def();
    sphere.radius = fixed(0.3);
    sphere.transform = at(0, 0.5, 0);
    const std::uint64_t alone = net_over({sphere}, asset, false);
    for (const double distance : {1.2, 3.0, 60.0, 70.0, 200.0, 8000000.0}) {
        for (const std::uint32_t shape : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
            lks_collider_def other = lks_default_collider_def();
            other.shape = shape;
            other.radius = fixed(0.1);
            other.half_length = fixed(0.1);
            other.half_extents = fixed(0.1, 0.1, 0.1);
            other.transform = turned(at(distance, 0.5, -distance), 1, 2, 3, 30);
            INFO("shape " << shape << " at " << distance << " m");
            CHECK(net_over({sphere, other}, asset, false) == alone);
            CHECK(net_over({other, sphere}, asset, false) == alone);
        }
    }
}

TEST_CASE("colliders that touch the same particle act in index order") {
    // Documented in collider.h: the order of adding such colliders is part of the simulation. Points that
    // slide into the valley between two slopes touch both, and there the order shows.
    std::vector<Vector> points;
    std::vector<double> masses;
    for (int i = 0; i < 20; ++i) {
        points.push_back({0.05 * i - 0.47, 0.6, 0.1 * i});
        masses.push_back(1);
    }
    const Asset asset = loose_points(points, masses, 0.01);
    lks_collider_def slopes[2] = {lks_default_collider_def(), lks_default_collider_def()};
    for (int side = 0; side < 2; ++side) {
        slopes[side].shape = LKS_SHAPE_PLANE;
        slopes[side].transform = turned(at(0, 0, 0), 0, 0, 1, side == 0 ? 40 : -25);
    }
    const auto run = [&](int first, bool taken_again) {
        World world(world_def(60, 10));
        const lks_collider_id id = world.add(slopes[first]);
        world.add(slopes[1 - first]);
        if (taken_again) {
            REQUIRE(lks_world_remove_collider(world, id) == LKS_OK);
            world.add(slopes[first]);
        }
        const lks_object_id object = world.add(asset, at(0, 0, 0));
        world.step(90);
        return lks_object_hash(world, object);
    };
    CHECK(run(0, false) == run(0, false));
    CHECK(run(0, false) != run(1, false));
    // By index, not by the time of the call.
    CHECK(run(0, false) == run(0, true));
}
