// Rays, overlaps and nearest points against analytic answers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/refusals.h"

using namespace support;

namespace {

std::vector<lks_hit> cast(const World& world, const lks_vec3& from, const lks_vec3& to, double radius = 0,
                          std::uint32_t kinds = LKS_ALL_HITS) {
    lks_query query = lks_default_query();
    query.radius = fixed(radius);
    query.kinds = kinds;
    std::vector<lks_hit> hits(64);
    std::uint32_t count = 0;
    REQUIRE(lks_world_cast(world, &query, from, to, hits.data(), 64, &count) == LKS_OK);
    hits.resize(std::min(count, 64u));
    return hits;
}

lks_collider_id add(World& world, std::uint32_t shape, const lks_transform& transform) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = shape;
    def.radius = fixed(0.5);
    def.half_length = fixed(1);
    def.half_extents = fixed(0.5, 1, 2);
    def.transform = transform;
    return world.add(def);
}

} // namespace

TEST_CASE("a ray hits each shape where geometry says, the nearest first") {
    World world(world_def(60, 8));
    add(world, LKS_SHAPE_PLANE, at(0, -1, 0));
    add(world, LKS_SHAPE_SPHERE, at(5, 0, 0));
    const lks_body_id box = add_body(world, box_shape(0.5, 1, 2), fixed(10, 0, 0));
    lks_transform lying = at(15, 0, 0);
    lying.rotation = about(0, 0, 1, 90);
    add(world, LKS_SHAPE_CAPSULE, lying);
    const std::vector<lks_hit> hits = cast(world, fixed(0, 0.3, 0), fixed(20, 0.3, 0));
    REQUIRE(hits.size() == 3);
    CHECK(std::abs(metres(hits[0].distance) - (5 - 0.4)) < 2e-6);
    CHECK(hits[0].kind == LKS_HIT_COLLIDER);
    CHECK(hits[0].collider.index == 1);
    CHECK((metres(hits[0].normal) - Vector{-0.8, 0.6, 0}).length() < 1e-6);
    CHECK((metres(hits[0].point) - Vector{4.6, 0.3, 0}).length() < 2e-6);
    CHECK(hits[1].kind == LKS_HIT_BODY);
    CHECK(hits[1].body.index == box.index);
    CHECK(std::abs(metres(hits[1].distance) - 9.5) < 2e-6);
    CHECK(metres(hits[1].normal.x) == -1);
    CHECK(std::abs(metres(hits[2].distance) - (15 - 1 - 0.4)) < 2e-6);
    // Down onto the plane, as a ball.
    const std::vector<lks_hit> down = cast(world, fixed(2, 5, 1), fixed(2, -5, 1), 0.25);
    REQUIRE(down.size() == 1);
    CHECK(std::abs(metres(down[0].distance) - 5.75) < 2e-6);
    CHECK((metres(down[0].point) - Vector{2, -1, 1}).length() < 2e-6);
    // Short of everything, and from within.
    CHECK(cast(world, fixed(0, 3, 0), fixed(4, 3, 0)).empty());
    const std::vector<lks_hit> within = cast(world, fixed(5, 0.2, 0), fixed(6, 0.2, 0));
    REQUIRE(!within.empty());
    CHECK(within[0].distance == 0);
}

TEST_CASE("random rays against spheres and boxes agree with double precision") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> spread(-3, 3);
    World world(world_def(60, 8));
    lks_transform turned = at(0.3, -0.2, 0.1);
    turned.rotation = about(0, 0, 1, 90); // a box whose sides stay along the axes, exchanged
    add(world, LKS_SHAPE_BOX, turned);
    int hit = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vector a{spread(random), spread(random), spread(random)};
        const Vector b{spread(random), spread(random), spread(random)};
        const std::vector<lks_hit> hits = cast(world, fixed(a.x, a.y, a.z), fixed(b.x, b.y, b.z));
        // Slabs.
        const double centre[3] = {0.3, -0.2, 0.1};
        const double half[3] = {1, 0.5, 2};
        const double p[3] = {a.x, a.y, a.z};
        const double d[3] = {b.x - a.x, b.y - a.y, b.z - a.z};
        double enter = 0, leave = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double one = (centre[axis] - half[axis] - p[axis]) / d[axis];
            const double two = (centre[axis] + half[axis] - p[axis]) / d[axis];
            enter = std::max(enter, std::min(one, two));
            leave = std::min(leave, std::max(one, two));
        }
        if (std::abs(enter - leave) < 1e-4) {
            continue; // grazes an edge
        }
        CHECK(hits.size() == (enter < leave ? 1 : 0));
        if (enter < leave && !hits.empty()) {
            ++hit;
            const double cosine = std::abs(metres(hits[0].normal).dot(b - a)) / (b - a).length();
            CHECK(std::abs(metres(hits[0].distance) - enter * (b - a).length()) <
                  3e-6 / std::max(cosine, 1e-3));
        }
    }
    CHECK(hit > 300);
}

TEST_CASE("overlaps come by kind and index, and the nearest is the nearest") {
    World world(world_def(60, 8));
    add_ground(world);
    const lks_body_id low = add_body(world, ball_shape(0.2), fixed(0, 0.5, 0));
    const lks_body_id high = add_body(world, ball_shape(0.2), fixed(0, 1.4, 0));
    Net net;
    net.side = 3;
    net.width = 0.2;
    net.radius = 0.01;
    const lks_object_id cloth = world.add(net.build(), at(0.5, 0.5, 0));
    lks_query query = lks_default_query();
    query.radius = fixed(0.6);
    lks_hit hits[20];
    std::uint32_t count = 0;
    REQUIRE(lks_world_overlap(world, &query, fixed(0, 0.5, 0), hits, 20, &count) == LKS_OK);
    REQUIRE(count == 11); // the plane, one ball, nine particles
    CHECK(hits[0].kind == LKS_HIT_COLLIDER);
    CHECK(metres(hits[0].distance) == 0.5);
    CHECK(hits[1].kind == LKS_HIT_BODY);
    CHECK(hits[1].body.index == low.index);
    CHECK(std::abs(metres(hits[1].distance) + 0.2) < 1e-9);
    for (std::uint32_t i = 2; i < 11; ++i) {
        CHECK(hits[i].kind == LKS_HIT_PARTICLE);
        CHECK(hits[i].object.index == cloth.index);
        CHECK(hits[i].part == i - 2);
    }
    // Fewer than there are: the first ones, and how many it would have been.
    lks_hit few[2];
    REQUIRE(lks_world_overlap(world, &query, fixed(0, 0.5, 0), few, 2, &count) == LKS_OK);
    CHECK(count == 11);
    CHECK(few[1].kind == LKS_HIT_BODY);
    REQUIRE(lks_world_overlap(world, &query, fixed(0, 0.5, 0), nullptr, 0, &count) == LKS_OK);
    CHECK(count == 11);
    lks_hit nearest{};
    std::uint32_t found = 0;
    query.radius = fixed(2);
    REQUIRE(lks_world_closest(world, &query, fixed(0.05, 1.05, 0), &nearest, &found) == LKS_OK);
    REQUIRE(found == 1);
    CHECK(nearest.body.index == high.index);
    CHECK(std::abs(metres(nearest.distance) - (std::hypot(0.05, 0.35) - 0.2)) < 1e-9);
    // Without that one, and without bodies of its category.
    query.ignored = high;
    REQUIRE(lks_world_closest(world, &query, fixed(0.05, 1.05, 0), &nearest, &found) == LKS_OK);
    CHECK(nearest.body.index == low.index);
    query.mask = 2;
    REQUIRE(lks_world_closest(world, &query, fixed(0.05, 1.05, 0), &nearest, &found) == LKS_OK);
    CHECK(nearest.kind == LKS_HIT_PARTICLE);
    query.kinds = 0;
    REQUIRE(lks_world_closest(world, &query, fixed(0.05, 1.05, 0), &nearest, &found) == LKS_OK);
    CHECK(found == 0);
}

TEST_CASE("a query's mask says which bodies and colliders it is about") {
    World world(world_def(60, 8));
    for (int i = 0; i < 3; ++i) {
        lks_collider_def collider = lks_default_collider_def();
        collider.filter.category = 1u << i;
        collider.transform = at(10 * i, 0, 0);
        world.add(collider);
        lks_body_def body = lks_default_body_def();
        body.filter.category = 1u << i;
        add_body(world, ball_shape(0.5), fixed(10 * i + 5, 0, 0), body);
    }
    for (std::uint32_t mask = 0; mask < 16; ++mask) {
        lks_query query = lks_default_query();
        query.mask = mask;
        query.radius = LKS_FIXED(30);
        lks_hit near[8];
        std::uint32_t count = 0;
        REQUIRE(lks_world_overlap(world, &query, fixed(12, 0, 0), near, 8, &count) == LKS_OK);
        query.radius = 0;
        lks_hit along[8];
        std::uint32_t along_count = 0;
        REQUIRE(lks_world_cast(world, &query, fixed(-2, 0, 0), fixed(30, 0, 0), along, 8, &along_count) ==
                LKS_OK);
        std::uint32_t place = 0;
        for (std::uint32_t i = 0; i < 3; ++i) {
            if ((mask >> i & 1) == 0) {
                continue;
            }
            REQUIRE(along_count >= place + 2);
            CHECK(along[place].kind == LKS_HIT_COLLIDER);
            CHECK(along[place].collider.index == i);
            CHECK(along[place + 1].kind == LKS_HIT_BODY);
            CHECK(along[place + 1].body.index == i);
            place += 2;
        }
        CHECK(along_count == place);
        CHECK(count == place);
    }
}

TEST_CASE(
    "where in the world it is asked changes no bit of the answer, and asking changes no bit of the world") {
    const auto ask = [](const lks_vec3& offset) {
        World world(world_def(60, 8));
        lks_body_def def = lks_default_body_def();
        def.transform.rotation = about(1, 2, 3, 40);
        lks_transform place = at(0, 0, 0);
        place.position = offset + fixed(3, 0.2, 0);
        add_body(world, capsule_shape(0.3, 0.5), place.position, def);
        const std::uint64_t hash = world.hash();
        const std::vector<lks_hit> hits =
            cast(world, offset + fixed(0, 0, 0.1), offset + fixed(7, 0.5, 0), 0.02);
        CHECK(world.hash() == hash);
        REQUIRE(hits.size() == 1);
        lks_hit hit = hits[0];
        hit.point = {hit.point.x - offset.x, hit.point.y - offset.y, hit.point.z - offset.z};
        return hit;
    };
    const lks_hit here = ask({});
    const lks_hit there = ask(fixed(-7000000, 123456.25, 8000));
    CHECK(here.distance == there.distance);
    CHECK(here.point.x == there.point.x);
    CHECK(here.point.y == there.point.y);
    CHECK(here.normal.z == there.normal.z);
}

TEST_CASE("what is at the other end of the world is not hit, but for a plane") {
    World world(world_def(60, 8));
    add(world, LKS_SHAPE_SPHERE, at(8000000, 1, 0));
    add(world, LKS_SHAPE_BOX, at(8000000, 1, 8000000));
    add(world, LKS_SHAPE_PLANE, at(8000000, -1, -8000000));
    const std::vector<lks_hit> hits = cast(world, fixed(-8000000, 1, 0), fixed(-8000000, -3, 0));
    REQUIRE(hits.size() == 1);
    CHECK(hits[0].collider.index == 2);
    CHECK(std::abs(metres(hits[0].distance) - 2) < 2e-6);
}

TEST_CASE("a point far below a plane knows how deep it is, as far as a coordinate goes") {
    lks_query query = lks_default_query();
    query.kinds = LKS_HIT_BIT(LKS_HIT_COLLIDER);
    const auto closest = [&](const World& world, const lks_vec3& point) {
        lks_hit hit{};
        std::uint32_t found = 0;
        REQUIRE(lks_world_closest(world, &query, point, &hit, &found) == LKS_OK);
        REQUIRE(found == 1);
        return hit;
    };
    World level(world_def(60, 8));
    add(level, LKS_SHAPE_PLANE, at(0, 0, 0));
    const lks_hit below = closest(level, fixed(3, -8000000, 5));
    CHECK(metres(below.distance) == -8000000);
    CHECK(metres(below.point.y) == 0);
    // Deeper than a coordinate goes.
    World leaning(world_def(60, 8));
    add(leaning, LKS_SHAPE_PLANE, turned(at(8388000, 8388000, 0), 0, 0, 1, 45));
    const lks_hit deep = closest(leaning, fixed(8388000, -8388000, 0));
    CHECK(metres(deep.distance) < -8384000);
    CHECK(deep.point.y > -LKS_FIXED(8388000));
    CHECK(deep.point.x < LKS_FIXED(8388000));
}

TEST_CASE("queries that make no sense are refused") {
    World world(world_def(60, 8));
    lks_query query = lks_default_query();
    lks_hit hit{};
    std::uint32_t count = 0;
    const auto refuse = [&](const lks_query& bad, const char* value,
                            lks_result expected = LKS_ERROR_INVALID_ARGUMENT) {
        check_call_refused(world, expected, value,
                           [&] { return lks_world_cast(world, &bad, {}, fixed(1, 0, 0), &hit, 1, &count); });
        check_call_refused(world, expected, value,
                           [&] { return lks_world_overlap(world, &bad, {}, &hit, 1, &count); });
        check_call_refused(world, expected, value,
                           [&] { return lks_world_closest(world, &bad, {}, &hit, &count); });
    };
    lks_query bad = query;
    bad.struct_size = 3;
    refuse(bad, "3", LKS_ERROR_STRUCT_SIZE);
    bad = query;
    bad.kinds = 8;
    refuse(bad, "kinds are 8");
    bad = query;
    bad.radius = fixed(-1);
    refuse(bad, "radius -1");
    check_call_refused(world, LKS_ERROR_INVALID_ARGUMENT, "4001",
                       [&] { return lks_world_cast(world, &query, {}, fixed(4001, 0, 0), &hit, 1, &count); });
    CHECK(lks_world_cast(nullptr, &query, {}, {}, &hit, 1, &count) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_cast(world, nullptr, {}, {}, &hit, 1, &count) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_cast(world, &query, {}, {}, nullptr, 1, &count) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_overlap(world, &query, {}, &hit, 1, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_world_closest(world, &query, {}, nullptr, &count) == LKS_ERROR_NULL_ARGUMENT);
    check_sentence(world.message(), "hit, which");
    CHECK(lks_world_closest(world, &query, {}, &hit, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    check_sentence(world.message(), "found");
    // A way of no length is a point.
    CHECK(lks_world_cast(world, &query, {}, {}, &hit, 1, &count) == LKS_OK);
    CHECK(count == 0);
}
