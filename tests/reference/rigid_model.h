// What a reference solver of rigid bodies simulates: bodies and joints in plain numbers.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/numbers.h"

namespace reference {

struct Rotation {
    double x = 0, y = 0, z = 0, w = 1; // a unit quaternion
};

struct RigidBody {
    double mass = 0;         // 0: an anchor, which stays where it is
    support::Vector inertia; // about its own axes
    support::Vector position;
    Rotation orientation;
    support::Vector velocity;
    support::Vector spin; // in world axes
};

struct RigidJoint {
    std::uint32_t kind; // lks_joint_kind: ball, hinge or fixed
    std::size_t a, b;
    support::Vector point_a, point_b; // from the centres of mass, in the bodies' axes
    Rotation frame_a, frame_b;
};

// Joints form one tree and stand in its order, from the body of the lowest index on.
struct RigidModel {
    std::vector<RigidBody> bodies;
    std::vector<RigidJoint> joints;
};

// Of one shape with the body's own axes and centre. `mass` counts, whatever the density.
RigidBody rigid_body(const lks_body_def& def, const lks_body_shape& shape, double mass);
RigidJoint rigid_joint(const lks_joint_def& def, std::size_t a, std::size_t b);

} // namespace reference
