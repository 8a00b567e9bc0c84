// The limits of swing and twist of the rigid reference solver: as sdk/src/rigid/joint_limits.h has them, from
// the definitions of the angles on.
#pragma once

#include <cmath>

#include "reference/rigid_body.h"

namespace reference {

// Of one joint. Frames are given in the bodies' axes; the axis is local y.
template <typename Scalar>
class JointLimits {
public:
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;
    using Body = MovingBody<Scalar>;

    explicit JointLimits(const RigidJoint& joint)
        : frame_a_(quaternion_of<Scalar>(joint.frame_a)), frame_b_(quaternion_of<Scalar>(joint.frame_b)),
          swings_(joint.kind == LKS_JOINT_BALL &&
                  std::min(joint.swing_limit, joint.swing_limit_z) < half_circle),
          twists_((joint.kind == LKS_JOINT_BALL || joint.kind == LKS_JOINT_HINGE) &&
                  (joint.twist_min > -half_circle || joint.twist_max < half_circle)),
          limit_x_(static_cast<Scalar>(joint.swing_limit)),
          limit_z_(static_cast<Scalar>(joint.swing_limit_z)),
          twist_min_(static_cast<Scalar>(joint.twist_min)), twist_max_(static_cast<Scalar>(joint.twist_max)) {
    }

    // Before the prediction: how far they let turn.
    void begin(const Body& a, const Body& b) {
        Swing swing;
        swing_start_ = swings_ && find_swing(a, b, swing) ? swing.angle : Scalar(0);
        twist_least_ = twist_min_;
        twist_most_ = twist_max_;
        Scalar twist = 0;
        if (twists_ && find_twist(a, b, twist)) {
            twist_least_ = std::min(twist_min_, twist);
            twist_most_ = std::max(twist_max_, twist);
        }
    }

    void push_again(Body& a, Body& b) const { push(a, b, swing_push_, twist_push_); }
    void carry_more(Body& a, Body& b, Scalar share) {
        push(a, b, swing_push_ * share, twist_push_ * share);
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

    // In this substep.
    Scalar exceeded(const Body& a, const Body& b) const {
        Scalar beyond = 0;
        Swing swing;
        if (swings_ && find_swing(a, b, swing)) {
            beyond = swing.angle - std::max(swing.limit, swing_start_);
        }
        Scalar twist = 0;
        if (twists_ && find_twist(a, b, twist)) {
            beyond = std::max({beyond, twist - twist_most_, twist_least_ - twist});
        }
        return beyond;
    }

    // Without giving speed. True: one was exceeded by more than half a degree.
    bool undo(Body& a, Body& b) const {
        constexpr Scalar more = Scalar(1.5); // the points of the joint hold much of it back
        Scalar beyond = 0;
        Swing swing;
        if (swings_ && find_swing(a, b, swing) && swing.angle > swing.limit) {
            beyond = swing.angle - swing.limit;
            turn(a, b, swing.axis, push_for(a, b, swing.axis, -beyond * more));
        }
        Scalar twist = 0;
        if (twists_ && find_twist(a, b, twist)) {
            const Scalar back = std::clamp(twist, twist_min_, twist_max_) - twist;
            const Vec axis = twist_axis(a, b);
            beyond = std::max(beyond, std::abs(back));
            turn(a, b, axis, push_for(a, b, axis, back * more));
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

    // False: within the least limit, and nothing is pushed that could be taken back.
    bool find_swing(const Body& a, const Body& b, Swing& swing) const {
        const Vec u = axis_a(a);
        const Vec v = axis_b(b);
        const Vec sine = cross(u, v);
        swing.angle = std::atan2(sine.length(), u.dot(v));
        if (swing.angle <= std::min(limit_x_, limit_z_) && swing_push_ == 0) {
            return false;
        }
        swing.axis = sine * (1 / sine.length());
        swing.limit = swing_limit(a, v);
        return true;
    }

    // On the ellipse: (cos φ/limit_x, sin φ/limit_z) has length 1/limit.
    Scalar swing_limit(const Body& a, const Vec& v) const {
        if (limit_x_ == limit_z_) {
            return limit_x_;
        }
        const Scalar x = v.dot(a.rotation * frame_a_.matrix().column(0));
        const Scalar z = v.dot(a.rotation * frame_a_.matrix().column(2));
        return std::hypot(x, z) / std::hypot(x / limit_x_, z / limit_z_);
    }

    // False: within the limits.
    bool find_twist(const Body& a, const Body& b, Scalar& twist) const {
        Quat q = (a.orientation * frame_a_).conjugate() * (b.orientation * frame_b_);
        if (q.w < 0) {
            q = {-q.x, -q.y, -q.z, -q.w};
        }
        twist = 2 * std::atan2(q.y, q.w);
        return twist < twist_min_ || twist > twist_max_ || twist_push_ != 0;
    }

    // About the middle of both axes.
    Vec twist_axis(const Body& a, const Body& b) const {
        const Vec sum = axis_a(a) + axis_b(b);
        return sum * (1 / sum.length());
    }

    void hold_swing(Body& a, Body& b) {
        Swing swing;
        if (!find_swing(a, b, swing)) {
            return;
        }
        const Scalar beyond = swing.angle - std::max(swing.limit, swing_start_);
        const Scalar wanted = std::max(swing_push_ + push_for(a, b, swing.axis, beyond), Scalar(0));
        turn(a, b, swing.axis, swing_push_ - wanted);
        swing_push_ = wanted;
    }

    // Beyond its greatest it may only be turned down, below its least only up.
    void hold_twist(Body& a, Body& b) {
        Scalar twist = 0;
        if (!find_twist(a, b, twist)) {
            return;
        }
        const Vec axis = twist_axis(a, b);
        const Scalar before = twist_push_;
        if (twist > twist_most_ || before < 0) {
            twist_push_ = std::min(before + push_for(a, b, axis, twist_most_ - twist), Scalar(0));
        } else if (twist < twist_least_ || before > 0) {
            twist_push_ = std::max(before + push_for(a, b, axis, twist_least_ - twist), Scalar(0));
        }
        turn(a, b, axis, twist_push_ - before);
    }

    void push(Body& a, Body& b, Scalar swing_push, Scalar twist_push) const {
        Swing swing;
        if (swing_push != 0 && find_swing(a, b, swing)) {
            turn(a, b, swing.axis, -swing_push);
        }
        if (twist_push != 0) {
            turn(a, b, twist_axis(a, b), twist_push);
        }
    }

    static Scalar push_for(const Body& a, const Body& b, const Vec& axis, Scalar angle) {
        return angle / axis.dot(a.world_inverse * axis + b.world_inverse * axis);
    }
    static void turn(Body& a, Body& b, const Vec& axis, Scalar push) {
        a.turn(a.world_inverse * axis * -push);
        b.turn(b.world_inverse * axis * push);
    }

    Quat frame_a_, frame_b_;
    bool swings_, twists_;
    Scalar limit_x_, limit_z_, twist_min_, twist_max_;
    // kg·m²: carried from substep to substep.
    Scalar swing_push_ = 0, twist_push_ = 0;
    // Of the substep.
    Scalar swing_start_ = 0, twist_least_ = 0, twist_most_ = 0;
};

} // namespace reference
