#include "rigid/joint.h"

#include <algorithm>

#include "fixed/arc_tangent.h"
#include "fixed/trigonometry.h"
#include "rigid/make_body.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

constexpr std::int64_t half_circle_degrees = LKS_FIXED(180);

SinCos sine_and_cosine(std::int64_t degrees, int fraction_bits) {
    const fixed::SineCosine wide = fixed::sine_cosine(degrees, fraction_bits);
    return {fixed::round_component(wide.sine), fixed::round_component(wide.cosine)};
}

std::int64_t to_radians(std::int64_t degrees) {
    return fixed::multiply_divide(degrees, fixed::half_circle, half_circle_degrees);
}

// Of a joint's frame: local y, in its body's axes.
Direction frame_axis(const fixed::Rotation& frame) {
    const fixed::Matrix3 m = fixed::to_matrix(frame);
    return {m.m[0][1], m.m[1][1], m.m[2][1]};
}

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

// The inverse of a symmetric positive matrix with 30 fraction bits. Where it is too flat to be inverted in
// 32 bits, that of its trace serves, which falls short but never goes too far.
void invert_block(const std::int64_t (&k)[6], SymmetricMatrix& inverse, std::int32_t& shift) {
    constexpr std::int64_t unit = std::int64_t{1} << 28;
    const std::int64_t greatest = std::max({k[0], k[3], k[5]});
    int down = 0;
    while (greatest >> down >= 2 * unit) {
        ++down;
    }
    std::int64_t m[6]; // in units of 2^28, the greatest of the diagonal from 1 to 2
    for (int i = 0; i < 6; ++i) {
        m[i] = k[i] >> down;
    }
    const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t t) {
        return (p * q - r * t) >> 28;
    };
    std::int64_t cofactors[6] = {minor(m[3], m[5], m[4], m[4]), minor(m[2], m[4], m[1], m[5]),
                                 minor(m[1], m[4], m[2], m[3]), minor(m[0], m[5], m[2], m[2]),
                                 minor(m[1], m[2], m[0], m[4]), minor(m[0], m[3], m[1], m[1])};
    std::int64_t whole = (m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2]) >> 28;
    if (whole < unit >> 14) {
        whole = m[0] + m[3] + m[5];
        for (int i = 0; i < 6; ++i) {
            cofactors[i] = i == 0 || i == 3 || i == 5 ? unit : 0;
        }
    }
    std::int64_t entries[6]; // 30 fraction bits, of units
    std::int64_t size = 0;
    for (int i = 0; i < 6; ++i) {
        entries[i] = (cofactors[i] * (std::int64_t{1} << 30)) / whole;
        size = std::max(size, entries[i] < 0 ? -entries[i] : entries[i]);
    }
    int narrowed = 0;
    while (size >> narrowed >= std::int64_t{1} << 29) {
        ++narrowed;
    }
    const auto part = [&](int i) { return static_cast<std::int32_t>(entries[i] >> narrowed); };
    inverse = {part(0), part(1), part(2), part(3), part(4), part(5)};
    // K is m · 2^(down − 30), and m in units is m · 2^-28.
    shift = narrowed + 2 - down;
}

Vec3 scaled(const Vec3& v, int shift) {
    const auto part = [shift](std::int64_t c) {
        return shift >= 0 ? fixed::wrapping_multiply(c, std::int64_t{1} << shift)
                          : fixed::shift_right_rounded(c, -shift);
    };
    return {part(v.x), part(v.y), part(v.z)};
}

// Soft joints, distances, and those with rows for angles besides begin each substep anew, as XPBD has them: a
// beam on a fixed joint sagged by 9° when its points alone carried their push on.
bool keeps_push(const Joint& joint) {
    return joint.description.kind == LKS_JOINT_BALL && joint.constants.softness == 0;
}

void push_apart(const Joint& joint, Body& a, Body& b, const Vec3& p) {
    push(a, joint.side_a, p, -1);
    push(b, joint.side_b, p, 1);
}

// Errors beyond this are taken in several substeps: a bone that was torn 10 m away comes back at a bounded
// speed.
constexpr std::int64_t greatest_step = std::int64_t{1} << (world_fraction_bits - 1);

// The points together, in all directions at once (XPBD eq. 18).
void project_points(Joint& joint, Body& a, Body& b) {
    Vec3 error = joint_offset(joint, a, b) - joint.start;
    const std::int64_t softness = joint.constants.softness;
    if (softness != 0) {
        const auto part = [softness](std::int64_t c) { return fixed::multiply_shift(c, softness, 30); };
        error = error + Vec3{part(joint.push.x), part(joint.push.y), part(joint.push.z)};
    }
    clamp_vector(error, greatest_step);
    const Vec3 before = joint.push;
    joint.push = before - scaled(multiply(joint.inverse, error), joint.inverse_shift);
    clamp_vector(joint.push, greatest_push);
    push_apart(joint, a, b, joint.push - before);
}

// The points at a distance: a row along the way between them.
void project_distance(Joint& joint, Body& a, Body& b) {
    const JointDescription& d = joint.description;
    fixed::NormalisedVector way{};
    const Vec3 offset = joint_offset(joint, a, b);
    if (!fixed::normalise(offset, way)) {
        way = {{direction_one, 0, 0}, 0}; // one in the other: any direction
    }
    const bool rod = d.distance_min == d.distance_max;
    // What the push along the way was, and what it may be: it holds back, or off.
    std::int64_t pushed = fixed::dot(way.direction, joint.push);
    std::int64_t error = 0;
    bool pulls = false;
    if (way.length > d.distance_max || (pushed < 0 && !rod)) {
        error = way.length - d.distance_max;
        pulls = true;
    } else if (way.length < d.distance_min || (pushed > 0 && !rod)) {
        error = way.length - d.distance_min;
    } else if (!rod) {
        joint.push = {0, 0, 0};
        return;
    }
    error = std::clamp(error, -greatest_step, greatest_step);
    std::int64_t weight = joint.constants.softness;
    const Vec3 lever_a = fixed::rotate(a.rotation, d.point_a);
    const Vec3 lever_b = fixed::rotate(b.rotation, d.point_b);
    const RowSide side_a = push_side(a, joint.constants.shares.a, way.direction, lever_a, weight);
    const RowSide side_b = push_side(b, joint.constants.shares.b, way.direction, lever_b, weight);
    const std::int64_t soft = fixed::multiply_shift(pushed, joint.constants.softness, 30);
    std::int64_t p = -divide(error + soft, invert(weight));
    if (!rod) {
        // A rope only pulls, a strut only pushes.
        const std::int64_t total =
            pulls ? std::min<std::int64_t>(pushed + p, 0) : std::max<std::int64_t>(pushed + p, 0);
        p = total - pushed;
    }
    joint.push = fixed::scale(way.direction, pushed + p);
    const Vec3 along = fixed::scale(way.direction, p);
    push(a, side_a, along, p, -1);
    push(b, side_b, along, p, 1);
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
    const Vec3 error = scaled(fixed::cross(u, v), -30);
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
    if (!fixed::normalise(scaled(fixed::cross(u, v), -30), way)) {
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

Vec3 joint_offset(const Joint& joint, const Body& a, const Body& b) {
    return (b.position - a.position) + fixed::rotate(b.rotation, joint.description.point_b) -
           fixed::rotate(a.rotation, joint.description.point_a);
}

JointAngles joint_angles(const Joint& joint, const Body& a, const Body& b) {
    const fixed::Rotation q = relative_rotation(joint, a, b);
    const auto [u, v] = axes_of(joint, a, b);
    fixed::NormalisedVector way{};
    const bool apart = fixed::normalise(scaled(fixed::cross(u, v), -30), way);
    return {fixed::angle_of(apart ? way.length : 0, fixed::dot(u, v)), 2 * fixed::angle_of(q.y, q.w)};
}

lks_joint_def define_joint(const JointDescription& d) {
    const auto rotation = [](const fixed::Rotation& q) { return lks_rotation{q.x, q.y, q.z, q.w}; };
    lks_joint_def def{};
    def.struct_size = sizeof(lks_joint_def);
    def.kind = d.kind;
    def.frame_a.rotation = rotation(d.frame_a);
    def.frame_b.rotation = rotation(d.frame_b);
    def.bodies_collide = d.bodies_collide;
    def.swing_limit = d.swing_limit;
    def.twist_min = d.twist_min;
    def.twist_max = d.twist_max;
    def.distance_min = d.distance_min;
    def.distance_max = d.distance_max;
    def.compliance = d.compliance;
    def.friction = d.friction;
    return def;
}

JointConstants make_joint_constants(const JointDescription& d, const Body& a, const Body& b,
                                    const StepRate& rate) {
    JointConstants c{};
    c.shares = pair_shares(a.inverse_mass, b.inverse_mass);
    c.axis_a = frame_axis(d.frame_a);
    c.axis_b = frame_axis(d.frame_b);
    c.swing_limited = d.kind == LKS_JOINT_BALL && d.swing_limit < half_circle_degrees;
    c.twist_limited = (d.kind == LKS_JOINT_BALL || d.kind == LKS_JOINT_HINGE) &&
                      (d.twist_min > -half_circle_degrees || d.twist_max < half_circle_degrees);
    c.swing_cosine = sine_and_cosine(d.swing_limit, world_fraction_bits).cosine;
    c.swing_limit = to_radians(d.swing_limit);
    // One fraction bit more is half the angle.
    c.half_min = sine_and_cosine(d.twist_min, world_fraction_bits + 1);
    c.half_max = sine_and_cosine(d.twist_max, world_fraction_bits + 1);
    c.twist_min = to_radians(d.twist_min);
    c.twist_max = to_radians(d.twist_max);
    const auto reach_of = [](const Body& body) { return body.scale - body.inverse_shift / 2; };
    c.reach = !a.is_dynamic()   ? reach_of(b)
              : !b.is_dynamic() ? reach_of(a)
                                : std::min(reach_of(a), reach_of(b));
    const fixed::Scaled greater = greater_inverse_mass(c.shares, a, b);
    const fixed::Scaled inverse_h = rate.inverse_h();
    const auto world = [](std::int64_t value) {
        return fixed::Scaled::from_fixed(static_cast<std::uint64_t>(value), world_fraction_bits);
    };
    if (!greater.is_zero()) {
        const fixed::Scaled softness = world(d.compliance) * inverse_h * inverse_h / greater;
        c.softness = std::min(softness.to_i64_fixed(30), std::int64_t{1} << 50);
        // A torque M over a substep is a push of M·h²·w, of angles at a radius of 2^reach m.
        const fixed::Scaled most =
            world(d.friction) * greater / (inverse_h * inverse_h).times_power_of_two(2 * c.reach);
        c.friction = std::min(most.to_i64_fixed(world_fraction_bits), std::int64_t{1} << 50);
    }
    return c;
}

void begin_substep(Joint& joint, const Body& a, const Body& b) {
    joint.start = joint_offset(joint, a, b);
}

void warm_start(Joint& joint, Body& a, Body& b) {
    const JointDescription& d = joint.description;
    joint.turn = {0, 0, 0};
    joint.grip = {0, 0, 0};
    if (!keeps_push(joint)) {
        joint.push = {0, 0, 0};
        joint.start = {0, 0, 0};
    }
    if (d.kind != LKS_JOINT_DISTANCE) {
        const std::int64_t softness = joint.constants.softness;
        std::int64_t k[6] = {softness, 0, 0, softness, 0, softness};
        joint.side_a = block_side(a, joint.constants.shares.a, fixed::rotate(a.rotation, d.point_a), k);
        joint.side_b = block_side(b, joint.constants.shares.b, fixed::rotate(b.rotation, d.point_b), k);
        invert_block(k, joint.inverse, joint.inverse_shift);
        push_apart(joint, a, b, joint.push);
    }
}

void undo_error(const Joint& joint, Body& a, Body& b) {
    if (keeps_push(joint)) {
        Vec3 error = joint_offset(joint, a, b);
        clamp_vector(error, greatest_step);
        push_apart(joint, a, b, -scaled(multiply(joint.inverse, error), joint.inverse_shift));
    }
    // Nobody does so behind it.
    for (Body* body : {&a, &b}) {
        if (body->is_dynamic()) {
            body->orientation = normalise(body->orientation);
        }
    }
}

void project(Joint& joint, Body& a, Body& b, bool forward) {
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
    if (joint.description.kind == LKS_JOINT_DISTANCE) {
        project_distance(joint, a, b);
    } else {
        project_points(joint, a, b);
    }
}

} // namespace lks
