// What a body was added with and the game changes while it exists: each does what it says from the next tick
// on, and wakes whom it concerns.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/events.h"

using namespace support;

namespace {

constexpr double g = 9.81;
constexpr lks_filter everything{1, 0xffffffffu, 0};
constexpr lks_filter nothing{1, 0, 0};

bool is_awake(const World& world, lks_body_id body) {
    return lks_body_is_awake(world, body) == 1;
}

void set_surface(const World& world, lks_body_id body, double friction, double restitution = 0) {
    REQUIRE(lks_body_set_surface(world, body, fixed(friction), fixed(friction), fixed(restitution)) ==
            LKS_OK);
}

void set_filter(const World& world, lks_body_id body, const lks_filter& filter) {
    REQUIRE(lks_body_set_filter(world, body, filter) == LKS_OK);
}

lks_body_def kinematic() {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    return def;
}

std::uint32_t count(const std::vector<lks_event>& events, lks_event_kind kind) {
    std::uint32_t found = 0;
    for (const lks_event& event : events) {
        found += event.kind == static_cast<std::uint32_t>(kind) ? 1u : 0u;
    }
    return found;
}

// A box at rest on a kinematic table, both upon the ground, and a ball on the box; all that may sleep do.
struct Table {
    Table() : world(world_def(60, 8)) {
        add_ground(world);
        table = add_body(world, box_shape(1, 0.25, 1), fixed(0, 0.25, 0), kinematic());
        box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.7, 0));
        top = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, 1, 0));
        for (int tick = 0; tick < 300 && lks_world_awake_body_count(world) > 0; ++tick) {
            world.step();
        }
        REQUIRE(lks_world_awake_body_count(world) == 0);
    }

    double height(lks_body_id body) const { return state_of(world, body).position.y; }

    World world;
    lks_body_id table{}, box{}, top{};
};

} // namespace

TEST_CASE("a body falls by its gravity factor, whatever it was before") {
    World world(world_def(60, 8));
    const lks_body_id ball = add_body(world, ball_shape(0.1), {});
    double speed = 0;
    for (const double factor : {1.0, 0.0, -0.5, 3.0}) {
        REQUIRE(lks_body_set_gravity_factor(world, ball, fixed(factor)) == LKS_OK);
        world.step(30);
        speed -= factor * g / 2;
        CHECK(std::abs(state_of(world, ball).velocity.y - speed) < 1e-6);
    }
}

TEST_CASE("damping takes speed and spin as it is set") {
    World world(weightless(8));
    lks_body_def def = lks_default_body_def();
    def.velocity = fixed(4, 0, 0);
    def.angular_velocity = fixed(0, 5, 0);
    const lks_body_id ball = add_body(world, ball_shape(0.1), {}, def);
    world.step(30);
    CHECK(std::abs(state_of(world, ball).velocity.x - 4) < 1e-9);
    REQUIRE(lks_body_set_damping(world, ball, fixed(2), 0) == LKS_OK);
    world.step(60);
    CHECK(std::abs(state_of(world, ball).velocity.x / (4 * std::exp(-2.0)) - 1) < 0.02);
    CHECK(std::abs(state_of(world, ball).spin.y - 5) < 1e-6);
    REQUIRE(lks_body_set_damping(world, ball, 0, fixed(1)) == LKS_OK);
    const double speed = state_of(world, ball).velocity.x;
    world.step(60);
    CHECK(std::abs(state_of(world, ball).velocity.x - speed) < 1e-9);
    CHECK(std::abs(state_of(world, ball).spin.y / (5 * std::exp(-1.0)) - 1) < 0.02);
}

TEST_CASE("a box slides as far as the friction that it was given lets it") {
    for (const double friction : {0.2, 0.4, 0.8}) {
        CAPTURE(friction);
        World world(world_def(60, 8));
        add_ground(world, 1);
        const lks_body_id box = add_body(world, box_shape(0.2, 0.1, 0.2), fixed(0, 0.1, 0));
        world.step(10);
        // The geometric mean counts.
        set_surface(world, box, friction * friction);
        const double from = state_of(world, box).position.x;
        REQUIRE(lks_body_set_velocity(world, box, fixed(3, 0, 0), {}) == LKS_OK);
        world.step(240);
        const double way = state_of(world, box).position.x - from;
        CHECK(std::abs(way / (9 / (2 * friction * g)) - 1) < 0.05);
    }
}

TEST_CASE("what lies on a slope slides when its friction goes, asleep or not, and when that of a belt below "
          "it goes") {
    for (const bool of_belt : {false, true}) {
        CAPTURE(of_belt);
        World world(world_def(60, 8));
        lks_body_def def = kinematic();
        def.static_friction = def.dynamic_friction = fixed(1);
        def.transform.rotation = about(0, 0, 1, 20);
        const lks_body_id belt = add_body(world, box_shape(10, 0.5, 1), fixed(0, -0.5, 0), def);
        def = lks_default_body_def();
        def.static_friction = def.dynamic_friction = fixed(1);
        def.transform.rotation = about(0, 0, 1, 20);
        const lks_body_id box = add_body(world, box_shape(0.2, 0.1, 0.2), fixed(0, 0.14, 0), def);
        world.step(200);
        REQUIRE_FALSE(is_awake(world, box));
        set_surface(world, of_belt ? belt : box, 0);
        CHECK(is_awake(world, box));
        const double from = state_of(world, box).position.x;
        world.step(60);
        const double along = g * std::sin(20 * 3.14159265358979 / 180);
        CHECK(std::abs((from - state_of(world, box).position.x) /
                           (along / 2 * std::cos(20 * 3.14159265358979 / 180)) -
                       1) < 0.05);
    }
}

TEST_CASE("a ball bounces by the restitution that it was given") {
    World world(world_def(60, 20));
    add_ground(world);
    const lks_body_id ball = add_body(world, ball_shape(0.1), {});
    for (const double restitution : {0.0, 0.8, 0.5}) {
        CAPTURE(restitution);
        set_surface(world, ball, 0.5, restitution);
        lks_transform up = lks_transform_identity();
        up.position = fixed(0, 1.1, 0);
        REQUIRE(lks_body_set_transform(world, ball, up) == LKS_OK);
        REQUIRE(lks_body_set_velocity(world, ball, {}, {}) == LKS_OK);
        double highest = 0;
        bool was_down = false;
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            const BodyState state = state_of(world, ball);
            was_down = was_down || state.velocity.y >= -1e-3;
            highest = was_down ? std::max(highest, state.position.y - 0.1) : highest;
        }
        CHECK(std::abs(highest - restitution * restitution) < 0.03);
    }
}

TEST_CASE("a filter that excludes what a body lies on ends the contact with an event and lets it fall") {
    for (const bool asleep : {false, true}) {
        CAPTURE(asleep);
        Table t;
        if (!asleep) {
            REQUIRE(lks_body_wake(t.world, t.top) == LKS_OK);
            t.world.step(2);
        }
        record(t.world);
        // The box falls through the table onto the ground, and what lies on it goes with it.
        lks_filter filter = everything;
        filter.category = 2;
        set_filter(t.world, t.box, filter);
        set_filter(t.world, t.table, {1, ~2u, 0});
        CHECK(is_awake(t.world, t.box));
        CHECK(is_awake(t.world, t.top));
        t.world.step();
        const std::vector<lks_event> events = events_of(t.world);
        CHECK(std::count_if(events.begin(), events.end(), [&](const lks_event& event) {
                  return event.kind == LKS_EVENT_CONTACT_END && event.body_a.index == t.table.index &&
                         event.body_b.index == t.box.index;
              }) == 1);
        CHECK(count(events, LKS_EVENT_CONTACT_BEGIN) == 0);
        const std::vector<lks_event> later = run(t.world, 120);
        CHECK(std::abs(t.height(t.box) - 0.2) < 0.002);
        CHECK(std::abs(t.height(t.top) - 0.6) < 0.1); // on the table, which stops it, or the box
        CHECK(count(later, LKS_EVENT_CONTACT_BEGIN) >= 1);
    }
}

TEST_CASE("a filter that still lets two touch ends nothing and begins nothing") {
    Table t;
    record(t.world);
    lks_filter filter = everything;
    filter.mask = 0x7fffffffu;
    set_filter(t.world, t.box, filter);
    const std::vector<lks_event> events = run(t.world, 20);
    CHECK(count(events, LKS_EVENT_CONTACT_END) == 0);
    CHECK(count(events, LKS_EVENT_CONTACT_BEGIN) == 0);
    CHECK(std::abs(t.height(t.box) - 0.7) < 0.001);
    // Nor is it seen when it excludes them for less than a tick.
    set_filter(t.world, t.box, nothing);
    set_filter(t.world, t.box, filter);
    const std::vector<lks_event> more = run(t.world, 20);
    CHECK(count(more, LKS_EVENT_CONTACT_END) == 0);
    CHECK(std::abs(t.height(t.box) - 0.7) < 0.001);
}

TEST_CASE("a ghost that becomes solid is stopped, and wakes whom it is in") {
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id sleeper = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2, 0));
    lks_body_def def = kinematic();
    def.filter = nothing;
    const lks_body_id ghost = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0.3, 0.2, 0), def);
    def = lks_default_body_def();
    def.filter = nothing;
    def.gravity_factor = fixed(0.05);
    const lks_body_id falling = add_body(world, ball_shape(0.1), fixed(3, 1, 0), def);
    world.step(60);
    REQUIRE_FALSE(is_awake(world, sleeper));
    set_filter(world, falling, everything);
    CHECK_FALSE(is_awake(world, sleeper)); // it has nothing to do with that one
    set_filter(world, ghost, everything);
    CHECK(is_awake(world, sleeper));
    world.step(240);
    CHECK(state_of(world, sleeper).position.x < -0.09); // it is out of it
    CHECK(std::abs(state_of(world, falling).position.y - 0.1) < 0.001);
}

TEST_CASE("cloth is held by a body as long as its filter says so, and queries ask the new one") {
    World world(world_def(60, 8));
    Net shape;
    shape.side = 12;
    shape.width = 1;
    const Asset net = shape.build();
    const lks_body_id table = add_body(world, box_shape(3, 0.2, 3), fixed(0, -0.2, 0), kinematic());
    const lks_object_id cloth = world.add(net, turned(at(-0.5, 0.05, -0.5), 1, 0, 0, -90));
    const auto lowest = [&] {
        double least = 1e9;
        for (const lks_vec3& p : world.positions(cloth)) {
            least = std::min(least, metres(p.y));
        }
        return least;
    };
    world.step(60);
    REQUIRE(lowest() > -0.01);
    lks_query query = lks_default_query();
    query.mask = 4;
    query.kinds = LKS_HIT_BIT(LKS_HIT_BODY);
    std::uint32_t hits = 0;
    const auto ask = [&] {
        REQUIRE(lks_world_cast(world, &query, fixed(0, 2, 0), fixed(0, -2, 0), nullptr, 0, &hits) == LKS_OK);
        return hits;
    };
    CHECK(ask() == 0);
    set_filter(world, table, {4, ~LKS_CATEGORY_PARTICLES, 0});
    CHECK(ask() == 1);
    world.step(60);
    CHECK(lowest() < -1);
}

TEST_CASE("friction of a body holds cloth as it is set") {
    const auto slid = [](bool smooth) {
        World world(world_def(60, 8));
        Net shape;
        shape.side = 12;
        shape.width = 1;
        const Asset net = shape.build();
        lks_body_def def = kinematic();
        def.transform.rotation = about(0, 0, 1, 15);
        def.static_friction = def.dynamic_friction = fixed(1);
        const lks_body_id slope = add_body(world, box_shape(5, 0.2, 2), fixed(0, -0.2, 0), def);
        const lks_object_id cloth = world.add(net, turned(at(-0.5, 0.2, -0.5), 1, 0, 0, -90));
        world.step(60);
        if (smooth) {
            set_surface(world, slope, 0);
        }
        const double from = metres(world.positions(cloth)[0].x);
        world.step(60);
        return from - metres(world.positions(cloth)[0].x);
    };
    CHECK(slid(false) < 0.1);
    CHECK(slid(true) > 0.5);
}

TEST_CASE("a change wakes the body with all that it lies on and bears, and what is the same nobody") {
    struct Change {
        std::string name;
        std::function<lks_result(const Table&, bool)> make; // once more: the same
    };
    const auto at_once = [](bool other, double a, double b) { return fixed(other ? a : b); };
    const Change changes[] = {
        {"gravity factor",
         [&](const Table& t, bool other) {
             return lks_body_set_gravity_factor(t.world, t.box, at_once(other, 2, 1));
         }},
        {"damping",
         [&](const Table& t, bool other) {
             return lks_body_set_damping(t.world, t.box, at_once(other, 1, 0), 0);
         }},
        {"surface",
         [&](const Table& t, bool other) {
             return lks_body_set_surface(t.world, t.box, at_once(other, 0.75, 0.5), LKS_FIXED_RATIO(4, 10),
                                         0);
         }},
        {"filter",
         [&](const Table& t, bool other) {
             return lks_body_set_filter(t.world, t.box, {other ? 3u : 1u, 0xffffffffu, 0});
         }},
        {"never_sleeps",
         [&](const Table& t, bool other) {
             return lks_body_set_never_sleeps(t.world, t.box, other ? 1u : 0u);
         }},
    };
    for (const Change& change : changes) {
        CAPTURE(change.name);
        Table t;
        REQUIRE(change.make(t, false) == LKS_OK);
        CHECK_FALSE(is_awake(t.world, t.box));
        t.world.step();
        CHECK(lks_world_awake_body_count(t.world) == 0);
        REQUIRE(change.make(t, true) == LKS_OK);
        CHECK(is_awake(t.world, t.box));
        t.world.step();
        CHECK(lks_world_awake_body_count(t.world) == 2);
        t.world.step(120);
        CHECK(is_awake(t.world, t.top) == (change.name == "never_sleeps"));
        REQUIRE(change.make(t, true) == LKS_OK);
        REQUIRE(change.make(t, false) == LKS_OK);
        t.world.step(120);
        CHECK(lks_world_awake_body_count(t.world) == 0);
    }
}

TEST_CASE("how a kinematic body would fall concerns nobody until it does") {
    Table t;
    REQUIRE(lks_body_set_gravity_factor(t.world, t.table, 0) == LKS_OK);
    REQUIRE(lks_body_set_damping(t.world, t.table, fixed(1), fixed(1)) == LKS_OK);
    REQUIRE(lks_body_set_never_sleeps(t.world, t.table, 1) == LKS_OK);
    t.world.step();
    CHECK(lks_world_awake_body_count(t.world) == 0);
    // What it was given then counts.
    World world(world_def(60, 8));
    const lks_body_id body = add_body(world, ball_shape(0.1), {}, kinematic());
    REQUIRE(lks_body_set_gravity_factor(world, body, fixed(-1)) == LKS_OK);
    world.step(10);
    CHECK(state_of(world, body).position.y == 0);
    REQUIRE(lks_body_set_kind(world, body, LKS_BODY_DYNAMIC) == LKS_OK);
    world.step(60);
    CHECK(std::abs(state_of(world, body).velocity.y - g) < 1e-6);
}

TEST_CASE("what sank so slowly that it slept falls when its damping goes") {
    World world(world_def(60, 8));
    lks_body_def def = lks_default_body_def();
    def.linear_damping = fixed(1000);
    def.gravity_factor = fixed(0.1);
    const lks_body_id ball = add_body(world, ball_shape(0.1), {}, def);
    world.step(300);
    REQUIRE_FALSE(is_awake(world, ball));
    REQUIRE(lks_body_set_damping(world, ball, 0, 0) == LKS_OK);
    const double from = state_of(world, ball).position.y;
    world.step(60);
    CHECK(std::abs((from - state_of(world, ball).position.y) / (0.05 * g) - 1) < 0.02);
}
