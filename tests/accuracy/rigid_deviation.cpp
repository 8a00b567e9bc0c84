// How far bodies and joints in fixed point get from the same method in double precision, and float32 beside
// it.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "reference/rigid_scenes.h"

using namespace support;
using namespace reference;

namespace {

void add_arm(RigidScene& scene, std::uint32_t kind, double degrees) {
    add_arm(scene, joint(kind, {}, {}), degrees);
}

// Thirty times as heavy.
void add_pair(RigidScene& scene, std::uint32_t kind) {
    add_pair(scene, joint(kind, {}, {}), 30, fixed(-0.4, 5, 2), fixed(0.6, 1, 2));
}

} // namespace

TEST_CASE("a box that tumbles about its middle axis is within 3e-8 m and 2e-4 rad after ten seconds") {
    // Nearly all of the angle is the 2^-33 that a spin loses in a substep.
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_body_def def = at_rest(fixed(0, 1, 0));
        def.transform.rotation = about(1, 2, 3, 40);
        def.velocity = fixed(3, 6, -2);
        def.angular_velocity = fixed(0.3, 0.5, 6);
        scene.add(box_shape(0.1, 0.3, 0.2), def);
        check_run("box" + substeps_name(substeps), scene, {2e-9, 2e-6, 1e4}, {3e-8, 2e-4, 1e5});
    }
}

TEST_CASE("a compound pendulum that circles is within 1e-6 m after a second, 2e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
        lks_body_def def = at_rest(fixed(0.5, 3, 0));
        def.transform.rotation = about(0, 0, 1, 90);
        def.angular_velocity = fixed(2, 1, 0);
        def.velocity = fixed(0, 0, -0.5);
        const std::size_t rod = scene.add(capsule_shape(0.1, 0.4), def);
        scene.join(joint(LKS_JOINT_BALL, fixed(0, 0, 0), fixed(0, 0.5, 0)), anchor, rod);
        check_run("pendulum" + substeps_name(substeps), scene, {7e-7, 1e-5, 100}, {2e-5, 8e-4, 100});
    }
}

TEST_CASE(
    "a chain of ten capsules released level is within 3e-6 m after a second, with an end of 1:10,000 too") {
    struct Case {
        int substeps;
        int ratio;
        RigidBounds bounds;
    };
    for (const Case& c : {Case{8, 1, {6e-8, 1e-6, 1000}}, Case{20, 1, {2e-7, 5e-6, 1000}},
                          Case{20, 300, {6e-7, 5e-6, 1000}}, Case{20, 10000, {6e-7, 5e-6, 1000}}}) {
        RigidScene scene(with_substeps(c.substeps));
        add_chain(scene, 10, lks_default_joint_def(), lks_default_joint_def(), c.ratio);
        check("chain 1:" + std::to_string(c.ratio) + substeps_name(c.substeps) + ", 1 s",
              scene.run({second}).back(), c.bounds);
    }
}

TEST_CASE("a ring of eight that is hung up at one is within 3e-5 m after a second") {
    struct Case {
        int substeps;
        RigidBounds bounds;
    };
    for (const Case& c : {Case{8, {3e-5, 3e-4, 1000}}, Case{20, {3e-5, 3e-4, 1000}}}) {
        RigidScene scene(with_substeps(c.substeps));
        const std::size_t anchor = scene.add_anchor(fixed(0, 5, 0));
        const double radius = 0.1 / std::tan(std::acos(-1.0) / 8);
        std::size_t links[8];
        for (int i = 0; i < 8; ++i) {
            const double angle = i * std::acos(-1.0) / 4;
            lks_body_def def = at_rest(fixed(radius * std::sin(angle), 5 - radius * std::cos(angle), 0));
            def.transform.rotation = about(0, 0, 1, 45 * i - 90);
            links[i] = scene.add(capsule_shape(0.03, 0.07), def);
        }
        scene.join(joint(LKS_JOINT_BALL, {}, fixed(0, -0.1, 0)), anchor, links[3]);
        for (int i = 0; i < 8; ++i) {
            scene.join(joint(LKS_JOINT_BALL, fixed(0, 0.1, 0), fixed(0, -0.1, 0)), links[i],
                       links[(i + 1) % 8]);
        }
        check("ring" + substeps_name(c.substeps), scene.run({second}).back(), c.bounds);
    }
}

// Its hinges hold more than there is to be held.
TEST_CASE("a linkage of four bars on hinges, on a rope, is within 1e-5 m after half a second") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t anchor = scene.add_anchor(fixed(0, 5, 0));
        std::size_t bars[4];
        for (int i = 0; i < 4; ++i) {
            const double angle = (i + 0.5) * std::acos(-1.0) / 2;
            lks_body_def def = at_rest(fixed(0.14 * std::sin(angle), 5 - 0.14 * std::cos(angle), 0));
            def.transform.rotation = about(0, 0, 1, 90 * i + 45 - 90);
            bars[i] = scene.add(capsule_shape(0.03, 0.11), def);
        }
        const double half = 0.14;
        lks_joint_def hinge = joint(LKS_JOINT_HINGE, fixed(0, half, 0), fixed(0, -half, 0));
        hinge.frame_a.rotation = hinge.frame_b.rotation = about(1, 0, 0, 90);
        for (int i = 0; i < 4; ++i) {
            hinge.twist_min = fixed(i == 0 ? 60 : -180); // one of them has a limit, and comes to it
            scene.join(hinge, bars[i], bars[(i + 1) % 4]);
        }
        lks_joint_def rope = joint(LKS_JOINT_DISTANCE, fixed(0, 0, 0.05), fixed(0, -half, 0));
        rope.distance_max = fixed(0.3);
        scene.join(rope, anchor, bars[2]);
        check("linkage" + substeps_name(substeps), scene.run({second / 2}).back(), {1e-5, 1e-4, 10});
    }
}

TEST_CASE("a thrown pair on a ball joint is within 6e-6 m after a second, 3e-4 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_pair(scene, LKS_JOINT_BALL);
        check_run("pair 1:30" + substeps_name(substeps), scene, {6e-6, 6e-5, 1000}, {3e-4, 1.2e-3, 1000});
    }
}

TEST_CASE("a thrown pair on a hinge is within 2e-5 m after a second, 4e-4 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_pair(scene, LKS_JOINT_HINGE);
        check_run("hinged pair 1:30" + substeps_name(substeps), scene, {2e-5, 1.4e-4, 100},
                  {4e-4, 2.4e-3, 100});
    }
}

TEST_CASE("an arm on a level hinge is within 1e-7 m after a second, 1e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_arm(scene, LKS_JOINT_HINGE, 0);
        check_run("level hinge" + substeps_name(substeps), scene, {1e-7, 2e-7, 100}, {1e-6, 2e-6, 100});
    }
}

TEST_CASE("an arm on a leaning hinge is within 1e-7 m after a second, 1e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_arm(scene, LKS_JOINT_HINGE, 30);
        check_run("leaning hinge" + substeps_name(substeps), scene, {1e-7, 2e-7, 100}, {1e-6, 2e-6, 50});
    }
}

TEST_CASE("an arm held by a fixed joint is within 3e-9 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_arm(scene, LKS_JOINT_FIXED, 0);
        check_run("fixed joint" + substeps_name(substeps), scene, {3e-9, 6e-9, 50}, {3e-9, 6e-9, 50});
    }
}
