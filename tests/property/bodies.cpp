// How rigid bodies move and touch, against what mechanics says.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double g = 9.81;

// Angular momentum per kilogram of a box of these half extents, in world axes.
Vector momentum(const BodyState& body, const Vector& e) {
    const lks_rotation back = conjugate(body.rotation);
    const Vector w = rotate(back, body.spin);
    const Vector l{w.x * (e.y * e.y + e.z * e.z) / 3, w.y * (e.z * e.z + e.x * e.x) / 3,
                   w.z * (e.x * e.x + e.y * e.y) / 3};
    return rotate(body.rotation, l);
}

} // namespace

TEST_CASE("a body falls as Galileo says") {
    World world(world_def(60, 8));
    const lks_body_id body = add_body(world, ball_shape(0.1), fixed(0, 100, 0));
    world.step(120);
    const BodyState state = state_of(world, body);
    CHECK(std::abs(state.velocity.y + 2 * g) < 1e-6);
    // A substep's velocity acts for all of it: half a substep more than a parabola.
    CHECK(std::abs(state.position.y - (100 - g * 2 * (2 + 1 / 480.0) / 2)) < 1e-6);
}

TEST_CASE("a free body keeps its angular momentum and gains no energy in ten minutes") {
    // Half extents of a box, and of one that tumbles about its middle axis, as the T-handle does; poles; slow
    // ones, of whose torque little is left in 40 fraction bits.
    const Vector box{0.5, 0.1, 0.3};
    const Vector pole{0.02, 1, 0.02};
    struct Case {
        Vector e, spin;
        std::uint32_t substeps;
    };
    for (const Case& body_case :
         {Case{box, {0.4, 3, 0.2}, 8}, Case{box, {0.01, 0.02, 5}, 8}, Case{box, {6, 0.01, 0.02}, 8},
          Case{pole, {2, 0, 1}, 20}, Case{pole, {0.01, 30, 0.01}, 8}, Case{{0.05, 1, 0.05}, {2, 0, 1}, 20},
          Case{{0.1, 0.25, 0.5}, {0.02, 0.01, 0.01}, 20}}) {
        const Vector e = body_case.e;
        const Vector spin = body_case.spin;
        CAPTURE(e.x);
        CAPTURE(spin.x);
        World world(world_def(60, body_case.substeps));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_body_def def = lks_default_body_def();
        def.angular_velocity = fixed(spin.x, spin.y, spin.z);
        const lks_body_id body = add_body(world, box_shape(e.x, e.y, e.z), {}, def);
        const double energy = energy_of(world);
        const Vector start = momentum(state_of(world, body), e);
        double greatest = 0;
        double turned = 1;
        for (int second = 0; second < 600; ++second) {
            world.step(60);
            greatest = std::max(greatest, energy_of(world));
            const Vector now = momentum(state_of(world, body), e);
            CHECK((now - start).length() < 1e-3 * start.length());
            turned = std::min(turned, state_of(world, body).spin.dot(spin) / spin.dot(spin));
        }
        INFO("energy, greatest over start: " << greatest / energy);
        CHECK(greatest <= energy * (1 + 1e-9));
        CHECK(energy_of(world) > energy * 0.999);
    }
}

TEST_CASE("a T of two capsules turns over and over for ten minutes, with its momentum, and gains no energy") {
    constexpr double radius = 0.03;
    constexpr double density = 1000;
    const double bar = 0.15;  // half lengths; the bar along x, on top of the stem
    const double stem = 0.12; // along y
    lks_body_shape shapes[] = {capsule_shape(radius, bar, density), capsule_shape(radius, stem, density)};
    shapes[0].transform.rotation = about(0, 0, 1, 90);
    shapes[1].transform.position = fixed(0, -stem - radius, 0);
    // Mass, and the moments of inertia along a capsule's axis and across it.
    const auto capsule = [](double half) {
        const double pi = std::acos(-1.0);
        const double tube = density * pi * radius * radius * 2 * half;
        const double ball = density * pi * radius * radius * radius * 4 / 3;
        const double across = tube * (radius * radius / 4 + half * half / 3) +
                              ball * (0.4 * radius * radius + half * half + 0.75 * half * radius);
        return Vector{tube + ball, tube * radius * radius / 2 + ball * 0.4 * radius * radius, across};
    };
    const Vector b = capsule(bar);
    const Vector s = capsule(stem);
    const double apart = stem + radius;
    const double steiner = b.x * s.x / (b.x + s.x) * apart * apart;
    const Vector inertia{b.y + s.z + steiner, b.z + s.y, b.z + s.z + steiner};
    const auto angular_momentum = [&](const BodyState& state) {
        const lks_rotation& q = state.rotation;
        const Vector w = rotate(conjugate(q), state.spin);
        return rotate(q, {w.x * inertia.x, w.y * inertia.y, w.z * inertia.z});
    };
    REQUIRE(inertia.y < inertia.x); // so that it turns over about x
    REQUIRE(inertia.x < inertia.z);
    for (const Vector& spin : {Vector{5, 0.01, 0.02}, Vector{0.02, 5, 0.01}, Vector{0.4, 0.2, 3}}) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_body_def def = lks_default_body_def();
        def.shapes = shapes;
        def.shape_count = 2;
        def.angular_velocity = fixed(spin.x, spin.y, spin.z);
        lks_body_id body{};
        REQUIRE(lks_world_add_body(world, &def, &body) == LKS_OK);
        const double energy = energy_of(world);
        const Vector start = angular_momentum(state_of(world, body));
        CHECK(std::abs(start.dot(spin) / 2 / energy - 1) < 1e-6); // the moments are the body's
        double greatest = 0;
        double drift = 0;
        int turns = 0;
        bool over = false;
        for (int i = 0; i < 6000; ++i) {
            world.step(6);
            const BodyState state = state_of(world, body);
            greatest = std::max(greatest, energy_of(world));
            drift = std::max(drift, (angular_momentum(state) - start).length() / start.length());
            const lks_rotation& q = state.rotation;
            const bool is_over = rotate(conjugate(q), start).dot(start) < 0;
            turns += is_over != over ? 1 : 0;
            over = is_over;
        }
        INFO("energy, greatest over start: " << greatest / energy << ", now " << energy_of(world) / energy
                                             << "; momentum's drift " << drift << "; turned over " << turns);
        CHECK(greatest <= energy * (1 + 1e-9));
        CHECK(energy_of(world) > energy * 0.999);
        CHECK(drift < 1e-3);
        CHECK((spin.x == 5 ? turns > 50 : spin.y != 5 || turns == 0));
    }
}

TEST_CASE("a ball bounces to the height that its restitution gives it") {
    for (const auto& row :
         {std::pair{0.0, 20u}, {0.3, 20u}, {0.5, 20u}, {0.9, 20u}, {0.3, 8u}, {0.5, 8u}, {0.9, 8u}}) {
        const double restitution = row.first;
        const std::uint32_t substeps = row.second;
        World world(world_def(60, substeps));
        add_ground(world);
        lks_body_def def = lks_default_body_def();
        def.restitution = fixed(restitution);
        const lks_body_id ball = add_body(world, ball_shape(0.25), fixed(0, 2.25, 0), def);
        double highest = 0;
        bool bounced = false;
        for (int tick = 0; tick < 150; ++tick) {
            world.step();
            const BodyState state = state_of(world, ball);
            CHECK(state.position.y > 0.25 - 1e-3);
            const bool rises = state.velocity.y > 0.01;
            bounced = bounced || rises || (restitution == 0.0 && tick > 60);
            if (bounced && highest >= 0) {
                highest = std::max(highest, state.position.y - 0.25);
            }
            if (bounced && !rises && restitution > 0) {
                break;
            }
        }
        const double expected = 2 * restitution * restitution;
        INFO("restitution " << restitution << ", " << substeps << " substeps: height " << highest << " of "
                            << expected);
        // A tick sees the top within half of it, and a substep the impact.
        CHECK(std::abs(highest - expected) < 0.015 * expected + 1e-4);
    }
}

TEST_CASE("a capsule rolls on at the speed it has") {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_def def = lks_default_body_def();
    def.velocity = fixed(2, 0, 0);
    def.angular_velocity = fixed(0, 0, -20);
    REQUIRE(lks_rotation_from_axis_angle(1, 0, 0, 90, &def.transform.rotation) == LKS_OK);
    const lks_body_id body = add_body(world, capsule_shape(0.1, 0.4), fixed(0, 0.1, 0), def);
    const double energy = energy_of(world);
    world.step(600);
    CHECK(std::abs(energy_of(world) / energy - 1) < 1e-3);
    CHECK(std::abs(state_of(world, body).position.x - 20) < 0.02);
}

TEST_CASE("ten boxes upon each other stand for an hour") {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_id boxes[10];
    for (int i = 0; i < 10; ++i) {
        boxes[i] = add_body(world, box_shape(0.5, 0.5, 0.5), fixed(0, 0.5 + i, 0));
    }
    // They settle by what a contact allows, a tenth of a millimetre each, and then stand.
    world.step(60);
    Vector settled[10];
    for (int i = 0; i < 10; ++i) {
        settled[i] = state_of(world, boxes[i]).position;
        CHECK(std::abs(settled[i].y - (0.5 + i)) < 1.5e-3);
    }
    world.step(216000);
    CHECK(energy_of(world) == 0);
    for (int i = 0; i < 10; ++i) {
        const Vector now = state_of(world, boxes[i]).position;
        CHECK(std::hypot(now.x, now.z) < 5e-5);
        CHECK((now - settled[i]).length() < 1e-4);
    }
}

TEST_CASE("towers whose boxes may not sleep stand" * doctest::skip(support::sanitised)) {
    struct Tower {
        int boxes;
        std::uint32_t substeps;
        int seconds;
        double sway; // metres
    };
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    for (const Tower& tower :
         {Tower{10, 8, long_runs() ? 3600 : 600, 2e-5}, Tower{20, 8, 60, 2e-5}, Tower{30, 8, 30, 1e-4},
          Tower{10, 4, 60, 2e-5}, Tower{20, 4, 30, 1e-4}, Tower{10, 2, 60, 2e-5}, Tower{5, 1, 60, 2e-5}}) {
        World world(world_def(60, tower.substeps));
        add_ground(world);
        lks_body_id top{};
        for (int i = 0; i < tower.boxes; ++i) {
            top = add_body(world, box_shape(0.5, 0.5, 0.5), fixed(0, 0.5 + i, 0), def);
        }
        world.step(60 * static_cast<std::uint32_t>(tower.seconds));
        const BodyState state = state_of(world, top);
        const double sway = std::hypot(state.position.x, state.position.z);
        INFO(tower.boxes << " boxes, " << tower.substeps << " substeps: after " << tower.seconds
                         << " s the top one is " << sway << " m aside and "
                         << tower.boxes - 0.5 - state.position.y << " m low");
        CHECK(sway < tower.sway);
        CHECK(std::abs(tower.boxes - 0.5 - state.position.y) < 2e-2);
        CHECK(state.velocity.length() < 1e-5);
    }
}

// Faces that are turned against each other meet in eight corners, of which four are kept: the same ones from
// tick to tick, or what the others pushed is lost. (By the deepest alone, which roundings choose, three of
// six towers turned by up to 10 degrees fell within a minute at 8 substeps, and all of those by up to 45.)
TEST_CASE("towers of boxes that are turned at random stand, and may not sleep" *
          doctest::skip(support::sanitised)) {
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    // (With four substeps five of them sway, and ten fall, where they may not sleep.)
    for (const std::uint32_t substeps : {8u, 20u}) {
        for (const double degrees : {0.1, 3.0, 10.0, 45.0}) {
            for (std::uint32_t seed = 1; seed <= (long_runs() ? 2u : 1u); ++seed) {
                World world(world_def(60, substeps));
                add_ground(world);
                std::mt19937 random(seed);
                lks_body_id top{};
                for (int i = 0; i < 10; ++i) {
                    def.transform.rotation = about(0, 1, 0, degrees * (random() / 0x1p31 - 1));
                    top = add_body(world, box_shape(0.25, 0.25, 0.25), fixed(0, 0.25 + 0.5 * i, 0), def);
                }
                world.step(120);
                const Vector start = state_of(world, top).position;
                world.step(3600);
                const double moved = (state_of(world, top).position - start).length();
                INFO(substeps << " substeps, turned by up to " << degrees << " degrees, seed " << seed << ": "
                              << 1e3 * moved << " mm in a minute");
                CHECK(moved < 1e-3);
            }
        }
    }
}

TEST_CASE("a tower of pairs that joints hold together stands, and may not sleep" *
          doctest::skip(support::sanitised)) {
    struct Tower {
        int pairs;
        std::uint32_t substeps;
        double sway; // metres
    };
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = 1;
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_a.position = fixed(0.5, 0, 0);
    joint.frame_b.position = fixed(-0.5, 0, 0);
    for (const std::uint32_t kind : {LKS_JOINT_FIXED, LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
        for (const Tower& tower : {Tower{10, 8, 2e-5}, Tower{20, 8, 3e-2}, Tower{10, 4, 5e-3}}) {
            if (kind == LKS_JOINT_BALL && tower.substeps < 8) {
                continue; // they sway by decimetres
            }
            World world(world_def(60, tower.substeps));
            add_ground(world);
            lks_body_id top{};
            joint.kind = kind;
            for (int i = 0; i < tower.pairs; ++i) {
                top = add_body(world, box_shape(0.5, 0.5, 0.5), fixed(-0.5, 0.5 + i, 0), def);
                add_joint(world, joint, top,
                          add_body(world, box_shape(0.5, 0.5, 0.5), fixed(0.5, 0.5 + i, 0), def));
            }
            world.step(1800);
            const Vector place = state_of(world, top).position;
            const double sway = std::hypot(place.x + 0.5, place.z);
            INFO("joints of kind " << kind << ", " << tower.pairs << " pairs, " << tower.substeps
                                   << " substeps: the top one is " << sway << " m aside");
            CHECK(sway < tower.sway);
        }
    }
}

TEST_CASE("fast bodies don't pass through a thin wall or each other") {
    for (const double speed : {20.0, 60.0}) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_collider_def wall = lks_default_collider_def();
        wall.shape = LKS_SHAPE_BOX;
        wall.half_extents = fixed(0.025, 5, 5);
        wall.transform.position = fixed(3, 0, 0);
        world.add(wall);
        lks_body_def def = lks_default_body_def();
        lks_body_id shots[20];
        for (int i = 0; i < 20; ++i) {
            def.velocity = fixed(speed, 0, 0);
            def.angular_velocity = fixed(0, 0.3 * i, 1.0 * i);
            shots[i] = add_body(world, capsule_shape(0.05, 0.1), fixed(-0.05 * i, 0.4 * i - 4, 0), def);
        }
        def.angular_velocity = {};
        def.velocity = fixed(-speed, 0, 0);
        const lks_body_id left = add_body(world, ball_shape(0.05), fixed(-3, 4.5, 2.0), def);
        def.velocity = fixed(speed, 0, 0);
        const lks_body_id right = add_body(world, ball_shape(0.05), fixed(-6.01, 4.5, 2.0), def);
        world.step(60);
        for (const lks_body_id shot : shots) {
            CHECK(state_of(world, shot).position.x < 3);
        }
        CHECK(state_of(world, left).position.x > state_of(world, right).position.x);
    }
}

TEST_CASE("an impulse changes velocity and spin by what it carries") {
    World world;
    const lks_body_id body = add_body(world, box_shape(0.5, 0.1, 0.3), fixed(1, 2, 3));
    lks_fixed mass = 0;
    REQUIRE(lks_body_mass(world, body, &mass) == LKS_OK);
    CHECK(std::abs(metres(mass) - 120) < 1e-6);
    REQUIRE(lks_body_apply_impulse(world, body, fixed(0, 240, 0), fixed(1.5, 2, 3)) == LKS_OK);
    const BodyState state = state_of(world, body);
    CHECK(std::abs(state.velocity.y - 2) < 1e-6);
    CHECK(std::abs(state.spin.z - 240 * 0.5 / (120 * (0.25 + 0.01) / 3)) < 1e-4);
    CHECK(std::abs(state.spin.x) < 1e-9);
}

TEST_CASE("an angular impulse turns, and moves nothing") {
    World world;
    REQUIRE(lks_world_set_gravity(world, {}) == LKS_OK);
    lks_body_def def = lks_default_body_def();
    def.transform.rotation = about(0, 0, 1, 90); // its own x is the world's y
    const lks_body_id body = add_body(world, box_shape(0.5, 0.1, 0.3), fixed(1, 2, 3), def);
    const double mass = 120;
    REQUIRE(lks_body_apply_angular_impulse(world, body, fixed(6, -3, 9)) == LKS_OK);
    const BodyState state = state_of(world, body);
    CHECK(std::abs(state.spin.x - 6 / (mass * (0.25 + 0.09) / 3)) < 1e-5);
    CHECK(std::abs(state.spin.y + 3 / (mass * (0.01 + 0.09) / 3)) < 1e-5);
    CHECK(std::abs(state.spin.z - 9 / (mass * (0.25 + 0.01) / 3)) < 1e-5);
    CHECK(std::abs(state.velocity.x) + std::abs(state.velocity.y) + std::abs(state.velocity.z) == 0);
    REQUIRE(lks_body_apply_angular_impulse(world, body, fixed(-6, 3, -9)) == LKS_OK);
    const BodyState still = state_of(world, body);
    CHECK(std::abs(still.spin.x) + std::abs(still.spin.y) + std::abs(still.spin.z) < 1e-8);
    // As an impulse at a lever does, but for the way.
    const lks_body_id other = add_body(world, box_shape(0.5, 0.1, 0.3), fixed(1, 2, 9), def);
    REQUIRE(lks_body_apply_impulse(world, other, fixed(0, 0, -10), fixed(1, 2.25, 9)) == LKS_OK);
    REQUIRE(lks_body_apply_angular_impulse(world, body, fixed(-2.5, 0, 0)) == LKS_OK);
    CHECK(std::abs(state_of(world, other).spin.x - state_of(world, body).spin.x) < 1e-8);
    // It wakes, and a kinematic body takes none.
    world.step(300);
    const lks_body_id anchor = add_anchor(world, fixed(5, 0, 0));
    REQUIRE(lks_body_apply_angular_impulse(world, anchor, fixed(100, 0, 0)) == LKS_OK);
    CHECK(state_of(world, anchor).spin.x == 0);
    // Beyond the limit it is clamped, and counted.
    REQUIRE(lks_body_apply_angular_impulse(world, body, fixed(0, 8388607, 0)) == LKS_OK);
    CHECK(state_of(world, body).spin.y == metres(lks_world_spin_limit(world)));
    lks_world_counters counters{};
    REQUIRE(lks_world_get_counters(world, &counters) == LKS_OK);
    CHECK(counters.speed_clamps == 1);
}

TEST_CASE("a kinematic body carries what lies on it") {
    World world(world_def(60, 8));
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    const lks_body_id cart = add_body(world, box_shape(1, 0.1, 1), {}, def);
    const lks_body_id load = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.3, 0));
    lks_transform target{};
    REQUIRE(lks_body_transform(world, cart, &target) == LKS_OK);
    for (int tick = 0; tick < 120; ++tick) {
        target.position.x += fixed(0.5 / 60 * std::min(tick, 30) / 30);
        REQUIRE(lks_body_move_to(world, cart, target) == LKS_OK);
        world.step();
    }
    CHECK(std::abs(state_of(world, load).position.x - metres(target.position.x)) < 2e-3);
    CHECK(std::abs(state_of(world, load).velocity.x - 0.5) < 1e-3);
}
