#include "rigid/free_figure.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/energy_factor.h"
#include "rigid/figure_momentum.h"
#include "rigid/figure_pushes.h"
#include "rigid/figures.h"

namespace lks {
namespace {

using fixed::Int128;
using fixed::Vec3;

Vec3 times(const Vec3& v, std::int64_t factor) {
    const auto part = [factor](std::int64_t c) {
        return fixed::multiply_shift(c, factor, factor_fraction_bits);
    };
    return factor == one_factor ? v : Vec3{part(v.x), part(v.y), part(v.z)};
}

// Joints hold it together, and nothing outside is near that may push it but contacts and joints.
bool may_be_free(const RigidScene& scene, const FigureRange& figure) {
    return figure.count(Part::joint) != 0 && !figure.is_loaded && figure.count(Part::attachment) == 0 &&
           !is_near_objects(scene, figure, [](std::uint32_t) { return true; });
}

// Turns without any resistance, but for limits.
bool turns_freely(const Joint& joint) {
    const std::uint32_t kind = joint.description.kind;
    const JointConstants& c = joint.constants;
    return (kind == LKS_JOINT_BALL || kind == LKS_JOINT_HINGE) && joint.in_tree && c.points.softness == 0 &&
           c.grip == 0 && c.drag_softness == 0;
}

bool is_hinge(const Joint& joint) {
    return joint.description.kind == LKS_JOINT_HINGE;
}

// Of a figure that is held: by one joint alone, at something that stands, and so that a substep of gravity is
// short beside it: else what it gains and gives back in each swing is much.
bool find_pivot(const RigidScene& scene, const FigureRange& figure, const MotionRate& rate,
                FreeMotion& motion) {
    int holders = 0;
    bool found = true;
    for_each_part(scene, figure, Part::joint, [&](std::uint32_t i) {
        const Joint& joint = scene.joints[i];
        const Body& a = scene.bodies[joint.description.body_a];
        const Body& b = scene.bodies[joint.description.body_b];
        found = found && turns_freely(joint);
        const bool is_inner = a.is_awake() && b.is_awake();
        found = found && (!has_limits(joint.constants) || (!is_inner && is_hinge(joint)));
        if (is_inner) {
            return;
        }
        ++holders;
        const bool holds_a = a.is_awake();
        const Body& holder = holds_a ? b : a;
        const JointConstants& c = joint.constants;
        const Vec3& point = holds_a ? joint.description.point_b : joint.description.point_a;
        found = found && !holder.is_dynamic() && !holder.is_moving();
        motion.pivot_joint = i;
        motion.pivot = holder.position + fixed::rotate(holder.rotation, point);
        motion.has_axis = is_hinge(joint);
        motion.axis = fixed::rotate(holder.rotation, holds_a ? c.axis_b : c.axis_a);
    });
    if (holders != 1 || !found) {
        return false;
    }
    constexpr std::int64_t least_ratio = 256;
    Vec3 lever = saturating_subtract(FigureMomentum(scene, figure).position(), motion.pivot);
    if (motion.has_axis) {
        lever = lever - fixed::scale(motion.axis, fixed::dot(motion.axis, lever));
    }
    const Vec3& step = scene.ticks[name_of(scene, figure)].gravity_step;
    return sum_of_magnitudes(lever) >= least_ratio * (sum_of_magnitudes(step) / rate.substeps_per_second);
}

// The hinge that it hangs on leans on one.
bool is_pushed_by_limit(const RigidScene& scene, const FreeMotion& motion) {
    return motion.has_pivot && scene.joints[motion.pivot_joint].twist_push != 0;
}

// Neither motors nor springs are at work. Soft limits of a figure with loops are rows beside what solves
// these, and give back nothing: what they would give has no bounds there.
bool is_passive(const RigidScene& scene, const FigureRange& figure) {
    bool passive = true;
    for_each_part(scene, figure, Part::joint, [&](std::uint32_t i) {
        const Joint& joint = scene.joints[i];
        passive = passive && joint.description.motor_torque == 0 && !has_spring(joint.constants) &&
                  (joint.constants.limits.softness == 0 || joint.turns_in_tree);
    });
    return passive;
}

bool falls_unevenly(const RigidScene& scene, const FigureRange& figure) {
    const std::int64_t factor = scene.descriptions[name_of(scene, figure)].gravity_factor;
    bool uneven = false;
    for_each_part(scene, figure, Part::body, [&](std::uint32_t i) {
        uneven = uneven || scene.descriptions[i].gravity_factor != factor;
    });
    return uneven;
}

void begin_tick(const RigidScene& scene, FigureRange& figure, const MotionRate& rate) {
    FreeMotion& motion = figure.motion;
    motion = {};
    if (!may_be_free(scene, figure)) {
        return;
    }
    const bool uneven = has_uneven_tree(scene, figure);
    motion.has_pivot = figure.is_held && !uneven && find_pivot(scene, figure, rate, motion);
    motion.free = motion.has_pivot || !figure.is_held;
    motion.passive = motion.free && !motion.has_pivot && is_passive(scene, figure);
    motion.gravity_works = motion.passive && falls_unevenly(scene, figure);
    motion.each_substep = uneven || (figure.has_held_tree && !figure.is_held);
}

// ω × r, as exact as velocities.
Vec3 turning(const Vec3& spin, const Vec3& lever) {
    const auto part = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
        return fixed::saturate_to_int64((fixed::multiply_signed(a, b) - fixed::multiply_signed(c, d)) >>
                                        world_fraction_bits);
    };
    return {part(spin.y, lever.z, spin.z, lever.y), part(spin.z, lever.x, spin.x, lever.z),
            part(spin.x, lever.y, spin.y, lever.x)};
}

class FreeFigure {
public:
    FreeFigure(RigidScene& scene, const FigureRange& figure, const MotionRate& rate)
        : scene_(scene), figure_(figure), rate_(rate) {}

    void keep_momentum() {
        const FigureMomentum now(scene_, figure_);
        const FreeMotion& motion = figure_.motion;
        const Vec3 spin = motion.has_axis ? now.inertia().spin_about(motion.axis, motion.lost)
                                          : now.inertia().spin_of(motion.lost);
        if (spin == Vec3{0, 0, 0}) {
            return;
        }
        for_each_body([&](Body& body) {
            set_speeds(body, body.velocity + turning(spin, lever_of(now, body)),
                       body.angular_velocity + spin);
        });
        if (motion.passive) {
            take_out_gain(motion.energy);
        }
    }

private:
    template <typename Use>
    void for_each_body(const Use& use) {
        for_each_part(scene_, figure_, Part::body, [&](std::uint32_t i) { use(scene_.bodies[i]); });
    }

    Vec3 lever_of(const FigureMomentum& momentum, const Body& body) const {
        return saturating_subtract(body.position, momentum.position());
    }

    void take_out_gain(const Int128& most) {
        const FigureMomentum now(scene_, figure_);
        const Int128 energy = now.energy();
        const Int128 allowed = std::max(most, Int128{0, 0});
        if (energy <= allowed) {
            return;
        }
        // A little is the rounding of turns, and not of what moves within.
        Speeds whole{now.velocity(), {0, 0, 0}};
        std::int64_t beside = one_factor;
        std::int64_t together = one_factor;
        if (energy - allowed <= allowed >> 8) {
            together = energy_factor(allowed, energy);
        } else {
            const Sum3 momentum = now.momentum();
            whole.spin = now.inertia().spin_of(momentum);
            const Int128 least = energy_of_turning(momentum, whole.spin);
            beside = allowed > least ? energy_factor(allowed - least, energy - least) : 0;
            together = allowed < least ? energy_factor(allowed, least) : one_factor;
        }
        for_each_body([&](Body& body) {
            const Vec3 turned = turning(whole.spin, lever_of(now, body));
            const Vec3 own = body.velocity - whole.velocity - turned;
            set_speeds(body, whole.velocity + times(turned + times(own, beside), together),
                       times(whole.spin + times(body.angular_velocity - whole.spin, beside), together));
        });
    }

    void set_speeds(Body& body, const Vec3& velocity, const Vec3& spin) {
        body.velocity = velocity;
        body.angular_velocity = spin;
        clamp_vector(body.velocity, rate_.speed_limit);
        clamp_vector(body.angular_velocity, rate_.spin_limit);
    }

    RigidScene& scene_;
    const FigureRange& figure_;
    const MotionRate& rate_;
};

} // namespace

void FreeFigures::begin_substep(FigureRange& figure, std::uint32_t substep) const {
    FreeMotion& motion = figure.motion;
    if (substep == 1) {
        begin_tick(scene_, figure, rate_);
    }
    if (motion.passive && (substep == 1 || motion.each_substep)) {
        motion.energy = FigureMomentum(scene_, figure).energy();
    }
}

void FreeFigures::finish_substep(FigureRange& figure, std::uint32_t substep) const {
    FreeMotion& motion = figure.motion;
    if (!motion.free) {
        return;
    }
    if (is_pushed_from_outside(scene_, figure) || is_pushed_by_limit(scene_, motion)) {
        motion.free = motion.each_substep;
        motion.lost = {};
        return;
    }
    motion.lost = motion.lost + lost_momentum(scene_, figure, rate_);
    if (motion.gravity_works) {
        motion.energy = motion.energy + work_of_gravity(scene_, figure, rate_);
    }
    if (motion.each_substep || substep == substeps_) {
        FreeFigure(scene_, figure, rate_).keep_momentum();
        motion.lost = {};
    }
}

} // namespace lks
