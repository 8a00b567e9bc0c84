// How far bodies on rods, ropes and struts get from the same method in double precision, and float32 beside
// it.
#include <doctest/doctest.h>

#include <string>

#include "reference/rigid_scenes.h"

using namespace support;
using namespace reference;

namespace {

lks_joint_def distance(double min, double max, double compliance = 0, double damping = 0) {
    lks_joint_def def = joint(LKS_JOINT_DISTANCE, {}, {});
    def.distance_min = fixed(min);
    def.distance_max = fixed(max);
    def.compliance = fixed(compliance);
    def.damping = fixed(damping);
    return def;
}

// A capsule beside an anchor at (0, 3, 0), held at its end; its motion is damped.
void add_hanging(RigidScene& scene, lks_joint_def def, const lks_vec3& position, const lks_vec3& velocity) {
    const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
    lks_body_def body = at_rest(position);
    body.transform.rotation = about(0, 0, 1, 90);
    body.velocity = velocity;
    body.linear_damping = fixed(0.2);
    body.angular_damping = fixed(0.4);
    const std::size_t rod = scene.add(capsule_shape(0.1, 0.3), body);
    def.frame_b.position = fixed(0, 0.4, 0);
    scene.join(def, anchor, rod);
}

} // namespace

TEST_CASE("a damped capsule that swings on a rod is within 8e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_hanging(scene, distance(0.6, 0.6), fixed(1, 3, 0), fixed(0, 0, 1));
        check_run("rod" + substeps_name(substeps), scene, {4e-7, 2e-5, 500}, {8e-6, 3e-4, 300});
    }
}

TEST_CASE("a capsule on a rope that goes slack and snaps taut is within 6e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_hanging(scene, distance(0, 1), fixed(0.8, 3, 0), fixed(1, 3, 0.5));
        check_run("rope" + substeps_name(substeps), scene, {2e-7, 4e-6, 1000}, {6e-6, 3e-4, 1000});
    }
}

TEST_CASE("balls that ropes hold from two sides, one on the other, are within 1e-5 m after a second, 2e-5 m "
          "after ten") {
    // What one rope pulls, the other may take back; but neither pushes. Each jerk sets the next ones aside.
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t left = scene.add_anchor(fixed(-1, 3, 0));
        const std::size_t right = scene.add_anchor(fixed(1, 3, 0));
        lks_body_def def = at_rest(fixed(0, 3, 0));
        def.velocity = fixed(3, 1, 0.5);
        const std::size_t upper = scene.add(ball_shape(0.1), def);
        def.velocity = fixed(-2, 2, 0);
        def.transform.position = fixed(0, 2.5, 0);
        const std::size_t lower = scene.add(ball_shape(0.15), def);
        scene.join(distance(0, 1.1), left, upper);
        scene.join(distance(0, 1.1), right, upper);
        scene.join(distance(0, 0.5), upper, lower);
        check_run("ropes" + substeps_name(substeps), scene, {1e-5, 1e-9, 100}, {2e-5, 1e-9, 150});
    }
}

TEST_CASE("a ball that a strut holds off until it slips past is within 3e-6 m after two seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
        const std::size_t ball = scene.add(ball_shape(0.1), at_rest(fixed(0.2, 4, 0.1)));
        scene.join(distance(1, 64), anchor, ball);
        check("strut" + substeps_name(substeps), scene.run({2 * second}).back(), {3e-6, 1e-9, 3000});
    }
}

TEST_CASE("two capsules in flight that are kept from near and far are within 8e-6 m after a second, 2e-2 m "
          "after ten") {
    // Each jerk sets the next ones aside.
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_pair(scene, distance(0.1, 0.3), 4, fixed(1, 5, 2), fixed(0.5, 1, 2));
        check_run("tethered pair" + substeps_name(substeps), scene, {8e-6, 8e-5, 200}, {2e-2, 1e-1, 50});
    }
}

TEST_CASE("capsules beyond the limits of their ropes, rods and struts are within 1e-5 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        // Too long for a rope and a rod, too short for a strut.
        for (const lks_joint_def& def : {distance(0, 0.7), distance(0.7, 0.7), distance(1, 2)}) {
            RigidScene scene(with_substeps(substeps));
            add_hanging(scene, def, fixed(0.8, 2.5, 0.2), fixed(0.5, 0, 0));
            check_run("exceeded" + substeps_name(substeps), scene, {1e-6, 2e-5, 200}, {1e-5, 3e-4, 300});
        }
    }
}

TEST_CASE("a capsule on a soft rod or rope is within 1e-5 m after a second, damped within 3e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        for (const double damping : {0, 40}) {
            for (const double min : {0.6, 0.0}) {
                RigidScene scene(with_substeps(substeps));
                // Where it is damped it gets more than half a metre longer.
                const double compliance = damping == 0 ? 1.0 / 8192 : 1.0 / 1024;
                add_hanging(scene, distance(min, 0.6, compliance, damping), fixed(1, 3, 0), fixed(1, 3, 0.5));
                check_run((damping == 0 ? "soft " : "soft and damped ") +
                              std::string(min == 0 ? "rope" : "rod") + substeps_name(substeps),
                          scene, {1e-5, 3e-5, 100},
                          damping == 0 ? RigidBounds{1e-3, 1e-2, 20} : RigidBounds{3e-5, 3e-4, 100});
            }
        }
    }
}
