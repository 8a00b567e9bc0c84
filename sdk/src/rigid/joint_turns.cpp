#include "rigid/joint_turns.h"

#include <algorithm>
#include <bit>

#include "fixed/arc_tangent.h"
#include "rigid/joint_frames.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

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
    const Direction error = from_frame_a(joint, a, {q.x, q.y, q.z});
    return {2 * std::int64_t{error.x}, 2 * std::int64_t{error.y}, 2 * std::int64_t{error.z}};
}

// What hinges and fixed joints don't let turn, 30 fraction bits.
Vec3 turned_apart(const Joint& joint, const Body& a, const Body& b) {
    return joint.description.kind == LKS_JOINT_HINGE   ? axes_apart(joint, a, b)
           : joint.description.kind == LKS_JOINT_FIXED ? frames_apart(joint, a, b)
                                                       : Vec3{0, 0, 0};
}

bool holds_turn(const Joint& joint) {
    return joint.description.kind == LKS_JOINT_HINGE || joint.description.kind == LKS_JOINT_FIXED;
}

// Soft ones begin each substep anew, as XPBD has them.
bool keeps_turn(const Joint& joint) {
    return joint.constants.angular_softness == 0;
}

// K with what it has along u and across it taken out, and one along it put in: as large as the greatest.
void replace_axis(const Direction& u, std::int64_t (&k)[6]) {
    const auto dot = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        return (x * u.x + y * u.y + z * u.z) >> 30;
    };
    const std::int64_t v[3] = {dot(k[0], k[1], k[2]), dot(k[1], k[3], k[4]), dot(k[2], k[4], k[5])};
    const std::int64_t along = dot(v[0], v[1], v[2]) + std::max({k[0], k[3], k[5]});
    const std::int64_t axis[3] = {u.x, u.y, u.z};
    int entry = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            k[entry++] +=
                ((along * ((axis[i] * axis[j]) >> 30)) >> 30) - ((axis[i] * v[j] + v[i] * axis[j]) >> 30);
        }
    }
}

// K⁻¹ of turning pushes in all directions; hinges let nothing be pushed about their axis, which an entry of
// its own takes the place of.
BlockInverse invert_turning(const Joint& joint, const Body& a, const Body& b) {
    const JointConstants& c = joint.constants;
    std::int64_t k[6] = {c.angular_softness, 0, 0, c.angular_softness, 0, c.angular_softness};
    add_turning_block(a, c.shares.a, c.reach, k);
    add_turning_block(b, c.shares.b, c.reach, k);
    const std::int64_t greatest = std::max({k[0], k[3], k[5]});
    if (greatest <= 0) {
        return {};
    }
    // The greatest of the diagonal from 2^29 to 2^30.
    const int up = std::countl_zero(static_cast<std::uint64_t>(greatest)) - 34;
    for (std::int64_t& entry : k) {
        entry = up >= 0 ? entry * (std::int64_t{1} << up) : entry >> -up;
    }
    if (joint.description.kind == LKS_JOINT_HINGE) {
        replace_axis(fixed::rotate(a.rotation, c.axis_a), k);
    }
    BlockInverse inverse = invert_block(k);
    inverse.shift += up;
    return inverse;
}

// What the joint has to turn by, World.
Vec3 angle_of(const Vec3& turned) {
    return {to_world_angle(turned.x), to_world_angle(turned.y), to_world_angle(turned.z)};
}

// The same of soft ones, which give way by the angle: at 11° its sine is 0.6 % less.
Vec3 soft_axes_apart(const Joint& joint, const Body& a, const Body& b) {
    fixed::NormalisedVector way{};
    if (!fixed::normalise(axes_apart(joint, a, b), way)) {
        return {0, 0, 0};
    }
    const auto [u, v] = axes_of(joint, a, b);
    const auto sine = static_cast<std::int64_t>(fixed::length(sines(u, v)));
    return fixed::scale(way.direction, fixed::angle_of(sine, fixed::dot(u, v)));
}

Vec3 soft_frames_apart(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = relative_rotation(joint, a, b);
    fixed::NormalisedVector half{};
    if (!fixed::normalise(Vec3{q.x, q.y, q.z}, half)) {
        return {0, 0, 0};
    }
    return fixed::scale(from_frame_a(joint, a, half.direction), 2 * fixed::angle_of(half.length, q.w));
}

// With what a soft one's push so far asks for.
Vec3 left_to_turn(const Joint& joint, const Body& a, const Body& b) {
    if (keeps_turn(joint)) {
        return angle_of(turned_apart(joint, a, b) - joint.turn_start);
    }
    const Vec3 angle = joint.description.kind == LKS_JOINT_HINGE ? soft_axes_apart(joint, a, b)
                                                                 : soft_frames_apart(joint, a, b);
    const std::int64_t softness = joint.constants.angular_softness;
    return {soften(softness, angle.x, joint.turn.x), soften(softness, angle.y, joint.turn.y),
            soften(softness, angle.z, joint.turn.z)};
}

} // namespace

void begin_turn(Joint& joint, const Body& a, const Body& b) {
    joint.turn_start = {0, 0, 0};
    if (holds_turn(joint) && keeps_turn(joint)) {
        joint.turn_start = turned_apart(joint, a, b);
    }
}

void prepare_turn(Joint& joint, const Body& a, const Body& b) {
    if (!holds_turn(joint)) {
        return;
    }
    joint.turn_inverse = invert_turning(joint, a, b);
    if (!keeps_turn(joint) || joint.turns_in_tree) {
        joint.turn = {0, 0, 0};
        return;
    }
    if (joint.description.kind == LKS_JOINT_HINGE) {
        // The axis has turned since: what the old push has along it would drive the hinge, and nothing holds
        // it back.
        const Direction axis = fixed::rotate(a.rotation, joint.constants.axis_a);
        joint.turn = joint.turn - fixed::scale(axis, fixed::dot(axis, joint.turn));
    }
}

void carry_turn_on(const Joint& joint, Body& a, Body& b) {
    if (holds_turn(joint) && keeps_turn(joint)) {
        turn_apart(joint, a, b, joint.turn);
    }
}

Vec3 add_to_turn(Joint& joint, std::int32_t share) {
    if (!holds_turn(joint) || !keeps_turn(joint)) {
        return {0, 0, 0};
    }
    const Vec3 more = fixed::scaled(share, joint.turn);
    joint.turn = joint.turn + more;
    clamp_vector(joint.turn, greatest_push);
    return more;
}

void project_turn(Joint& joint, Body& a, Body& b) {
    if (!holds_turn(joint) || joint.turns_in_tree) {
        return;
    }
    const Vec3 before = joint.turn;
    joint.turn = before - solve(joint.turn_inverse, left_to_turn(joint, a, b));
    clamp_vector(joint.turn, greatest_push);
    turn_apart(joint, a, b, joint.turn - before);
}

void undo_turn(const Joint& joint, Body& a, Body& b) {
    if (holds_turn(joint) && keeps_turn(joint)) {
        turn_apart(joint, a, b, -solve(joint.turn_inverse, angle_of(turned_apart(joint, a, b))));
    }
}

std::uint32_t turn_rows(const Joint& joint, const Body& a, const Body& b, bool in_substep,
                        HeldRow (&rows)[most_held_rows]) {
    if (!holds_turn(joint) || !keeps_turn(joint)) {
        return 0;
    }
    Direction axes[3] = {{direction_one, 0, 0}, {0, direction_one, 0}, {0, 0, direction_one}};
    std::uint32_t count = 3;
    if (joint.description.kind == LKS_JOINT_HINGE) {
        const Direction u = fixed::rotate(a.rotation, joint.constants.axis_a);
        fixed::NormalisedVector across{};
        fixed::normalise(fixed::some_across(u), across);
        const Vec3 third = sines(u, across.direction);
        axes[0] = across.direction;
        axes[1] = {static_cast<std::int32_t>(third.x), static_cast<std::int32_t>(third.y),
                   static_cast<std::int32_t>(third.z)};
        count = 2;
    }
    const Vec3 turned = turned_apart(joint, a, b) - (in_substep ? joint.turn_start : Vec3{0, 0, 0});
    for (std::uint32_t i = 0; i < count; ++i) {
        rows[i] = {HeldRow::Kind::turn, axes[i], to_world_angle(fixed::dot(axes[i], turned)), 0};
    }
    return count;
}

Vec3 turn_error(const Joint& joint, const Body& a, const Body& b, bool in_substep) {
    HeldRow rows[most_held_rows];
    const std::uint32_t count = turn_rows(joint, a, b, in_substep, rows);
    Vec3 sum{0, 0, 0};
    for (std::uint32_t i = 0; i < count; ++i) {
        sum = sum + fixed::scale(rows[i].axis, rows[i].error);
    }
    return sum;
}

std::int64_t turned_away(const Joint& joint, const Body& a, const Body& b, bool in_substep) {
    HeldRow rows[most_held_rows];
    const std::uint32_t count = turn_rows(joint, a, b, in_substep, rows);
    std::int64_t most = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        most = std::max({most, rows[i].error, -rows[i].error});
    }
    return most;
}

} // namespace lks
