// lockstitch/ragdoll.h.
#include <lockstitch/ragdoll.h>

#include <algorithm>

#include "api/body_checks.h"
#include "api/joint_checks.h"
#include "api/ragdoll_checks.h"
#include "api/ragdoll_scale.h"
#include "collide/saturation.h"
#include "fixed/formats.h"
#include "rigid/make_body.h"

using namespace lks;

namespace {

fixed::Vec3 scaled(const lks_vec3& v, lks_fixed scale) {
    return {lks::scaled(v.x, scale), lks::scaled(v.y, scale), lks::scaled(v.z, scale)};
}

// The ragdoll's frame in the world.
struct Placement {
    explicit Placement(const lks_ragdoll_def& def)
        : position(to_vec3(def.transform.position)),
          rotation(fixed::normalise(to_rotation(def.transform.rotation))), matrix(fixed::to_matrix(rotation)),
          scale(def.scale) {}

    lks_transform place(const lks_transform& local) const {
        const fixed::Vec3 p = saturating_add(position, fixed::rotate(matrix, scaled(local.position, scale)));
        const fixed::Rotation q =
            fixed::normalise(fixed::multiply(rotation, fixed::normalise(to_rotation(local.rotation))));
        return {from_vec3(p), {q.x, q.y, q.z, q.w}};
    }

    fixed::Vec3 position;
    fixed::Rotation rotation;
    fixed::Matrix3 matrix;
    lks_fixed scale;
};

// One bone's body as it goes into the world; `shapes` has room for LKS_MAX_BODY_SHAPES.
lks_body_def make_body_def(const lks_ragdoll_def& def, const lks_bone& bone, const Placement& placement,
                           lks_body_shape* shapes) {
    lks_body_def body = bone.body;
    for (std::uint32_t i = 0; i < body.shape_count; ++i) {
        lks_body_shape& shape = shapes[i];
        shape = bone.body.shapes[i];
        shape.transform.position = from_vec3(scaled(shape.transform.position, def.scale));
        shape.radius = lks::scaled(shape.radius, def.scale);
        shape.half_length = lks::scaled(shape.half_length, def.scale);
        shape.half_extents = from_vec3(scaled(shape.half_extents, def.scale));
    }
    body.shapes = shapes;
    body.mass = lks::scaled(body.mass, def.scale, 3);
    body.transform = placement.place(bone.body.transform);
    body.velocity = def.velocity;
    body.angular_velocity = {0, 0, 0};
    if (def.group != 0) {
        body.filter.group = def.group;
    }
    return body;
}

// A transform of the world in a body's frame.
lks_transform relative(const lks_transform& body, const lks_transform& world) {
    const fixed::Rotation q = fixed::normalise(to_rotation(body.rotation));
    const fixed::Vec3 p =
        fixed::rotate_transposed(fixed::to_matrix(q), to_vec3(world.position) - to_vec3(body.position));
    const fixed::Rotation r =
        fixed::normalise(fixed::multiply(fixed::conjugate(q), to_rotation(world.rotation)));
    return {from_vec3(p), {r.x, r.y, r.z, r.w}};
}

lks_transform turned(const lks_transform& frame, const lks_rotation& rotation) {
    const fixed::Rotation r = fixed::multiply(to_rotation(frame.rotation), to_rotation(rotation));
    return {frame.position, {r.x, r.y, r.z, r.w}};
}

// What a joint of a scaled figure bears: never nothing, which would be everything.
lks_fixed scaled_strength(lks_fixed strength, lks_fixed scale, int power) {
    if (strength == 0) {
        return 0;
    }
    return std::clamp<lks_fixed>(lks::scaled(strength, scale, power), 1, greatest_break_strength);
}

// Of a bone that has a parent, without its bodies.
lks_joint_def make_joint_def(const lks_ragdoll_def& def, const lks_bone& bone, const Placement& placement) {
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = bone.joint_kind;
    const lks_transform frame = placement.place(bone.joint_frame);
    joint.frame_a = relative(placement.place(def.bones[bone.parent].body.transform), frame);
    joint.frame_b = relative(placement.place(bone.body.transform), turned(frame, bone.joint_rest));
    joint.swing_limit = bone.swing_limit;
    joint.swing_limit_z = bone.swing_limit_z;
    joint.twist_min = bone.twist_min;
    joint.twist_max = bone.twist_max;
    joint.compliance = bone.compliance;
    joint.damping = bone.damping;
    joint.angular_compliance = bone.angular_compliance;
    joint.angular_damping = bone.angular_damping;
    joint.limit_compliance = bone.limit_compliance;
    joint.limit_damping = bone.limit_damping;
    joint.friction = bone.friction;
    joint.break_force = scaled_strength(bone.break_force, def.scale, 3);
    joint.break_torque = scaled_strength(bone.break_torque, def.scale, 4);
    return joint;
}

lks_result check_bone(const lks_world& world, const lks_ragdoll_def& def, std::uint32_t index) {
    const lks_bone& bone = def.bones[index];
    if (bone.body.struct_size != sizeof(lks_body_def)) {
        return world.fail(LKS_ERROR_STRUCT_SIZE,
                          Sentence() << "Bone " << index << " has a body whose struct_size is "
                                     << bone.body.struct_size << "; lks_default_bone sets it.");
    }
    if (bone.joint_kind > LKS_JOINT_FIXED) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Bone " << index << " has the joint kind "
                                                                 << bone.joint_kind
                                                                 << "; the kinds of bones are 0 to 2.");
    }
    if (!within(bone.joint_frame.position, LKS_FIXED(30)) ||
        !within(bone.body.transform.position, LKS_FIXED(30))) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "Bone " << index
                                     << " or its joint lies more than 30 m from the ragdoll.");
    }
    const WithinBone within_bone(world, index);
    for (const lks_rotation& rotation :
         {bone.joint_frame.rotation, bone.joint_rest, bone.body.transform.rotation}) {
        if (const lks_result result = check_rotation(world, rotation); result != LKS_OK) {
            return result;
        }
    }
    if (bone.body.shape_count > LKS_MAX_BODY_SHAPES || bone.body.shapes == nullptr) {
        return check_body_def(world, bone.body);
    }
    lks_body_shape shapes[LKS_MAX_BODY_SHAPES];
    const lks_body_def body = make_body_def(def, bone, Placement(def), shapes);
    const lks_result result = check_body_def(world, body);
    return result != LKS_OK ? result
                            : check_body_place(world, describe_body(plain_definition(body)), body.transform);
}

lks_result check_ragdoll(const lks_world& world, const lks_ragdoll_def& def) {
    if (const lks_result result = check_bone_tree(world, def); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_body_frame(world, def.transform); result != LKS_OK) {
        return result;
    }
    for (std::uint32_t i = 0; i < def.bone_count; ++i) {
        if (const lks_result result = check_bone(world, def, i); result != LKS_OK) {
            return result;
        }
        if (i == 0) {
            continue;
        }
        const WithinBone within_bone(world, i);
        const lks_joint_def joint = make_joint_def(def, def.bones[i], Placement(def));
        if (const lks_result result = check_joint_ranges(world, joint); result != LKS_OK) {
            return result;
        }
        if (const lks_result result = check_joint_points(world, joint); result != LKS_OK) {
            return result;
        }
    }
    const RigidScene& scene = world.rigid;
    if (count_used(scene.body_slots) + def.bone_count > LKS_MAX_BODIES ||
        count_used(scene.joint_slots) + def.bone_count - 1 > LKS_MAX_JOINTS) {
        return world.fail(LKS_ERROR_LIMIT, Sentence() << "A world holds at most " << LKS_MAX_BODIES
                                                      << " bodies and " << LKS_MAX_JOINTS << " joints.");
    }
    return LKS_OK;
}

// Doubles at least where it grows, so that many ragdolls cost no more than their number.
bool reserve(lks_world& world, std::uint32_t bones) {
    RigidScene& scene = world.rigid;
    const auto room = [bones](std::size_t size, std::size_t capacity) {
        return size + bones <= capacity ? capacity : 2 * size + bones;
    };
    return scene.reserve(room(scene.bodies.size(), scene.body_room()), world.colliders.capacity()) &&
           scene.reserve_joints(room(scene.joints.size(), scene.joint_room()));
}

} // namespace

extern "C" {

lks_bone lks_default_bone(void) {
    lks_bone bone{};
    bone.parent = LKS_NO_PARENT;
    bone.body = lks_default_body_def();
    bone.joint_frame.rotation.w = LKS_ROTATION_ONE;
    bone.joint_rest.w = LKS_ROTATION_ONE;
    bone.swing_limit = LKS_FIXED(180);
    bone.swing_limit_z = -1;
    bone.twist_min = -LKS_FIXED(180);
    bone.twist_max = LKS_FIXED(180);
    return bone;
}

lks_ragdoll_def lks_default_ragdoll_def(void) {
    lks_ragdoll_def def{};
    def.struct_size = sizeof(lks_ragdoll_def);
    def.transform.rotation.w = LKS_ROTATION_ONE;
    def.scale = LKS_FIXED_ONE;
    return def;
}

lks_result lks_world_add_ragdoll(lks_world* world, const lks_ragdoll_def* def, lks_body_id* bodies,
                                 lks_joint_id* joints) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (def == nullptr || bodies == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT,
                           null_argument("lks_world_add_ragdoll", def == nullptr ? "def" : "bodies"));
    }
    if (const lks_result result = check_ragdoll(*world, *def); result != LKS_OK) {
        return result;
    }
    if (!reserve(*world, def->bone_count)) {
        return world->fail_out_of_memory("a ragdoll");
    }
    // Everything was checked and has its room: none of these can fail.
    const Placement placement(*def);
    for (std::uint32_t i = 0; i < def->bone_count; ++i) {
        const lks_bone& bone = def->bones[i];
        lks_body_shape shapes[LKS_MAX_BODY_SHAPES];
        const lks_body_def body = make_body_def(*def, bone, placement, shapes);
        lks_world_add_body(world, &body, &bodies[i]);
        if (i > 0) {
            lks_joint_def joint = make_joint_def(*def, bone, placement);
            joint.body_a = bodies[bone.parent];
            joint.body_b = bodies[i];
            lks_joint_id added{};
            lks_world_add_joint(world, &joint, &added);
            if (joints != nullptr) {
                joints[i - 1] = added;
            }
        }
    }
    return LKS_OK;
}

} // extern "C"
