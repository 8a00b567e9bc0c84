// How far bodies of several shapes get from the same method in double precision, and float32 beside it: as in
// rigid_contacts.cpp, for as long as no threshold decides otherwise.
#include <doctest/doctest.h>

#include <vector>

#include "reference/rigid_bounds.h"

using namespace support;
using namespace reference;

namespace {

lks_body_shape at(lks_body_shape shape, const lks_vec3& position) {
    shape.transform.position = position;
    return shape;
}

// An arm along x, and one along y at its end: neither's middle is the body's, and no axis is the inertia's.
std::vector<lks_body_shape> l_shape() {
    return {at(box_shape(0.2, 0.05, 0.1), fixed(0.2, 0, 0)),
            at(box_shape(0.05, 0.15, 0.08), fixed(0.05, 0.2, 0.02))};
}

// Two balls on a bar along x; the lesser one is denser.
std::vector<lks_body_shape> dumbbell(double density = 1000) {
    lks_body_shape bar = capsule_shape(0.04, 0.2, density);
    bar.transform.rotation = about(0, 0, 1, 90);
    return {at(ball_shape(0.12, density), fixed(-0.25, 0, 0)), bar,
            at(ball_shape(0.1, 1.5 * density), fixed(0.25, 0, 0))};
}

} // namespace

TEST_CASE("an L of two boxes in flight is within 3e-9 m after a second, 3e-8 m and 2e-4 rad after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_body_def def = at_rest(fixed(0, 1, 0));
        def.transform.rotation = about(1, 2, 3, 40);
        def.velocity = fixed(3, 6, -2);
        def.angular_velocity = fixed(2, 5, 3);
        scene.add(l_shape(), def);
        check_run("L in flight" + substeps_name(substeps), scene, {3e-9, 2e-6, 3e4}, {3e-8, 2e-4, 3e5});
    }
}

TEST_CASE("an L that swings on a ball joint is within 2e-7 m after a second, 2e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
        lks_body_def def = at_rest(fixed(-0.05, 2.65, -0.02));
        const std::size_t l = scene.add(l_shape(), def);
        scene.join(joint(LKS_JOINT_BALL, {}, fixed(0.05, 0.35, 0.02)), anchor, l);
        check_run("hanging L" + substeps_name(substeps), scene, {2e-7, 2e-5, 300}, {2e-6, 8e-5, 300});
    }
}

TEST_CASE("an L of two boxes that tumbles on a plane until it lies is within 1e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        lks_body_def def = with_friction(fixed(0, 0.6, 0));
        def.transform.rotation = about(1, 2, 3, 40);
        def.velocity = fixed(1, 0, 0);
        def.angular_velocity = fixed(0.5, 1, -1);
        scene.add(l_shape(), def);
        check_run("tumbling L" + substeps_name(substeps), scene, {1e-6, 4e-6, 10}, {1e-6, 4e-6, 10});
    }
}

TEST_CASE(
    "a dumbbell that falls on a slope and rolls down is within 1e-5 m after a second, 6e-5 m after three") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true, about(0, 0, 1, -10));
        lks_body_def def = with_friction(fixed(0, 0.2, 0));
        def.transform.rotation = about(0, 1, 0, 75);
        scene.add(dumbbell(), def);
        const std::vector<RigidDeviation> d = scene.run({second, 3 * second});
        check("dumbbell on a slope" + substeps_name(substeps) + ", 1 s", d[0], {1e-5, 1e-4, 10});
        check("dumbbell on a slope" + substeps_name(substeps) + ", 3 s", d[1], {6e-5, 5e-4, 30});
    }
}

// It hangs by its short arm, the ball in its corner.
TEST_CASE("an L that is caught on a ball is within 5e-7 m after a second, 4e-6 m after ten") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_collider_def ball = lks_default_collider_def();
        ball.radius = fixed(0.02);
        ball.static_friction = ball.dynamic_friction = fixed(0.5);
        scene.add_collider(ball, true);
        lks_body_def def = with_friction(fixed(-0.075, 0.13, 0));
        def.transform.rotation = about(0, 0, 1, -90);
        const std::size_t l = scene.add(l_shape(), def);
        check_run("L on a ball" + substeps_name(substeps), scene, {5e-7, 4e-5, 20}, {4e-6, 4e-4, 20});
        CHECK(state_of(scene.world(), scene.id(l)).position.y > 0.1);
    }
}

// Its bar comes to lie over an edge a few substeps sooner or later than the twin's after that.
TEST_CASE("a dumbbell that falls across an L is within 1e-6 m after 0.4 s, with 20 substeps 0.2") {
    for (const int substeps : {8, 20}) {
        const int ticks = substeps == 8 ? 24 : 12;
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        scene.add(l_shape(), with_friction(fixed(0, 0.05, 0)));
        lks_body_def def = with_friction(fixed(0.12, 0.5, 0));
        def.transform.rotation = about(0.1, 1, 0.2, 70);
        scene.add(dumbbell(), def);
        check("dumbbell on an L" + substeps_name(substeps), scene.run({ticks}).back(), {1e-6, 1e-5, 5});
    }
}

// Both of its balls push the same body, and what is carried on of that is one push. It is let go low: what
// strikes the board fast enough to carry it by its thickness is looked at in each substep (rigid/strikes.h),
// by the twin once a tick.
TEST_CASE("a heavy dumbbell that falls on a loose board is within 1.5e-6 m after 0.7 s") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        scene.add_ground(0.5, 0.5, true);
        scene.add(box_shape(0.5, 0.03, 0.3), with_friction(fixed(0, 0.03, 0)));
        lks_body_def def = with_friction(fixed(0.03, 0.23, 0.02));
        def.transform.rotation = about(0.1, 0.2, 1, 6);
        scene.add(dumbbell(5000), def);
        check("dumbbell on a board" + substeps_name(substeps) + ", 0.7 s", scene.run({42}).back(),
              {1.5e-6, 1e-5, 3});
    }
}
