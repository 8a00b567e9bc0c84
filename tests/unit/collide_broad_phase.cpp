// The broad phase loses no contact, rejects what is clearly away, and is defined for all numbers.
#include "collide_support.h"

#include <doctest/doctest.h>

using namespace collide_test;
using lks::Bounds;
using lks::ColliderState;
using lks::Shape;
using lks::fixed::Vec3;

namespace {

ColliderState random_collider(Dice& dice, Real reach) {
    const Shape shapes[] = {plane(), sphere(dice.between(0.01L, 2)),
                            capsule(dice.between(0.01L, 1), dice.between(0, 2)),
                            box(dice.between(0.01L, 2), dice.between(0.01L, 2), dice.between(0.01L, 2))};
    ColliderState collider = resting(shapes[dice.below(4)], dice.in_cube(reach), dice.rotation(360));
    if (dice.below(2) == 0) {
        collider.target_position = collider.position + worlds(dice.in_cube(3));
    }
    if (dice.below(2) == 0) {
        collider.target_rotation =
            lks::fixed::normalise(lks::fixed::multiply(dice.rotation(90), collider.rotation));
    }
    return collider;
}

} // namespace

TEST_CASE("collide: whatever a substep pushes was a candidate of its tick") {
    Dice dice(1);
    int pushed = 0, rejected = 0;
    for (int sample = 0; sample < samples(100000); ++sample) {
        const ColliderState collider = random_collider(dice, 4);
        // With a large turn in one substep, the straight way that stands for the particle's arc may cut a
        // corner.
        const std::uint32_t substeps = (collider.rotates() ? 5 : 1) + dice.below(16);
        Particle particle = Particle::at(dice.in_cube(4), dice.in_cube(1.0L / substeps));
        particle.margin = coordinate(dice.between(0, 0.1L));
        const std::uint32_t substep = 1 + dice.below(substeps);
        const Vec3 before = particle.position;
        const bool candidate = lks::may_touch(collider, particle.origin, particle.bounds(), particle.margin);
        particle.resolve(particle.frame(collider, substep, substeps));
        const bool moved = !(particle.position == before);
        pushed += moved ? 1 : 0;
        rejected += candidate ? 0 : 1;
        REQUIRE((candidate || !moved));
    }
    CHECK(pushed > samples(10000));
    CHECK(rejected > samples(10000));
}

TEST_CASE("collide: the frame's box rejects only what the full test rejects") {
    Dice dice(2);
    int pushed = 0, skipped = 0, swept = 0;
    for (int sample = 0; sample < samples(200000); ++sample) {
        ColliderState collider = random_collider(dice, 3);
        const bool blade = sample % 2 == 0;
        if (blade) {
            // Turns away from what it has swept, with a slow particle: the box has to reach back for it.
            collider = resting(box(2, 0.02L, 0.02L), dice.in_cube(1), dice.rotation(360));
            const Point axis = rotated(lks::fixed::to_matrix(collider.rotation), {0, 1, 0});
            collider.target_rotation = lks::fixed::normalise(
                lks::fixed::multiply(degrees_about(axis, dice.between(5, 19)), collider.rotation));
        }
        Particle particle = Particle::at(dice.in_cube(3), dice.in_cube(blade ? 1e-3L : 2));
        if (blade) {
            const Real along = dice.between(-2, 2);
            const Point in_collider = {along, 0, -along * dice.between(0, 0.3L)};
            particle = Particle::at(to_point(collider.position) * 65536.0L +
                                        rotated(lks::fixed::to_matrix(collider.rotation), in_collider),
                                    dice.in_cube(1e-3L));
        }
        Particle plain = particle;
        const std::uint32_t substeps = blade ? 1 : 1 + dice.below(6);
        lks::ContactFrame frame = particle.frame(collider, 1, substeps);
        if (collider.shape.kind == LKS_SHAPE_PLANE) {
            continue;
        }
        skipped += frame.reachable ? 0 : 1;
        particle.resolve(frame);
        frame.reachable = true;
        frame.box_low = {INT64_MIN, INT64_MIN, INT64_MIN};
        frame.box_high = {INT64_MAX, INT64_MAX, INT64_MAX};
        const Vec3 before = plain.position;
        plain.resolve(frame);
        const bool moved = !(plain.position == before);
        pushed += moved ? 1 : 0;
        swept += moved && blade ? 1 : 0;
        REQUIRE(plain.position == particle.position);
        REQUIRE(plain.start == particle.start);
    }
    CHECK(pushed > samples(1500));
    CHECK(swept > samples(1500));
    CHECK(skipped > samples(5000));
}

TEST_CASE("collide: colliders that are away are no candidates") {
    const Bounds bounds = {coordinates({-1, -1, -1}), coordinates({1, 1, 1})};
    const Vec3 origin = worlds({1000, 2000, 3000});
    const auto touches = [&](const Shape& shape, const Point& at, const Point& to, std::int64_t margin) {
        ColliderState collider = resting(shape, Point{1000, 2000, 3000} + at);
        collider.target_position = worlds(Point{1000, 2000, 3000} + to);
        return lks::may_touch(collider, origin, bounds, margin);
    };
    CHECK(touches(sphere(0.5L), {1.4L, 0, 0}, {1.4L, 0, 0}, 0));
    CHECK_FALSE(touches(sphere(0.5L), {1.6L, 0, 0}, {1.6L, 0, 0}, 0));
    CHECK(touches(sphere(0.5L), {1.6L, 0, 0}, {1.6L, 0, 0}, coordinate(0.2L)));
    CHECK(touches(sphere(0.5L), {20, 0, 0}, {-20, 0, 0}, 0));
    CHECK_FALSE(touches(sphere(0.5L), {20, 2, 0}, {-20, 2, 0}, 0));
    CHECK(touches(box(5, 0.1L, 5), {4, -1.05L, 0}, {4, -1.05L, 0}, 0));
    CHECK_FALSE(touches(box(5, 0.1L, 5), {4, -1.2L, 0}, {4, -1.2L, 0}, 0));
    CHECK(touches(capsule(0.5L, 3), {0, 4, 0}, {0, 4, 0}, 0));
    CHECK_FALSE(touches(capsule(0.5L, 3), {0, 5, 0}, {0, 5, 0}, 0));
    CHECK(touches(plane(), {500, -0.9L, 0}, {500, -0.9L, 0}, 0));
    CHECK(touches(plane(), {500, 900, 0}, {500, 900, 0}, 0));
    CHECK_FALSE(touches(plane(), {500, -1.1L, 0}, {500, -1.1L, 0}, 0));
    CHECK(touches(plane(), {500, -1.1L, 0}, {500, -1.1L, 0}, coordinate(0.2L)));
    CHECK(touches(plane(), {500, -50, 0}, {500, -0.9L, 0}, 0));
}

TEST_CASE(
    "collide: candidates come in ascending order, only used slots, and only those that meet particles") {
    struct Slot {
        ColliderState collider;
        bool used;
    };
    Slot slots[7] = {};
    for (int i = 0; i < 7; ++i) {
        slots[i] = {resting(sphere(0.5L), {i == 3 ? Real(40) : Real(0.1L * i), 0, 0}), i != 1};
    }
    slots[6].collider.filter = {1, ~LKS_CATEGORY_PARTICLES, 0};
    std::uint32_t indices[7] = {};
    const Bounds bounds = {coordinates({-1, -1, -1}), coordinates({1, 1, 1})};
    REQUIRE(lks::collect_candidates(slots, 7u, Vec3{0, 0, 0}, bounds, 0, indices) == 4);
    CHECK(indices[0] == 0);
    CHECK(indices[1] == 2);
    CHECK(indices[2] == 4);
    CHECK(indices[3] == 5);
}

TEST_CASE("collide: any 64-bit positions and bounds are defined, and end within the range of coordinates") {
    Dice dice(7);
    const std::int64_t edges[] = {
        INT64_MIN, INT64_MAX, std::int64_t{1} << 62, -(std::int64_t{1} << 62), lks::coordinate_limit,
        0,         1,         -lks::coordinate_limit};
    const auto any = [&] { return dice.below(2) == 0 ? edges[dice.below(8)] : dice.any() >> dice.below(63); };
    for (int sample = 0; sample < samples(300000); ++sample) {
        ColliderState collider = random_collider(dice, dice.below(2) == 0 ? 64 : 8e6L);
        if (dice.below(4) == 0) {
            collider.shape = dice.below(2) == 0 ? capsule(30, 30) : box(30, 30, 30);
        }
        if (dice.below(2) == 0) {
            collider.target_position = collider.position + worlds(dice.in_cube(100));
        }
        collider.static_friction = world(dice.between(0, 100));
        collider.dynamic_friction = collider.static_friction;
        Particle particle;
        particle.origin = dice.below(2) == 0 ? Vec3{0, 0, 0} : worlds(dice.in_cube(8388000));
        particle.position = {any(), any(), any()};
        particle.start = dice.below(2) == 0 ? particle.position : Vec3{any(), any(), any()};
        particle.margin = coordinate(dice.between(0, 1));
        particle.friction_factor = world(100);
        (void)lks::may_touch(collider, particle.origin, particle.bounds(), particle.margin);
        const Vec3 before = particle.position;
        particle.resolve(particle.frame(collider, 1, 1 + dice.below(3)));
        if (!(particle.position == before)) {
            REQUIRE(std::max({particle.position.x, particle.position.y, particle.position.z}) <=
                    lks::coordinate_limit);
            REQUIRE(std::min({particle.position.x, particle.position.y, particle.position.z}) >=
                    -lks::coordinate_limit);
        }
    }
}
