#include "rigid/joint_turns.h"

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

} // namespace

void begin_turn(Joint& joint, const Body& a, const Body& b) {
    joint.turn_start = {0, 0, 0};
    if (holds_turn(joint) && keeps_turn(joint)) {
        joint.turn_start = turned_apart(joint, a, b);
    }
}

void warm_start_turn(Joint& joint, Body& a, Body& b) {
    if (!holds_turn(joint) || !keeps_turn(joint)) {
        joint.turn = {0, 0, 0};
    } else {
        turn_apart(joint, a, b, joint.turn);
    }
}

void carry_more_turn(Joint& joint, Body& a, Body& b, std::int32_t share) {
    if (holds_turn(joint) && keeps_turn(joint)) {
        const Vec3 more = fixed::scaled(share, joint.turn);
        joint.turn = joint.turn + more;
        clamp_vector(joint.turn, greatest_push);
        turn_apart(joint, a, b, more);
    }
}

void project_turn(Joint& joint, Body& a, Body& b) {
    if (!holds_turn(joint)) {
        return;
    }
    fixed::NormalisedVector way{};
    if (!fixed::normalise(turned_apart(joint, a, b) - joint.turn_start, way)) {
        return;
    }
    turn_back(joint, a, b, way.direction, to_world_angle(way.length), joint.constants.angular_softness,
              joint.turn);
}

void undo_turn(const Joint& joint, Body& a, Body& b) {
    fixed::NormalisedVector way{};
    if (holds_turn(joint) && keeps_turn(joint) && fixed::normalise(turned_apart(joint, a, b), way)) {
        TurnRow(joint, a, b, way.direction).turn_by(-to_world_angle(way.length));
    }
}

} // namespace lks
