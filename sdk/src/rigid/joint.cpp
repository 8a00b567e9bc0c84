#include "rigid/joint.h"

#include "collide/saturation.h"
#include "rigid/joint_distance.h"
#include "rigid/joint_drive.h"
#include "rigid/joint_frames.h"
#include "rigid/joint_limits.h"
#include "rigid/joint_turns.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Soft joints and distances begin each substep anew, as XPBD has them.
bool keeps_push(const Joint& joint) {
    return !is_distance(joint) && joint.constants.points.softness == 0 &&
           joint.constants.angular_softness == 0;
}

void push_apart(const Joint& joint, Body& a, Body& b, const Vec3& p) {
    push(a, joint.side_a, p, -1);
    push(b, joint.side_b, p, 1);
}

// Trees solve the points of their joints; motors bring them together within their rounds all the same.
bool needs_block(const Joint& joint) {
    return !is_distance(joint) && (!joint.in_tree || joint.description.motor_torque != 0);
}

// Friction, or a motor, begins with what held the load in the substep before, which turns the bodies about
// their centres; what holds the points of a soft joint begins from nothing. Until it has pushed, that turn
// looks like one to be stopped, and the joint would let go in each substep of what it holds.
bool drives_before_points(const Joint& joint) {
    return joint.constants.grip != 0 && !keeps_push(joint) && !is_distance(joint) && !joint.in_tree;
}

// How far such a turn moves a point, to first order.
Vec3 moved_by(const Move& turn, const Vec3& lever) {
    const Vec3& h = turn.half_turn;
    const auto part = [](std::int64_t x, std::int64_t v, std::int64_t y, std::int64_t u) {
        constexpr int down = half_turn_fraction_bits - 1;
        return fixed::multiply_shift(x, v, down) - fixed::multiply_shift(y, u, down);
    };
    return {part(h.y, lever.z, h.z, lever.y), part(h.z, lever.x, h.x, lever.z),
            part(h.x, lever.y, h.y, lever.x)};
}

// What friction or the motor carries on, and with it what it takes to hold the points: together they turn the
// bodies about the joint, where one after the other would turn them to and fro by more than is of first
// order.
void carry_drive_with_points(Joint& joint, Body& a, Body& b) {
    const JointConstants& c = joint.constants;
    Move move_a = turning_move_of(a, c.shares.a, c.reach, joint.grip, -1);
    Move move_b = turning_move_of(b, c.shares.b, c.reach, joint.grip, 1);
    const Vec3 turned = moved_by(move_b, fixed::rotate(b.rotation, joint.description.point_b)) -
                        moved_by(move_a, fixed::rotate(a.rotation, joint.description.point_a));
    const Vec3 offset = joint_offset(joint, a, b) + turned;
    joint.push = next_push(joint.inverse, c.points, offset, offset - joint.begin, {0, 0, 0});
    add_move(move_of(a, joint.side_a, joint.push, -1), move_a);
    add_move(move_of(b, joint.side_b, joint.push, 1), move_b);
    apply(a, move_a);
    apply(b, move_b);
}

// The points together, in all directions at once (XPBD eq. 18).
void project_points(Joint& joint, Body& a, Body& b) {
    const Vec3 offset = joint_offset(joint, a, b);
    const Vec3 before = joint.push;
    joint.push =
        next_push(joint.inverse, joint.constants.points, offset - joint.start, offset - joint.begin, before);
    push_apart(joint, a, b, joint.push - before);
}

} // namespace

Vec3 joint_offset(const Joint& joint, const Body& a, const Body& b) {
    // Points are near their bodies, but bodies may be as far apart as the world is wide.
    return saturating_add(saturating_subtract(b.position, a.position),
                          fixed::rotate(b.rotation, joint.description.point_b) -
                              fixed::rotate(a.rotation, joint.description.point_a));
}

Vec3 points_apart(const Joint& joint, const Body& a, const Body& b, bool in_substep) {
    const Vec3 offset = joint_offset(joint, a, b);
    return in_substep || has_soft_points(joint.constants) ? offset - joint.start : offset;
}

Vec3 left_of_points(const Joint& joint, const Body& a, const Body& b) {
    const Vec3 apart = points_apart(joint, a, b, true);
    return left_of(joint.constants.points, apart, apart - joint.begin, joint.push);
}

void forget_pushes(Joint& joint) {
    const JointDescription description = joint.description;
    const JointConstants constants = joint.constants;
    const fixed::Rotation motor_target = joint.motor_target;
    joint = Joint{};
    joint.motor_target = motor_target;
    joint.description = description;
    joint.constants = constants;
}

void begin_substep(Joint& joint, const Body& a, const Body& b) {
    joint.begin = joint_offset(joint, a, b);
    joint.start = keeps_push(joint) ? joint.begin : Vec3{0, 0, 0};
    if (is_distance(joint)) {
        begin_distance(joint, a, b);
    }
    if (joint.in_tree) {
        joint.tension = sum_of_magnitudes(joint.push);
        joint.push = {0, 0, 0};
    } else {
        clamp_vector(joint.push, greatest_push); // it may have been in an uneven tree
    }
    aim_motor(joint, a, b);
    begin_limits(joint, a, b);
    begin_turn(joint, a, b);
}

void prepare_pushes(Joint& joint, const Body& a, const Body& b) {
    const JointDescription& d = joint.description;
    prepare_turn(joint, a, b);
    prepare_limits(joint);
    prepare_drive(joint, a);
    if (!keeps_push(joint)) {
        joint.push = {0, 0, 0};
    }
    if (needs_block(joint)) {
        const std::int64_t softness = joint.constants.points.softness;
        std::int64_t k[6] = {softness, 0, 0, softness, 0, softness};
        joint.side_a = block_side(a, joint.constants.shares.a, fixed::rotate(a.rotation, d.point_a), k);
        joint.side_b = block_side(b, joint.constants.shares.b, fixed::rotate(b.rotation, d.point_b), k);
        joint.inverse = invert_block(k);
    }
}

void carry_pushes_on(Joint& joint, Body& a, Body& b) {
    carry_turn_on(joint, a, b);
    carry_limits_on(joint, a, b);
    if (drives_before_points(joint)) {
        carry_drive_with_points(joint, a, b);
        return;
    }
    carry_drive_on(joint, a, b);
    if (!is_distance(joint) && !joint.in_tree) {
        push_apart(joint, a, b, joint.push);
    }
}

void carry_more(Joint& joint, Body& a, Body& b, std::int32_t share) {
    turn_apart(joint, a, b, add_to_turn(joint, share));
    carry_more_limits(joint, a, b, share);
    turn_apart(joint, a, b, add_to_drive(joint, share));
    if (keeps_push(joint) && !joint.in_tree) {
        const Vec3 more = fixed::scaled(share, joint.push);
        joint.push = joint.push + more;
        clamp_vector(joint.push, greatest_push);
        push_apart(joint, a, b, more);
    }
}

Vec3 carried_turn(const Joint& joint, const Body& a, const Body& b) {
    return joint.turn + limit_push(joint, a, b) + joint.grip;
}

Vec3 add_to_carried_turn(Joint& joint, const Body& a, const Body& b, std::int32_t share) {
    const Vec3 before = carried_turn(joint, a, b);
    add_to_turn(joint, share);
    add_to_limits(joint, share);
    add_to_drive(joint, share);
    return carried_turn(joint, a, b) - before;
}

void add_up_pushes(Joint& joint, const Body& a, const Body& b) {
    joint.pushed = saturating_add(joint.pushed, joint.push);
    clamp_vector(joint.pushed, greatest_pushed);
    joint.turned = joint.turned + joint.turn + limit_push(joint, a, b) + joint.grip + joint.drag;
}

bool undo_error(const Joint& joint, Body& a, Body& b, bool pinned) {
    undo_turn(joint, a, b);
    const bool far_off = undo_limits(joint, a, b);
    if (is_distance(joint)) {
        if (!joint.in_tree) {
            undo_distance(joint, a, b);
        }
    } else if (keeps_push(joint) && !joint.in_tree && !pinned) {
        Vec3 error = joint_offset(joint, a, b);
        clamp_vector(error, greatest_step);
        push_apart(joint, a, b, -solve(joint.inverse, error));
    }
    // Nobody does so behind it.
    for (Body* body : {&a, &b}) {
        if (body->is_awake()) {
            body->orientation = normalise(body->orientation);
            body->follow_orientation();
        }
    }
    return far_off;
}

void project(Joint& joint, Body& a, Body& b) {
    if (drives_before_points(joint)) {
        project_turn(joint, a, b);
        project_points(joint, a, b);
    }
    // A motor's turn is about the joint, a row's about the centres of mass: with the points in between, some
    // rounds make one of the other. (With one round a spider's legs bent by 15°, with four by 5°.)
    constexpr int more_rounds = 3;
    for (int i = 0; i < more_rounds && joint.description.motor_torque != 0 && !joint.motor_in_tree; ++i) {
        project_drive(joint, a, b);
        project_points(joint, a, b);
    }
    project_drive(joint, a, b);
    project_turn(joint, a, b);
    project_limits(joint, a, b);
    if (joint.in_tree) {
        return;
    }
    if (is_distance(joint)) {
        project_distance(joint, a, b);
    } else {
        project_points(joint, a, b);
    }
}

bool breaks(const Joint& joint) {
    return exceeds(joint.pushed, joint.constants.break_push) ||
           exceeds(joint.turned, joint.constants.break_turn);
}

} // namespace lks
