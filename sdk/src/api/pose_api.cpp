// lockstitch/ragdoll.h: poses, in and out.
#include <lockstitch/ragdoll.h>

#include <algorithm>

#include "api/body_checks.h"
#include "api/joint_checks.h"
#include "api/ragdoll_checks.h"
#include "api/ragdoll_scale.h"
#include "collide/saturation.h"
#include "rigid/body_motion.h"
#include "rigid/make_body.h"
#include "rigid/tick_spin.h"

using namespace lks;

namespace {

// One bone after the other, until one is refused: check(i), whose sentence names the bone.
template <typename Check>
lks_result check_bones(const lks_world& world, std::uint32_t count, const char* when, const Check& check) {
    lks_result result = LKS_OK;
    for (std::uint32_t i = 0; result == LKS_OK && i < count; ++i) {
        const WithinBone within_bone(world, i, when);
        result = check(i);
    }
    return result;
}

// Ids that are good; each once.
lks_result check_given_once(const lks_world& world, const lks_body_id* bodies, std::uint32_t index) {
    for (std::uint32_t i = 0; i < index; ++i) {
        if (bodies[i].index == bodies[index].index) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                              << "The body with index " << bodies[i].index
                                                              << " is that of bone " << i << " already.");
        }
    }
    return LKS_OK;
}

lks_result require_bodies(const lks_world* world, const lks_body_id* bodies, std::uint32_t count,
                          const void* pose, const char* function) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (bodies == nullptr || pose == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT,
                           null_argument(function, bodies == nullptr ? "bodies" : "pose"));
    }
    return check_bones(*world, count, "", [&](std::uint32_t i) {
        const lks_result result = require_body(world, bodies[i]);
        return result == LKS_OK ? check_given_once(*world, bodies, i) : result;
    });
}

// Where these are to be.
lks_result check_pose(const lks_world& world, const lks_body_id* bodies, const lks_transform* pose,
                      std::uint32_t count, const char* when = "") {
    return check_bones(world, count, when, [&](std::uint32_t i) {
        return check_body_place(world, world.rigid.descriptions[bodies[i].index], pose[i]);
    });
}

// As fast as it takes from one transform to the other in a tick.
void set_velocity(lks_world& world, Body& body, const BodyDescription& description,
                  const lks_transform& before, const lks_transform& now) {
    Body from = body;
    place_body(from, description, to_vec3(before.position), fixed::normalise(to_rotation(before.rotation)));
    Body to = body;
    place_body(to, description, to_vec3(now.position), fixed::normalise(to_rotation(now.rotation)));
    const std::int64_t ticks = world.rate.ticks_per_second;
    const auto speed = [ticks](std::int64_t way) { return fixed::multiply_shift(way, ticks, 0); };
    const fixed::Vec3 way = saturating_subtract(to.position, from.position);
    body.velocity = {speed(way.x), speed(way.y), speed(way.z)};
    body.angular_velocity = tick_spin(from.orientation, to.orientation, world.rate);
    clamp_vector(body.velocity, body_speed_limit(world.rate));
    clamp_vector(body.angular_velocity, body_spin_limit(world.rate));
}

// Of child against parent in the joint's frames, where bodies are turned as the pose says.
lks_rotation motor_target(const JointDescription& d, const lks_rotation& parent, const lks_rotation& child) {
    const fixed::Rotation a = fixed::multiply(fixed::normalise(to_rotation(parent)), d.frame_a);
    const fixed::Rotation b = fixed::multiply(fixed::normalise(to_rotation(child)), d.frame_b);
    const fixed::Rotation q = fixed::normalise(fixed::multiply(fixed::conjugate(a), b));
    return {q.x, q.y, q.z, q.w};
}

lks_fixed scaled_torque(const lks_bone& bone, const lks_ragdoll_def& def, lks_fixed strength) {
    const lks_fixed torque = fixed::multiply_divide(bone.motor_torque, strength, LKS_FIXED_ONE);
    return std::min(scaled(torque, def.scale, 4), LKS_FIXED(1000000));
}

// False: the game says that it has broken.
bool is_there(lks_joint_id joint) {
    return joint.generation != 0;
}

// Of bone i, which is not the root.
lks_result check_joint_of(const lks_world& world, const lks_joint_id* joints, std::uint32_t bone) {
    const lks_joint_id joint = joints[bone - 1];
    if (const lks_result result = require_joint(&world, joint); result != LKS_OK) {
        return result;
    }
    for (std::uint32_t i = 1; i < bone; ++i) {
        if (is_there(joints[i - 1]) && joints[i - 1].index == joint.index) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                              << "The joint with index " << joint.index
                                                              << " is that of bone " << i << " already.");
        }
    }
    return LKS_OK;
}

lks_result check_drive(const lks_world& world, const lks_ragdoll_def& def, const lks_joint_id* joints,
                       const lks_transform* pose, lks_fixed strength, lks_fixed response) {
    const Number numbers[] = {{"drive's strength", "", strength, 0, LKS_FIXED(100)},
                              {"drive's response", " s", response, 0, LKS_FIXED(100)}};
    if (const lks_result result = check_numbers(world, numbers); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_bone_tree(world, def); result != LKS_OK) {
        return result;
    }
    const lks_result result = check_bones(world, def.bone_count, "", [&](std::uint32_t i) {
        return i == 0 || !is_there(joints[i - 1]) ? LKS_OK : check_joint_of(world, joints, i);
    });
    if (result != LKS_OK) {
        return result;
    }
    return check_bones(world, def.bone_count, "",
                       [&](std::uint32_t i) { return check_body_frame(world, pose[i]); });
}

} // namespace

extern "C" {

lks_result lks_ragdoll_pose(const lks_world* world, const lks_body_id* bodies, uint32_t count,
                            lks_transform* pose) {
    const lks_result result = require_bodies(world, bodies, count, pose, "lks_ragdoll_pose");
    for (std::uint32_t i = 0; result == LKS_OK && i < count; ++i) {
        lks_body_transform(world, bodies[i], &pose[i]);
    }
    return result;
}

lks_result lks_ragdoll_set_pose(lks_world* world, const lks_body_id* bodies, uint32_t count,
                                const lks_transform* pose, const lks_transform* before) {
    lks_result result = require_bodies(world, bodies, count, pose, "lks_ragdoll_set_pose");
    result = result == LKS_OK ? check_pose(*world, bodies, pose, count) : result;
    result = result == LKS_OK && before != nullptr
                 ? check_pose(*world, bodies, before, count, ", a tick before")
                 : result;
    for (std::uint32_t i = 0; result == LKS_OK && i < count; ++i) {
        lks_body_set_transform(world, bodies[i], pose[i]);
        Body& body = world->rigid.bodies[bodies[i].index];
        if (before != nullptr && body.is_dynamic()) {
            set_velocity(*world, body, world->rigid.descriptions[bodies[i].index], before[i], pose[i]);
        }
    }
    return result;
}

lks_result lks_ragdoll_move_to(lks_world* world, const lks_body_id* bodies, uint32_t count,
                               const lks_transform* pose) {
    lks_result result = require_bodies(world, bodies, count, pose, "lks_ragdoll_move_to");
    if (result != LKS_OK) {
        return result;
    }
    // Targets of those before it are put back where one is refused.
    std::uint32_t done = 0;
    fixed::Vec3 positions[LKS_MAX_BONES];
    Quaternion orientations[LKS_MAX_BONES];
    if (count > LKS_MAX_BONES) {
        return world->fail(LKS_ERROR_LIMIT, Sentence() << "A pose of " << count << " bones is more than "
                                                       << LKS_MAX_BONES << ".");
    }
    for (; done < count && result == LKS_OK; ++done) {
        const Body& body = world->rigid.bodies[bodies[done].index];
        positions[done] = body.target_position;
        orientations[done] = body.target_orientation;
        const WithinBone within_bone(*world, done);
        result = lks_body_move_to(world, bodies[done], pose[done]);
    }
    while (result != LKS_OK && done-- > 0) {
        Body& body = world->rigid.bodies[bodies[done].index];
        body.target_position = positions[done];
        body.target_orientation = orientations[done];
    }
    return result;
}

lks_result lks_ragdoll_set_kind(lks_world* world, const lks_body_id* bodies, uint32_t count, uint32_t kind) {
    lks_result result = require_bodies(world, bodies, count, bodies, "lks_ragdoll_set_kind");
    result = result == LKS_OK ? check_body_kind(*world, kind) : result;
    for (std::uint32_t i = 0; result == LKS_OK && i < count; ++i) {
        result = lks_body_set_kind(world, bodies[i], kind);
    }
    return result;
}

lks_result lks_ragdoll_drive(lks_world* world, const lks_ragdoll_def* def, const lks_joint_id* joints,
                             const lks_transform* pose, lks_fixed strength, lks_fixed response) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (def == nullptr || joints == nullptr || pose == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT,
                           null_argument("lks_ragdoll_drive", def == nullptr      ? "def"
                                                              : joints == nullptr ? "joints"
                                                                                  : "pose"));
    }
    if (const lks_result result = check_drive(*world, *def, joints, pose, strength, response);
        result != LKS_OK) {
        return result;
    }
    for (std::uint32_t i = 1; i < def->bone_count; ++i) {
        if (!is_there(joints[i - 1])) {
            continue;
        }
        const JointDescription& d = world->rigid.joints[joints[i - 1].index].description;
        if (d.kind == LKS_JOINT_BALL || d.kind == LKS_JOINT_HINGE) {
            lks_motor motor{};
            motor.max_torque = scaled_torque(def->bones[i], *def, strength);
            motor.response = response;
            motor.target = motor_target(d, pose[def->bones[i].parent].rotation, pose[i].rotation);
            lks_joint_set_motor(world, joints[i - 1], &motor);
        }
    }
    return LKS_OK;
}

} // extern "C"
