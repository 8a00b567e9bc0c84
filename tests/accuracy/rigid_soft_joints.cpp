// How far bodies on joints that give way get from the same method in double precision, and float32 beside it.
#include <doctest/doctest.h>

#include "reference/rigid_scenes.h"

using namespace support;
using namespace reference;

namespace {

lks_joint_def soft_points(double compliance, double damping) {
    lks_joint_def def = lks_default_joint_def();
    def.compliance = fixed(compliance);
    def.damping = fixed(damping);
    return def;
}

} // namespace

TEST_CASE("a rod on a soft ball joint, damped or not, is within 5e-7 m after a second, 1e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        for (const double damping : {0, 50}) {
            RigidScene scene(with_substeps(substeps));
            const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
            lks_body_def def = at_rest(fixed(0.5, 3, 0));
            def.transform.rotation = about(0, 0, 1, 90);
            def.angular_velocity = fixed(2, 1, 0);
            const std::size_t rod = scene.add(capsule_shape(0.1, 0.4), def);
            lks_joint_def hold = soft_points(1.0 / 4096, damping);
            hold.frame_b.position = fixed(0, 0.5, 0);
            scene.join(hold, anchor, rod);
            check_run((damping == 0 ? "soft ball joint" : "soft and damped ball joint") +
                          substeps_name(substeps),
                      scene, {1e-6, 1e-5, 100}, {1e-5, 8e-4, 100});
        }
    }
}

TEST_CASE("a rod that friction slows is within 1e-6 m on a soft ball joint, 1e-5 m on a soft hinge") {
    for (const int substeps : {8, 20}) {
        for (const lks_joint_kind kind : {LKS_JOINT_BALL, LKS_JOINT_HINGE}) {
            RigidScene scene(with_substeps(substeps));
            const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
            lks_body_def def = at_rest(fixed(0.5, 3, 0));
            def.transform.rotation = about(0, 0, 1, 90);
            const std::size_t rod = scene.add(capsule_shape(0.1, 0.4), def);
            lks_joint_def hold = soft_points(1.0 / 4096, 50);
            hold.kind = kind;
            hold.angular_compliance = kind == LKS_JOINT_HINGE ? fixed(1.0 / 65536) : 0;
            hold.friction = fixed(20); // N·m, of 135 that the weight turns by
            hold.frame_a.rotation = about(1, 0, 0, 60);
            hold.frame_b.rotation = about(0, 1, 0, -60);
            hold.frame_b.position = fixed(0, 0.5, 0);
            scene.join(hold, anchor, rod);
            const bool ball = kind == LKS_JOINT_BALL;
            const RigidBounds bounds = ball ? RigidBounds{1e-6, 1e-5, 100} : RigidBounds{1e-5, 4e-5, 30};
            check_run((ball ? "soft ball joint, friction" : "soft hinge, friction") + substeps_name(substeps),
                      scene, bounds, bounds);
        }
    }
}

TEST_CASE("a chain of soft joints, and of soft and rigid ones in turn, is within 1e-6 m after a second") {
    for (const int substeps : {8, 20}) {
        {
            RigidScene scene(with_substeps(substeps));
            add_chain(scene, 6, soft_points(1.0 / 4096, 20), soft_points(1.0 / 4096, 20));
            check("soft chain" + substeps_name(substeps), scene.run({second}).back(), {4e-7, 4e-6, 1000});
        }
        {
            RigidScene scene(with_substeps(substeps));
            add_chain(scene, 6, lks_default_joint_def(), soft_points(1.0 / 4096, 20));
            check("soft and rigid chain" + substeps_name(substeps), scene.run({second}).back(),
                  {5e-7, 8e-6, 500});
        }
    }
}

TEST_CASE(
    "an arm on a fixed joint that bends, damped or not, is within 1e-6 m after a second, 8e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        for (const double damping : {0, 2}) {
            RigidScene scene(with_substeps(substeps));
            lks_joint_def def = joint(LKS_JOINT_FIXED, {}, {});
            def.angular_compliance = fixed(1.0 / 256);
            def.angular_damping = fixed(damping);
            add_arm(scene, def, 30);
            check_run((damping == 0 ? "bending arm" : "damped bending arm") + substeps_name(substeps), scene,
                      {1e-6, 2e-6, 200}, {8e-6, 2e-5, 200});
        }
    }
}

TEST_CASE("an arm on a soft and damped hinge is within 4e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_joint_def def = joint(LKS_JOINT_HINGE, {}, {});
        def.angular_compliance = fixed(1.0 / 1024);
        def.angular_damping = fixed(3);
        add_arm(scene, def, 30);
        check_run("soft hinge" + substeps_name(substeps), scene, {2e-6, 4e-6, 200}, {4e-6, 8e-6, 200});
    }
}

TEST_CASE("a rod against soft and damped limits is within 1e-6 m after a second, 8e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_joint_def hold = lks_default_joint_def();
        hold.swing_limit = fixed(20);
        hold.twist_min = fixed(-10);
        hold.twist_max = fixed(15);
        hold.limit_compliance = fixed(1.0 / 256);
        hold.limit_damping = fixed(3);
        add_rod(scene, hold);
        check_run("soft limits" + substeps_name(substeps), scene, {1e-6, 5e-6, 200}, {8e-6, 2e-4, 200});
    }
}
