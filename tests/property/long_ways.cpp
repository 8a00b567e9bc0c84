// Ways of a tick or a substep that are long beside what they lead to: thin boxes, kinematic bodies that
// outrun the limit of speeds, few substeps a second under much gravity, planes far below.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

lks_world_def slow_ticks(std::uint32_t rate, std::uint32_t substeps, double gravity) {
    lks_world_def def = world_def(rate, substeps);
    def.gravity = fixed(0, -gravity, 0);
    return def;
}

void add_floor(World& world, double half_thickness) {
    add_box(world, fixed(1, half_thickness, 1), fixed(0, -half_thickness, 0));
}

bool is_awake(const World& world, lks_body_id body) {
    return lks_body_is_awake(world, body) == 1;
}

} // namespace

TEST_CASE("what is small and fast stops at what is thin, wherever in a tick it comes there") {
    struct Shot {
        std::uint32_t rate, substeps;
        double speed, radius, half_wall;
    };
    std::mt19937 random(1);
    for (const Shot& shot :
         {Shot{60, 1, 900, 0.01, 0.01}, Shot{60, 1, 400, 0.005, 0.005}, Shot{60, 1, 600, 0.01, 0.01},
          Shot{10, 1, 100, 0.01, 0.01}, Shot{10, 2, 200, 0.01, 0.01}, Shot{60, 8, 900, 0.01, 0.01}}) {
        World world([&] {
            lks_world_def def = weightless(shot.substeps);
            def.tick_rate_hz = shot.rate;
            return def;
        }());
        add_box(world, fixed(shot.half_wall, 5, 5), {});
        int through = 0;
        for (int i = 0; i < 100; ++i) {
            const double way = shot.speed / shot.rate;
            const double share = std::uniform_real_distribution<double>(0.02, 0.98)(random);
            lks_body_def def = lks_default_body_def();
            def.velocity = fixed(shot.speed, 0, 0);
            const lks_body_id ball = add_body(world, ball_shape(shot.radius), fixed(-way * share, 0, 0), def);
            world.step(2);
            through += state_of(world, ball).position.x > 0 ? 1 : 0;
            REQUIRE(lks_world_remove_body(world, ball) == LKS_OK);
        }
        INFO(shot.speed << " m/s, " << shot.rate << " Hz × " << shot.substeps);
        CHECK(through == 0);
    }
}

TEST_CASE("a ball that clears an edge is put nowhere by what it only seems to overlap") {
    for (const std::uint32_t substeps : {8u, 20u}) {
        lks_world_def world_def = weightless(substeps);
        world_def.tick_rate_hz = 10;
        World world(world_def);
        lks_collider_def box = lks_default_collider_def();
        box.shape = LKS_SHAPE_BOX;
        box.half_extents = fixed(0.5, 0.5, 0.5);
        box.transform.rotation = about(0, 0, 1, 45);
        world.add(box);
        for (int start = 0; start < 40; ++start) {
            const double x = -1.7 + 0.04 * start;
            const double y = 0.5 * std::sqrt(2.) + 0.2 + 0.01;
            lks_body_def def = lks_default_body_def();
            def.velocity = fixed(20, 0, 0);
            const lks_body_id ball = add_body(world, ball_shape(0.2), fixed(x, y, 0), def);
            world.step(2);
            const BodyState state = state_of(world, ball);
            INFO(substeps << " substeps from " << x);
            CHECK((state.position - Vector{x + 4, y, 0}).length() < 1e-5);
            CHECK((state.velocity - Vector{20, 0, 0}).length() < 1e-5);
            REQUIRE(lks_world_remove_body(world, ball) == LKS_OK);
        }
    }
}

TEST_CASE("what outruns the limit of speeds wakes and pushes whom it comes to") {
    struct Move {
        std::uint32_t rate, substeps;
        double from;
        bool collider;
    };
    for (const Move& move : {Move{60, 20, -30, false}, Move{60, 20, -30, true}, Move{1000, 1, -2.5, false},
                             Move{1000, 1, -2.5, true}, Move{10, 1, -40, false}}) {
        World world(world_def(move.rate, move.substeps));
        add_ground(world);
        const lks_body_id box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0.3, 0.2, 0));
        lks_body_id ram{};
        lks_collider_id wall{};
        if (move.collider) {
            lks_collider_def def = lks_default_collider_def();
            def.shape = LKS_SHAPE_BOX;
            def.half_extents = fixed(0.2, 0.2, 0.2);
            def.transform = at(move.from, 0.2, 0);
            wall = world.add(def);
        } else {
            lks_body_def def = lks_default_body_def();
            def.kind = LKS_BODY_KINEMATIC;
            ram = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(move.from, 0.2, 0), def);
        }
        world.step(2 * move.rate);
        REQUIRE_FALSE(is_awake(world, box));
        REQUIRE((move.collider ? lks_collider_move_to(world, wall, at(0, 0.2, 0))
                               : lks_body_move_to(world, ram, at(0, 0.2, 0))) == LKS_OK);
        world.step();
        INFO(move.rate << " Hz from " << move.from);
        CHECK(is_awake(world, box));
        world.step(move.rate);
        CHECK(std::abs(state_of(world, box).position.x) > 0.398);
    }
}

TEST_CASE("under much gravity, or with few substeps a second, nothing falls into a thin floor") {
    struct Fall {
        std::uint32_t rate, substeps;
        double gravity;
    };
    for (const Fall& fall : {Fall{10, 2, 100}, Fall{10, 1, 9.81}, Fall{5, 2, 9.81}, Fall{60, 2, 1000}}) {
        for (int i = 0; i < 60; ++i) {
            World world(slow_ticks(fall.rate, fall.substeps, fall.gravity));
            add_floor(world, 0.02);
            const double height = 0.05 + 0.02 * i;
            const lks_body_id ball = add_body(world, ball_shape(0.05), fixed(0, height, 0));
            double least = height;
            for (std::uint32_t tick = 0; tick < fall.rate; ++tick) {
                world.step();
                least = std::min(least, state_of(world, ball).position.y);
            }
            INFO(fall.rate << " Hz × " << fall.substeps << ", " << fall.gravity << " m/s² from " << height);
            CHECK(least > 0.049);
        }
    }
}

TEST_CASE("what falls on a sleeper within a long tick wakes it") {
    World world(slow_ticks(10, 8, 9.81));
    add_ground(world);
    const lks_body_id below = add_body(world, box_shape(0.5, 0.1, 0.5), fixed(0, 0.1, 0));
    world.step(20);
    REQUIRE_FALSE(is_awake(world, below));
    add_body(world, ball_shape(0.1), fixed(0.3, 0.34, 0));
    world.step();
    CHECK(is_awake(world, below));
}

TEST_CASE("a plane far below stops what comes to it within a tick where it is") {
    World world(slow_ticks(5, 100, 0));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.velocity = fixed(0, -1000, 0);
    const lks_body_id ball = add_body(world, ball_shape(0.5), fixed(0, 150, 0), def);
    world.step();
    CHECK(state_of(world, ball).position.y == doctest::Approx(0.5).epsilon(0.01));
}
