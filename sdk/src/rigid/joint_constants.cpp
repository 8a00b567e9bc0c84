#include "rigid/joint.h"

#include <algorithm>

#include "fixed/arc_tangent.h"
#include "fixed/trigonometry.h"
#include "fixed/world_times.h"
#include "rigid/make_body.h"

namespace lks {
namespace {

using fixed::Direction;

constexpr std::int64_t half_circle_degrees = LKS_FIXED(180);

SinCos sine_and_cosine(std::int64_t degrees, int fraction_bits) {
    const fixed::SineCosine wide = fixed::sine_cosine(degrees, fraction_bits);
    return {fixed::round_component(wide.sine), fixed::round_component(wide.cosine)};
}

std::int64_t to_radians(std::int64_t degrees) {
    return fixed::multiply_divide(degrees, fixed::half_circle, half_circle_degrees);
}

// Of a joint's frame: a local axis in its body's axes.
Direction frame_axis(const fixed::Rotation& frame, int axis) {
    const fixed::Matrix3 m = fixed::to_matrix(frame);
    return {m.m[0][axis], m.m[1][axis], m.m[2][axis]};
}

// Of an ellipse, degrees: about a thinner one a swing would find no way along it.
constexpr lks_fixed least_half_axis = LKS_FIXED_ONE / 20;

// Where its inertia about the joint is more than about thirteen times that about its centre: m·r²/I, which
// the arm has of two axes, is 6 for a rod's end, and 75 for a cube of 20 cm half a metre away.
bool is_far_out(const Body& body, const SwingArm& arm) {
    constexpr std::int64_t far = std::int64_t{24} << world_fraction_bits;
    const std::int64_t square = fixed::multiply_shift(arm.length, arm.length, world_fraction_bits);
    return fixed::multiply_shift(square, arm.across, 30 - body.inverse_shift) > far;
}

void set_swing(JointConstants& c, const JointDescription& d) {
    lks_fixed x = d.swing_limit;
    lks_fixed z = d.swing_limit_z < 0 ? x : d.swing_limit_z;
    c.swing_limited = d.kind == LKS_JOINT_BALL && std::min(x, z) < half_circle_degrees;
    c.swing_round = z == x;
    if (!c.swing_round) {
        x = std::max(x, least_half_axis);
        z = std::max(z, least_half_axis);
    }
    c.swing_cosine = sine_and_cosine(std::min(x, z), world_fraction_bits).cosine;
    c.swing_limit = to_radians(x);
    c.swing_limit_z = to_radians(z);
    c.across_a[0] = frame_axis(d.frame_a, 0);
    c.across_a[1] = frame_axis(d.frame_a, 2);
}

// What twists are measured from, degrees. Where a limit is near a half turn that is the middle of both: what
// goes beyond it would be read from the other side, and turned all the way to the other limit.
lks_fixed middle_of_twists(const JointDescription& d) {
    constexpr lks_fixed near_half_turn = LKS_FIXED(170);
    const bool is_near = d.twist_min < -near_half_turn || d.twist_max > near_half_turn;
    return is_near ? d.twist_min / 2 + d.twist_max / 2 : 0;
}

void set_twist(JointConstants& c, const JointDescription& d) {
    c.twist_limited = (d.kind == LKS_JOINT_BALL || d.kind == LKS_JOINT_HINGE) &&
                      (d.twist_min > -half_circle_degrees || d.twist_max < half_circle_degrees);
    constexpr fixed::Rotation units[4] = {{fixed::rotation_one, 0, 0, 0},
                                          {0, fixed::rotation_one, 0, 0},
                                          {0, 0, fixed::rotation_one, 0},
                                          {0, 0, 0, fixed::rotation_one}};
    const lks_fixed middle = middle_of_twists(d);
    // One fraction bit more is half the angle.
    c.half_middle = sine_and_cosine(middle, world_fraction_bits + 1);
    const fixed::Rotation back{0, -c.half_middle.sine, 0, c.half_middle.cosine};
    for (int i = 0; i < 4; ++i) {
        const fixed::Rotation turned = fixed::multiply(
            fixed::multiply(fixed::conjugate(d.frame_a), fixed::multiply(units[i], d.frame_b)), back);
        c.twist_sine[i] = turned.y;
        c.twist_cosine[i] = turned.w;
    }
    c.half_min = sine_and_cosine(d.twist_min - middle, world_fraction_bits + 1);
    c.half_max = sine_and_cosine(d.twist_max - middle, world_fraction_bits + 1);
    c.twist_min = to_radians(d.twist_min - middle);
    c.twist_max = to_radians(d.twist_max - middle);
}

// `greater` is the greater inverse mass.
void set_forces(JointConstants& c, const JointDescription& d, const fixed::Scaled& greater,
                const StepRate& rate) {
    const fixed::Scaled inverse_h = rate.inverse_h();
    const fixed::Scaled one = fixed::Scaled::from_u64(1);
    const fixed::Scaled by_reach = one.times_power_of_two(2 * c.reach);
    c.points = make_softness(d.compliance, d.damping, greater, rate);
    if (d.kind == LKS_JOINT_HINGE || d.kind == LKS_JOINT_FIXED) {
        c.angular_softness =
            softness_of(world_value(d.angular_compliance) * inverse_h * inverse_h * by_reach / greater);
    }
    c.limits =
        make_softness(d.limits.compliance, d.limits.damping, greater.times_power_of_two(-2 * c.reach), rate);
    if (d.angular_damping != 0) {
        c.drag_softness = softness_of(by_reach * inverse_h / (world_value(d.angular_damping) * greater));
        c.drag_softness = std::max<std::int64_t>(c.drag_softness, 1);
    }
    // A force F over a substep is a push of F·h²·w; a torque the same, of angles at a radius of 2^reach m.
    const fixed::Scaled force_push = greater / (inverse_h * inverse_h);
    const fixed::Scaled torque_push = force_push / by_reach;
    c.break_push = greatest_sum(d.break_force, force_push, rate);
    c.break_turn = greatest_sum(d.break_torque, torque_push, rate);
    const bool motor = d.motor_torque != 0;
    const fixed::Scaled grip = world_value(motor ? d.motor_torque : d.friction) * torque_push;
    c.grip = std::min(grip.to_i64_fixed(world_fraction_bits), greatest_push);
    if (motor) {
        const fixed::Scaled response = world_value(d.motor_response) * inverse_h; // in substeps
        // What is to be made up for in a substep must be less than what swings lose in it.
        const fixed::Scaled least = fixed::Scaled::from_u64(8);
        c.motor_share =
            static_cast<std::int32_t>((one / (response < least ? least : response)).to_i64_fixed(30));
    }
}

} // namespace

lks_joint_def define_joint(const JointDescription& d) {
    const auto rotation = [](const fixed::Rotation& q) { return lks_rotation{q.x, q.y, q.z, q.w}; };
    lks_joint_def def{};
    def.struct_size = sizeof(lks_joint_def);
    def.kind = d.kind;
    def.frame_a.rotation = rotation(d.frame_a);
    def.frame_b.rotation = rotation(d.frame_b);
    def.bodies_collide = d.bodies_collide;
    def.swing_limit = d.swing_limit;
    def.swing_limit_z = d.swing_limit_z;
    def.twist_min = d.twist_min;
    def.twist_max = d.twist_max;
    def.distance_min = d.distance_min;
    def.distance_max = d.distance_max;
    def.compliance = d.compliance;
    def.damping = d.damping;
    def.angular_compliance = d.angular_compliance;
    def.angular_damping = d.angular_damping;
    def.limit_compliance = d.limits.compliance;
    def.limit_damping = d.limits.damping;
    def.friction = d.friction;
    def.break_force = d.break_force;
    def.break_torque = d.break_torque;
    return def;
}

SwingArm swing_arm(const Body& body, const fixed::Vec3& point) {
    fixed::NormalisedVector lever{};
    if (!fixed::normalise(point, lever)) {
        return {0, 0};
    }
    const SymmetricMatrix& m = body.inverse_inertia;
    const Direction& d = lever.direction;
    const std::int64_t along = fixed::dot(d, multiply(m, fixed::Vec3{d.x, d.y, d.z}));
    return {in_units(body, lever.length), std::int64_t{m.xx} + m.yy + m.zz - along};
}

JointConstants make_joint_constants(const JointDescription& d, const Body& a, const Body& b,
                                    const StepRate& rate) {
    JointConstants c{};
    c.shares = pair_shares(a.inverse_mass, b.inverse_mass);
    c.arm_a = swing_arm(a, d.point_a);
    c.arm_b = swing_arm(b, d.point_b);
    c.loads_from_far = is_far_out(a, c.arm_a) || is_far_out(b, c.arm_b);
    c.axis_a = frame_axis(d.frame_a, 1);
    c.axis_b = frame_axis(d.frame_b, 1);
    set_swing(c, d);
    set_twist(c, d);
    const auto reach_of = [](const Body& body) { return body.scale - body.inverse_shift / 2; };
    c.reach = !a.is_dynamic()   ? reach_of(b)
              : !b.is_dynamic() ? reach_of(a)
                                : std::min(reach_of(a), reach_of(b));
    const fixed::Scaled greater = greater_inverse_mass(c.shares, a, b);
    if (!greater.is_zero()) {
        set_forces(c, d, greater, rate);
    }
    return c;
}

} // namespace lks
