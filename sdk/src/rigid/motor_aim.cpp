#include "rigid/motor_aim.h"

#include <algorithm>

#include "fixed/arc_tangent.h"
#include "fixed/trigonometry.h"
#include "rigid/swing_ellipse.h"

namespace lks {
namespace {

using fixed::Rotation;
using fixed::Vec3;

// What a target is beyond a limit by its own rounding: World, radians.
constexpr std::int64_t rounding = world_one >> 20;

// The cosine of half the swing beyond which twist limits give way.
constexpr std::int32_t least_twisted = direction_one / 32;

// Of half an angle in World, radians.
SinCos half_of(std::int64_t angle) {
    const std::int64_t degrees =
        fixed::multiply_divide(angle, std::int64_t{180} << world_fraction_bits, fixed::half_circle);
    const fixed::SineCosine half = fixed::sine_cosine(degrees, world_fraction_bits + 1);
    return {fixed::round_component(half.sine), fixed::round_component(half.cosine)};
}

std::int64_t angle_of_half(const SinCos& half) {
    return 2 * fixed::angle_of(half.sine, half.cosine);
}

// First a twist, then a swing about x and z. Where the swing is a half turn there is no twist.
struct Parts {
    Rotation swing;
    Rotation twist;
};

Parts parts_of(const Rotation& q) {
    fixed::NormalisedVector half{};
    if (!fixed::normalise(Vec3{q.y, q.w, 0}, half)) {
        return {q, fixed::identity_rotation()};
    }
    const Rotation twist{0, half.direction.x, 0, half.direction.y};
    return {fixed::multiply(q, fixed::conjugate(twist)), twist};
}

Rotation about_y(const SinCos& half) {
    return {0, half.sine, 0, half.cosine};
}

// From one angle up to another, within a circle.
std::int64_t way_up(std::int64_t from, std::int64_t to) {
    return to < from ? to - from + 2 * fixed::half_circle : to - from;
}

// False: it is within its range.
bool bring_twist_back(const JointConstants& c, Rotation& twist) {
    const Rotation middle = about_y(c.half_middle);
    Rotation q = fixed::multiply(fixed::conjugate(middle), twist);
    q = q.w < 0 ? Rotation{0, -q.y, 0, -q.w} : q;
    const std::int64_t angle = angle_of_half({q.y, q.w});
    if (angle <= c.twist_max + rounding && angle >= c.twist_min - rounding) {
        return false;
    }
    const bool to_most = way_up(c.twist_max, angle) <= way_up(angle, c.twist_min);
    twist = fixed::multiply(middle, about_y(to_most ? c.half_max : c.half_min));
    return true;
}

// By an angle about an axis across; false: it is within its limit.
bool bring_swing_back(const JointConstants& c, Rotation& swing) {
    fixed::NormalisedVector axis{};
    if (!fixed::normalise(Vec3{swing.x, swing.z, 0}, axis)) {
        return false;
    }
    // It turns y towards x by −z and towards z by x.
    const std::int64_t angle = angle_of_half({static_cast<std::int32_t>(axis.length), swing.w});
    if (angle <= std::min(c.swing_limit, c.swing_limit_z)) {
        return false;
    }
    const SwingEdge edge = nearest_edge(c, -fixed::scale_component(axis.direction.y, angle),
                                        fixed::scale_component(axis.direction.x, angle));
    if (edge.beyond <= rounding) {
        return false;
    }
    fixed::NormalisedVector way{};
    if (!fixed::normalise(Vec3{edge.z, -edge.x, 0}, way)) {
        swing = fixed::identity_rotation();
        return true;
    }
    const SinCos half = half_of(way.length);
    const auto part = [&half](std::int32_t share) {
        return static_cast<std::int32_t>(fixed::scale_component(share, half.sine));
    };
    swing = {part(way.direction.x), 0, part(way.direction.y), half.cosine};
    return true;
}

} // namespace

void find_motor_aim(Joint& joint) {
    const JointConstants& c = joint.constants;
    if (joint.description.motor_torque == 0) {
        return;
    }
    joint.motor_aim = joint.motor_target;
    if (c.limits.softness != 0 || !has_limits(c)) {
        return;
    }
    Parts parts = parts_of(joint.motor_target);
    const bool swings_less = c.swing_limited && bring_swing_back(c, parts.swing);
    const bool twists = swings_less || parts.swing.w >= least_twisted;
    const bool twists_less = c.twist_limited && twists && bring_twist_back(c, parts.twist);
    if (swings_less || twists_less) {
        joint.motor_aim = fixed::normalise(fixed::multiply(parts.swing, parts.twist));
    }
}

} // namespace lks
