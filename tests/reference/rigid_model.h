// What a reference solver of rigid bodies simulates: bodies, joints and colliders in plain numbers.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/model.h"
#include "reference/rigid_mass.h"
#include "support/numbers.h"

namespace reference {

struct Rotation {
    double x = 0, y = 0, z = 0, w = 1; // a unit quaternion

    bool operator==(const Rotation&) const = default;
};

Rotation rotation_of(const lks_rotation& q);

struct RigidSurface {
    double static_friction = 0;
    double dynamic_friction = 0;
    double restitution = 0;
};

struct RigidShape {
    std::uint32_t kind; // lks_shape_kind
    double radius;      // 0: a box
    double half_length; // of a capsule, along y
    support::Vector half_extents;
    // Of a body: from its centre of mass, in its axes.
    support::Vector position{};
    Rotation orientation{};
};

// Of a ball about its own centre that contains it.
double radius_of(const RigidShape& shape);

struct RigidBody {
    double mass = 0;          // 0: kinematic, goes where it is led
    RigidInertia inertia;     // in its own axes
    support::Vector centre;   // of mass, in the frame that its shapes were given in
    support::Vector position; // of the centre of mass
    Rotation orientation;
    support::Vector velocity;
    support::Vector spin; // in world axes
    double gravity_factor = 1;
    double linear_damping = 0, angular_damping = 0; // 1/s
    std::vector<RigidShape> shapes;
    double radius = 0; // of a ball about the centre of mass with all shapes in it
    RigidSurface surface;
    bool touches_colliders = false;
    bool touches_bodies = false; // but those that a joint holds to it
};

struct RigidMotor {
    double max_torque = 0; // N·m; 0: off
    double response = 0;   // seconds
    Rotation target;       // b's frame in a's
};

struct RigidJoint {
    std::uint32_t kind; // lks_joint_kind
    std::size_t a, b;
    support::Vector point_a, point_b; // from the centres of mass, in the bodies' axes
    Rotation frame_a, frame_b;
    // Radians; π, and -π: none.
    double swing_limit, swing_limit_z;
    double twist_min, twist_max;
    double distance_min = 0, distance_max = 0;          // metres
    double compliance = 0, damping = 0;                 // of the points: m/N, N·s/m
    double angular_compliance = 0, angular_damping = 0; // rad/(N·m), N·m·s
    double limit_compliance = 0, limit_damping = 0;
    double friction = 0; // N·m
    RigidMotor motor;
};

struct RigidCollider {
    support::Vector position;
    Rotation orientation; // local y is a plane's normal
    RigidShape shape;
    RigidSurface surface;
};

// A particle that is held at a point of a body, or at one of another object.
struct RigidAttachment {
    std::size_t object, particle;
    bool to_body;
    std::size_t other; // body, or object
    std::size_t other_particle;
    support::Vector point; // from the body's centre of mass, in its axes
    double compliance, damping;
};

// Joints that form trees stand in their order, from the body of the lowest index on.
struct RigidModel {
    std::vector<RigidBody> bodies;
    std::vector<RigidJoint> joints;
    std::vector<RigidCollider> colliders;
    std::vector<Model> objects; // of particles, which only attachments touch
    std::vector<RigidAttachment> attachments;
};

// Which touches nothing. `mass` counts, whatever the densities.
RigidBody rigid_body(const lks_body_def& def, double mass);
// Of bodies whose frames are at their centres of mass.
RigidJoint rigid_joint(const lks_joint_def& def, std::size_t a, std::size_t b);
RigidMotor rigid_motor(const lks_motor& motor);
// Of a bone to its parent: bones that stand upright in the rest pose, each its own shape's middle.
lks_joint_def joint_of_bone(const lks_bone* bones, std::uint32_t bone);
RigidCollider rigid_collider(const lks_collider_def& def);

} // namespace reference
