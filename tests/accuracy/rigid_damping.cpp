// How far bodies whose motion is damped, under more or less of gravity, get from the same method in double
// precision, and float32 beside it.
#include <doctest/doctest.h>

#include "reference/rigid_scenes.h"

using namespace support;
using namespace reference;

namespace {

lks_body_def damped(const lks_vec3& position, double linear, double angular) {
    lks_body_def def = at_rest(position);
    def.linear_damping = fixed(linear);
    def.angular_damping = fixed(angular);
    return def;
}

} // namespace

TEST_CASE("a damped box that spins under half of gravity is within 3e-7 m after a second, 3e-5 m after ten") {
    // A kept share is a multiple of 2^-31: over ten metres a second that is what it is off by.
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_body_def def = damped(fixed(0, 1, 0), 0.3, 0.1);
        def.gravity_factor = fixed(0.5);
        def.transform.rotation = about(1, 2, 3, 40);
        def.velocity = fixed(3, 6, -2);
        def.angular_velocity = fixed(0.3, 0.5, 6);
        scene.add(box_shape(0.1, 0.3, 0.2), def);
        check_run("damped box" + substeps_name(substeps), scene, {3e-7, 2e-6, 20}, {3e-5, 1e-4, 60});
    }
}

TEST_CASE("a damped body that gravity lifts is within 3e-6 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        lks_body_def def = damped(fixed(0, 1, 0), 2, 0);
        def.gravity_factor = fixed(-0.25);
        def.velocity = fixed(3, -6, -2);
        scene.add(ball_shape(0.2), def);
        check_run("lifted ball" + substeps_name(substeps), scene, {5e-7, 1e-9, 15}, {3e-6, 1e-9, 100});
    }
}

TEST_CASE("a damped pendulum is within 1e-5 m after ten seconds") {
    for (const int substeps : {8, 20}) {
        RigidScene scene(with_substeps(substeps));
        const std::size_t anchor = scene.add_anchor(fixed(0, 3, 0));
        lks_body_def def = damped(fixed(0.5, 3, 0), 0.2, 0.4);
        def.transform.rotation = about(0, 0, 1, 90);
        def.angular_velocity = fixed(2, 1, 0);
        const std::size_t rod = scene.add(capsule_shape(0.1, 0.4), def);
        scene.join(joint(LKS_JOINT_BALL, fixed(0, 0, 0), fixed(0, 0.5, 0)), anchor, rod);
        check_run("damped pendulum" + substeps_name(substeps), scene, {2e-6, 2e-5, 300}, {1e-5, 1e-4, 100});
    }
}
