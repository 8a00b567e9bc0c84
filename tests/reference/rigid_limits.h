// The limits of swing and twist of the rigid reference solver: as sdk/src/rigid/joint_limits.h has them, from
// the definitions of the angles on.
#pragma once

#include <cmath>

#include "reference/rigid_body.h"
#include "reference/rigid_held.h"
#include "reference/rigid_softness.h"

namespace reference {

// Of one joint. Frames are given in the bodies' axes; the axis is local y.
template <typename Scalar>
class JointLimits {
public:
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;
    using Body = MovingBody<Scalar>;

    // rate: substeps a second.
    JointLimits(const RigidJoint& joint, Scalar rate)
        : frame_a_(quaternion_of<Scalar>(joint.frame_a)), frame_b_(quaternion_of<Scalar>(joint.frame_b)),
          swings_(joint.kind == LKS_JOINT_BALL &&
                  std::min(joint.swing_limit, joint.swing_limit_z) < half_circle),
          twists_((joint.kind == LKS_JOINT_BALL || joint.kind == LKS_JOINT_HINGE) &&
                  (joint.twist_min > -half_circle || joint.twist_max < half_circle)),
          limit_x_(static_cast<Scalar>(joint.swing_limit)),
          limit_z_(static_cast<Scalar>(joint.swing_limit_z)),
          twist_min_(static_cast<Scalar>(joint.twist_min)), twist_max_(static_cast<Scalar>(joint.twist_max)),
          softness_(joint.limit_compliance, joint.limit_damping, rate) {}

    bool is_soft() const { return softness_.is_soft(); }
    bool any() const { return swings_ || twists_; }
    bool pushes() const { return swing_push_ != 0 || twist_push_ != 0; }

    // Before the prediction: how far they let turn.
    void begin(const Body& a, const Body& b) {
        Swing swing;
        swing_beyond_ = -Scalar(half_circle); // certainly within
        if (swings_ && find_swing(a, b, swing)) {
            swing_beyond_ = swing.angle - swing.limit;
            swing_axis_ = swing.axis;
        }
        twist_least_ = twist_min_;
        twist_most_ = twist_max_;
        Twist twist;
        if (twists_ && find_twist(a, b, twist)) {
            twist_least_ = std::min(twist_min_, twist.angle);
            twist_most_ = std::max(twist_max_, twist.angle);
        }
    }

    // What a motor aims at instead of a target: what is next to it within them (sdk/src/rigid/motor_aim.h).
    Quat nearest_within(const Quat& target) const {
        const Scalar length = std::hypot(target.y, target.w);
        if (softness_.is_soft() || length == 0) {
            return target;
        }
        const Quat twist{0, target.y / length, 0, target.w / length};
        return (swings_ ? nearest_swing(target * twist.conjugate()) : target * twist.conjugate()) *
               (twists_ ? nearest_twist(twist) : twist);
    }

    // What a motor is to turn, no further beyond them.
    Vec along(const Body& a, const Body& b, Vec aim) const {
        const auto no_further = [&aim](const Vec& axis, Scalar room) {
            aim = aim - axis * std::max(axis.dot(aim) - std::max(room, Scalar(0)), Scalar(0));
        };
        if (softness_.is_soft()) {
            return aim;
        }
        if (swings_) {
            const Swing swing = measure_swing(a, b);
            no_further(swing.axis, swing.limit - swing.angle);
        }
        if (twists_) {
            const Twist twist = measure_twist(a, b);
            no_further(twist.axis, (twist_max_ - twist.angle) * twist.share);
            no_further(twist.axis * Scalar(-1), (twist.angle - twist_min_) * twist.share);
        }
        return aim;
    }

    // Soft ones begin each substep anew, and those that are solved with a tree.
    void prepare(bool in_tree) {
        if (softness_.is_soft() || in_tree) {
            swing_push_ = twist_push_ = 0;
        }
    }
    void push_again(Body& a, Body& b) const { push(a, b, swing_push_, twist_push_); }
    // What they push, b against a.
    Vec pushed(const Body& a, const Body& b) const {
        Vec sum;
        Swing swing;
        if (swing_push_ != 0 && find_pushed_swing(a, b, swing)) {
            sum = swing.axis * -swing_push_;
        }
        return twist_push_ != 0 ? sum + measure_twist(a, b).axis * twist_push_ : sum;
    }
    void carry_more(Body& a, Body& b, Scalar share) {
        push(a, b, swing_push_ * share, twist_push_ * share);
        scale(share);
    }
    void scale(Scalar share) {
        swing_push_ += swing_push_ * share;
        twist_push_ += twist_push_ * share;
    }

    void project(Body& a, Body& b) {
        if (swings_) {
            hold_swing(a, b);
        }
        if (twists_) {
            hold_twist(a, b);
        }
    }

    // In this substep; soft ones never.
    Scalar exceeded(const Body& a, const Body& b) const {
        Scalar beyond = 0;
        if (softness_.is_soft()) {
            return beyond;
        }
        Swing swing;
        if (swings_ && find_swing(a, b, swing)) {
            beyond = swing.angle - swing.limit - std::max(swing_beyond_, Scalar(0));
        }
        Twist twist;
        if (twists_ && find_twist(a, b, twist)) {
            beyond = std::max(beyond,
                              twist.share * std::max(twist.angle - twist_most_, twist_least_ - twist.angle));
        }
        return beyond;
    }

    // By how much they are exceeded at all.
    Scalar beyond(const Body& a, const Body& b) const {
        Scalar worst = 0;
        if (softness_.is_soft()) {
            return worst;
        }
        Swing swing;
        if (swings_ && find_swing(a, b, swing)) {
            worst = swing.angle - swing.limit;
        }
        Twist twist;
        if (twists_ && find_twist(a, b, twist)) {
            worst =
                std::max(worst, twist.share * std::max(twist.angle - twist_max_, twist_min_ - twist.angle));
        }
        return worst;
    }

    // In this substep, or at all; of a twist the nearer one.
    void add_rows(const Body& a, const Body& b, bool in_substep, std::vector<HeldRow<Scalar>>& rows) {
        if (softness_.is_soft()) {
            return;
        }
        if (swings_) {
            Swing swing = measure_swing(a, b);
            if (in_substep) {
                turn_to_push(swing);
                swing_axis_ = swing.axis;
            }
            const Scalar limit = swing.limit + (in_substep ? std::max(swing_beyond_, Scalar(0)) : 0);
            rows.push_back({swing.axis * Scalar(-1), limit - swing.angle, in_substep ? swing_push_ : 0,
                            &swing_push_, 1});
        }
        if (twists_) {
            const Twist twist = measure_twist(a, b);
            const Scalar push = in_substep ? twist_push_ : 0;
            const Scalar to_most = ((in_substep ? twist_most_ : twist_max_) - twist.angle) * twist.share;
            const Scalar to_least = (twist.angle - (in_substep ? twist_least_ : twist_min_)) * twist.share;
            const bool most = push < 0 || (push == 0 && to_most < to_least);
            const Scalar sign = most ? -1 : 1;
            rows.push_back({twist.axis * sign, most ? to_most : to_least, push * sign, &twist_push_, sign});
        }
    }

    // Without giving speed. True: one was exceeded by more than half a degree.
    bool undo(Body& a, Body& b) const {
        constexpr Scalar more = Scalar(1.5); // the points of the joint hold much of it back
        if (softness_.is_soft()) {
            return false;
        }
        Scalar beyond = 0;
        Swing swing;
        if (swings_ && find_swing(a, b, swing) && swing.angle > swing.limit) {
            beyond = swing.angle - swing.limit;
            turn(a, b, swing.axis, push_for(a, b, swing.axis, -beyond * more));
        }
        Twist twist;
        if (twists_ && find_twist(a, b, twist)) {
            const Scalar back = (std::clamp(twist.angle, twist_min_, twist_max_) - twist.angle) * twist.share;
            beyond = std::max(beyond, std::abs(back));
            turn(a, b, twist.axis, push_for(a, b, twist.axis, back * more));
        }
        return beyond > Scalar(1) / 115;
    }

private:
    static constexpr double half_circle = 3.14159265358979323846;

    // How far the axes are apart, about which axis, and how far they may be.
    struct Swing {
        Vec axis;
        Scalar angle = 0;
        Scalar limit = 0;
    };

    Vec axis_a(const Body& a) const { return a.rotation * frame_a_.matrix().column(1); }
    Vec axis_b(const Body& b) const { return b.rotation * frame_b_.matrix().column(1); }

    Swing measure_swing(const Body& a, const Body& b) const {
        const Vec u = axis_a(a);
        const Vec v = axis_b(b);
        const Vec sine = cross(u, v);
        const Scalar length = sine.length();
        const Vec some = std::abs(u.x) < std::abs(u.y) ? Vec{0, -u.z, u.y} : Vec{-u.z, 0, u.x};
        return square_to_edge(a, v, length > 0 ? sine * (1 / length) : some * (1 / some.length()),
                              std::atan2(length, u.dot(v)), length);
    }
    // False: within the least limit, and nothing is pushed that could be taken back.
    bool find_swing(const Body& a, const Body& b, Swing& swing) const {
        swing = measure_swing(a, b);
        return swing.angle > std::min(limit_x_, limit_z_) || swing_push_ != 0;
    }

    // What has been turned back past the middle in this substep has swung by less than nothing.
    void turn_to_push(Swing& swing) const {
        if (swing_push_ != 0 && swing.axis.dot(swing_axis_) < 0) {
            swing.axis = swing.axis * Scalar(-1);
            swing.angle = -swing.angle;
        }
    }
    bool find_pushed_swing(const Body& a, const Body& b, Swing& swing) const {
        const bool found = find_swing(a, b, swing);
        turn_to_push(swing);
        return found;
    }

    // The parameter of the point of the ellipse that is next to (x, z), in the first quadrant.
    struct OnEllipse {
        Scalar cosine, sine;
    };
    OnEllipse nearest(Scalar x, Scalar z) const {
        OnEllipse t{std::sqrt(Scalar(0.5)), std::sqrt(Scalar(0.5))};
        const Scalar difference = limit_x_ * limit_x_ - limit_z_ * limit_z_;
        for (int i = 0; i < 4; ++i) {
            const Scalar centre_x = difference / limit_x_ * t.cosine * t.cosine * t.cosine;
            const Scalar centre_z = -difference / limit_z_ * t.sine * t.sine * t.sine;
            const Scalar radius = std::hypot(limit_x_ * t.cosine - centre_x, limit_z_ * t.sine - centre_z);
            const Scalar away = std::hypot(x - centre_x, z - centre_z);
            if (away == 0) {
                break;
            }
            const Scalar cosine =
                std::clamp(((x - centre_x) * radius / away + centre_x) / limit_x_, Scalar(0), Scalar(1));
            const Scalar sine =
                std::clamp(((z - centre_z) * radius / away + centre_z) / limit_z_, Scalar(0), Scalar(1));
            const Scalar length = std::hypot(cosine, sine);
            if (length == 0) {
                break;
            }
            t = {cosine / length, sine / length};
        }
        return t;
    }

    // Of a swing about x and z.
    Quat nearest_swing(const Quat& swing) const {
        const Scalar sine = std::hypot(swing.x, swing.z);
        const Scalar angle = 2 * std::atan2(sine, swing.w);
        const Scalar x = sine > 0 ? -swing.z / sine * angle : 0;
        const Scalar z = sine > 0 ? swing.x / sine * angle : 0;
        if (angle <= std::min(limit_x_, limit_z_) || std::hypot(x / limit_x_, z / limit_z_) <= 1) {
            return swing;
        }
        const OnEllipse t = limit_x_ == limit_z_ ? OnEllipse{std::abs(x) / angle, std::abs(z) / angle}
                                                 : nearest(std::abs(x), std::abs(z));
        const Scalar end_x = std::copysign(t.cosine * limit_x_, x);
        const Scalar end_z = std::copysign(t.sine * limit_z_, z);
        const Scalar end = std::hypot(end_x, end_z);
        const Scalar share = end > 0 ? std::sin(end / 2) / end : 0;
        return {end_z * share, 0, -end_x * share, std::cos(end / 2)};
    }
    // Of a twist about y.
    Quat nearest_twist(const Quat& twist) const {
        const auto up = [](Scalar from, Scalar to) {
            const Scalar way = std::remainder(to - from, 2 * Scalar(half_circle));
            return way < 0 ? way + 2 * Scalar(half_circle) : way;
        };
        const Scalar angle = 2 * std::atan2(twist.y, twist.w);
        if (up(twist_min_, angle) <= twist_max_ - twist_min_) {
            return twist;
        }
        const Scalar end = up(twist_max_, angle) <= up(angle, twist_min_) ? twist_max_ : twist_min_;
        return {0, std::sin(end / 2), 0, std::cos(end / 2)};
    }

    // As sdk/src/rigid/swing_ellipse.h has it.
    Swing square_to_edge(const Body& a, const Vec& v, const Vec& k, Scalar angle, Scalar sine) const {
        if (limit_x_ == limit_z_) {
            return {k, angle, limit_x_};
        }
        const Vec across_x = a.rotation * frame_a_.matrix().column(0);
        const Vec across_z = a.rotation * frame_a_.matrix().column(2);
        const Scalar reach = std::hypot(v.dot(across_x), v.dot(across_z));
        const bool x_is_less = limit_x_ < limit_z_;
        const Scalar cosine_phi = reach > 0 ? v.dot(across_x) / reach : Scalar(x_is_less ? 1 : 0);
        const Scalar sine_phi = reach > 0 ? v.dot(across_z) / reach : Scalar(x_is_less ? 0 : 1);
        const Scalar x = std::abs(angle * cosine_phi);
        const Scalar z = std::abs(angle * sine_phi);
        const OnEllipse t = nearest(x, z);
        const Scalar scale = std::hypot(t.cosine * limit_z_, t.sine * limit_x_);
        const Scalar n_x = t.cosine * limit_z_ / scale;
        const Scalar n_z = t.sine * limit_x_ / scale;
        const Scalar radial = n_x * std::abs(cosine_phi) + n_z * std::abs(sine_phi);
        const Scalar along =
            std::copysign(n_z, sine_phi) * cosine_phi - std::copysign(n_x, cosine_phi) * sine_phi;
        const Scalar least = angle > 2 ? Scalar(0.25) : Scalar(0);
        const Scalar over_sine = angle < Scalar(1) / 1024 ? Scalar(1) : angle / std::max(sine, least);
        const Vec m = cross(v, across_z * cosine_phi - across_x * sine_phi);
        const Vec way = k * radial + m * (along * over_sine);
        const Scalar length = way.length();
        return {way * (1 / length), (n_x * x + n_z * z) / length,
                (n_x * t.cosine * limit_x_ + n_z * t.sine * limit_z_) / length};
    }

    // About the middle of both axes, and how much of it is to be turned: all, but beyond 110 degrees of swing
    // no more than one and three quarters of what it takes.
    struct Twist {
        Vec axis;
        Scalar share = 1;
        Scalar angle = 0;
    };
    Twist measure_twist(const Body& a, const Body& b) const {
        Quat q = (a.orientation * frame_a_).conjugate() * (b.orientation * frame_b_);
        if (q.w < 0) {
            q = {-q.x, -q.y, -q.z, -q.w};
        }
        const Vec sum = axis_a(a) + axis_b(b);
        const Scalar length = sum.length();
        return {sum * (1 / length), std::min(length * Scalar(0.875), Scalar(1)), 2 * std::atan2(q.y, q.w)};
    }
    // False: within the limits.
    bool find_twist(const Body& a, const Body& b, Twist& twist) const {
        twist = measure_twist(a, b);
        return twist.angle < twist_min_ || twist.angle > twist_max_ || twist_push_ != 0;
    }

    // By how much it is beyond its limit, was when the substep began, and what has been pushed against that.
    Scalar to_turn_back(Scalar beyond, Scalar start, Scalar push) const {
        return softness_.is_soft() ? softness_.left(beyond, beyond - start, -push) : beyond - start;
    }

    void hold_swing(Body& a, Body& b) {
        Swing swing;
        if (!find_pushed_swing(a, b, swing)) {
            return;
        }
        swing_axis_ = swing.axis;
        const Scalar start = std::max(swing_beyond_, Scalar(0));
        const Scalar back = to_turn_back(swing.angle - swing.limit, start, swing_push_);
        const Scalar wanted = std::max(swing_push_ + push_for(a, b, swing.axis, back), Scalar(0));
        turn(a, b, swing.axis, swing_push_ - wanted);
        swing_push_ = wanted;
    }

    // Beyond its greatest it may only be turned down, below its least only up.
    void hold_twist(Body& a, Body& b) {
        Twist twist;
        if (!find_twist(a, b, twist)) {
            return;
        }
        const bool soft = softness_.is_soft();
        const auto push_back = [&](Scalar back) {
            return push_for(a, b, twist.axis, soft ? back : back * twist.share);
        };
        const Scalar before = twist_push_;
        if (twist.angle > (soft ? twist_max_ : twist_most_) || before < 0) {
            const Scalar back = to_turn_back(twist.angle - twist_max_, twist_most_ - twist_max_, -before);
            twist_push_ = std::min(before - push_back(back), Scalar(0));
        } else if (twist.angle < (soft ? twist_min_ : twist_least_) || before > 0) {
            const Scalar back = to_turn_back(twist_min_ - twist.angle, twist_min_ - twist_least_, before);
            twist_push_ = std::max(before + push_back(back), Scalar(0));
        }
        turn(a, b, twist.axis, twist_push_ - before);
    }

    void push(Body& a, Body& b, Scalar swing_push, Scalar twist_push) const {
        Swing swing;
        if (swing_push != 0 && find_pushed_swing(a, b, swing)) {
            turn(a, b, swing.axis, -swing_push);
        }
        if (twist_push != 0) {
            turn(a, b, measure_twist(a, b).axis, twist_push);
        }
    }

    Scalar push_for(const Body& a, const Body& b, const Vec& axis, Scalar angle) const {
        return angle / (axis.dot(a.world_inverse * axis + b.world_inverse * axis) + softness_.added);
    }
    static void turn(Body& a, Body& b, const Vec& axis, Scalar push) {
        a.turn(a.world_inverse * axis * -push);
        b.turn(b.world_inverse * axis * push);
    }

    Quat frame_a_, frame_b_;
    bool swings_, twists_;
    Scalar limit_x_, limit_z_, twist_min_, twist_max_;
    Softness<Scalar> softness_;
    // kg·m²: carried from substep to substep.
    Scalar swing_push_ = 0, twist_push_ = 0;
    // Of the substep.
    Scalar swing_beyond_ = 0, twist_least_ = 0, twist_most_ = 0;
    Vec swing_axis_; // about which b has swung where its limit pushes
};

} // namespace reference
