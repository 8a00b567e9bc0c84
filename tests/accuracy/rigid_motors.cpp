// How far bodies on joints with motors and with friction get from the same method in double precision, and
// float32 beside it.
#include <doctest/doctest.h>

#include "reference/rigid_scenes.h"

using namespace support;
using namespace reference;

namespace {

lks_joint_def with_friction(std::uint32_t kind, double friction) {
    lks_joint_def def = joint(kind, {}, {});
    def.friction = fixed(friction);
    return def;
}

lks_motor motor(double torque, double response, const lks_rotation& target) {
    return {fixed(torque), fixed(response), target};
}

// Four times as heavy.
void add_pair(RigidScene& scene, double friction) {
    add_pair(scene, with_friction(LKS_JOINT_BALL, friction), 4, fixed(1, 5, 2), fixed(0.5, 1, 2));
}

} // namespace

TEST_CASE("an arm that a motor lifts is within 2e-5 m on a ball joint and 8e-5 m on a hinge") {
    // 196 N·m pull it down; 400 lift it, 120 do not. A motor's row turns about the missed axis with one
    // weight: what is missed across it, be it a rounding, grows twentyfold in a round where inertias are as 1
    // : 21.
    for (const int substeps : {8, 20}) {
        for (const double torque : {400, 120}) {
            for (const std::uint32_t kind : {LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
                RigidScene scene(with_substeps(substeps));
                add_arm(scene, with_friction(kind, 0), 30);
                scene.drive(0, motor(torque, 0.1, about(0, 1, 0, 50)));
                const bool hinge = kind == LKS_JOINT_HINGE;
                const RigidBounds bounds = hinge ? RigidBounds{8e-5, 1.6e-4, 2} : RigidBounds{2e-5, 4e-5, 20};
                const std::string name = hinge ? "motor on a hinge" : "motor on a ball joint";
                check_run((torque == 400 ? "strong " : "weak ") + name + substeps_name(substeps), scene,
                          bounds, bounds);
            }
        }
    }
}

TEST_CASE("an arm that a motor lifts to beyond a cone or an ellipse is within 3e-6 m") {
    for (const int substeps : {8, 20}) {
        for (const double limit_z : {40, 15}) {
            RigidScene scene(with_substeps(substeps));
            lks_joint_def def = with_friction(LKS_JOINT_BALL, 0);
            def.swing_limit = fixed(40);
            def.swing_limit_z = fixed(limit_z);
            def.twist_min = fixed(-20);
            def.twist_max = fixed(20);
            add_arm(scene, def, 30);
            scene.drive(0, motor(400, 0.1, about(0.5, 1, 0.6, 110)));
            check_run((limit_z == 40 ? "motor beyond a cone" : "motor beyond an ellipse") +
                          substeps_name(substeps),
                      scene, {3e-6, 6e-6, 20}, {3e-6, 6e-6, 20});
        }
    }
}

TEST_CASE("an arm whose joint has friction is within 8e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        for (const std::uint32_t kind : {LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
            RigidScene scene(with_substeps(substeps));
            add_arm(scene, with_friction(kind, 30), 30);
            check_run((kind == LKS_JOINT_HINGE ? "hinge with friction" : "ball joint with friction") +
                          substeps_name(substeps),
                      scene, {8e-6, 1.6e-5, 20}, {8e-6, 1.6e-5, 20});
        }
    }
}

TEST_CASE("a thrown pair is within 5e-4 m after ten seconds with friction, 2e-2 m with a motor") {
    for (const int substeps : {8, 20}) {
        RigidScene rubbed(with_substeps(substeps));
        add_pair(rubbed, 0.05);
        check_run("thrown pair with friction" + substeps_name(substeps), rubbed, {6e-6, 4e-5, 500},
                  {5e-4, 1e-3, 500});
        RigidScene driven(with_substeps(substeps));
        add_pair(driven, 0);
        driven.drive(0, motor(2, 0.2, about(1, 0.5, 0.2, 70)));
        check_run("thrown pair with a motor" + substeps_name(substeps), driven, {2e-4, 6e-4, 30},
                  {2e-2, 5e-2, 100});
    }
}
