// Small scenes that several tests of the rigid solvers have in common; what their joints are is the test's.
#pragma once

#include <cstddef>

#include "reference/rigid_bounds.h"

namespace reference {

// A board held at one end, level along x; the joint's axis leans by so much.
inline void add_arm(RigidScene& scene, lks_joint_def def, double degrees) {
    const std::size_t anchor = scene.add_anchor(support::fixed(0, 3, 0));
    const std::size_t arm = scene.add(support::box_shape(0.5, 0.1, 0.05), at_rest(support::fixed(0.5, 3, 0)));
    def.frame_b.position = support::fixed(-0.5, 0, 0);
    def.frame_a.rotation = def.frame_b.rotation = support::about(1, 0, 0, 90 - degrees);
    scene.join(def, anchor, arm);
}

// Hangs on a ball joint, and is pushed against whatever limits it has.
inline void add_rod(RigidScene& scene, lks_joint_def def) {
    const std::size_t anchor = scene.add_anchor(support::fixed(0, 3, 0));
    lks_body_def body = at_rest(support::fixed(0, 2.5, 0));
    body.angular_velocity = support::fixed(3, 2, 4);
    body.velocity = support::fixed(2, 0, -1.5);
    const std::size_t rod = scene.add(support::capsule_shape(0.1, 0.4), body);
    def.frame_b.position = support::fixed(0, 0.5, 0);
    scene.join(def, anchor, rod);
}

// Level along x on an anchor and released, on ball joints that take turns.
inline void add_chain(RigidScene& scene, int links, const lks_joint_def& even, const lks_joint_def& odd,
                      double end_mass = 1) {
    std::size_t above = scene.add_anchor(support::fixed(0, 5, 0));
    for (int i = 0; i < links; ++i) {
        lks_body_def body = at_rest(support::fixed(0.1 + 0.2 * i, 5, 0));
        body.transform.rotation = support::about(0, 0, 1, 90);
        body.mass = support::fixed(i == links - 1 ? end_mass : 1);
        const std::size_t link = scene.add(support::capsule_shape(0.03, 0.08), body);
        lks_joint_def def = i % 2 == 0 ? even : odd;
        def.frame_a.position = support::fixed(0, i == 0 ? 0 : -0.1, 0);
        def.frame_b.position = support::fixed(0, 0.1, 0);
        scene.join(def, above, link);
        above = link;
    }
}

// Two capsules in flight, the upper one so heavy, and thrown so.
inline void add_pair(RigidScene& scene, lks_joint_def def, double mass, const lks_vec3& velocity,
                     const lks_vec3& spin) {
    lks_body_def body = at_rest(support::fixed(0, 3, 0));
    body.velocity = support::fixed(1, 5, 2);
    body.angular_velocity = support::fixed(0, 0, 2);
    body.mass = support::fixed(1);
    const std::size_t light = scene.add(support::capsule_shape(0.1, 0.2), body);
    body.transform.position = support::fixed(0, 3.7, 0);
    body.velocity = velocity;
    body.angular_velocity = spin;
    body.mass = support::fixed(mass);
    const std::size_t heavy = scene.add(support::capsule_shape(0.1, 0.3), body);
    def.frame_a.position = support::fixed(0, 0.3, 0);
    def.frame_b.position = support::fixed(0, -0.4, 0);
    scene.join(def, light, heavy);
}

} // namespace reference
