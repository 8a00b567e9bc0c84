#include "rigid/joint.h"

#include <algorithm>

#include "fixed/arc_tangent.h"
#include "fixed/trigonometry.h"
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

// Of a joint's frame: local y, in its body's axes.
Direction frame_axis(const fixed::Rotation& frame) {
    const fixed::Matrix3 m = fixed::to_matrix(frame);
    return {m.m[0][1], m.m[1][1], m.m[2][1]};
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

} // namespace lks
