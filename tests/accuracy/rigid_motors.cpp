// How far bodies on joints with motors and with friction get from the same method in double precision, and
// float32 beside it.
#include <doctest/doctest.h>

#include "reference/rigid_bounds.h"

using namespace support;
using namespace reference;

namespace {

// Held at one end, level along x; a hinge's axis leans by 30°.
void add_arm(RigidScene& scene, std::uint32_t kind, double friction) {
    const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
    const std::size_t arm = scene.add(box_shape(0.5, 0.1, 0.05), at_rest(fixed(0.5, 3, 0)));
    lks_joint_def def = joint(kind, {}, fixed(-0.5, 0, 0));
    def.frame_a.rotation = def.frame_b.rotation = about(1, 0, 0, 60);
    def.friction = fixed(friction);
    scene.join(def, anchor, arm);
}

lks_motor motor(double torque, double response, const lks_rotation& target) {
    return {fixed(torque), fixed(response), target};
}

// A pair in flight, the upper one four times as heavy.
void add_pair(RigidScene& scene, double friction) {
    lks_body_def def = at_rest(fixed(0, 3, 0));
    def.velocity = fixed(1, 5, 2);
    def.angular_velocity = fixed(0, 0, 2);
    def.mass = fixed(1);
    const std::size_t light = scene.add(capsule_shape(0.1, 0.2), def);
    def.transform.position = fixed(0, 3.7, 0);
    def.angular_velocity = fixed(0.5, 1, 2);
    def.mass = fixed(4);
    const std::size_t heavy = scene.add(capsule_shape(0.1, 0.3), def);
    lks_joint_def hold = joint(LKS_JOINT_BALL, fixed(0, 0.3, 0), fixed(0, -0.4, 0));
    hold.friction = fixed(friction);
    scene.join(hold, light, heavy);
}

} // namespace

TEST_CASE("an arm that a motor lifts is within 1e-5 m on a ball joint and 8e-5 m on a hinge") {
    // 196 N·m pull it down; 400 lift it, 120 do not. A motor's row turns about the missed axis with one
    // weight: what is missed across it, be it a rounding, grows twentyfold in a round where inertias are as 1
    // : 21.
    for (const int substeps : {8, 20}) {
        for (const double torque : {400, 120}) {
            for (const std::uint32_t kind : {LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
                RigidScene scene(with_substeps(substeps));
                add_arm(scene, kind, 0);
                scene.drive(0, motor(torque, 0.1, about(0, 1, 0, 50)));
                const bool hinge = kind == LKS_JOINT_HINGE;
                const RigidBounds bounds = hinge ? RigidBounds{8e-5, 1.6e-4, 2} : RigidBounds{1e-5, 2e-5, 40};
                const std::string name = hinge ? "motor on a hinge" : "motor on a ball joint";
                check_run((torque == 400 ? "strong " : "weak ") + name + substeps_name(substeps), scene,
                          bounds, bounds);
            }
        }
    }
}

TEST_CASE("an arm whose joint has friction is within 8e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        for (const std::uint32_t kind : {LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
            RigidScene scene(with_substeps(substeps));
            add_arm(scene, kind, 30);
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
