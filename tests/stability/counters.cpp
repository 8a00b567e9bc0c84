// Every counter of what overflowed: provoked, counted as often as it happens and no more, and survived.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "stability/support/table.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;
using namespace stability;

namespace {

const char* const no_twin = "it counts and clamps nothing";

void expect_count(const std::string& counter, double least, double most, std::uint64_t count) {
    expect_at_least(counter, "counted", "", least, static_cast<double>(count), no_twin);
    expect_at_most(counter, "counted", "", most, static_cast<double>(count), no_twin);
}

Asset two_points() {
    return loose_points({{0, 0, 0}, {1, 0, 0}}, {1, 1});
}

} // namespace

TEST_CASE("position_clamps: a particle's axis at ±64 m of its object's origin, once a substep") {
    World world(weightless(1));
    const lks_object_id object = world.add(two_points(), at(0, 0, 0));
    // Two points that part: the origin stays in the middle of them. From 60 m on by 5 m a tick.
    REQUIRE(lks_object_set_velocity(world, object, 0, fixed(-300, 0, 0)) == LKS_OK);
    REQUIRE(lks_object_set_velocity(world, object, 1, fixed(300, 0, 0)) == LKS_OK);
    world.step(12);
    CHECK(world.counters().position_clamps == 0);
    world.step(8);
    // Each at the edge, and once more with what was left of its motion.
    expect_count("position_clamps", 4, 4, world.counters().position_clamps);
    const std::uint64_t clamped = world.counters().position_clamps;
    for (const std::uint32_t vertex : {0u, 1u}) {
        REQUIRE(lks_object_set_velocity(world, object, vertex, {}) == LKS_OK);
    }
    world.step(60);
    CHECK(world.counters().position_clamps == clamped);
}

TEST_CASE("speed_clamps: a particle's axis faster than the limit, and a body") {
    World world(weightless(10));
    const lks_object_id object = world.add(two_points(), at(0, 0, 0));
    REQUIRE(lks_object_apply_impulse(world, object, 0, fixed(100000, 0, 0)) == LKS_OK);
    world.step();
    expect_count("speed_clamps, a particle", 1, 1, world.counters().speed_clamps);
    const double limit = metres(lks_world_speed_limit(world));
    expect_at_most("speed_clamps, a particle", "its speed then", "m/s", limit,
                   metres(world.velocities(object)[0].x), no_twin);
    world.step(60);
    CHECK(world.counters().speed_clamps == 1);

    World bodies(weightless(10));
    const lks_body_id body = add_body(bodies, ball_shape(0.1, 1), fixed(0, 0, 0));
    REQUIRE(lks_body_apply_impulse(bodies, body, fixed(100000, 0, 0), fixed(0, 0, 0)) == LKS_OK);
    bodies.step();
    expect_at_most("speed_clamps, a body", "its speed then", "m/s", limit,
                   state_of(bodies, body).velocity.length(), no_twin);
    expect_count("speed_clamps, a body", 1, 1, bodies.counters().speed_clamps);
}

TEST_CASE("target_clamps: a pin's target out of its object's range, once a call") {
    World world(weightless(10));
    const lks_object_id object = world.add(two_points(), at(0, 0, 0));
    world.pin(object, 0);
    world.set_target(object, 0, fixed(63, 0, 0));
    CHECK(world.counters().target_clamps == 0);
    world.set_target(object, 0, fixed(5000, 0, 0));
    world.set_target(object, 0, fixed(-5000, 5000, -8388000));
    expect_count("target_clamps", 2, 2, world.counters().target_clamps);
    world.set_target(object, 0, fixed(0, 0, 0));
    world.step(60);
    CHECK(world.counters().target_clamps == 2);
    CHECK(metres(world.positions(object)[0]).length() == 0);
}

TEST_CASE("world_edge_hits: an object that cannot follow its particles, once an axis and tick") {
    World world(weightless(10));
    const Asset points = two_points();
    lks_object_def def = object_def(points, at(8387999, 0, 0));
    def.velocity = fixed(60, 0, 0);
    const lks_object_id object = world.add(def);
    world.step(120);
    expect_count("world_edge_hits", 112, 112, world.counters().world_edge_hits);
    REQUIRE(lks_object_add_velocity(world, object, fixed(-200, 0, 0)) == LKS_OK);
    world.step(60);
    const std::uint64_t hits = world.counters().world_edge_hits;
    world.step(60);
    CHECK(world.counters().world_edge_hits == hits);
}

TEST_CASE("world_edge_hits: a body that goes no further, once an axis and tick") {
    World world(weightless(10));
    lks_body_def def = lks_default_body_def();
    def.velocity = fixed(60, 0, 0);
    const lks_body_id body = add_body(world, ball_shape(0.1), fixed(8387990.5, 0, 0), def);
    def.velocity = fixed(0, -1000, 0);
    const lks_body_id fast = add_body(world, ball_shape(0.1), fixed(0, -8387895, 8388000), def);
    world.step(120);
    // One is there after nine ticks, the other after six, and rests at another edge, which is none.
    expect_count("world_edge_hits, bodies", 111 + 114, 111 + 114, world.counters().world_edge_hits);
    CHECK(state_of(world, body).position.x == 8388000);
    REQUIRE(lks_body_set_velocity(world, body, fixed(-1, 1, 0), {}) == LKS_OK);
    REQUIRE(lks_body_set_velocity(world, fast, {}, {}) == LKS_OK);
    const std::uint64_t hits = world.counters().world_edge_hits;
    world.step(60);
    CHECK(world.counters().world_edge_hits == hits);
    CHECK(world.counters().speed_clamps == 0);
    // Two axes at once.
    REQUIRE(lks_body_set_velocity(world, fast, fixed(0, -1, 1), {}) == LKS_OK);
    world.step(5);
    CHECK(world.counters().world_edge_hits == hits + 10);
}

TEST_CASE("dropped_ticks: time beyond the cap of a call") {
    World world;
    std::uint32_t ran = 0;
    REQUIRE(lks_world_advance(world, 1000000000, &ran) == LKS_OK); // 60 ticks are due, 8 run
    CHECK(ran == 8);
    expect_count("dropped_ticks", 52, 52, world.counters().dropped_ticks);
}

TEST_CASE("lost_contacts: more pairs than a tick has room for, and the crowd parts all the same") {
    World world(world_def(60, 10));
    add_ground(world);
    // All in one place: 19,900 pairs.
    std::vector<lks_body_id> bodies;
    for (int i = 0; i < 200; ++i) {
        bodies.push_back(add_body(world, ball_shape(0.1),
                                  fixed(0.001 * (i % 10), 0.2 + 0.001 * (i / 10), 0.0005 * (i % 7))));
    }
    world.step(1);
    expect_count("lost_contacts", 1.2e4, 19900, world.counters().lost_contacts);
    world.step(300);
    const std::uint64_t lost = world.counters().lost_contacts;
    world.step(20);
    CHECK(world.counters().lost_contacts == lost);
    expect_at_most("lost_contacts, 200 balls in one place", "kinetic energy, after 5 s", "J", 500,
                   energy_of(world), no_twin);
    double lowest = 1;
    for (const lks_body_id body : bodies) {
        lowest = std::min(lowest, state_of(world, body).position.y);
    }
    expect_at_least("lost_contacts, 200 balls in one place", "lowest ball's middle", "m", 0.099, lowest,
                    no_twin);
}

TEST_CASE("lost_events: more than there is room for") {
    World world(world_def(60, 10));
    add_ground(world);
    for (int i = 0; i < 10; ++i) {
        add_body(world, ball_shape(0.1), fixed(i, 0.1, 0));
    }
    REQUIRE(lks_world_record_events(world, LKS_ALL_EVENTS, 0, 4) == LKS_OK);
    for (int tick = 0; tick < 60 && world.counters().lost_events == 0; ++tick) {
        world.step();
    }
    expect_count("lost_events", 26, 26, world.counters().lost_events);
    CHECK(lks_world_event_count(world) == 4); // each of the ten begins, hits the ground and loads it
}
