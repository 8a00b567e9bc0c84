// What bodies, joints and contacts are made of, once for writing, reading and hashing.
//
// Io has u32(value), i64(value) and turns them into bytes, or bytes into them.
#pragma once

#include "rigid/make_body.h"
#include "rigid/rigid_scene.h"
#include "state/field_io.h"

namespace lks {

template <typename Io>
void quaternion_fields(Io& io, Quaternion& q) {
    io.i64(q.x);
    io.i64(q.y);
    io.i64(q.z);
    io.i64(q.w);
}

template <typename Io>
void record_fields(Io& io, BodySettings& settings) {
    io.i64(settings.mass);
    io.i64(settings.gravity_factor);
    io.i64(settings.linear_damping);
    io.i64(settings.angular_damping);
    io.i64(settings.static_friction);
    io.i64(settings.dynamic_friction);
    io.i64(settings.restitution);
    io.u32(settings.filter.category);
    io.u32(settings.filter.mask);
    io.i32(settings.filter.group);
    io.u32(settings.never_sleeps);
}

template <typename Io>
void record_fields(Io& io, lks_body_shape& shape) {
    io.u32(shape.shape);
    io.u32(shape.reserved);
    vector_fields(io, shape.transform.position);
    rotation_fields(io, shape.transform.rotation);
    io.i64(shape.radius);
    io.i64(shape.half_length);
    vector_fields(io, shape.half_extents);
    io.i64(shape.density);
}

// How it is turned, how it moves, and its sleep.
template <typename Io>
void body_motion_fields(Io& io, BodyState& body) {
    quaternion_fields(io, body.orientation);
    quaternion_fields(io, body.target_orientation);
    vector_fields(io, body.velocity);
    vector_fields(io, body.angular_velocity);
    quaternion_fields(io, body.rest_orientation);
    io.u32(body.rest);
    std::uint32_t sleep = body.asleep | std::uint32_t{body.gathers} << 8 | std::uint32_t{body.turns} << 16 |
                          std::uint32_t{body.steady} << 24;
    io.u32(sleep);
    body.asleep = static_cast<std::uint8_t>(sleep);
    body.gathers = static_cast<std::uint8_t>(sleep >> 8);
    body.turns = static_cast<std::uint8_t>(sleep >> 16);
    body.steady = static_cast<std::uint8_t>(sleep >> 24);
}

template <typename Io>
void record_fields(Io& io, BodyState& body) {
    vector_fields(io, body.position);
    vector_fields(io, body.target_position);
    vector_fields(io, body.rest_position);
    body_motion_fields(io, body);
}

// But for soft limits.
template <typename Io>
void joint_fields(Io& io, JointDescription& d) {
    io.u32(d.kind);
    io.u32(d.body_a);
    io.u32(d.body_b);
    io.u32(d.bodies_collide);
    vector_fields(io, d.point_a);
    vector_fields(io, d.point_b);
    rotation_fields(io, d.frame_a);
    rotation_fields(io, d.frame_b);
    io.i64(d.swing_limit);
    io.i64(d.swing_limit_z);
    io.i64(d.twist_min);
    io.i64(d.twist_max);
    io.i64(d.distance_min);
    io.i64(d.distance_max);
    io.i64(d.compliance);
    io.i64(d.damping);
    io.i64(d.angular_compliance);
    io.i64(d.angular_damping);
    io.i64(d.friction);
    io.i64(d.break_force);
    io.i64(d.break_torque);
    io.i64(d.motor_torque);
    io.i64(d.motor_response);
}

template <typename Io>
void record_fields(Io& io, JointDescription& d) {
    joint_fields(io, d);
    io.i64(d.limits.compliance);
    io.i64(d.limits.damping);
}

template <typename Io>
void record_fields(Io& io, fixed::Rotation& rotation) {
    rotation_fields(io, rotation);
}

template <typename Io>
void record_fields(Io& io, JointState& joint) {
    record_fields(io, joint.motor_target);
    vector_fields(io, joint.push);
    vector_fields(io, joint.turn);
    vector_fields(io, joint.grip);
    io.i64(joint.swing_push);
    io.i64(joint.twist_push);
    vector_fields(io, joint.pushed);
    vector_fields(io, joint.turned);
}

template <typename Io>
void attachment_fields(Io& io, Attachment& attachment) {
    AttachmentDescription& d = attachment.description;
    io.u32(d.kind);
    io.u32(d.object);
    io.u32(d.particle);
    io.u32(d.other);
    io.u32(d.other_particle);
    io.u32(d.reserved);
    vector_fields(io, d.point);
    io.i64(d.compliance);
    io.i64(d.damping);
    io.i64(d.break_force);
    vector_fields(io, attachment.pushed);
}

template <typename Io>
void record_fields(Io& io, ContactPush& push) {
    io.u32(push.feature);
    io.u32(push.reserved);
    vector_fields(io, push.place);
    io.i64(push.normal);
    io.i64(push.across[0]);
    io.i64(push.across[1]);
}

// All of it but what it pushed.
template <typename Io, typename Memory>
void contact_fields(Io& io, Memory& memory) {
    io.u32(memory.key.body_a);
    io.u32(memory.key.other);
    io.u32(memory.key.shapes);
    io.u32(memory.count);
    io.i32(memory.normal.x);
    io.i32(memory.normal.y);
    io.i32(memory.normal.z);
    io.u32(memory.forgotten);
}

template <typename Io>
void record_fields(Io& io, ContactMemory& memory) {
    contact_fields(io, memory);
    for (ContactPush& push : memory.pushes) {
        record_fields(io, push);
    }
}

} // namespace lks
