// lockstitch/joint.h.
#include <lockstitch/joint.h>

#include <algorithm>

#include "api/joint_checks.h"
#include "api/read_out.h"
#include "collide/saturation.h"
#include "fixed/arc_tangent.h"
#include "rigid/joint_distance.h"
#include "rigid/make_body.h"
#include "rigid/sleep.h"

using namespace lks;

namespace {

void describe_limits(const lks_joint_def& def, JointDescription& d) {
    d.swing_limit = def.swing_limit;
    d.swing_limit_z = def.swing_limit_z < 0 ? -1 : def.swing_limit_z;
    d.twist_min = def.twist_min;
    d.twist_max = def.twist_max;
    d.distance_min = def.distance_min;
    d.distance_max = def.distance_max;
}

JointDescription describe(const lks_joint_def& def, const RigidScene& scene) {
    JointDescription d{};
    d.kind = def.kind;
    d.body_a = def.body_a.index;
    d.body_b = def.body_b.index;
    d.bodies_collide = def.bodies_collide;
    d.point_a = to_vec3(def.frame_a.position) - scene.descriptions[d.body_a].centre;
    d.point_b = to_vec3(def.frame_b.position) - scene.descriptions[d.body_b].centre;
    d.frame_a = fixed::normalise(to_rotation(def.frame_a.rotation));
    d.frame_b = fixed::normalise(to_rotation(def.frame_b.rotation));
    describe_limits(def, d);
    d.compliance = def.compliance;
    d.damping = def.damping;
    d.angular_compliance = def.angular_compliance;
    d.angular_damping = def.angular_damping;
    d.limits = {def.limit_compliance, def.limit_damping};
    d.friction = def.friction;
    d.break_force = def.break_force;
    d.break_torque = def.break_torque;
    return d;
}

struct JointBodies {
    const Body& a;
    const Body& b;
};

JointBodies bodies_of(const lks_world& world, const Joint& joint) {
    return {world.rigid.bodies[joint.description.body_a], world.rigid.bodies[joint.description.body_b]};
}

lks_fixed to_degrees(std::int64_t radians) {
    return fixed::multiply_divide(radians, LKS_FIXED(180), fixed::half_circle);
}

void take_limits(const lks_limits& limits, lks_joint_def& def) {
    def.swing_limit = limits.swing_limit;
    def.swing_limit_z = limits.swing_limit_z;
    def.twist_min = limits.twist_min;
    def.twist_max = limits.twist_max;
    def.distance_min = limits.distance_min;
    def.distance_max = limits.distance_max;
}

bool have_same_limits(const JointDescription& d, const JointDescription& e) {
    return d.swing_limit == e.swing_limit && d.swing_limit_z == e.swing_limit_z &&
           d.twist_min == e.twist_min && d.twist_max == e.twist_max && d.distance_min == e.distance_min &&
           d.distance_max == e.distance_max;
}

// Of a checked definition.
void set_limits(lks_world& world, Joint& joint, const lks_joint_def& def) {
    JointDescription wanted = joint.description;
    describe_limits(def, wanted);
    if (have_same_limits(wanted, joint.description)) {
        return;
    }
    joint.description = wanted;
    if (is_distance(joint)) {
        // Else as much as they moved it would be made up for with speed. What it bore stays to be read.
        const fixed::Vec3 pushed = joint.pushed;
        const fixed::Vec3 turned = joint.turned;
        forget_pushes(joint);
        joint.pushed = pushed;
        joint.turned = turned;
    }
    Body& a = world.rigid.bodies[wanted.body_a];
    Body& b = world.rigid.bodies[wanted.body_b];
    joint.constants = make_joint_constants(wanted, a, b, world.rate);
    // Where there is no limit any more nothing would take its push back.
    joint.swing_push = joint.constants.swing_limited ? joint.swing_push : 0;
    joint.twist_push = joint.constants.twist_limited ? joint.twist_push : 0;
    wake(a);
    wake(b);
}

// A checked motor.
void set_motor(lks_world& world, Joint& joint, const lks_motor& motor) {
    JointDescription& d = joint.description;
    const fixed::Rotation target = fixed::settle(to_rotation(motor.target));
    if (d.motor_torque == motor.max_torque && d.motor_response == motor.response &&
        joint.motor_target == target) {
        return;
    }
    const bool is_on = d.motor_torque != 0 || motor.max_torque != 0;
    d.motor_torque = motor.max_torque;
    d.motor_response = motor.response;
    joint.motor_target = target;
    Body& a = world.rigid.bodies[d.body_a];
    Body& b = world.rigid.bodies[d.body_b];
    joint.constants = make_joint_constants(d, a, b, world.rate);
    if (is_on) {
        wake(a);
        wake(b);
    }
}

} // namespace

extern "C" {

lks_joint_def lks_default_joint_def(void) {
    lks_joint_def def{};
    def.struct_size = sizeof(lks_joint_def);
    def.kind = LKS_JOINT_BALL;
    def.frame_a.rotation.w = LKS_ROTATION_ONE;
    def.frame_b.rotation.w = LKS_ROTATION_ONE;
    def.swing_limit = LKS_FIXED(180);
    def.swing_limit_z = -1;
    def.twist_min = -LKS_FIXED(180);
    def.twist_max = LKS_FIXED(180);
    return def;
}

lks_result lks_world_add_joint(lks_world* world, const lks_joint_def* def, lks_joint_id* joint) {
    if (const lks_result result = check_addition(world, "joint", def, joint); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_joint_def(*world, *def); result != LKS_OK) {
        return result;
    }
    RigidScene& scene = world->rigid;
    const std::uint32_t index = first_free(scene.joint_slots);
    if (index >= LKS_MAX_JOINTS) {
        return world->fail(LKS_ERROR_LIMIT, Sentence()
                                                << "A world holds at most " << LKS_MAX_JOINTS << " joints.");
    }
    if (index >= scene.joint_room() && !scene.reserve_joints(grown_room(scene.joints.size()))) {
        return world->fail_out_of_memory("a joint");
    }
    if (index == scene.joint_slots.size()) {
        scene.joint_slots.push_reserved(Slot{1, false});
        scene.joints.push_reserved(Joint{});
    }
    Joint& made = scene.joints[index];
    made.description = describe(*def, scene);
    made.motor_target = fixed::identity_rotation();
    const JointBodies bodies = bodies_of(*world, made);
    made.constants = make_joint_constants(made.description, bodies.a, bodies.b, world->rate);
    scene.joint_slots[index].used = true;
    wake(scene.bodies[made.description.body_a]);
    wake(scene.bodies[made.description.body_b]);
    scene.joints_changed();
    *joint = {index, scene.joint_slots[index].generation};
    return LKS_OK;
}

lks_result lks_world_remove_joint(lks_world* world, lks_joint_id joint) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    const JointDescription& description = world->rigid.joints[joint.index].description;
    wake(world->rigid.bodies[description.body_a]);
    wake(world->rigid.bodies[description.body_b]);
    world->rigid.free_joint(joint.index);
    world->rigid.joints_changed();
    return LKS_OK;
}

uint32_t lks_world_has_joint(const lks_world* world, lks_joint_id joint) {
    return world != nullptr && world->has_joint(joint) ? 1u : 0u;
}

uint32_t lks_world_joint_count(const lks_world* world) {
    return world == nullptr ? 0 : count_used(world->rigid.joint_slots);
}

lks_result lks_joint_bodies(const lks_world* world, lks_joint_id joint, lks_body_id* body_a,
                            lks_body_id* body_b) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    const JointDescription& d = world->rigid.joints[joint.index].description;
    const auto id_of = [world](std::uint32_t index) {
        return lks_body_id{index, world->rigid.body_slots[index].generation};
    };
    if (body_a != nullptr) {
        *body_a = id_of(d.body_a);
    }
    if (body_b != nullptr) {
        *body_b = id_of(d.body_b);
    }
    return LKS_OK;
}

lks_result lks_joint_error(const lks_world* world, lks_joint_id joint, lks_fixed* error) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    if (error == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_joint_error", "error"));
    }
    const Joint& found = world->rigid.joints[joint.index];
    const JointBodies bodies = bodies_of(*world, found);
    const std::int64_t distance = saturate(fixed::length(joint_offset(found, bodies.a, bodies.b)));
    const JointDescription& d = found.description;
    *error = d.kind == LKS_JOINT_DISTANCE
                 ? std::max<std::int64_t>({distance - d.distance_max, d.distance_min - distance, 0})
                 : distance;
    return LKS_OK;
}

lks_result lks_joint_angles(const lks_world* world, lks_joint_id joint, lks_fixed* swing, lks_fixed* twist) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    const Joint& found = world->rigid.joints[joint.index];
    const JointBodies bodies = bodies_of(*world, found);
    const JointAngles angles = joint_angles(found, bodies.a, bodies.b);
    if (swing != nullptr) {
        *swing = to_degrees(angles.swing);
    }
    if (twist != nullptr) {
        *twist = to_degrees(angles.twist);
    }
    return LKS_OK;
}

lks_result lks_joint_swing(const lks_world* world, lks_joint_id joint, lks_fixed* x, lks_fixed* z) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    const Joint& found = world->rigid.joints[joint.index];
    const JointBodies bodies = bodies_of(*world, found);
    const SwingParts swung = swing_parts(found, bodies.a, bodies.b);
    if (x != nullptr) {
        *x = to_degrees(swung.x);
    }
    if (z != nullptr) {
        *z = to_degrees(swung.z);
    }
    return LKS_OK;
}

lks_result lks_joint_load(const lks_world* world, lks_joint_id joint, lks_vec3* force, lks_vec3* torque) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    const Joint& found = world->rigid.joints[joint.index];
    const JointBodies bodies = bodies_of(*world, found);
    const fixed::Scaled factor =
        force_of_push(world->rate, greater_inverse_mass(found.constants.shares, bodies.a, bodies.b));
    if (force != nullptr) {
        *force = times(found.pushed, factor);
    }
    if (torque != nullptr) {
        *torque = times(found.turned, factor.times_power_of_two(2 * found.constants.reach));
    }
    return LKS_OK;
}

lks_result lks_joint_set_limits(lks_world* world, lks_joint_id joint, const lks_limits* limits) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    if (limits == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_joint_set_limits", "limits"));
    }
    Joint& found = world->rigid.joints[joint.index];
    lks_joint_def def = define_joint(found.description);
    take_limits(*limits, def);
    if (const lks_result result = check_joint_ranges(*world, def); result != LKS_OK) {
        return result;
    }
    set_limits(*world, found, def);
    return LKS_OK;
}

lks_result lks_joint_limits(const lks_world* world, lks_joint_id joint, lks_limits* limits) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    if (limits == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_joint_limits", "limits"));
    }
    const JointDescription& d = world->rigid.joints[joint.index].description;
    *limits = {d.swing_limit, d.swing_limit_z, d.twist_min, d.twist_max, d.distance_min, d.distance_max};
    return LKS_OK;
}

lks_result lks_joint_set_motor(lks_world* world, lks_joint_id joint, const lks_motor* motor) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    if (motor == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_joint_set_motor", "motor"));
    }
    Joint& found = world->rigid.joints[joint.index];
    if (const lks_result result = check_motor(*world, found.description.kind, *motor); result != LKS_OK) {
        return result;
    }
    set_motor(*world, found, *motor);
    return LKS_OK;
}

lks_result lks_joint_motor(const lks_world* world, lks_joint_id joint, lks_motor* motor) {
    if (const lks_result result = require_joint(world, joint); result != LKS_OK) {
        return result;
    }
    if (motor == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_joint_motor", "motor"));
    }
    const Joint& found = world->rigid.joints[joint.index];
    const JointDescription& d = found.description;
    const fixed::Rotation& q = found.motor_target;
    *motor = {d.motor_torque, d.motor_response, {q.x, q.y, q.z, q.w}};
    return LKS_OK;
}

} // extern "C"
