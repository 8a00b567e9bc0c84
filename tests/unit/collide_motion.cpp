// Poses at the ends of substeps, and the promise that the place in the world changes no bit.
#include "collide_support.h"

#include <doctest/doctest.h>

using namespace collide_test;
using lks::ColliderState;
using lks::ContactFrame;
using lks::Shape;
using lks::fixed::Vec3;

namespace {

bool same(const ContactFrame& a, const ContactFrame& b) {
    return a.reachable == b.reachable && a.moving == b.moving && a.rotating == b.rotating &&
           a.has_box == b.has_box && a.start_rotation == b.start_rotation &&
           a.end_rotation == b.end_rotation && a.start_centre == b.start_centre &&
           a.end_centre == b.end_centre && a.box_low == b.box_low && a.box_high == b.box_high &&
           a.static_friction == b.static_friction && a.dynamic_friction == b.dynamic_friction;
}

ColliderState random_mover(Dice& dice, const Shape& shape, Real reach, bool moves, bool turns) {
    ColliderState collider = resting(shape, dice.in_cube(reach), dice.rotation(360));
    if (moves) {
        collider.target_position = collider.position + worlds(dice.in_cube(2));
    }
    if (turns) {
        collider.target_rotation =
            lks::fixed::normalise(lks::fixed::multiply(dice.rotation(80), collider.rotation));
    }
    return collider;
}

} // namespace

TEST_CASE(
    "collide: positions are interpolated within a unit, exactly at the ends, and alike wherever they are") {
    Dice dice(1);
    for (int sample = 0; sample < 100000; ++sample) {
        const std::uint32_t n = 1 + dice.below(1000);
        const std::uint32_t j = dice.below(n + 1);
        const std::int64_t a = dice.any() >> 2, b = a + (dice.any() >> (3 + dice.below(40)));
        const std::int64_t found = lks::interpolate_position(a, b, j, n);
        const Real exact = Real(b - a) * j / n;
        REQUIRE(std::fabs(Real(found - a) - exact) <= 1.001L);
        REQUIRE(lks::interpolate_position(a, b, 0, n) == a);
        REQUIRE(lks::interpolate_position(a, b, n, n) == b);
        const std::int64_t shift = dice.any() >> 3;
        REQUIRE(lks::interpolate_position(a + shift, b + shift, j, n) == found + shift);
    }
}

TEST_CASE("collide: frames follow each other without a gap and come out at the target") {
    Dice dice(2);
    for (int sample = 0; sample < 500; ++sample) {
        const Shape shape = sample % 2 == 0 ? box(1, 2, 3) : capsule(0.5L, 1);
        const ColliderState collider = random_mover(dice, shape, 2, true, true);
        const std::uint32_t substeps = 1 + dice.below(20);
        Particle particle = Particle::at(dice.in_cube(1), {0, 0, 0});
        ContactFrame before = particle.frame(collider, 1, substeps);
        const Vec3 start = {collider.position.x * 65536, collider.position.y * 65536,
                            collider.position.z * 65536};
        REQUIRE(before.start_centre == start);
        REQUIRE(before.start_rotation == lks::fixed::to_matrix(collider.rotation));
        for (std::uint32_t substep = 2; substep <= substeps; ++substep) {
            const ContactFrame frame = particle.frame(collider, substep, substeps);
            REQUIRE(frame.start_centre == before.end_centre);
            REQUIRE(frame.start_rotation == before.end_rotation);
            before = frame;
        }
        const Vec3 end = {collider.target_position.x * 65536, collider.target_position.y * 65536,
                          collider.target_position.z * 65536};
        REQUIRE(before.end_centre == end);
        REQUIRE(before.end_rotation == lks::fixed::to_matrix(collider.target_rotation));
    }
}

TEST_CASE("collide: moved by any number of world units, frames, candidates and contacts keep their bits") {
    Dice dice(3);
    int touched = 0, candidates = 0;
    for (int sample = 0; sample < 20000; ++sample) {
        const Shape shapes[] = {plane(), sphere(0.7L), capsule(0.3L, 0.8L), box(0.5L, 0.2L, 0.9L)};
        const Shape& shape = shapes[sample % 4];
        ColliderState here = random_mover(dice, shape, shape.kind == LKS_SHAPE_PLANE ? 1000 : 1.5L,
                                          sample % 3 != 0, sample % 5 < 2);
        here.static_friction = world(0.4L);
        here.dynamic_friction = world(0.3L);
        Particle particle = Particle::at(dice.in_cube(1), dice.in_cube(0.3L));
        particle.margin = coordinate(0.02L);
        if (shape.kind == LKS_SHAPE_PLANE) {
            // Through the particle's neighbourhood.
            const lks::fixed::Direction n = {lks::fixed::to_matrix(here.rotation).m[0][1],
                                             lks::fixed::to_matrix(here.rotation).m[1][1],
                                             lks::fixed::to_matrix(here.rotation).m[2][1]};
            const std::int64_t height = lks::fixed::dot(n, here.position);
            here.position = here.position - lks::fixed::scale(n, height);
            here.target_position = here.target_position - lks::fixed::scale(n, height);
        }
        Particle there = particle;
        // Whole and odd units up to the edge of the world.
        const auto offset = [&dice] { return world(dice.between(-8386000, 8386000)) + dice.below(1000); };
        const Vec3 shift = {offset(), offset(), offset()};
        there.origin = particle.origin + shift;
        ColliderState moved = here;
        moved.position = here.position + shift;
        moved.target_position = here.target_position + shift;

        const bool candidate = lks::may_touch(here, particle.origin, particle.bounds(), particle.margin);
        REQUIRE(candidate == lks::may_touch(moved, there.origin, there.bounds(), there.margin));
        candidates += candidate ? 1 : 0;
        const ContactFrame frame = particle.frame(here, 1, 2);
        const ContactFrame moved_frame = there.frame(moved, 1, 2);
        REQUIRE(same(frame, moved_frame));
        const Vec3 before = particle.position;
        particle.resolve(frame);
        there.resolve(moved_frame);
        REQUIRE(particle.position == there.position);
        REQUIRE(particle.start == there.start);
        touched += particle.position == before ? 0 : 1;
    }
    CHECK(touched > 3000);
    CHECK(candidates > 5000);
}

TEST_CASE("collide: a plane's height is exact however far away its position is") {
    Dice dice(4);
    for (int sample = 0; sample < 2000; ++sample) {
        const bool moves = sample % 2 == 1;
        ColliderState collider = resting(plane(), {}, dice.rotation(360));
        const lks::fixed::Matrix3 r = lks::fixed::to_matrix(collider.rotation);
        // Within the plane, so far as its quantised normal can tell; the last bits of the height are what is
        // tested.
        const Real far = 4e6L;
        collider.position = worlds(rotated(r, {dice.between(-far, far), 0, dice.between(-far, far)}));
        collider.target_position = collider.position + (moves ? worlds(dice.in_cube(0.01L)) : Vec3{0, 0, 0});
        Particle particle = Particle::at(dice.in_cube(0.1L), dice.in_cube(0.1L));
        const Vec3 p = particle.position;
        const ContactFrame frame = particle.frame(collider, 1, 1);
        if (!frame.reachable) {
            continue;
        }
        // n·(p - position) in exact integers of 128 bits, then rounded.
        const lks::fixed::Int128 exact =
            (lks::fixed::multiply_signed(r.m[0][1], p.x) + lks::fixed::multiply_signed(r.m[1][1], p.y) +
             lks::fixed::multiply_signed(r.m[2][1], p.z)) -
            ((lks::fixed::multiply_signed(r.m[0][1], collider.target_position.x) +
              lks::fixed::multiply_signed(r.m[1][1], collider.target_position.y) +
              lks::fixed::multiply_signed(r.m[2][1], collider.target_position.z))
             << 16);
        const std::int64_t height = lks::fixed::saturate_to_int64(lks::fixed::shift_right_rounded(exact, 30));
        if (height > coordinate(1) || height < -coordinate(1)) {
            continue;
        }
        const Real found = local_end(frame, p).y;
        REQUIRE(std::fabs(found - from_coordinate(height)) < 1e-15L);
    }
}

TEST_CASE("collide: a point of a moving plane is carried with it, turns included") {
    Dice dice(6);
    for (int sample = 0; sample < 2000; ++sample) {
        const ColliderState collider = random_mover(dice, plane(), 3, true, sample % 2 == 0);
        Particle particle = Particle::at(dice.in_cube(0.5L), dice.in_cube(0.1L));
        const ContactFrame frame = particle.frame(collider, 1, 1);
        if (!frame.reachable) {
            continue;
        }
        const Point start = to_point(collider.position) * 65536.0L,
                    end = to_point(collider.target_position) * 65536.0L;
        const Point local = rotated_back(frame.start_rotation, to_point(frame.start_centre) - start);
        const Point carried = end + rotated(frame.end_rotation, local);
        REQUIRE(std::fabs(local.y) < 1e-15L);
        REQUIRE((carried - to_point(frame.end_centre)).length() < 3e-8L);
    }
}

TEST_CASE("collide: what is far below a plane is lifted in steps of 32 m, without speed") {
    const ColliderState collider = resting(plane(), {0, 100, 0});
    Particle particle = Particle::at({1, 0, 2}, {0, 0, 0});
    particle.resolve(particle.frame(collider, 1, 1));
    CHECK(particle.position == coordinates({1, 32, 2}));
    CHECK(particle.motion() == Vec3{0, 0, 0});
}
