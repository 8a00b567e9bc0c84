// How far bodies on joints with limits get from the same method in double precision, and float32 beside it.
#include <doctest/doctest.h>

#include "reference/rigid_scenes.h"

using namespace support;
using namespace reference;

namespace {

// Hangs on a ball joint of 30° and from -20° to 35° of twist, and is pushed against all of them.
void add_rod(RigidScene& scene, double swing_limit_z) {
    lks_joint_def hold = lks_default_joint_def();
    hold.swing_limit = fixed(30);
    hold.swing_limit_z = fixed(swing_limit_z);
    hold.twist_min = fixed(-20);
    hold.twist_max = fixed(35);
    add_rod(scene, hold);
}

// Three bones on a ball joint and a hinge, thrown on the ground.
void add_limb(RigidScene& scene) {
    scene.add_ground(0.5, 0.5, false);
    std::size_t bones[3];
    for (int i = 0; i < 3; ++i) {
        lks_body_def def = at_rest(fixed(0.1 * i, 1.2 - 0.4 * i, 0));
        def.static_friction = def.dynamic_friction = fixed(0.5);
        def.transform.rotation = about(0, 0, 1, 5);
        def.velocity = fixed(1, 0, 0.5);
        bones[i] = scene.add(capsule_shape(0.06, 0.12), def);
    }
    lks_joint_def shoulder = joint(LKS_JOINT_BALL, fixed(0, -0.2, 0), fixed(0, 0.2, 0));
    shoulder.swing_limit = fixed(40);
    shoulder.twist_min = fixed(-20);
    shoulder.twist_max = fixed(20);
    scene.join(shoulder, bones[0], bones[1]);
    lks_joint_def elbow = joint(LKS_JOINT_HINGE, fixed(0, -0.2, 0), fixed(0, 0.2, 0));
    elbow.frame_a.rotation = elbow.frame_b.rotation = about(0, 0, 1, -90);
    elbow.twist_min = fixed(-90);
    elbow.twist_max = fixed(0);
    scene.join(elbow, bones[1], bones[2]);
}

} // namespace

TEST_CASE("a rod against a cone and both limits of its twist is within 1e-5 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_rod(scene, 30);
        check_run("cone" + substeps_name(substeps), scene, {1e-5, 2e-5, 10}, {1e-5, 4e-4, 50});
    }
}

// Along its edge it slides from bounce to bounce, and soon no two solvers are in the same one.
TEST_CASE("a rod against an ellipse is within 5e-6 m after a second, 5e-2 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_rod(scene, 60);
        check_run("ellipse" + substeps_name(substeps), scene, {5e-6, 2e-5, 30}, {5e-2, 0.15, 0.05});
    }
}

TEST_CASE("an arm that falls against the limit of a leaning hinge is within 5e-7 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_joint_def def = joint(LKS_JOINT_HINGE, {}, {});
        def.twist_min = fixed(-40);
        def.twist_max = fixed(25);
        add_arm(scene, def, 30);
        check_run("hinge with limits" + substeps_name(substeps), scene, {5e-7, 1e-6, 100}, {5e-7, 1e-6, 100});
    }
}

TEST_CASE("a limb with limits that is thrown on the ground is within 2e-5 m after 0.6 s") {
    // Later nothing can be: at 20 substeps the twin itself is 5 cm aside after a second if it starts one
    // nanometre aside.
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_limb(scene);
        check("limb" + substeps_name(substeps) + ", 0.6 s", scene.run({36}).back(), {2e-5, 2e-4, 50});
    }
}
