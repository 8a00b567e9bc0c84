#include "reference/rigid_model.h"

#include <cmath>

namespace reference {
namespace {

using support::Vector;

Rotation rotation_of(const lks_rotation& q) {
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    return {x / length, y / length, z / length, w / length};
}

// Of one kilogram.
Vector inertia_of(const lks_body_shape& shape) {
    const double r = support::metres(shape.radius);
    const double ball = 2 * r * r / 5;
    if (shape.shape == LKS_SHAPE_SPHERE) {
        return {ball, ball, ball};
    }
    if (shape.shape == LKS_SHAPE_CAPSULE) {
        const double h = support::metres(shape.half_length);
        const double cylinder = 3 * h / (3 * h + 2 * r); // its share of the mass
        const double ends = 1 - cylinder;
        const double across = cylinder * (r * r / 4 + h * h / 3) + ends * (ball + h * h + 3 * h * r / 4);
        return {across, cylinder * r * r / 2 + ends * ball, across};
    }
    const Vector e = support::metres(shape.half_extents);
    return {(e.y * e.y + e.z * e.z) / 3, (e.z * e.z + e.x * e.x) / 3, (e.x * e.x + e.y * e.y) / 3};
}

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

RigidBody rigid_body(const lks_body_def& def, const lks_body_shape& shape, double mass) {
    RigidBody body;
    body.position = support::metres(def.transform.position);
    body.orientation = rotation_of(def.transform.rotation);
    body.shape = shape_of(shape);
    body.surface = {support::metres(def.static_friction), support::metres(def.dynamic_friction),
                    support::metres(def.restitution)};
    if (def.kind == LKS_BODY_DYNAMIC) {
        body.mass = mass;
        body.inertia = inertia_of(shape) * mass;
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
