// Any number of workers, the world's own or the game's tasks in whatever order and time: the same bits.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"
#include "support/scene.h"
#include "support/task_system.h"

using namespace support;

namespace {

// Beside one. A sanitizer, which watches each access, sees in three what it sees in four to seven.
std::vector<std::uint32_t> worker_counts() {
    return sanitised ? std::vector<std::uint32_t>{2, 3, 8} : std::vector<std::uint32_t>{2, 3, 4, 5, 6, 7, 8};
}

// A cloth that is large enough for blocks of its phases, thrown over colliders, and a crowd of small things.
struct Crowd {
    Asset sheet;
    Asset net;
    Asset chain;

    static Asset make_sheet() {
        Net shape;
        shape.side = 180; // large with every instruction set
        shape.width = 6;
        shape.shear = soft(1e-6, 2);
        return shape.build();
    }
    static Asset make_net() {
        Net shape;
        shape.side = 12;
        shape.stretch = soft(1e-6);
        return shape.build();
    }

    Crowd() : sheet(make_sheet()), net(make_net()), chain(Chain().build()) {}

    std::vector<std::uint64_t> hashes(const lks_world_def& def, int ticks) const {
        World world(def);
        lks_collider_def ball = lks_default_collider_def();
        ball.transform.position.y = -LKS_FIXED(1);
        lks_collider_id id{};
        REQUIRE(lks_world_add_collider(world, &ball, &id) == LKS_OK);
        lks_collider_def ground = lks_default_collider_def();
        ground.shape = LKS_SHAPE_PLANE;
        ground.transform.position.y = -LKS_FIXED(2);
        REQUIRE(lks_world_add_collider(world, &ground, &id) == LKS_OK);
        for (int i = 0; i < 9; ++i) {
            const lks_object_id small = world.add(i % 2 == 0 ? net : chain, at(i - 4.0, 0.5 * i, 0.2 * i));
            world.pin(small, 0);
            if (i % 2 == 0) {
                REQUIRE(lks_object_apply_impulse(world, small, 70, fixed(5, 9, 5)) == LKS_OK);
            }
        }
        const lks_object_id large = world.add(sheet, turned(at(-1.5, 0, -1), 1, 0, 0, 80));
        world.pin(large, 5);
        // Some of it faster than it may be: the counters have to agree as well.
        for (std::uint32_t vertex = 100; vertex < 4000; vertex += 7) {
            REQUIRE(lks_object_apply_impulse(world, large, vertex, fixed(30, -5, -20)) == LKS_OK);
        }
        std::vector<std::uint64_t> found;
        for (int tick = 0; tick < ticks; ++tick) {
            world.step();
            found.push_back(world.hash());
        }
        const lks_world_counters counters = world.counters();
        found.push_back(counters.speed_clamps);
        found.push_back(counters.position_clamps);
        return found;
    }
};

lks_world_def crowd_def(std::uint32_t workers) {
    lks_world_def def = world_def(60, 8);
    def.worker_count = workers;
    return def;
}

constexpr int ticks = 12;

// Humanoids that fall into each other onto a board that moves, faster than they may be.
std::vector<std::uint64_t> ragdoll_hashes(const lks_world_def& def) {
    World world(def);
    add_ground(world);
    lks_body_def board = lks_default_body_def();
    board.kind = LKS_BODY_KINEMATIC;
    const lks_body_id moved = add_body(world, box_shape(2, 0.05, 2), fixed(0, 0.05, 0), board);
    for (int i = 0; i < 6; ++i) {
        Humanoid humanoid;
        humanoid.def.transform.position = fixed(0.3 * i, 0.2 + 0.4 * i, 0.2 * (i % 2));
        lks_body_id bodies[LKS_HUMANOID_BONES];
        REQUIRE(humanoid.add(world, bodies) == LKS_OK);
        const lks_vec3 fast = fixed(0, -40, 600);
        REQUIRE(lks_body_set_velocity(world, bodies[LKS_HUMANOID_HAND_LEFT], fast, fixed(0, 400, 0)) ==
                LKS_OK);
    }
    std::vector<std::uint64_t> found;
    for (int tick = 0; tick < 4 * ticks; ++tick) {
        lks_transform there = at(0.02 * tick, 0.05, 0);
        REQUIRE(lks_body_move_to(world, moved, there) == LKS_OK);
        world.step();
        found.push_back(world.hash());
    }
    found.push_back(world.counters().speed_clamps);
    return found;
}

} // namespace

TEST_CASE("one to eight workers of the world's own give the same hashes and counters as one") {
    const Crowd crowd;
    const std::vector<std::uint64_t> expected = crowd.hashes(crowd_def(1), ticks);
    CHECK(expected[ticks] + expected[ticks + 1] > 0);
    for (const std::uint32_t workers : worker_counts()) {
        CAPTURE(workers);
        CHECK(crowd.hashes(crowd_def(workers), ticks) == expected);
    }
}

TEST_CASE("a game's tasks give the same hashes however late and in whatever order they run") {
    const Crowd crowd;
    const std::vector<std::uint64_t> expected = crowd.hashes(crowd_def(1), ticks);
    for (const Temper temper : {Temper::at_once, Temper::late, Temper::threads}) {
        for (const std::uint32_t workers : {2u, 3u, 8u}) {
            CAPTURE(workers);
            TaskSystem system(temper);
            lks_world_def def = crowd_def(workers);
            def.tasks = system.interface();
            CHECK(crowd.hashes(def, ticks) == expected);
            CHECK(system.tasks() == ticks * (workers - 1));
            CHECK(system.all_awaited());
        }
    }
}

TEST_CASE("a small world asks nobody for help") {
    TaskSystem system(Temper::at_once);
    lks_world_def def = world_def(60, 8);
    def.worker_count = 8;
    def.tasks = system.interface();
    World world(def);
    const Asset chain = Chain().build();
    for (int i = 0; i < 5; ++i) {
        world.add(chain, at(i, 0, 0));
    }
    for (int i = 0; i < 5; ++i) {
        add_body(world, ball_shape(0.1), fixed(i, 3, 0));
    }
    world.step(20);
    CHECK(system.tasks() == 0);
}

TEST_CASE("a crowd of ragdolls gives the same hashes on one to eight workers, and on a game's") {
    const std::vector<std::uint64_t> expected = ragdoll_hashes(crowd_def(1));
    for (const std::uint32_t workers : worker_counts()) {
        CAPTURE(workers);
        CHECK(ragdoll_hashes(crowd_def(workers)) == expected);
    }
    for (const Temper temper : {Temper::at_once, Temper::late, Temper::threads}) {
        TaskSystem system(temper);
        lks_world_def def = crowd_def(3);
        def.tasks = system.interface();
        CHECK(ragdoll_hashes(def) == expected);
        CHECK(system.tasks() == 4 * ticks * 2);
    }
}

TEST_CASE("an image of a world with many workers continues in a world with one") {
    const Crowd crowd;
    World many(crowd_def(5));
    World one(crowd_def(1));
    for (World* world : {&many, &one}) {
        world->pin(world->add(crowd.sheet, at(0, 0, 0)), 0);
    }
    many.step(10);
    const auto image = many.save();
    REQUIRE(lks_world_load(one, image.data(), image.size()) == LKS_OK);
    many.step(10);
    one.step(10);
    CHECK(many.hash() == one.hash());
}

TEST_CASE("worlds with workers come and go, and all leave the same state") {
    const Asset chain = Chain().build();
    const auto hash = [&chain](std::uint32_t workers) {
        World world(crowd_def(workers));
        world.add(chain, at(0, 0, 0));
        world.step(2);
        return world.hash();
    };
    const std::uint64_t expected = hash(1);
    for (std::uint32_t i = 0; i < 40; ++i) {
        CAPTURE(i);
        CHECK(hash(1 + i % 8) == expected);
    }
}
