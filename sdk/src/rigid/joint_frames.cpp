#include "rigid/joint_frames.h"

#include "fixed/arc_tangent.h"

namespace lks {

using fixed::Direction;
using fixed::Vec3;

JointAxes axes_of(const Joint& joint, const Body& a, const Body& b) {
    return {fixed::rotate(a.rotation, joint.constants.axis_a),
            fixed::rotate(b.rotation, joint.constants.axis_b)};
}

fixed::Rotation relative_rotation(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation in_a = fixed::multiply(narrow(a.orientation), joint.description.frame_a);
    const fixed::Rotation in_b = fixed::multiply(narrow(b.orientation), joint.description.frame_b);
    const fixed::Rotation q = fixed::multiply(fixed::conjugate(in_a), in_b);
    return q.w < 0 ? fixed::Rotation{-q.x, -q.y, -q.z, -q.w} : q;
}

Direction from_frame_a(const Joint& joint, const Body& a, const Direction& v) {
    return fixed::rotate(a.rotation, fixed::rotate(fixed::to_matrix(joint.description.frame_a), v));
}

Vec3 sines(const Direction& u, const Direction& v) {
    const Vec3 exact = fixed::cross(u, v);
    const auto part = [](std::int64_t c) { return fixed::shift_right_rounded(c, 30); };
    return {part(exact.x), part(exact.y), part(exact.z)};
}

void turn_apart(const Joint& joint, Body& a, Body& b, const Vec3& p) {
    turn(a, joint.constants.shares.a, joint.constants.reach, p, -1);
    turn(b, joint.constants.shares.b, joint.constants.reach, p, 1);
}

TurnRow::TurnRow(const Joint& joint, Body& a, Body& b, const Direction& axis, std::int64_t softness)
    : a_(a), b_(b) {
    std::int64_t weight = softness;
    side_a_ = turn_side(a, joint.constants.shares.a, axis, joint.constants.reach, weight);
    side_b_ = turn_side(b, joint.constants.shares.b, axis, joint.constants.reach, weight);
    possible_ = weight >= 1 << 8;
    inverse_ = possible_ ? invert(weight) : Inverse{};
}

void TurnRow::apply(std::int64_t p) const {
    turn(a_, side_a_, p, -1);
    turn(b_, side_b_, p, 1);
}

std::int64_t TurnRow::turn_by(std::int64_t angle) const {
    const std::int64_t p = push_for(angle);
    apply(p);
    return p;
}

void turn_back(const Joint& joint, Body& a, Body& b, const Direction& axis, std::int64_t angle,
               std::int64_t softness, Vec3& push) {
    const std::int64_t left = soften(softness, angle, fixed::dot(axis, push));
    const TurnRow row(joint, a, b, axis, softness);
    push = push + fixed::scale(axis, row.turn_by(-left));
    clamp_vector(push, greatest_push);
}

JointAngles joint_angles(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = relative_rotation(joint, a, b);
    const auto [u, v] = axes_of(joint, a, b);
    fixed::NormalisedVector way{};
    const bool apart = fixed::normalise(sines(u, v), way);
    return {fixed::angle_of(apart ? way.length : 0, fixed::dot(u, v)), 2 * fixed::angle_of(q.y, q.w)};
}

SwingParts swing_parts(const Joint& joint, const Body& a, const Body& b) {
    const std::int64_t swing = joint_angles(joint, a, b).swing;
    const Direction v = axes_of(joint, a, b).b;
    const auto across = [&](int axis) {
        return std::int64_t{fixed::dot(fixed::rotate(a.rotation, joint.constants.across_a[axis]), v)};
    };
    fixed::NormalisedVector way{};
    if (!fixed::normalise(fixed::Vec3{across(0), across(1), 0}, way)) {
        return {swing, 0}; // none, or all the way round
    }
    return {fixed::scale_component(way.direction.x, swing), fixed::scale_component(way.direction.y, swing)};
}

} // namespace lks
