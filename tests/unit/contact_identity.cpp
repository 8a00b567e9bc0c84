// Contacts are the same ones from tick to tick: their keys, their points' features, and what these pushed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "solver/world.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

struct Point {
    lks::ContactKey key;
    std::uint32_t feature;
    std::int64_t push;
};

std::vector<Point> points_of(lks_world* world) {
    std::vector<Point> points;
    for (const lks::ContactMemory& memory : world->rigid.memories) {
        for (std::uint32_t i = 0; i < memory.count; ++i) {
            points.push_back({memory.key, memory.pushes[i].feature, memory.pushes[i].normal});
        }
    }
    return points;
}

bool are_the_same(const std::vector<Point>& a, const std::vector<Point>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Point& p, const Point& q) {
        return p.key == q.key && p.feature == q.feature;
    });
}

} // namespace

TEST_CASE("what rests on something has the same contact points in every tick, and they push on") {
    // A box on the ground; one turned by 30° on it; a capsule, and a ball, each on a box that stays.
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    add_body(world, box_shape(0.5, 0.2, 0.5), fixed(0, 0.2, 0), def);
    def.transform.rotation = about(0, 1, 0, 30);
    add_body(world, box_shape(0.3, 0.2, 0.3), fixed(0, 0.6, 0), def);
    def.transform.rotation = about(0, 0, 1, 90);
    add_box(world, fixed(0.5, 0.5, 0.5), fixed(3, 0.5, 0));
    add_body(world, capsule_shape(0.1, 0.2), fixed(3, 1.1, 0), def);
    add_box(world, fixed(0.5, 0.5, 0.5), fixed(6, 0.5, 0));
    add_body(world, ball_shape(0.1), fixed(6, 1.1, 0), def);
    world.step(60);
    const std::vector<Point> first = points_of(world);
    CHECK(first.size() == 4 + 4 + 2 + 1);
    for (int tick = 0; tick < 240; ++tick) {
        world.step();
        const std::vector<Point> now = points_of(world);
        REQUIRE(are_the_same(first, now));
        for (std::size_t i = 0; i < now.size(); ++i) {
            CAPTURE(i);
            CHECK(now[i].push > 0);
            // Carried on: within a thousandth of what it was. Begun anew in each tick it would not be.
            CHECK(std::abs(now[i].push - first[i].push) <= first[i].push / 1000 + 1);
        }
    }
}

TEST_CASE("a box that slides and turns keeps its corners' contacts as they are") {
    World world(world_def(60, 8));
    add_ground(world, 0.3);
    lks_body_def def = lks_default_body_def();
    def.static_friction = def.dynamic_friction = fixed(0.3);
    def.velocity = fixed(3, 0, 1);
    def.angular_velocity = fixed(0, 4, 0);
    add_body(world, box_shape(0.3, 0.1, 0.3), fixed(0, 0.1, 0), def);
    world.step(10);
    const std::vector<Point> first = points_of(world);
    REQUIRE(first.size() == 4);
    std::set<std::uint32_t> features;
    for (const Point& point : first) {
        features.insert(point.feature);
    }
    CHECK(features.size() == 4);
    for (int tick = 0; tick < 30; ++tick) {
        world.step();
        CHECK(are_the_same(first, points_of(world)));
    }
}

TEST_CASE("shapes of one body have contacts of their own") {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_shape shapes[2] = {ball_shape(0.1), ball_shape(0.1)};
    shapes[0].transform.position = fixed(-0.3, 0, 0);
    shapes[1].transform.position = fixed(0.3, 0, 0);
    lks_body_def def = lks_default_body_def();
    def.shapes = shapes;
    def.shape_count = 2;
    def.transform.position = fixed(0, 0.1, 0);
    lks_body_id id{};
    REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
    world.step(10);
    const std::vector<Point> points = points_of(world);
    REQUIRE(points.size() == 2);
    CHECK(points[0].key.body_a == points[1].key.body_a);
    CHECK(points[0].key.other == points[1].key.other);
    CHECK(points[0].key.shapes / LKS_MAX_BODY_SHAPES == 0);
    CHECK(points[1].key.shapes / LKS_MAX_BODY_SHAPES == 1);
}
