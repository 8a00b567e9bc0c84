// Bodies and joints in one line each.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>

#include "support/handles.h"

namespace support {

inline lks_body_shape ball_shape(double radius, double density = 1000) {
    lks_body_shape shape = lks_default_body_shape();
    shape.radius = fixed(radius);
    shape.density = fixed(density);
    return shape;
}

inline lks_body_shape capsule_shape(double radius, double half_length, double density = 1000) {
    lks_body_shape shape = ball_shape(radius, density);
    shape.shape = LKS_SHAPE_CAPSULE;
    shape.half_length = fixed(half_length);
    return shape;
}

inline lks_body_shape box_shape(double x, double y, double z, double density = 1000) {
    lks_body_shape shape = ball_shape(0.5, density);
    shape.shape = LKS_SHAPE_BOX;
    shape.half_extents = fixed(x, y, z);
    return shape;
}

inline lks_rotation about(double x, double y, double z, double degrees) {
    lks_rotation rotation{};
    REQUIRE(lks_rotation_from_axis_angle(x, y, z, degrees, &rotation) == LKS_OK);
    return rotation;
}

inline lks_body_id add_body(const World& world, const lks_body_shape& shape, const lks_vec3& position,
                            lks_body_def def = lks_default_body_def()) {
    def.shapes = &shape;
    def.shape_count = 1;
    def.transform.position = position;
    lks_body_id id{};
    const lks_result result = lks_world_add_body(world, &def, &id);
    INFO(world.message());
    REQUIRE(result == LKS_OK);
    return id;
}

inline lks_body_id add_anchor(const World& world, const lks_vec3& position) {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    def.filter.mask = 0;
    return add_body(world, ball_shape(0.05), position, def);
}

inline lks_joint_id add_joint(const World& world, lks_joint_def def, lks_body_id a, lks_body_id b) {
    def.body_a = a;
    def.body_b = b;
    lks_joint_id id{};
    const lks_result result = lks_world_add_joint(world, &def, &id);
    INFO(world.message());
    REQUIRE(result == LKS_OK);
    return id;
}

// A figure of lockstitch/ragdoll.h, for tests that put it somewhere or break it.
template <std::uint32_t bone_count, lks_result (*describe)(lks_bone*, lks_body_shape*)>
struct ReadyFigure {
    ReadyFigure() {
        REQUIRE(describe(bones, shapes) == LKS_OK);
        def.bones = bones;
        def.bone_count = bone_count;
    }
    ReadyFigure(const ReadyFigure&) = delete;
    ReadyFigure& operator=(const ReadyFigure&) = delete;

    lks_result add(const World& world, lks_body_id* ids = nullptr, lks_joint_id* joints = nullptr) const {
        lks_body_id bodies[bone_count];
        return lks_world_add_ragdoll(world, &def, ids == nullptr ? bodies : ids, joints);
    }

    // What is attached to it pulls, and touches nothing.
    void let_particles_through() {
        for (lks_bone& bone : bones) {
            bone.body.filter.mask &= ~LKS_CATEGORY_PARTICLES;
        }
    }

    lks_bone bones[bone_count];
    lks_body_shape shapes[bone_count];
    lks_ragdoll_def def = lks_default_ragdoll_def();
};
using Humanoid = ReadyFigure<LKS_HUMANOID_BONES, lks_humanoid>;
using Spider = ReadyFigure<LKS_SPIDER_BONES, lks_spider>;

inline void add_ground(World& world, double friction = 0.5, const lks_rotation* rotation = nullptr) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_PLANE;
    def.static_friction = fixed(friction);
    def.dynamic_friction = fixed(friction);
    if (rotation != nullptr) {
        def.transform.rotation = *rotation;
    }
    world.add(def);
}

inline void add_box(World& world, const lks_vec3& half, const lks_vec3& position) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = half;
    def.transform.position = position;
    world.add(def);
}

struct BodyState {
    Vector position;
    Vector velocity;
    Vector spin;
    lks_rotation rotation;
};

inline BodyState state_of(const World& world, lks_body_id body) {
    lks_transform transform{};
    lks_vec3 velocity{};
    lks_vec3 spin{};
    REQUIRE(lks_body_transform(world, body, &transform) == LKS_OK);
    REQUIRE(lks_body_velocity(world, body, &velocity, &spin) == LKS_OK);
    return {metres(transform.position), metres(velocity), metres(spin), transform.rotation};
}

inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// World axes from a body's.
inline Vector rotate(const lks_rotation& q, const Vector& v) {
    const Vector u = Vector{double(q.x), double(q.y), double(q.z)} * 0x1p-30;
    const double w = q.w * 0x1p-30;
    const Vector t = cross(u, v) * 2;
    return v + t * w + cross(u, t);
}

// Of a unit: the way back.
inline lks_rotation conjugate(const lks_rotation& q) {
    return {-q.x, -q.y, -q.z, q.w};
}

inline double mass_of(const World& world, lks_body_id body) {
    lks_fixed mass = 0;
    REQUIRE(lks_body_mass(world, body, &mass) == LKS_OK);
    return metres(mass);
}

inline double error_of(const lks_world* world, lks_joint_id joint) {
    lks_fixed error = 0;
    REQUIRE(lks_joint_error(world, joint, &error) == LKS_OK);
    return metres(error);
}

// Degrees by which a bone's joint is beyond what it allows, of an ellipse by its wider axis.
inline double degrees_beyond(const lks_world* world, const lks_bone& bone, lks_joint_id joint) {
    lks_fixed swing = 0;
    lks_fixed twist = 0;
    REQUIRE(lks_joint_angles(world, joint, &swing, &twist) == LKS_OK);
    const lks_fixed cone =
        bone.joint_kind == LKS_JOINT_BALL ? std::max(bone.swing_limit, bone.swing_limit_z) : 0;
    return std::max({0.0, metres(swing) - metres(cone), metres(twist) - metres(bone.twist_max),
                     metres(bone.twist_min) - metres(twist)});
}

inline double energy_of(const World& world) {
    lks_fixed energy = 0;
    REQUIRE(lks_world_kinetic_energy(world, &energy) == LKS_OK);
    return lks_fixed_to_double(energy);
}

// Kinetic, and potential of these.
inline double whole_energy(const World& world, const lks_body_id* bodies, std::size_t count) {
    double sum = energy_of(world);
    for (std::size_t i = 0; i < count; ++i) {
        sum += mass_of(world, bodies[i]) * 9.81 * state_of(world, bodies[i]).position.y;
    }
    return sum;
}

inline constexpr std::uint32_t collider_shapes[] = {LKS_SHAPE_PLANE, LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE,
                                                    LKS_SHAPE_BOX};

// A static one with its top at the origin; a capsule lies.
inline lks_collider_def collider_below_origin(std::uint32_t shape) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = shape;
    def.half_length = fixed(2);
    def.half_extents = fixed(1, 0.5, 1);
    def.transform.position.y = shape == LKS_SHAPE_PLANE ? 0 : fixed(-0.5);
    if (shape == LKS_SHAPE_CAPSULE) {
        def.transform.rotation = about(0, 0, 1, 90);
    }
    return def;
}

} // namespace support
