// What overlaps parts, without flying off, and has time to before it falls asleep.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/overlaps.h"

using namespace support;

namespace {

// How long until nobody is awake any more, in ticks.
int ticks_awake(World& world, int most) {
    int tick = 0;
    do {
        world.step();
        ++tick;
    } while (tick < most && lks_world_awake_body_count(world) > 0);
    return tick;
}

} // namespace

TEST_CASE("a box that begins in the ground comes out of it, and leaves it by next to nothing") {
    for (const double depth : {0.002, 0.02, 0.1}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            World world(world_def(60, substeps));
            add_ground(world);
            const lks_body_id box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 0.2 - depth, 0));
            double highest = -1;
            double fastest = 0;
            for (int tick = 0; tick < 120; ++tick) {
                world.step();
                const BodyState state = state_of(world, box);
                highest = std::max(highest, state.position.y - 0.2);
                fastest = std::max(fastest, state.velocity.length());
            }
            INFO(depth << " m, " << substeps << " substeps: " << highest << " m above the ground, " << fastest
                       << " m/s");
            CHECK(highest < 1e-4);
            CHECK(fastest < 0.1); // it parts by up to three metres a second, without speed
            CHECK(std::abs(state_of(world, box).position.y - 0.2) < 6e-4);
        }
    }
}

TEST_CASE("what begins a thousand kilometres in the ground comes up, and sinks no further") {
    for (const bool jointed : {false, true}) {
        World world(world_def(60, 8));
        add_ground(world);
        const lks_body_id box = add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, -1e6, 0));
        if (jointed) {
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_a.position = fixed(0.25, 0, 0);
            joint.frame_b.position = fixed(-0.25, 0, 0);
            add_joint(world, joint, box, add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0.5, -1e6, 0)));
        }
        world.step(60);
        const BodyState state = state_of(world, box);
        INFO("jointed " << jointed << ": risen by " << state.position.y + 1e6 << " m");
        CHECK(state.position.y > -1e6 + 2.5); // undone at three metres a second
        CHECK(state.position.y < -1e6 + 4);
        CHECK(state.velocity.length() < 0.5);
    }
}

TEST_CASE("a light box squeezed between the ground and a heavy one comes free, by itself and in a figure") {
    for (const bool jointed : {false, true}) {
        World world(world_def(60, 8));
        add_ground(world);
        const lks_body_id light = add_body(world, box_shape(0.1, 0.05, 0.1, 100), fixed(0, 0.04, 0));
        const lks_body_id heavy = add_body(world, box_shape(0.1, 0.1, 0.1, 1400), fixed(0, 0.17, 0));
        REQUIRE(mass_of(world, heavy) > 25 * mass_of(world, light));
        if (jointed) {
            const lks_body_id arm = add_body(world, box_shape(0.1, 0.05, 0.1, 100), fixed(0.3, 0.05, 0));
            lks_joint_def joint = lks_default_joint_def();
            joint.kind = LKS_JOINT_HINGE;
            joint.frame_a.position = fixed(0.15, 0, 0);
            joint.frame_b.position = fixed(-0.15, 0, 0);
            add_joint(world, joint, light, arm);
        }
        const int ticks = ticks_awake(world, 600);
        const double below = 0.05 - state_of(world, light).position.y;
        const double between = state_of(world, light).position.y + 0.15 - state_of(world, heavy).position.y;
        INFO("jointed " << jointed << ": " << below << " m and " << between << " m deep, asleep after "
                        << ticks << " ticks");
        // By itself it is moved without speed, and may sleep once no more than a millimetre and a half is
        // left. Figures are moved as wholes down to a millimetre.
        const double left = jointed ? 1.1e-3 : 1.6e-3;
        CHECK(below < left);
        CHECK(between < left);
        CHECK(lks_world_awake_body_count(world) == 0);
    }
}

TEST_CASE("an arm that hangs on something kinematic is not torn off it by what it is pressed into") {
    World world(world_def(60, 8));
    add_box(world, fixed(0.5, 1, 1), fixed(0.65, 1, 0)); // its face is at x = 0.15
    lks_body_def bracket_def = lks_default_body_def();
    bracket_def.kind = LKS_BODY_KINEMATIC;
    const lks_body_id bracket = add_body(world, box_shape(0.05, 0.05, 0.05), fixed(0, 1.6, 0), bracket_def);
    const lks_body_id arm = add_body(world, box_shape(0.05, 0.2, 0.05), fixed(0, 1.3, 0));
    const lks_body_id hand = add_body(world, box_shape(0.17, 0.05, 0.05), fixed(0, 1.05, 0)); // 2 cm in it
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_FIXED;
    joint.frame_a.position = fixed(0, -0.1, 0);
    joint.frame_b.position = fixed(0, 0.2, 0);
    add_joint(world, joint, bracket, arm);
    joint.frame_a.position = fixed(0, -0.2, 0);
    joint.frame_b.position = fixed(0, 0.05, 0);
    add_joint(world, joint, arm, hand);
    for (int tick = 0; tick < 60; ++tick) {
        world.step();
        const BodyState below = state_of(world, arm);
        const Vector shoulder = below.position + rotate(below.rotation, {0, 0.2, 0});
        INFO("tick " << tick << ": " << 1e3 * (shoulder - Vector{0, 1.5, 0}).length() << " mm apart");
        CHECK((shoulder - Vector{0, 1.5, 0}).length() < 1e-4);
    }
}

TEST_CASE("what nothing can free falls asleep, later than what lies free") {
    int ticks[2];
    for (const bool squeezed : {false, true}) {
        World world(world_def(60, 8));
        add_ground(world);
        // A gap of 20 cm, and a box of 19 or 21.
        for (const double side : {-0.6, 0.6}) {
            add_box(world, fixed(0.5, 1, 1), fixed(side, 1, 0));
        }
        const double half = squeezed ? 0.105 : 0.095;
        const lks_body_id box = add_body(world, box_shape(half, 0.1, 0.1), fixed(0, 0.1, 0));
        ticks[squeezed ? 1 : 0] = ticks_awake(world, 600);
        CHECK(lks_world_awake_body_count(world) == 0);
        CHECK(std::abs(state_of(world, box).position.x) < 6e-3);
    }
    INFO("free: asleep after " << ticks[0] << " ticks, squeezed: " << ticks[1]);
    CHECK(ticks[0] < 60);
    CHECK(ticks[1] >= 120);
    CHECK(ticks[1] < 300);
}

// Asleep with what was left, they were 20 cm in each other, and the crate 5 cm in what lies on it.
TEST_CASE("what is still coming out of something else does not fall asleep in it") {
    struct Start {
        lks_body_shape shape;
        double height;
    };
    const lks_body_shape box = box_shape(0.1, 0.1, 0.1);
    const Start crate{box_shape(0.1, 0.1, 0.1, 625), 0.1};  // 5 kg
    const Start weight{box_shape(0.5, 0.5, 0.5, 500), 1.7}; // 500 kg
    for (const std::vector<Start>& starts :
         {std::vector<Start>(20, {box, 0.5}), std::vector<Start>(8, {box, 0.5}),
          std::vector<Start>(12, {capsule_shape(0.1, 0.2), 0.5}), std::vector<Start>{crate, weight}}) {
        World world(world_def(60, 8));
        add_ground(world);
        std::vector<lks_body_id> bodies;
        for (const Start& start : starts) {
            bodies.push_back(add_body(world, start.shape, fixed(0, start.height, 0)));
        }
        const int ticks = ticks_awake(world, 1200);
        std::vector<Solid> solids;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            solids.push_back(solid_of(starts[i].shape, state_of(world, bodies[i])));
        }
        double gap = 0;
        for (std::size_t i = 0; i < solids.size(); ++i) {
            for (std::size_t j = i + 1; j < solids.size(); ++j) {
                gap = std::min(gap, gap_between(solids[i], solids[j]));
            }
        }
        INFO(starts.size() << " bodies: asleep after " << ticks << " ticks, " << -gap << " m of overlap");
        CHECK(ticks < 600);
        CHECK(gap > -2.5e-3);
    }
}
