#include "state/rigid_checks.h"

#include <cstddef>
#include <cstring>

#include "api/body_checks.h"
#include "api/joint_checks.h"
#include "rigid/body_motion.h"
#include "state/records.h"

namespace lks {
namespace {

constexpr std::int64_t unit_room = turn_one >> 20;
constexpr std::int64_t greatest_u32 = UINT32_MAX;

// Components within the range of a unit's.
bool is_unit(const unsigned char* at) {
    std::int64_t squared = -turn_one;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::int64_t part = read_i64(at + 8 * i);
        squared += multiply_turn(part, part);
    }
    return within(squared, unit_room);
}

// Of a normal, with room for roundings.
bool is_direction(const fixed::Direction& d) {
    constexpr std::int32_t longest = direction_one + (direction_one >> 16);
    return within(d.x, longest) && within(d.y, longest) && within(d.z, longest);
}

// What a shape has not got is zero.
bool is_plain(const lks_body_shape& s) {
    const bool round = s.shape != LKS_SHAPE_BOX;
    const fixed::Rotation rotation = to_rotation(s.transform.rotation);
    return (round || s.radius == 0) && (s.shape == LKS_SHAPE_CAPSULE || s.half_length == 0) &&
           (!round || within(s.half_extents, 0)) && fixed::normalise(rotation) == rotation;
}

} // namespace

RigidChecks::RigidChecks(const lks_world& world) : world_(world) {
    const std::int64_t greatest_sum = greatest_push * world.rate.substeps;
    body_ranges_.within(world_position_limit, 9)
        .within(turn_one + unit_room, 8)
        .within(body_speed_limit(world.rate), 3)
        // Free spins go beyond the limit, within 7/4 of it.
        .within(2 * body_spin_limit(world.rate), 3)
        .within(turn_one + unit_room, 4)
        .between(INT64_MIN, INT64_MAX); // any rest; the others: sleeps_soundly
    joint_ranges_
        .within(greatest_uneven_push, 3) // push
        .within(greatest_push, 6)        // turn, grip
        .between(0, greatest_push)       // swing_push
        .within(greatest_push, 1)
        .within(greatest_pushed, 3)
        .within(5 * greatest_sum, 3);
    for (std::uint32_t i = 0; i < greatest_point_count; ++i) {
        push_ranges_
            .between(0, greatest_u32) // any feature; nothing reserved
            .within(LKS_FIXED(128), 3)
            .between(0, greatest_push)
            .within(greatest_push, 2);
    }
}

bool RigidChecks::definition(const BodyDefinition& definition) const {
    if (check_body_def(world_, define_body(definition)) != LKS_OK) {
        return false;
    }
    for (std::uint32_t i = 0; i < definition.shape_count; ++i) {
        if (!is_plain(definition.shapes[i])) {
            return false;
        }
    }
    return true;
}

// The points are from the centres of mass, which lie within 60 m of the frames that the game gave.
bool RigidChecks::description(const JointDescription& d) const {
    const lks_motor motor{d.motor_torque, d.motor_response, {0, 0, 0, LKS_ROTATION_ONE}};
    return within(d.point_a, LKS_FIXED(124)) && within(d.point_b, LKS_FIXED(124)) &&
           check_joint_ranges(world_, define_joint(d)) == LKS_OK && d.swing_limit_z >= -1 &&
           check_motor(world_, d.kind, motor) == LKS_OK;
}

bool RigidChecks::joined(std::uint32_t a, std::uint32_t b, const Array<Loaded>& bodies) {
    return a != b && a < bodies.size() && b < bodies.size() && bodies[a] != Loaded::nothing &&
           bodies[b] != Loaded::nothing;
}

bool RigidChecks::moves_within_reach(const unsigned char* at) const {
    Body body{};
    read_record<BodyState>(at, body);
    return check_body_motion(world_, body, body.target_position, narrow(body.target_orientation)) == LKS_OK;
}

// Who sleeps does not move, nor has any course, and is no kinematic one.
bool RigidChecks::sleeps_soundly(const unsigned char* at, std::uint32_t kind) {
    const unsigned char* sleep = at + offsetof(BodyState, asleep);
    if (sleep[0] == 0) {
        return at[offsetof(BodyState, gathers)] <= 1 && at[offsetof(BodyState, turns)] <= enough_turns;
    }
    std::int64_t speeds[6];
    static_assert(offsetof(BodyState, angular_velocity) ==
                  offsetof(BodyState, velocity) + sizeof(speeds) / 2);
    std::memcpy(speeds, at + offsetof(BodyState, velocity), sizeof(speeds)); // nought in any order of bytes
    const std::int64_t any = speeds[0] | speeds[1] | speeds[2] | speeds[3] | speeds[4] | speeds[5];
    return read_u32(sleep) == 1 && any == 0 && kind != LKS_BODY_KINEMATIC;
}

bool RigidChecks::body(const unsigned char* at, std::uint32_t kind) const {
    return body_ranges_.hold(at) && sleeps_soundly(at, kind) &&
           is_unit(at + offsetof(BodyState, orientation)) &&
           is_unit(at + offsetof(BodyState, target_orientation)) &&
           is_unit(at + offsetof(BodyState, rest_orientation)) &&
           (kind != LKS_BODY_KINEMATIC || moves_within_reach(at));
}

bool RigidChecks::joint(const unsigned char* at, const fixed::Rotation& known_target) const {
    static_assert(offsetof(JointState, motor_target) == 0);
    if (!joint_ranges_.hold(at + target_size)) {
        return false;
    }
    fixed::Rotation target{};
    read_record(at, target);
    return target == known_target || fixed::normalise(target) == target;
}

bool RigidChecks::contact(const ContactMemory& memory, const Array<Loaded>& bodies, std::uint32_t colliders) {
    const ContactKey& key = memory.key;
    const auto exists = [&bodies](std::uint32_t body) {
        return body < bodies.size() && bodies[body] != Loaded::nothing;
    };
    const bool other_exists = key.other >= other_is_collider ? (key.other & ~other_is_collider) < colliders
                                                             : key.other > key.body_a && exists(key.other);
    return exists(key.body_a) && other_exists && key.shapes < LKS_MAX_BODY_SHAPES * LKS_MAX_BODY_SHAPES &&
           memory.count >= 1 && memory.count <= greatest_point_count && is_direction(memory.normal) &&
           memory.forgotten <= 1;
}

bool RigidChecks::pushes(const unsigned char* at, std::uint32_t count) const {
    return push_ranges_.hold(at, count * push_words);
}

} // namespace lks
