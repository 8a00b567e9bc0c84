// How far boxes, capsules and balls that touch boxes and each other get from the same method in double
// precision, and float32 beside it: as in rigid_contacts.cpp, for as long as no threshold decides otherwise.
#include <doctest/doctest.h>

#include "reference/rigid_bounds.h"

using namespace support;
using namespace reference;

namespace {

// A stair of 17 cm above the ground, whose edge lies along z at x = 0.
void add_step(RigidScene& scene, double friction = 0.5) {
    scene.add_ground(friction, friction, true);
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = fixed(0.5, 0.085, 1);
    def.transform.position = fixed(-0.5, 0.085, 0);
    def.static_friction = def.dynamic_friction = fixed(friction);
    scene.add_collider(def, true);
}

} // namespace

TEST_CASE("a ball that rolls off a step is within 3e-7 m after a second, 1e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_step(scene);
        lks_body_def def = with_friction(fixed(-0.4, 0.3, 0.02));
        def.velocity = fixed(0.8, 0, 0.1);
        scene.add(ball_shape(0.1), def);
        check_run("ball off a step" + substeps_name(substeps), scene, {3e-7, 2e-6, 300}, {1e-5, 8e-5, 50});
    }
}

TEST_CASE("a capsule that falls on the edge of a step is within 4e-5 m after a second, 1e-3 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        add_step(scene);
        lks_body_def def = with_friction(fixed(0.05, 0.45, 0));
        def.transform.rotation = about(0.2, 0.3, 1, 70);
        scene.add(capsule_shape(0.06, 0.15), def);
        check_run("capsule on an edge" + substeps_name(substeps), scene, {4e-5, 6e-4, 2}, {1e-3, 4e-3, 10});
    }
}

TEST_CASE(
    "boxes that are set down on a step or slide off it are within 4e-5 m after a second, 1e-4 m after ten") {
    for (const int substeps : {8, 20}) {
        {
            RigidScene scene(with_substeps(substeps));
            add_step(scene);
            lks_body_def def = with_friction(fixed(-0.3, 0.28, 0));
            def.transform.rotation = about(0.3, 1, 0.2, 20);
            scene.add(box_shape(0.1, 0.08, 0.15), def);
            check_run("box set on a step" + substeps_name(substeps), scene, {2e-7, 2e-6, 30},
                      {8e-7, 8e-6, 8});
        }
        {
            RigidScene scene(with_substeps(substeps));
            add_step(scene, 0.1);
            lks_body_def def = with_friction(fixed(-0.3, 0.27, 0), 0.1);
            def.transform.rotation = about(0, 1, 0, 20);
            def.velocity = fixed(1.5, 0, 0.1);
            scene.add(box_shape(0.1, 0.08, 0.15), def);
            check_run("box off a step" + substeps_name(substeps), scene, {4e-5, 8e-5, 8}, {1e-4, 1e-4, 30});
        }
    }
}

TEST_CASE("a box that slides on another one is within 4e-8 m after a second, 1e-7 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        scene.add(box_shape(0.2, 0.1, 0.2), with_friction(fixed(0, 0.1, 0)));
        lks_body_def def = with_friction(fixed(0.05, 0.29, 0.02));
        def.transform.rotation = about(0, 1, 0, 25);
        def.velocity = fixed(0.3, 0, 0);
        scene.add(box_shape(0.1, 0.08, 0.15), def);
        check_run("box on a box" + substeps_name(substeps), scene, {4e-8, 4e-7, 50}, {1e-7, 6e-7, 40});
    }
}

TEST_CASE("a capsule that falls across another one is within 3e-5 m after a second, 3e-3 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_body_def def = with_friction(fixed(0, 0.1, 0));
        def.transform.rotation = about(1, 0, 0, 90);
        scene.add(capsule_shape(0.1, 0.3), def);
        def.transform.position = fixed(0.04, 0.45, 0.1);
        def.transform.rotation = about(0, 0.1, 1, 80);
        scene.add(capsule_shape(0.06, 0.2), def);
        check_run("crossed capsules" + substeps_name(substeps), scene, {3e-5, 5e-4, 5}, {3e-3, 5e-2, 2});
    }
}

TEST_CASE("a capsule and a ball that fall on a box are within 3e-6 m after a second, 6e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        scene.add(box_shape(0.3, 0.1, 0.3), with_friction(fixed(0, 0.1, 0)));
        lks_body_def def = with_friction(fixed(-0.1, 0.4, 0));
        def.transform.rotation = about(0.1, 0.3, 1, 80);
        scene.add(capsule_shape(0.06, 0.15), def);
        scene.add(ball_shape(0.08), with_friction(fixed(0.2, 0.4, 0.1)));
        check_run("capsule and ball on a box" + substeps_name(substeps), scene, {3e-6, 5e-5, 25},
                  {6e-5, 8e-4, 30});
    }
}

TEST_CASE("a capsule thrown at a thin wall at 60 m/s is within 4e-5 m after half a second") {
    // Further than it is thick in a tick: it is looked at in each substep, and keeps its side.
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_collider_def wall = lks_default_collider_def();
        wall.shape = LKS_SHAPE_BOX;
        wall.half_extents = fixed(0.025, 2, 2);
        wall.transform.position = fixed(1, 0, 0);
        scene.add_collider(wall, true);
        lks_body_def def = with_friction(fixed(-0.2, 0.1, 0));
        def.transform.rotation = about(0.2, 0.3, 1, 70);
        def.velocity = fixed(60, 2, 1);
        scene.add(capsule_shape(0.05, 0.2), def);
        check("capsule at a wall" + substeps_name(substeps), scene.run({30}).back(), {4e-5, 2e-4, 1.5});
    }
}

// Later, at 20 substeps, it is chance: after 0.3 s fixed-point and float32 are half a centimetre aside.
TEST_CASE(
    "a figure that stumbles over a stair is within 2e-5 m after 0.3 s, with 20 substeps 1e-4 after 0.2") {
    for (const int substeps : {5, 8, 20}) {
        const bool fine = substeps == 20;
        RigidScene scene(with_substeps(substeps));
        add_step(scene);
        const Humanoid humanoid;
        for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
            lks_body_def def = humanoid.bones[i].body;
            def.transform.position = def.transform.position + fixed(-0.3, 0.25, 0);
            def.velocity = fixed(1.5, 0, 0.1);
            scene.add(humanoid.shapes[i], def);
            if (i > 0) {
                scene.join(joint_of_bone(humanoid.bones, i), humanoid.bones[i].parent, i);
            }
        }
        check("figure on a stair" + substeps_name(substeps), scene.run({fine ? 12 : 18}).back(),
              fine ? RigidBounds{1e-4, 1e-3, 3} : RigidBounds{2e-5, 3e-4, 3});
    }
}
