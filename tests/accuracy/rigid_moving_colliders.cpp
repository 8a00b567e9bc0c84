// How far what moving colliders and kinematic bodies carry, push and lead gets from the same method in double
// precision, and float32 beside it: as in rigid_contacts.cpp, for as long as no threshold decides otherwise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/rigid_bounds.h"

using namespace support;
using namespace reference;

namespace {

lks_collider_def box_collider(const lks_vec3& half_extents, double friction = 0.5) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = half_extents;
    def.static_friction = def.dynamic_friction = fixed(friction);
    return def;
}

lks_transform place(const lks_vec3& position, const lks_rotation& rotation) {
    return {position, rotation};
}

// Of the end of a tick.
double seconds(int tick) {
    return (tick + 1) / double(second);
}

} // namespace

// Whether a substep's pushes are worth scaling is decided at a threshold: later a rounding may show.
TEST_CASE("a box that a platform carries is within 5e-8 m after a second, 2e-4 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_collider(box_collider(fixed(1, 0.1, 1)), true);
        lks_body_def def = with_friction(fixed(0.1, 0.2, 0.2));
        def.transform.rotation = about(0, 1, 0, 25);
        scene.add(box_shape(0.2, 0.1, 0.15), def);
        const auto swing = [](RigidScene& s, int tick) {
            const double t = seconds(tick);
            s.lead_collider(0, place(fixed(0.5 * (1 - std::cos(2 * t)), 0.1 * std::sin(3 * t), 0),
                                     about(0, 1, 0, 20 * std::sin(t))));
        };
        check_run("box on a platform" + substeps_name(substeps), scene, {5e-8, 2e-7, 50}, {2e-4, 5e-4, 0.5},
                  swing);
    }
}

TEST_CASE("a ball that is hit by a swinging paddle is within 1e-6 m after a second, 7e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_collider_def paddle = box_collider(fixed(0.05, 0.3, 0.2));
        paddle.restitution = fixed(0.5);
        paddle.transform.position = fixed(-0.3, 0.5, 0);
        scene.add_collider(paddle, true);
        scene.add(ball_shape(0.1), with_friction(fixed(0, 0.1, 0.03)));
        // About its upper end, until just after it has hit.
        const auto swing = [](RigidScene& s, int tick) {
            const double angle = std::min(3 * seconds(tick) - 0.8, 0.3);
            s.lead_collider(1, place(fixed(0.5 * std::sin(angle), 0.7 - 0.5 * std::cos(angle), 0),
                                     about(0, 0, 1, angle * 180 / std::acos(-1.0))));
        };
        check_run("ball hit by a paddle" + substeps_name(substeps), scene, {1e-6, 1e-5, 40},
                  {7e-6, 7e-5, 200}, swing);
    }
}

// Further in its first tick than contacts are looked for around what rests.
TEST_CASE("a ball that a piston strikes from rest is within 2e-6 m after a second, 2e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_collider_def piston = box_collider(fixed(0.1, 0.2, 0.2));
        piston.transform.position = fixed(-0.25, 0.2, 0);
        scene.add_collider(piston, true);
        scene.add(ball_shape(0.1), with_friction(fixed(0, 0.1, 0.03)));
        const auto strike = [](RigidScene& s, int tick) {
            const double way = 0.12 * std::min(tick + 1, 2);
            s.lead_collider(1, place(fixed(way - 0.25, 0.2, 0), lks_transform_identity().rotation));
        };
        check_run("ball struck by a piston" + substeps_name(substeps), scene, {2e-6, 4e-5, 500},
                  {2e-5, 3e-4, 200}, strike);
    }
}

TEST_CASE("a box that a kinematic body pushes is within 7e-6 m after a second, 1.2e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_body_shape hook = box_shape(0.15, 0.1, 0.05);
        hook.transform.position = fixed(0.25, 0, 0.25);
        lks_body_def def = with_friction(fixed(-0.5, 0.15, 0.05), 0.2);
        def.kind = LKS_BODY_KINEMATIC;
        // Led by its frame, which is not its centre of mass.
        const std::size_t pusher = scene.add({box_shape(0.1, 0.1, 0.2), hook}, def);
        scene.add(box_shape(0.2, 0.15, 0.15), with_friction(fixed(0, 0.15, 0)));
        const auto push = [pusher](RigidScene& s, int tick) {
            const double t = std::min(seconds(tick), 2.0);
            s.lead_body(pusher, place(fixed(-0.5 + 0.3 * t * t, 0.15, 0.05), about(0, 1, 0, 5 * t)));
        };
        check_run("box that is pushed" + substeps_name(substeps), scene, {7e-6, 2e-5, 4}, {1.2e-5, 6e-5, 100},
                  push);
    }
}

TEST_CASE("a chain that a kinematic hand leads is within 4e-7 m after a second, 1.5e-6 m after three") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t hand = scene.add_anchor(fixed(0, 3, 0));
        std::size_t above = hand;
        for (int i = 0; i < 3; ++i) {
            const std::size_t link =
                scene.add(capsule_shape(0.05, 0.15), at_rest(fixed(0, 2.8 - 0.4 * i, 0)));
            scene.join(joint(i == 1 ? LKS_JOINT_HINGE : LKS_JOINT_BALL, fixed(0, i == 0 ? 0 : -0.2, 0),
                             fixed(0, 0.2, 0)),
                       above, link);
            above = link;
        }
        const auto lead = [hand](RigidScene& s, int tick) {
            const double t = seconds(tick);
            s.lead_body(
                hand, place(fixed(0.3 * (1 - std::cos(3 * t)), 3 + 0.1 * std::sin(2 * t), 0.2 * std::sin(t)),
                            about(0.2, 1, 0, 30 * std::sin(2 * t))));
        };
        const std::vector<RigidDeviation> d = scene.run({second, 3 * second}, lead);
        check("led chain" + substeps_name(substeps) + ", 1 s", d[0], {4e-7, 1e-4, 500});
        check("led chain" + substeps_name(substeps) + ", 3 s", d[1], {1.5e-6, 6e-4, 1500});
    }
}

TEST_CASE("a capsule on a ground that rises and tilts is within 6e-7 m after a second, 5e-5 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_body_def def = with_friction(fixed(0, 0.11, 0));
        def.transform.rotation = about(0.1, 0.3, 1, 80);
        scene.add(capsule_shape(0.1, 0.2), def);
        const auto tilt = [](RigidScene& s, int tick) {
            const double t = seconds(tick);
            s.lead_collider(0,
                            place(fixed(0, 0.2 * std::sin(2 * t), 0), about(0.3, 0, 1, -10 * std::sin(t))));
        };
        check_run("capsule on a tilting ground" + substeps_name(substeps), scene, {6e-7, 7e-6, 10},
                  {5e-5, 5e-4, 50}, tilt);
    }
}

TEST_CASE("an L that a turntable throws off is within 6e-8 m after a second, 2e-7 m after two") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_collider_def table = box_collider(fixed(0.6, 0.05, 0.6));
        table.transform.position = fixed(0, 0.4, 0);
        scene.add_collider(table, true);
        lks_body_shape arm = box_shape(0.05, 0.15, 0.08);
        arm.transform.position = fixed(-0.15, 0.2, 0.02);
        scene.add({box_shape(0.2, 0.05, 0.1), arm}, with_friction(fixed(0.25, 0.5, 0)));
        const auto turn = [](RigidScene& s, int tick) {
            const double t = seconds(tick);
            s.lead_collider(1, place(fixed(0, 0.4, 0), about(0, 1, 0, 90 * t * t)));
        };
        const std::vector<RigidDeviation> d = scene.run({second, 2 * second}, turn);
        check("L on a turntable" + substeps_name(substeps) + ", 1 s", d[0], {6e-8, 3e-7, 30});
        check("L on a turntable" + substeps_name(substeps) + ", 2 s", d[1], {2e-7, 2e-6, 80});
    }
}
