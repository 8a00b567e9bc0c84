#include "rigid/closure_tree.h"

#include "rigid/articulation.h"
#include "rigid/articulation_joint.h"
#include "rigid/held_tree.h"
#include "rigid/joint_drive.h"
#include "rigid/joint_turns.h"
#include "rigid/uneven_tree.h"

namespace lks {

using namespace tree_detail;
using fixed::Vec3;

namespace {

constexpr int more_bits = fine_fraction_bits - tree_fraction_bits;

// Of turns: by so small a part of what their bodies by themselves give way by they are soft.
constexpr int turn_give_shift = 20;

bool rests(const ArticulatedBody& part) {
    return part.shift == Vec3{0, 0, 0} && part.turn == Vec3{0, 0, 0};
}

} // namespace

Vec3 fine_axis_in_units(const Body& body, const Joint& joint, const fixed::Direction& axis) {
    return shifted({axis.x, axis.y, axis.z},
                   fine_fraction_bits - direction_fraction_bits + joint.constants.reach - body.scale);
}

ClosureTreeJoint& ClosureTree::rows_of(const ArticulatedJoint& part) {
    return scene_.closure_tree_joints[static_cast<std::size_t>(&part - scene_.tree_joints.begin())];
}

void ClosureTree::place(const ArticulatedJoint& part, const Joint& joint, ClosureTreeJoint& rows) {
    HeldRow turns[most_held_rows];
    rows.first_drive = turn_rows(joint, body_a(joint), body_b(joint), true, turns);
    rows.turn_count =
        rows.first_drive + drive_rows(joint, body_a(joint), body_b(joint), turns + rows.first_drive);
    rows.parent_lever = lever_in_units(scene_.bodies[part.parent], point_of(joint, !part.child_is_a));
    if (part.child_moves) {
        rows.child_lever = lever_in_units(scene_.bodies[part.child], point_of(joint, part.child_is_a));
    }
    for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
        rows.axes[i] = turns[i].axis;
        rows.child_axes[i] = fine_axis_in_units(scene_.bodies[part.child], joint, turns[i].axis);
        rows.parent_axes[i] = fine_axis_in_units(scene_.bodies[part.parent], joint, turns[i].axis);
    }
}

void ClosureTree::factor(bool springs_give) {
    for_each_body(
        [](Body& body, ArticulatedBody& part) { part.inverse = own_fine_inverse(body, part.fine_share); });
    for_each_joint_back([&](const ArticulatedJoint& part, const Joint& joint) {
        ClosureTreeJoint& rows = rows_of(part);
        place(part, joint, rows);
        factor_joint(part, joint, springs_give, rows);
        if (&part != &scene_.tree_joints[range_.first_joint]) {
            Algebra::fold_in(scene_.articulated[part.parent].inverse, rows);
        }
    });
}

void ClosureTree::factor_joint(const ArticulatedJoint& part, const Joint& joint, bool springs_give,
                               ClosureTreeJoint& rows) {
    std::int64_t d[most_rows][most_rows] = {};
    Wrench wrenches[most_rows];
    if (part.child_moves) {
        rows.system.count = find_wrenches(rows, rows.child_lever, rows.child_axes, wrenches);
        Algebra::add_motions(scene_.articulated[part.child].inverse, wrenches, rows, d);
    }
    rows.system.count = find_wrenches(rows, rows.parent_lever, rows.parent_axes, wrenches);
    Algebra::add_motions(scene_.articulated[part.parent].inverse, wrenches, rows, d);
    for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
        const std::int64_t by_child = part.child_moves ? own_turn_about(part.child, rows.child_axes[i]) : 0;
        const std::int64_t own = plus(by_child, own_turn_about(part.parent, rows.parent_axes[i]));
        std::int64_t& entry = d[point_rows + static_cast<int>(i)][point_rows + static_cast<int>(i)];
        entry = plus(entry, own >> turn_give_shift);
    }
    if (springs_give) {
        const std::int64_t give = points_give(joint, part.pair_share) * (std::int64_t{1} << more_bits);
        for (int row = 0; row < point_rows; ++row) {
            d[row][row] = plus(d[row][row], give);
        }
    }
    Algebra::factor_rows(d, rows);
}

int ClosureTree::find_wrenches(const ClosureTreeJoint& rows, const Vec3& lever,
                               const Vec3 (&axes)[most_held_rows], Wrench (&wrenches)[most_rows]) const {
    Algebra::find_point_wrenches(lever, wrenches);
    int count = point_rows;
    for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
        wrenches[count++] = {{0, 0, 0}, axes[i]};
    }
    return count;
}

std::int64_t ClosureTree::own_turn_about(std::uint32_t body, const Vec3& axis) const {
    return Algebra::dot(
        axis, own_turn<fine_fraction_bits>(scene_.bodies[body], scene_.articulated[body].fine_share, axis));
}

bool ClosureTree::is_apart() const {
    constexpr std::int64_t most = world_one / 10000000;
    for (std::uint32_t i = range_.first_joint; i < range_.joint_end; ++i) {
        const Joint& joint = scene_.joints[scene_.tree_joints[i].joint];
        const JointDescription& d = joint.description;
        if (sum_of_magnitudes(points_apart(joint, scene_.bodies[d.body_a], scene_.bodies[d.body_b], false)) >
            most) {
            return true;
        }
    }
    return false;
}

void ClosureTree::carry(std::uint32_t body, const Vec3& lever, const Vec3& push) {
    ArticulatedBody& part = scene_.articulated[body];
    const Inverse inverse = invert_pivot(part.share);
    const Vec3 force{divide(push.x, inverse), divide(push.y, inverse), divide(push.z, inverse)};
    part.carried_force = part.carried_force + force;
    part.carried_torque = part.carried_torque + cross_32(lever, force);
}

void ClosureTree::begin() {
    for_each_body([](const Body&, ArticulatedBody& part) {
        part.shift = part.turn = part.force = part.torque = {0, 0, 0};
    });
}

void ClosureTree::add_own_motion(std::uint32_t body, const Wrench& push) {
    const OwnMotion own = own_motion(body, push);
    ArticulatedBody& part = scene_.articulated[body];
    part.shift = part.shift + own.shift;
    part.turn = part.turn + own.turn;
}

void ClosureTree::solve(bool in_substep) {
    for_each_body([](const Body& body, ArticulatedBody& part) {
        part.force = part.torque = {0, 0, 0};
        part.shift = rounded_share<fine_fraction_bits>(part.fine_share, part.carried_force);
        part.turn = own_turn<fine_fraction_bits>(body, part.fine_share, part.carried_torque);
    });
    for_each_joint_back([&](const ArticulatedJoint& part, const Joint& joint) {
        fold_errors(part, joint, in_substep, rows_of(part));
    });
    for_each_joint([this](const ArticulatedJoint& part, const Joint&) { hand_down(part, rows_of(part)); });
    for_each_body([](const Body&, ArticulatedBody& part) {
        part.force = part.force + part.carried_force;
        part.torque = part.torque + part.carried_torque;
    });
}

void ClosureTree::fold_errors(const ArticulatedJoint& part, const Joint& joint, bool in_substep,
                              ClosureTreeJoint& rows) {
    const Body& a = body_a(joint);
    const Body& b = body_b(joint);
    Vec3 apart = in_substep ? left_of_points(joint, a, b) : points_apart(joint, a, b, false);
    if (!in_substep) {
        clamp_vector(apart, greatest_step);
    }
    std::int64_t turned[most_held_rows] = {};
    Vec3 error = turn_error(joint, a, b, in_substep);
    if (in_substep && rows.first_drive != rows.turn_count) {
        error = error + drive_error(joint, a, b);
    }
    for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
        const std::int64_t about =
            std::clamp(fixed::dot(rows.axes[i], error), -most_turned_back, most_turned_back);
        turned[i] = lks::shifted(part.child_is_a ? -about : about, joint.constants.reach);
    }
    fold_rest(part, part.child_is_a ? -apart : apart, turned, rows);
}

void ClosureTree::spread() {
    for_each_joint_back([this](const ArticulatedJoint& part, const Joint&) { fold(part, rows_of(part)); });
    for_each_joint([this](const ArticulatedJoint& part, const Joint&) { hand_down(part, rows_of(part)); });
}

void ClosureTree::fold(const ArticulatedJoint& part, ClosureTreeJoint& rows) {
    ArticulatedBody& parent = scene_.articulated[part.parent];
    if (rests(parent) && (!part.child_moves || rests(scene_.articulated[part.child]))) {
        std::fill(std::begin(rows.push), std::end(rows.push), 0);
        return;
    }
    fold_rest(part, {0, 0, 0}, {}, rows);
}

// With what is beyond.
void ClosureTree::fold_rest(const ArticulatedJoint& part, const Vec3& apart,
                            const std::int64_t (&turned)[most_held_rows], ClosureTreeJoint& rows) {
    ArticulatedBody& parent = scene_.articulated[part.parent];
    Vec3 points = apart - point_motion(parent, rows.parent_lever);
    if (part.child_moves) {
        points = points + point_motion(scene_.articulated[part.child], rows.child_lever);
    }
    std::int64_t left[most_rows] = {points.x, points.y, points.z};
    for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
        const std::int64_t by_child =
            part.child_moves ? Algebra::dot(rows.child_axes[i], scene_.articulated[part.child].turn) : 0;
        left[point_rows + i] =
            plus(turned[i], minus(by_child, Algebra::dot(rows.parent_axes[i], parent.turn)));
    }
    Algebra::fold_rows(left, greatest_uneven_push, rows, parent);
}

void ClosureTree::hand_down(const ArticulatedJoint& part, ClosureTreeJoint& rows) {
    ArticulatedBody& parent = scene_.articulated[part.parent];
    Algebra::push_more(greatest_uneven_push, rows, parent);
    const Vec3 push{rows.push[0], rows.push[1], rows.push[2]};
    add_force(parent, rows.parent_lever, -push);
    for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
        parent.torque = parent.torque - Algebra::multiply(rows.push[point_rows + i], rows.parent_axes[i]);
    }
    if (part.child_moves) {
        ArticulatedBody& child = scene_.articulated[part.child];
        add_force(child, rows.child_lever, push);
        for (std::uint32_t i = 0; i < rows.turn_count; ++i) {
            child.torque = child.torque + Algebra::multiply(rows.push[point_rows + i], rows.child_axes[i]);
        }
    }
}

void ClosureTree::add_push(std::uint32_t body, const Wrench& push) {
    ArticulatedBody& part = scene_.articulated[body];
    part.force = part.force + push.force;
    part.torque = part.torque + push.torque;
}

std::int64_t ClosureTree::greatest_bend() const {
    std::int64_t most = 0;
    for (std::uint32_t i = range_.first_body; i < range_.body_end; ++i) {
        const std::uint32_t index = scene_.tree_bodies[i];
        const Vec3 half_turn = move_uneven(scene_.bodies[index], scene_.articulated[index]).half_turn;
        const std::int64_t turn = std::min(2 * sum_of_magnitudes(half_turn), std::int64_t{1} << 44);
        // Half of θ² on a lever of its unit of length.
        most = std::max(most, lks::shifted(multiply_40(turn, turn), scene_.bodies[index].scale - 1));
    }
    return most;
}

OwnMotion ClosureTree::own_motion(std::uint32_t body, const Wrench& push) const {
    const std::int64_t share = scene_.articulated[body].fine_share;
    return {rounded_share<fine_fraction_bits>(share, push.force),
            own_turn<fine_fraction_bits>(scene_.bodies[body], share, push.torque)};
}

std::int64_t ClosureTree::own_give(std::uint32_t body, const Wrench& push) const {
    const OwnMotion own = own_motion(body, push);
    return Algebra::along(push, own.shift, own.turn);
}

void ClosureTree::move() {
    for_each_body([](Body& body, ArticulatedBody& part) {
        apply(body, move_uneven(body, part));
        part.carried_force = part.carried_torque = {0, 0, 0};
    });
}

void ClosureTree::keep_pushes() {
    for_each_joint([this](const ArticulatedJoint& part, Joint& joint) {
        const ClosureTreeJoint& rows = rows_of(part);
        const Vec3 push{rows.push[0], rows.push[1], rows.push[2]};
        add_tree_push(joint, multiply_32(part.pair_share, part.child_is_a ? -push : push), range_.is_uneven);
        joint.turn = joint.turn + turned_by(part, joint, rows, 0, rows.first_drive);
        clamp_vector(joint.turn, greatest_push);
        joint.grip = joint.grip + turned_by(part, joint, rows, rows.first_drive, rows.turn_count);
    });
}

// By its last pushes, of some of its rows.
Vec3 ClosureTree::turned_by(const ArticulatedJoint& part, const Joint& joint, const ClosureTreeJoint& rows,
                            std::uint32_t first, std::uint32_t end) const {
    Vec3 sum{0, 0, 0};
    for (std::uint32_t i = first; i < end; ++i) {
        const std::int64_t turned = rows.push[point_rows + i];
        const std::int64_t more = lks::shifted(
            lks::multiply_32(part.pair_share, part.child_is_a ? -turned : turned), -joint.constants.reach);
        sum = sum + fixed::scale(rows.axes[i], more);
    }
    return sum;
}

bool ClosureTree::drop_motors() {
    bool any = false;
    for_each_joint([&](const ArticulatedJoint& part, Joint& joint) {
        const ClosureTreeJoint& rows = rows_of(part);
        if (joint.motor_in_tree &&
            is_beyond_drive(joint, turned_by(part, joint, rows, rows.first_drive, rows.turn_count))) {
            joint.motor_in_tree = false;
            any = true;
        }
    });
    return any;
}

void ClosureTree::take_motors() {
    for_each_joint([](const ArticulatedJoint&, Joint& joint) { joint.motor_in_tree = has_motor(joint); });
}

} // namespace lks
