#include "reference/rigid_model.h"

#include <algorithm>
#include <cmath>

#include "reference/rigid_numbers.h"

namespace reference {
namespace {

using support::Vector;

// Of a body's shape or of a collider.
template <typename Definition>
RigidShape shape_of(const Definition& shape) {
    const bool box = shape.shape == LKS_SHAPE_BOX;
    const bool round = shape.shape == LKS_SHAPE_SPHERE || shape.shape == LKS_SHAPE_CAPSULE;
    return {shape.shape, round ? support::metres(shape.radius) : 0,
            shape.shape == LKS_SHAPE_CAPSULE ? support::metres(shape.half_length) : 0,
            box ? support::metres(shape.half_extents) : Vector{}};
}

double radians(lks_fixed degrees) {
    return support::metres(degrees) * (std::acos(-1.0) / 180);
}

} // namespace

Rotation rotation_of(const lks_rotation& q) {
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    return {x / length, y / length, z / length, w / length};
}

double radius_of(const RigidShape& shape) {
    return shape.kind == LKS_SHAPE_BOX ? shape.half_extents.length() : shape.radius + shape.half_length;
}

RigidBody rigid_body(const lks_body_def& def, double mass) {
    const RigidMass own = rigid_mass(def.shapes, def.shape_count);
    RigidBody body;
    body.centre = own.centre;
    body.orientation = rotation_of(def.transform.rotation);
    body.position =
        support::metres(def.transform.position) +
        (quaternion_of<double>(body.orientation).matrix() * Vector3<double>(own.centre)).widened();
    for (std::uint32_t i = 0; i < def.shape_count; ++i) {
        RigidShape shape = shape_of(def.shapes[i]);
        shape.position = support::metres(def.shapes[i].transform.position) - own.centre;
        shape.orientation = rotation_of(def.shapes[i].transform.rotation);
        body.radius = std::max(body.radius, shape.position.length() + radius_of(shape));
        body.shapes.push_back(shape);
    }
    body.surface = {support::metres(def.static_friction), support::metres(def.dynamic_friction),
                    support::metres(def.restitution)};
    if (def.kind == LKS_BODY_DYNAMIC) {
        body.mass = mass;
        body.inertia = own.inertia * mass;
        body.gravity_factor = support::metres(def.gravity_factor);
        body.linear_damping = support::metres(def.linear_damping);
        body.angular_damping = support::metres(def.angular_damping);
        body.velocity = support::metres(def.velocity);
        body.spin = support::metres(def.angular_velocity);
    }
    return body;
}

RigidJoint rigid_joint(const lks_joint_def& def, std::size_t a, std::size_t b) {
    return {def.kind,
            a,
            b,
            support::metres(def.frame_a.position),
            support::metres(def.frame_b.position),
            rotation_of(def.frame_a.rotation),
            rotation_of(def.frame_b.rotation),
            radians(def.swing_limit),
            radians(def.swing_limit_z < 0 ? def.swing_limit : def.swing_limit_z),
            radians(def.twist_min),
            radians(def.twist_max),
            support::metres(def.distance_min),
            support::metres(def.distance_max),
            support::metres(def.compliance),
            support::metres(def.damping),
            support::metres(def.angular_compliance),
            support::metres(def.angular_damping),
            support::metres(def.limit_compliance),
            support::metres(def.limit_damping),
            support::metres(def.friction),
            {}};
}

RigidMotor rigid_motor(const lks_motor& motor) {
    return {support::metres(motor.max_torque), support::metres(motor.response), rotation_of(motor.target)};
}

lks_joint_def joint_of_bone(const lks_bone* bones, std::uint32_t bone) {
    const lks_bone& child = bones[bone];
    const lks_bone& parent = bones[child.parent];
    const auto subtract = [](const lks_vec3& a, const lks_vec3& b) {
        return lks_vec3{a.x - b.x, a.y - b.y, a.z - b.z};
    };
    lks_joint_def def = lks_default_joint_def();
    def.kind = child.joint_kind;
    def.frame_a = def.frame_b = child.joint_frame;
    def.frame_a.position = subtract(child.joint_frame.position, parent.body.transform.position);
    def.frame_b.position = subtract(child.joint_frame.position, child.body.transform.position);
    def.frame_b.rotation = support::product(child.joint_frame.rotation, child.joint_rest);
    def.swing_limit = child.swing_limit;
    def.swing_limit_z = child.swing_limit_z;
    def.twist_min = child.twist_min;
    def.twist_max = child.twist_max;
    return def;
}

RigidCollider rigid_collider(const lks_collider_def& def) {
    return {support::metres(def.transform.position),
            rotation_of(def.transform.rotation),
            shape_of(def),
            {support::metres(def.static_friction), support::metres(def.dynamic_friction),
             support::metres(def.restitution)}};
}

} // namespace reference
