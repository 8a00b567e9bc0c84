#include "rigid/joint_limits.h"

#include <algorithm>

#include "collide/saturation.h"
#include "fixed/arc_tangent.h"
#include "rigid/joint_frames.h"
#include "rigid/swing_ellipse.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Half a degree: World, radians.
constexpr std::int64_t far_beyond = world_one / 115;

// How far a limit that pushes keeps off what is back within it by `gap`, where loads are far from the joint:
// of that it gives way to a 64th a substep. If it gave way to all at once, as it does for all others, it
// would push until the gap is closed, as hard as before. What hangs far from the joint a row turns by a small
// share only of what it means to, since the points hold the rest back: then the push falls by so little in
// each substep that the load has long left the limit when it ends, and falls back from higher up each time.
std::int64_t kept_gap(const Joint& joint, std::int64_t gap) {
    return joint.constants.loads_from_far && gap > 0 ? gap - gap / 64 : 0;
}

Swing measure_swing(const Joint& joint, const Body& a, const Direction& u, const Direction& v) {
    fixed::NormalisedVector way{};
    if (!fixed::normalise(sines(u, v), way)) {
        fixed::normalise(fixed::some_across(u), way);
        way.length = 0;
    }
    const JointConstants& c = joint.constants;
    const std::int64_t angle = fixed::angle_of(way.length, fixed::dot(u, v));
    return c.swing_round ? Swing{way.direction, angle, c.swing_limit}
                         : square_to_edge(c, a, v, way.direction, angle, way.length);
}

// As what has pushed in this substep knows it: what has been turned back past the middle, which a narrow cone
// lets it in a substep, has swung by less than nothing. So a push is taken back before the other side pushes.
void turn_to_push(const Joint& joint, Swing& swing) {
    if (joint.swing_push != 0 && fixed::dot(swing.axis, joint.swing_axis) < 0) {
        swing.axis = -swing.axis;
        swing.angle = -swing.angle;
    }
}

// False: certainly within the limit.
bool find_swing(const Joint& joint, const Body& a, const Body& b, Swing& swing) {
    const auto [u, v] = axes_of(joint, a, b);
    if (fixed::dot(u, v) >= joint.constants.swing_cosine && joint.swing_push == 0) {
        return false;
    }
    swing = measure_swing(joint, a, u, v);
    return true;
}

bool find_pushed_swing(const Joint& joint, const Body& a, const Body& b, Swing& swing) {
    if (!find_swing(joint, a, b, swing)) {
        return false;
    }
    turn_to_push(joint, swing);
    return true;
}

bool are_soft(const Joint& joint) {
    return joint.constants.limits.softness != 0;
}

// What has to be turned back, where `beyond` is now, and `start` was when the substep began; neither is less
// than zero but where it was turned back too far.
std::int64_t to_turn_back(const Joint& joint, std::int64_t beyond, std::int64_t start, std::int64_t push) {
    return are_soft(joint) ? soften(joint.constants.limits, beyond, beyond - start, -push) : beyond - start;
}

void hold_swing(Joint& joint, Body& a, Body& b) {
    Swing swing{};
    if (!find_pushed_swing(joint, a, b, swing)) {
        return;
    }
    joint.swing_axis = swing.axis;
    const TurnRow row(joint, a, b, swing.axis, joint.constants.limits.softness);
    const std::int64_t start = std::max(joint.swing_beyond, -joint.swing_gap);
    const std::int64_t beyond = to_turn_back(joint, swing.angle - swing.limit, start, joint.swing_push);
    const std::int64_t wanted =
        std::clamp<std::int64_t>(joint.swing_push + row.push_for(beyond), 0, greatest_push);
    const std::int64_t more = wanted - joint.swing_push;
    joint.swing_push = wanted;
    row.apply(-more);
}

// Sine and cosine of half the twist, times what is left of the swing: y and w of the rotation from a's frame
// to b's. The cosine is not negative.
SinCos half_twist(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = fixed::multiply(fixed::conjugate(narrow(a.orientation)), narrow(b.orientation));
    const auto part = [&q](const std::int32_t(&of)[4]) {
        const std::int64_t sum = std::int64_t{of[0]} * q.x + std::int64_t{of[1]} * q.y +
                                 std::int64_t{of[2]} * q.z + std::int64_t{of[3]} * q.w;
        return static_cast<std::int32_t>(fixed::shift_right_rounded(sum, 30));
    };
    const std::int32_t sine = part(joint.constants.twist_sine);
    const std::int32_t cosine = part(joint.constants.twist_cosine);
    return cosine < 0 ? SinCos{-sine, -cosine} : SinCos{sine, cosine};
}

// Where the swing is a half turn.
bool has_no_twist(const SinCos& half) {
    return std::int64_t{half.sine} * half.sine + std::int64_t{half.cosine} * half.cosine < std::int64_t{1}
                                                                                               << 50;
}

// What turns b about the middle of both axes twists it by more, the further it has swung: by one over the
// cosine of half the swing, which goes to infinity. To turn the whole twist would turn it ever further to the
// other side from 120 degrees on. So beyond 110 degrees it is turned by less: at most one and three quarters
// of what it takes.
struct Twist {
    Direction axis;
    std::int32_t share; // 30 fraction bits
    std::int64_t angle; // World, radians

    // What of a twist is to be turned.
    std::int64_t turn_for(std::int64_t twist) const { return fixed::scale_component(share, twist); }
};

// But for its angle. False: there is no middle.
bool find_twist_axis(const Joint& joint, const Body& a, const Body& b, Twist& twist) {
    const auto [u, v] = axes_of(joint, a, b);
    fixed::NormalisedVector way{};
    const bool any = fixed::normalise(
        Vec3{std::int64_t{u.x} + v.x, std::int64_t{u.y} + v.y, std::int64_t{u.z} + v.z}, way);
    twist.axis = way.direction;
    // The sum is as long as twice the cosine.
    twist.share = static_cast<std::int32_t>(std::min<std::int64_t>(way.length / 8 * 7, direction_one));
    return any;
}

// False: there is none.
bool measure_twist(const Joint& joint, const Body& a, const Body& b, const SinCos& half, Twist& twist) {
    twist.angle = 2 * fixed::angle_of(half.sine, half.cosine);
    return !has_no_twist(half) && find_twist_axis(joint, a, b, twist);
}

// How far it is beyond the nearer limit: sin(twist/2 − limit/2), times what is left of the swing, 60 fraction
// bits.
std::int64_t half_beyond(const JointConstants& c, const SinCos& half) {
    const std::int64_t above =
        std::int64_t{half.sine} * c.half_max.cosine - std::int64_t{half.cosine} * c.half_max.sine;
    const std::int64_t below =
        std::int64_t{half.cosine} * c.half_min.sine - std::int64_t{half.sine} * c.half_min.cosine;
    return std::max(above, below);
}

// Where the twist is certainly within its limits nobody need know it.
bool find_twist(const Joint& joint, const Body& a, const Body& b, Twist& twist) {
    const SinCos half = half_twist(joint, a, b);
    return (half_beyond(joint.constants, half) > 0 || joint.twist_push != 0) &&
           measure_twist(joint, a, b, half, twist);
}

// In a substep what was exceeded when it began stays so.
std::int64_t allowed_swing(const Joint& joint, const Swing& swing, bool in_substep) {
    return swing.limit + (in_substep ? std::max<std::int64_t>(joint.swing_beyond, 0) : 0);
}

struct AllowedTwist {
    std::int64_t most;
    std::int64_t least;
};

AllowedTwist allowed_twist(const Joint& joint, bool in_substep) {
    return in_substep ? AllowedTwist{joint.twist_most, joint.twist_least}
                      : AllowedTwist{joint.constants.twist_max, joint.constants.twist_min};
}

void hold_twist(Joint& joint, Body& a, Body& b) {
    Twist twist{};
    if (!find_twist(joint, a, b, twist)) {
        return;
    }
    const JointConstants& c = joint.constants;
    const TurnRow row(joint, a, b, twist.axis, c.limits.softness);
    const auto push_for = [&](std::int64_t back) {
        return row.push_for(are_soft(joint) ? back : twist.turn_for(back));
    };
    const auto kept = [&](std::int64_t start) { return start > 0 ? start : -joint.twist_gap; };
    const std::int64_t before = joint.twist_push;
    const std::int64_t most = are_soft(joint) ? c.twist_max : joint.twist_most;
    const std::int64_t least = are_soft(joint) ? c.twist_min : joint.twist_least;
    // Beyond its greatest it may only be turned down, below its least only up.
    if (twist.angle > most || before < 0) {
        const std::int64_t back =
            to_turn_back(joint, twist.angle - c.twist_max, kept(joint.twist_most - c.twist_max), -before);
        joint.twist_push = std::clamp<std::int64_t>(before + push_for(-back), -greatest_push, 0);
    } else if (twist.angle < least || before > 0) {
        const std::int64_t back =
            to_turn_back(joint, c.twist_min - twist.angle, kept(c.twist_min - joint.twist_least), before);
        joint.twist_push = std::clamp<std::int64_t>(before + push_for(back), 0, greatest_push);
    }
    row.apply(joint.twist_push - before);
}

// Of what turns b against a, half turns, Turn, about an axis no more than `room`: World, radians.
Vec3 no_further(const Vec3& turn, const Direction& axis, std::int64_t room) {
    const std::int64_t most =
        std::max<std::int64_t>(room, 0) * (std::int64_t{1} << (turn_fraction_bits - world_fraction_bits - 1));
    const std::int64_t along = fixed::dot(axis, turn);
    return along > most ? turn - fixed::scale(axis, along - most) : turn;
}

void push_limits(const Joint& joint, Body& a, Body& b, std::int64_t swing_push, std::int64_t twist_push) {
    Swing swing{};
    if (swing_push != 0 && find_pushed_swing(joint, a, b, swing)) {
        TurnRow(joint, a, b, swing.axis).apply(-swing_push);
    }
    Twist twist{};
    if (twist_push != 0 && find_twist_axis(joint, a, b, twist)) {
        TurnRow(joint, a, b, twist.axis).apply(twist_push);
    }
}

} // namespace

void begin_limits(Joint& joint, const Body& a, const Body& b) {
    const JointConstants& c = joint.constants;
    Swing swing{};
    joint.swing_beyond = -fixed::half_circle; // certainly within
    joint.swing_gap = joint.twist_gap = 0;
    if (c.swing_limited && find_swing(joint, a, b, swing)) {
        joint.swing_beyond = swing.angle - swing.limit;
        joint.swing_axis = swing.axis;
        if (joint.swing_push != 0) {
            joint.swing_gap = kept_gap(joint, swing.limit - swing.angle);
        }
    }
    joint.twist_least = c.twist_min;
    joint.twist_most = c.twist_max;
    Twist twist{};
    if (c.twist_limited && find_twist(joint, a, b, twist)) {
        joint.twist_least = std::min(c.twist_min, twist.angle);
        joint.twist_most = std::max(c.twist_max, twist.angle);
        if (joint.twist_push != 0) {
            joint.twist_gap =
                kept_gap(joint, joint.twist_push < 0 ? c.twist_max - twist.angle : twist.angle - c.twist_min);
        }
    }
}

Vec3 along_limits(const Joint& joint, const Body& a, const Body& b, const Vec3& aim) {
    const JointConstants& c = joint.constants;
    if (are_soft(joint) || !has_limits(c)) {
        return aim;
    }
    Vec3 left = aim;
    const std::int64_t most = sum_of_magnitudes(aim);
    // A cosine changes by no more than its angle.
    const auto [u, v] = axes_of(joint, a, b);
    if (c.swing_limited && fixed::dot(u, v) - (most >> (turn_fraction_bits - 31)) <= c.swing_cosine) {
        const Swing swing = measure_swing(joint, a, u, v);
        left = no_further(left, swing.axis, swing.limit - swing.angle);
    }
    const SinCos half = half_twist(joint, a, b);
    Twist twist{};
    if (c.twist_limited && half_beyond(c, half) > -most && measure_twist(joint, a, b, half, twist)) {
        left = no_further(left, twist.axis, twist.turn_for(c.twist_max - twist.angle));
        left = no_further(left, -twist.axis, twist.turn_for(twist.angle - c.twist_min));
    }
    return left;
}

void prepare_limits(Joint& joint) {
    if (are_soft(joint) || joint.limits_in_tree) {
        joint.swing_push = joint.twist_push = 0;
    }
}

void carry_limits_on(const Joint& joint, Body& a, Body& b) {
    push_limits(joint, a, b, joint.swing_push, joint.twist_push);
}

void carry_more_limits(Joint& joint, Body& a, Body& b, std::int32_t share) {
    const std::int64_t swing = fixed::scale_component(share, joint.swing_push);
    const std::int64_t twist = fixed::scale_component(share, joint.twist_push);
    push_limits(joint, a, b, swing, twist);
    add_to_limits(joint, share);
}

void add_to_limits(Joint& joint, std::int32_t share) {
    const std::int64_t swing = fixed::scale_component(share, joint.swing_push);
    const std::int64_t twist = fixed::scale_component(share, joint.twist_push);
    joint.swing_push = std::min(joint.swing_push + swing, greatest_push);
    joint.twist_push = std::clamp(joint.twist_push + twist, -greatest_push, greatest_push);
}

void project_limits(Joint& joint, Body& a, Body& b) {
    if (joint.limits_in_tree) {
        return;
    }
    if (joint.constants.swing_limited) {
        hold_swing(joint, a, b);
    }
    if (joint.constants.twist_limited) {
        hold_twist(joint, a, b);
    }
}

Vec3 limit_push(const Joint& joint, const Body& a, const Body& b) {
    Vec3 pushed{0, 0, 0};
    Swing swing{};
    if (joint.swing_push != 0 && find_pushed_swing(joint, a, b, swing)) {
        pushed = -fixed::scale(swing.axis, joint.swing_push);
    }
    Twist twist{};
    if (joint.twist_push != 0 && find_twist_axis(joint, a, b, twist)) {
        pushed = pushed + fixed::scale(twist.axis, joint.twist_push);
    }
    return pushed;
}

std::int64_t exceeded_limits(const Joint& joint, const Body& a, const Body& b, bool in_substep) {
    if (are_soft(joint)) {
        return 0;
    }
    std::int64_t beyond = 0;
    Swing swing{};
    if (joint.constants.swing_limited && find_swing(joint, a, b, swing)) {
        beyond = swing.angle - allowed_swing(joint, swing, in_substep);
    }
    Twist twist{};
    if (joint.constants.twist_limited && find_twist(joint, a, b, twist)) {
        const AllowedTwist allowed = allowed_twist(joint, in_substep);
        beyond = std::max(beyond,
                          twist.turn_for(std::max(twist.angle - allowed.most, allowed.least - twist.angle)));
    }
    return beyond;
}

bool undo_limits(const Joint& joint, Body& a, Body& b) {
    if (are_soft(joint)) {
        return false;
    }
    const JointConstants& c = joint.constants;
    // A row turns bodies about their centres, and the points of the joint hold much of that back: by half as
    // much again, rounds get there sooner.
    const auto more = [](std::int64_t angle) { return angle + angle / 2; };
    std::int64_t beyond = 0;
    Swing swing{};
    if (c.swing_limited && find_swing(joint, a, b, swing) && swing.angle > swing.limit) {
        beyond = swing.angle - swing.limit;
        TurnRow(joint, a, b, swing.axis).turn_by(-more(beyond));
    }
    Twist twist{};
    if (c.twist_limited && find_twist(joint, a, b, twist)) {
        const std::int64_t back =
            twist.turn_for(std::clamp(twist.angle, c.twist_min, c.twist_max) - twist.angle);
        if (back != 0) {
            beyond = std::max(beyond, back < 0 ? -back : back);
            TurnRow(joint, a, b, twist.axis).turn_by(more(back));
        }
    }
    return beyond > far_beyond;
}

std::uint32_t limit_rows(const Joint& joint, const Body& a, const Body& b, bool in_substep,
                         HeldRow (&rows)[most_held_rows], std::uint32_t count) {
    if (are_soft(joint)) {
        return count;
    }
    const JointConstants& c = joint.constants;
    if (c.swing_limited) {
        const auto [u, v] = axes_of(joint, a, b);
        Swing swing = measure_swing(joint, a, u, v);
        if (in_substep) {
            turn_to_push(joint, swing);
        }
        rows[count++] = {HeldRow::Kind::swing, -swing.axis,
                         allowed_swing(joint, swing, in_substep) - swing.angle,
                         in_substep ? joint.swing_push : 0};
    }
    Twist twist{};
    if (c.twist_limited && measure_twist(joint, a, b, half_twist(joint, a, b), twist)) {
        const std::int64_t push = in_substep ? joint.twist_push : 0;
        const AllowedTwist allowed = allowed_twist(joint, in_substep);
        const std::int64_t to_most = twist.turn_for(allowed.most - twist.angle);
        const std::int64_t to_least = twist.turn_for(twist.angle - allowed.least);
        if (push < 0 || (push == 0 && to_most < to_least)) {
            rows[count++] = {HeldRow::Kind::most_twist, -twist.axis, to_most, -push};
        } else {
            rows[count++] = {HeldRow::Kind::least_twist, twist.axis, to_least, push};
        }
    }
    return count;
}

void set_limit_push(Joint& joint, const HeldRow& row, std::int64_t push) {
    if (row.kind == HeldRow::Kind::swing) {
        joint.swing_push = push;
        joint.swing_axis = -row.axis;
    } else {
        joint.twist_push = row.kind == HeldRow::Kind::most_twist ? -push : push;
    }
}

} // namespace lks
