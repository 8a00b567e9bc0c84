#include "rigid/joint_drive.h"

#include "fixed/arc_tangent.h"
#include "rigid/joint_frames.h"
#include "rigid/joint_limits.h"
#include "rigid/substep_motion.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// How much b has turned against a in this substep: half turns, Turn.
Vec3 turned_since_start(const Body& a, const Body& b) {
    return half_turn_between(b.start_orientation, b.orientation) -
           half_turn_between(a.start_orientation, a.orientation);
}

// Half turns to angles, Turn to World.
std::int64_t to_angle(std::int64_t half_turn) {
    return half_turn >> (turn_fraction_bits - world_fraction_bits - 1);
}

// As much of it as friction, or the motor, is capable of.
Vec3 within_grip(const Joint& joint, const Vec3& turn) {
    fixed::NormalisedVector size{};
    const bool beyond = fixed::normalise(turn, size) && size.length > joint.constants.grip;
    return beyond ? fixed::scale(size.direction, joint.constants.grip) : turn;
}

// Across its axis a hinge bends a little in each substep before what holds it there has pushed enough.
// Friction that took that for a turn to be stopped would bear the load across, too, and slip about the axis.
Vec3 driven_part(const Joint& joint, const Body& a, const Vec3& turn) {
    if (joint.description.kind != LKS_JOINT_HINGE) {
        return turn;
    }
    const Direction axis = fixed::rotate(a.rotation, joint.constants.axis_a);
    return fixed::scale(axis, fixed::dot(axis, turn));
}

// Turns by what the aim is missed by, up to the greatest push.
void drive(Joint& joint, Body& a, Body& b) {
    fixed::NormalisedVector way{};
    if (!fixed::normalise(driven_part(joint, a, turned_since_start(a, b) - joint.aim), way)) {
        return;
    }
    const std::int64_t wanted = TurnRow(joint, a, b, way.direction).push_for(-to_angle(way.length));
    const Vec3 before = joint.grip;
    joint.grip = within_grip(joint, before + fixed::scale(way.direction, wanted));
    turn_apart(joint, a, b, joint.grip - before);
}

// A torque against the speed of turning.
void drag(Joint& joint, Body& a, Body& b) {
    fixed::NormalisedVector way{};
    if (!fixed::normalise(turned_since_start(a, b), way)) {
        return;
    }
    turn_back(joint, a, b, way.direction, to_angle(way.length), joint.constants.drag_softness, joint.drag);
}

// How far a hinge is turned from where twists are measured from: World, within half a circle.
std::int64_t twist_of(const JointConstants& c, const fixed::Rotation& q) {
    const auto part = [](std::int64_t sum) { return fixed::shift_right_rounded(sum, 30); };
    const std::int64_t sine =
        part(std::int64_t{q.y} * c.half_middle.cosine - std::int64_t{q.w} * c.half_middle.sine);
    const std::int64_t cosine =
        part(std::int64_t{q.w} * c.half_middle.cosine + std::int64_t{q.y} * c.half_middle.sine);
    return 2 * (cosine < 0 ? fixed::angle_of(-sine, -cosine) : fixed::angle_of(sine, cosine));
}

// From where it is to what the motor aims at without leaving its limits, which may be the long way round.
// Nought where there are none.
std::int64_t way_within_limits(const Joint& joint, const fixed::Rotation& now) {
    const bool limited = joint.description.kind == LKS_JOINT_HINGE && joint.constants.twist_limited;
    return limited ? twist_of(joint.constants, joint.motor_aim) - twist_of(joint.constants, now) : 0;
}

// What is missing to what the motor aims at, about any axis or about the hinge's: an angle in World, in the
// world.
Vec3 missing_turn(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation now = relative_rotation(joint, a, b);
    if (const std::int64_t way = way_within_limits(joint, now);
        way < -fixed::half_circle || way > fixed::half_circle) {
        return fixed::scale(from_frame_a(joint, a, {0, direction_one, 0}), way);
    }
    fixed::Rotation q = fixed::multiply(joint.motor_aim, fixed::conjugate(now));
    if (joint.description.kind == LKS_JOINT_HINGE) {
        q.x = 0;
        q.z = 0;
    }
    fixed::NormalisedVector way{};
    if (!fixed::normalise(Vec3{q.x, q.y, q.z}, way)) {
        return {0, 0, 0};
    }
    const std::int64_t half = fixed::angle_of(q.w < 0 ? -way.length : way.length, q.w < 0 ? -q.w : q.w);
    return fixed::scale(from_frame_a(joint, a, way.direction), 2 * half);
}

} // namespace

void aim_motor(Joint& joint, const Body& a, const Body& b) {
    joint.aim = {0, 0, 0};
    if (joint.description.motor_torque != 0) {
        const Vec3 missing = missing_turn(joint, a, b);
        // Half of it, as Turn.
        const auto part = [&](std::int64_t c) {
            return fixed::scale_component(
                joint.constants.motor_share,
                c * (std::int64_t{1} << (turn_fraction_bits - world_fraction_bits - 1)));
        };
        joint.aim = {part(missing.x), part(missing.y), part(missing.z)};
        if (joint.description.kind == LKS_JOINT_BALL) {
            joint.aim = along_limits(joint, a, b, joint.aim);
        }
    }
}

std::uint32_t drive_rows(const Joint& joint, const Body& a, const Body& b, HeldRow* rows) {
    if (!joint.motor_in_tree) {
        return 0;
    }
    Direction axes[3] = {{direction_one, 0, 0}, {0, direction_one, 0}, {0, 0, direction_one}};
    std::uint32_t count = 3;
    if (joint.description.kind == LKS_JOINT_HINGE) {
        axes[0] = fixed::rotate(a.rotation, joint.constants.axis_a);
        count = 1;
    }
    const Vec3 error = drive_error(joint, a, b);
    for (std::uint32_t i = 0; i < count; ++i) {
        rows[i] = {HeldRow::Kind::drive, axes[i], fixed::dot(axes[i], error), 0};
    }
    return count;
}

Vec3 drive_error(const Joint& joint, const Body& a, const Body& b) {
    const Vec3 error = driven_part(joint, a, turned_since_start(a, b) - joint.aim);
    return {to_angle(error.x), to_angle(error.y), to_angle(error.z)};
}

bool is_exhausted(const Joint& joint) {
    const std::int64_t most = joint.constants.grip;
    fixed::NormalisedVector size{};
    return fixed::normalise(joint.grip, size) && size.length >= most - most / 64;
}

bool is_beyond_drive(const Joint& joint, const Vec3& more) {
    fixed::NormalisedVector size{};
    return fixed::normalise(joint.grip + more, size) && size.length > joint.constants.grip;
}

void prepare_drive(Joint& joint, const Body& a) {
    joint.drag = {0, 0, 0};
    if (joint.constants.grip == 0) {
        joint.grip = {0, 0, 0};
        return;
    }
    joint.grip = driven_part(joint, a, joint.grip);
    if (joint.description.motor_torque != 0) {
        const std::int32_t kept = direction_one - 2 * joint.constants.motor_share;
        joint.grip = fixed::scaled(kept, joint.grip);
    }
}

void carry_drive_on(const Joint& joint, Body& a, Body& b) {
    if (joint.constants.grip != 0) {
        turn_apart(joint, a, b, joint.grip);
    }
}

Vec3 add_to_drive(Joint& joint, std::int32_t share) {
    const Vec3 before = joint.grip;
    joint.grip = within_grip(joint, before + fixed::scaled(share, before));
    return joint.grip - before;
}

std::int64_t work_of_turning(const Joint& joint, const Body& a, const Body& b, const Vec3& turned) {
    const auto at_reach = [&](std::int64_t angle) { return shifted(angle, joint.constants.reach); };
    const Vec3 half_turn = turned_since_start(a, b);
    const Vec3 push = to_motion({at_reach(turned.x), at_reach(turned.y), at_reach(turned.z)});
    const Vec3 way = to_motion(
        {at_reach(to_angle(half_turn.x)), at_reach(to_angle(half_turn.y)), at_reach(to_angle(half_turn.z))});
    return push.x * way.x + push.y * way.y + push.z * way.z;
}

void project_drive(Joint& joint, Body& a, Body& b) {
    if (joint.constants.drag_softness != 0) {
        drag(joint, a, b);
    }
    if (joint.constants.grip != 0 && !joint.motor_in_tree) {
        drive(joint, a, b);
    }
}

} // namespace lks
