// Orientations stay of length one, within 2^-53 (docs/rigid-solver.md), however long and whatever
// turns them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "solver/world.h"
#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double most = 128; // 2^-53

// The length less one, in units of 2^-60, exact but for the last step.
double off_one(const lks::Quaternion& q) {
    std::uint64_t hi = 0, lo = 0;
    for (const std::int64_t c : {q.x, q.y, q.z, q.w}) {
        const lks::fixed::UInt128 square =
            lks::fixed::multiply_unsigned(lks::fixed::magnitude(c), lks::fixed::magnitude(c));
        lo += square.lo;
        hi += square.hi + (lo < square.lo ? 1 : 0);
    }
    // |q|² = 1 + 2e, 120 fraction bits.
    const double more =
        std::ldexp(static_cast<double>(static_cast<std::int64_t>(hi - (std::uint64_t{1} << 56))), 64);
    return std::ldexp(more + static_cast<double>(lo), -61);
}

// The furthest from one of any body at the end of any of so many ticks.
double drift(World& world, int ticks) {
    double worst = 0;
    const lks_world* inside = world;
    for (int tick = 0; tick < ticks; ++tick) {
        world.step();
        for (const lks::Body& body : inside->rigid.bodies) {
            worst = std::max(worst, std::abs(off_one(body.orientation)));
        }
    }
    return worst;
}

} // namespace

TEST_CASE("the length of an orientation is told exactly enough") {
    CHECK(off_one({0, 0, 0, lks::turn_one}) == 0);
    CHECK(off_one({0, 0, 0, lks::turn_one + 3}) == 3);
    CHECK(off_one({0, lks::turn_one - 20, 0, 0}) == -20);
}

TEST_CASE("whatever is near a unit quaternion is made one") {
    Random random(7);
    double worst = 0;
    for (int i = 0; i < (support::sanitised ? 100000 : 1000000); ++i) {
        lks::fixed::Rotation q{};
        for (std::int32_t* c : {&q.x, &q.y, &q.z, &q.w}) {
            *c = static_cast<std::int32_t>(random.next() % (1u << 31)) - (1 << 30);
        }
        const double squared =
            std::ldexp(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w, -60);
        if (squared < 0.25 || squared > 3.9) {
            continue;
        }
        lks::Quaternion wide{};
        const std::int32_t from[4] = {q.x, q.y, q.z, q.w};
        std::int64_t* to[4] = {&wide.x, &wide.y, &wide.z, &wide.w};
        for (int axis = 0; axis < 4; ++axis) {
            *to[axis] = std::int64_t{from[axis]} * (1 << 30) + static_cast<std::int64_t>(random.next() >> 34);
        }
        worst = std::max(worst, std::abs(off_one(lks::normalise(wide))));
    }
    INFO(worst);
    CHECK(worst < 2 * most); // what is half as long is measured with half the precision
}

TEST_CASE("free bodies that spin for an hour, up to the limit, keep orientations of length one") {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    const double limit = metres(lks_world_spin_limit(world));
    for (int i = 0; i < 6; ++i) {
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = 1;
        def.angular_velocity = fixed(limit * 0.2 * i, limit * 0.001 * i + 0.1, 1);
        add_body(world, box_shape(0.5, 0.1, 0.3), fixed(3 * i, 0, 0), def);
    }
    CHECK(drift(world, support::sanitised ? 7200 : 216000) <= most);
}

TEST_CASE("figures that are held and led keep orientations of length one, and their worlds their images") {
    for (const std::uint32_t substeps : {1u, 4u, 8u}) {
        World world(world_def(60, substeps));
        lks_body_id led[2];
        lks_transform places[2];
        const int bones[2] = {LKS_HUMANOID_PELVIS, LKS_HUMANOID_HAND_LEFT};
        for (int i = 0; i < 2; ++i) {
            Humanoid human;
            human.def.transform.position = fixed(4 * i, 1.5, 0);
            human.def.velocity = fixed(i * 20, 0, 0);
            lks_body_id bodies[LKS_HUMANOID_BONES];
            REQUIRE(human.add(world, bodies) == LKS_OK);
            led[i] = bodies[bones[i]];
            REQUIRE(lks_body_set_kind(world, led[i], LKS_BODY_KINEMATIC) == LKS_OK);
            REQUIRE(lks_body_transform(world, led[i], &places[i]) == LKS_OK);
        }
        double worst = 0;
        for (int tick = 0; tick < 300; ++tick) {
            for (int i = 0; i < 2; ++i) {
                lks_transform to = places[i];
                to.position.x += fixed(0.5 * std::sin(0.2 * tick));
                to.rotation = about(0, 1, 0, 60 * std::sin(0.3 * tick));
                REQUIRE(lks_body_move_to(world, led[i], to) == LKS_OK);
            }
            worst = std::max(worst, drift(world, 1));
            const Image image = world.save();
            REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
        }
        INFO(worst);
        CHECK(worst <= most);
    }
}

TEST_CASE("humanoids that fall on each other keep orientations of length one") {
    World world(world_def(60, 8));
    add_ground(world);
    for (int i = 0; i < 3; ++i) {
        Humanoid human;
        for (lks_bone& bone : human.bones) {
            bone.body.never_sleeps = 1;
        }
        human.def.transform.position = fixed(0.1 * i, 0.5 + 1.2 * i, 0);
        human.def.transform.rotation = about(1, 0.3 * i, 0, 70 * i);
        REQUIRE(human.add(world) == LKS_OK);
    }
    CHECK(drift(world, 1800) <= most);
}
