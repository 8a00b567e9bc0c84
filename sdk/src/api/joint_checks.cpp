#include "api/joint_checks.h"

#include <algorithm>

#include "api/body_checks.h"

namespace lks {
namespace {

constexpr lks_fixed half_circle = LKS_FIXED(180);
constexpr lks_fixed greatest_length = LKS_FIXED(64);

lks_result check_bodies(const lks_world& world, const lks_joint_def& def) {
    for (const lks_body_id& body : {def.body_a, def.body_b}) {
        if (const lks_result result = require_body(&world, body); result != LKS_OK) {
            return result;
        }
    }
    if (def.body_a.index == def.body_b.index) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                          << "The joint's two bodies are the same, index "
                                                          << def.body_a.index << ".");
    }
    return LKS_OK;
}

} // namespace

lks_result check_joint_ranges(const lks_world& world, const lks_joint_def& def) {
    if (def.kind > LKS_JOINT_DISTANCE) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Joint kind " << def.kind
                                                                 << " does not exist: the kinds are 0 to 3.");
    }
    if (def.bodies_collide > 1 || def.reserved != 0) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence()
                                                          << "The joint's bodies_collide is "
                                                          << def.bodies_collide << " and its reserved field "
                                                          << def.reserved << "; they must be 0 or 1, and 0.");
    }
    for (const lks_transform& frame : {def.frame_a, def.frame_b}) {
        if (const lks_result result = check_rotation(world, frame.rotation); result != LKS_OK) {
            return result;
        }
    }
    const Number numbers[] = {
        {"swing_limit", " degrees", def.swing_limit, 0, half_circle},
        {"swing_limit_z", " degrees", std::max<lks_fixed>(def.swing_limit_z, 0), 0, half_circle},
        {"twist_max", " degrees", def.twist_max, -half_circle, half_circle},
        {"twist_min", " degrees", def.twist_min, -half_circle, def.twist_max},
        {"distance_max", " m", def.distance_max, 0, greatest_length},
        {"distance_min", " m", def.distance_min, 0, def.distance_max},
        {"joint's compliance", " m/N", def.compliance, 0, LKS_FIXED(1000)},
        {"joint's damping", " N·s/m", def.damping, 0, LKS_FIXED(1000000)},
        {"angular_compliance", " rad/(N·m)", def.angular_compliance, 0, LKS_FIXED(1000)},
        {"angular_damping", " N·m·s", def.angular_damping, 0, LKS_FIXED(1000000)},
        {"limit_compliance", " rad/(N·m)", def.limit_compliance, 0, LKS_FIXED(1000)},
        {"limit_damping", " N·m·s", def.limit_damping, 0, LKS_FIXED(1000000)},
        {"joint's friction", " N·m", def.friction, 0, LKS_FIXED(1000000)},
        {"break_force", " N", def.break_force, 0, greatest_break_strength},
        {"break_torque", " N·m", def.break_torque, 0, greatest_break_strength},
    };
    return check_numbers(world, numbers);
}

lks_result check_joint_points(const lks_world& world, const lks_joint_def& def) {
    for (const lks_transform& frame : {def.frame_a, def.frame_b}) {
        if (!within(frame.position, greatest_length)) {
            return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                              out_of_range("joint's point", frame.position, "m", greatest_length));
        }
    }
    return LKS_OK;
}

lks_result check_joint_def(const lks_world& world, const lks_joint_def& def) {
    if (const lks_result result = check_joint_ranges(world, def); result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_joint_points(world, def); result != LKS_OK) {
        return result;
    }
    return check_bodies(world, def);
}

lks_result check_motor(const lks_world& world, std::uint32_t kind, const lks_motor& motor) {
    if (kind != LKS_JOINT_BALL && kind != LKS_JOINT_HINGE && motor.max_torque != 0) {
        return world.fail(LKS_ERROR_UNSUPPORTED, Sentence() << "A joint of kind " << kind
                                                            << " has no motor: ball joints and hinges have.");
    }
    const Number numbers[] = {{"motor's max_torque", " N·m", motor.max_torque, 0, LKS_FIXED(1000000)},
                              {"motor's response", " s", motor.response, 0, LKS_FIXED(100)}};
    if (const lks_result result = check_numbers(world, numbers); result != LKS_OK) {
        return result;
    }
    return check_rotation(world, motor.target);
}

lks_result require_joint(const lks_world* world, lks_joint_id id) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (world->has_joint(id)) {
        return LKS_OK;
    }
    return world->fail(LKS_ERROR_STALE_ID, Sentence()
                                               << "There is no joint with index " << id.index
                                               << " and generation " << id.generation << " in this world.");
}

} // namespace lks
