#include "rigid/joint_turns.h"

#include <algorithm>

#include "fixed/arc_tangent.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// A joint's two axes in the world.
struct Axes {
    Direction a, b;
};

Axes axes_of(const Joint& joint, const Body& a, const Body& b) {
    return {fixed::rotate(a.rotation, joint.constants.axis_a),
            fixed::rotate(b.rotation, joint.constants.axis_b)};
}

// From a's frame to b's.
fixed::Rotation relative_rotation(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation in_a = fixed::multiply(narrow(a.orientation), joint.description.frame_a);
    const fixed::Rotation in_b = fixed::multiply(narrow(b.orientation), joint.description.frame_b);
    const fixed::Rotation q = fixed::multiply(fixed::conjugate(in_a), in_b);
    return q.w < 0 ? fixed::Rotation{-q.x, -q.y, -q.z, -q.w} : q;
}

// One row about an axis: what is to be turned, and by how much.
class TurnRow {
public:
    TurnRow(const Joint& joint, Body& a, Body& b, const Direction& axis) : a_(a), b_(b) {
        std::int64_t weight = 0;
        side_a_ = turn_side(a, joint.constants.shares.a, axis, joint.constants.reach, weight);
        side_b_ = turn_side(b, joint.constants.shares.b, axis, joint.constants.reach, weight);
        possible_ = weight >= 1 << 8;
        inverse_ = possible_ ? invert(weight) : Inverse{};
    }

    // What it takes to turn b against a by this angle about the axis.
    std::int64_t push_for(std::int64_t angle) const { return possible_ ? divide(angle, inverse_) : 0; }

    // Does so; the push that it took.
    std::int64_t turn_by(std::int64_t angle) const {
        const std::int64_t p = push_for(angle);
        turn(a_, side_a_, p, -1);
        turn(b_, side_b_, p, 1);
        return p;
    }

private:
    Body& a_;
    Body& b_;
    RowSide side_a_{};
    RowSide side_b_{};
    Inverse inverse_{};
    bool possible_ = false;
};

// Of 30 fraction bits.
Vec3 sines(const Direction& u, const Direction& v) {
    const Vec3 exact = fixed::cross(u, v);
    const auto part = [](std::int64_t c) { return fixed::shift_right_rounded(c, 30); };
    return {part(exact.x), part(exact.y), part(exact.z)};
}

void turn_apart(const Joint& joint, Body& a, Body& b, const Vec3& p) {
    turn(a, joint.constants.shares.a, joint.constants.reach, p, -1);
    turn(b, joint.constants.shares.b, joint.constants.reach, p, 1);
}

// b is turned back against an error of 30 fraction bits, radians or sines; the push that it took.
Vec3 turn_back(const Joint& joint, Body& a, Body& b, const Vec3& error) {
    fixed::NormalisedVector way{};
    if (!fixed::normalise(error, way)) {
        return {0, 0, 0};
    }
    const std::int64_t angle = way.length * (std::int64_t{1} << (world_fraction_bits - 30));
    return fixed::scale(way.direction, TurnRow(joint, a, b, way.direction).turn_by(-angle));
}

// A hinge's axes apart: a sine and its direction. Beyond a right angle: a right angle's worth; where they are
// opposite, about any axis across.
Vec3 axes_apart(const Joint& joint, const Body& a, const Body& b) {
    const auto [u, v] = axes_of(joint, a, b);
    const Vec3 error = sines(u, v);
    if (fixed::dot(u, v) >= 0) {
        return error;
    }
    fixed::NormalisedVector way{};
    if (!fixed::normalise(error, way)) {
        fixed::normalise(fixed::some_across(u), way);
    }
    return {way.direction.x, way.direction.y, way.direction.z};
}

// A fixed joint's frames apart: twice the sine of half the angle.
Vec3 frames_apart(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = relative_rotation(joint, a, b);
    const fixed::Matrix3 frame = fixed::to_matrix(joint.description.frame_a);
    const Direction in_a = fixed::rotate(frame, Direction{q.x, q.y, q.z});
    const Direction error = fixed::rotate(a.rotation, in_a);
    return {2 * std::int64_t{error.x}, 2 * std::int64_t{error.y}, 2 * std::int64_t{error.z}};
}

// What hinges and fixed joints don't let turn, 30 fraction bits.
Vec3 turned_apart(const Joint& joint, const Body& a, const Body& b) {
    return joint.description.kind == LKS_JOINT_HINGE   ? axes_apart(joint, a, b)
           : joint.description.kind == LKS_JOINT_FIXED ? frames_apart(joint, a, b)
                                                       : Vec3{0, 0, 0};
}

void limit_swing(const Joint& joint, Body& a, Body& b) {
    const auto [u, v] = axes_of(joint, a, b);
    const std::int32_t cosine = fixed::dot(u, v);
    if (cosine >= joint.constants.swing_cosine) {
        return;
    }
    fixed::NormalisedVector way{};
    if (!fixed::normalise(sines(u, v), way)) {
        fixed::normalise(fixed::some_across(u), way);
        way.length = 0;
    }
    const std::int64_t swing = fixed::angle_of(way.length, cosine);
    if (swing > joint.constants.swing_limit) {
        TurnRow(joint, a, b, way.direction).turn_by(joint.constants.swing_limit - swing);
    }
}

// The twist where it is beyond a limit; else anything between them. Half the twist is the angle of (q.w,
// q.y).
std::int64_t twist_beyond(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = relative_rotation(joint, a, b);
    const JointConstants& c = joint.constants;
    // Where the swing is a half turn there is no twist.
    if (std::int64_t{q.y} * q.y + std::int64_t{q.w} * q.w < std::int64_t{1} << 50) {
        return c.twist_min;
    }
    // sin(twist/2 − limit/2), times what is left of the swing.
    const std::int64_t above = std::int64_t{q.y} * c.half_max.cosine - std::int64_t{q.w} * c.half_max.sine;
    const std::int64_t below = std::int64_t{q.w} * c.half_min.sine - std::int64_t{q.y} * c.half_min.cosine;
    return above <= 0 && below <= 0 ? c.twist_min : 2 * fixed::angle_of(q.y, q.w);
}

void limit_twist(const Joint& joint, Body& a, Body& b) {
    const std::int64_t twist = twist_beyond(joint, a, b);
    const std::int64_t wanted = std::clamp(twist, joint.constants.twist_min, joint.constants.twist_max);
    if (wanted == twist) {
        return;
    }
    // About the middle of both axes.
    const auto [u, v] = axes_of(joint, a, b);
    fixed::NormalisedVector way{};
    if (fixed::normalise(Vec3{std::int64_t{u.x} + v.x, std::int64_t{u.y} + v.y, std::int64_t{u.z} + v.z},
                         way)) {
        TurnRow(joint, a, b, way.direction).turn_by(wanted - twist);
    }
}

// Resists turning within a substep, up to its greatest push.
void rub(Joint& joint, Body& a, Body& b) {
    if (joint.constants.friction == 0) {
        return;
    }
    const Vec3 turned = half_turn_between(b.start_orientation, b.orientation) -
                        half_turn_between(a.start_orientation, a.orientation);
    fixed::NormalisedVector way{};
    if (!fixed::normalise(turned, way)) {
        return;
    }
    // Half turns in Turn format to angles in World.
    const std::int64_t angle = way.length >> (turn_fraction_bits - world_fraction_bits - 1);
    const TurnRow row(joint, a, b, way.direction);
    const std::int64_t wanted = row.push_for(-angle);
    const Vec3 before = joint.grip;
    Vec3 total = before + fixed::scale(way.direction, wanted);
    fixed::NormalisedVector size{};
    if (fixed::normalise(total, size) && size.length > joint.constants.friction) {
        total = fixed::scale(size.direction, joint.constants.friction);
    }
    joint.grip = total;
    turn_apart(joint, a, b, total - before);
}

} // namespace

JointAngles joint_angles(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = relative_rotation(joint, a, b);
    const auto [u, v] = axes_of(joint, a, b);
    fixed::NormalisedVector way{};
    const bool apart = fixed::normalise(sines(u, v), way);
    return {fixed::angle_of(apart ? way.length : 0, fixed::dot(u, v)), 2 * fixed::angle_of(q.y, q.w)};
}

void project_turns(Joint& joint, Body& a, Body& b, bool forward) {
    if (forward) {
        rub(joint, a, b);
    }
    if (joint.description.kind == LKS_JOINT_HINGE || joint.description.kind == LKS_JOINT_FIXED) {
        joint.turn = joint.turn + turn_back(joint, a, b, turned_apart(joint, a, b));
        clamp_vector(joint.turn, greatest_push);
    }
    if (joint.constants.swing_limited) {
        limit_swing(joint, a, b);
    }
    if (joint.constants.twist_limited) {
        limit_twist(joint, a, b);
    }
}

} // namespace lks
