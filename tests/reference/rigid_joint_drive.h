// What a joint resists turning with, and its motor, in the rigid reference solver
// (sdk/src/rigid/joint_drive.h).
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/rigid_body.h"
#include "reference/rigid_limits.h"

namespace reference {

template <typename Scalar>
class JointDrive {
public:
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;
    using Body = MovingBody<Scalar>;

    // rate: substeps a second.
    JointDrive(const RigidJoint& joint, Scalar rate)
        : hinge_(joint.kind == LKS_JOINT_HINGE), frame_a_(quaternion_of<Scalar>(joint.frame_a)),
          frame_b_(quaternion_of<Scalar>(joint.frame_b)), limits_(joint, rate), rate_(rate),
          friction_(static_cast<Scalar>(joint.friction)),
          drag_softness_(joint.angular_damping > 0 ? rate / static_cast<Scalar>(joint.angular_damping) : 0) {
        set_motor(joint.motor);
    }

    void set_motor(const RigidMotor& motor) {
        motor_ = motor.max_torque > 0;
        target_ = limits_.nearest_within(quaternion_of<Scalar>(motor.target));
        motor_share_ = 1 / std::max(static_cast<Scalar>(motor.response) * rate_, Scalar(8));
        most_ = (motor_ ? static_cast<Scalar>(motor.max_torque) : friction_) / (rate_ * rate_);
    }

    bool is_motor() const { return motor_; }
    bool acts() const { return most_ > 0; }
    bool resists() const { return acts() || drag_softness_ > 0; }

    // Before the prediction: what the motor is to turn in the substep.
    void begin(const Body& a, const Body& b) {
        aim_ = motor_ ? missing_turn(a, b) * motor_share_ : Vec{};
        if (motor_ && !hinge_) {
            aim_ = limits_.along(a, b, aim_);
        }
    }

    // Drags begin each substep anew, and motors with less than they pushed: swings would feed on it.
    void prepare(const Body& a) {
        drag_ = {};
        grip_ = driven_part(a, grip_) * (motor_ ? 1 - 2 * motor_share_ : Scalar(1));
    }
    const Vec& pushed() const { return grip_; }
    // What is added.
    Vec add(Scalar share) {
        const Vec before = grip_;
        grip_ = within_grip(before + before * share);
        return grip_ - before;
    }

    void project(Body& a, Body& b) {
        if (drag_softness_ > 0) {
            drag(a, b);
        }
        if (most_ > 0) {
            drive(a, b);
        }
    }

private:
    // How much b has turned against a in this substep: as spins have it, by Cayley's map.
    static Vec turned_since_start(const Body& a, const Body& b) {
        return (half_turn_between(b.start_orientation, b.orientation) -
                half_turn_between(a.start_orientation, a.orientation)) *
               Scalar(2);
    }

    // To the target, about any axis or about the hinge's.
    Vec missing_turn(const Body& a, const Body& b) const {
        const Quat now = (a.orientation * frame_a_).conjugate() * (b.orientation * frame_b_);
        Quat q = target_ * now.conjugate();
        if (hinge_) {
            q.x = q.z = 0;
        }
        return a.rotation * (frame_a_.matrix() * q.vector()) * angle_by_vector(q);
    }

    // As much of it as friction, or the motor, is capable of.
    Vec within_grip(const Vec& push) const {
        const Scalar size = push.length();
        return size > most_ ? push * (most_ / size) : push;
    }

    // A push about the axis that turns so far.
    static Vec push_for(const Body& a, const Body& b, const Vec& axis, Scalar angle, Scalar softness) {
        return axis * (angle / (axis.dot(a.world_inverse * axis + b.world_inverse * axis) + softness));
    }

    // A hinge's friction, or motor, bears nothing across its axis.
    Vec driven_part(const Body& a, const Vec& turn) const {
        const Vec axis = a.rotation * frame_a_.matrix().column(1);
        return hinge_ ? axis * axis.dot(turn) : turn;
    }

    // By what the aim is missed by.
    void drive(Body& a, Body& b) {
        const Vec missed = driven_part(a, turned_since_start(a, b) - aim_);
        const Scalar size = missed.length();
        if (size == 0) {
            return;
        }
        const Vec before = grip_;
        grip_ = within_grip(before + push_for(a, b, missed * (1 / size), -size, 0));
        turn_apart(a, b, grip_ - before);
    }

    // A torque against the speed of turning.
    void drag(Body& a, Body& b) {
        const Vec turned = turned_since_start(a, b);
        const Scalar size = turned.length();
        if (size == 0) {
            return;
        }
        const Vec axis = turned * (1 / size);
        const Vec push = push_for(a, b, axis, -(size + drag_softness_ * axis.dot(drag_)), drag_softness_);
        drag_ = drag_ + push;
        turn_apart(a, b, push);
    }

    bool hinge_;
    Quat frame_a_, frame_b_;
    JointLimits<Scalar> limits_; // for what they let a motor aim at
    Scalar rate_;
    Scalar friction_;
    bool motor_ = false;
    Quat target_;
    Scalar motor_share_ = 0; // of what is missing, in a substep
    Scalar most_ = 0;        // kg·m², of friction or the motor; 0: none
    Scalar drag_softness_;   // 0: none
    Vec grip_;               // kg·m², of friction or the motor: carried from substep to substep
    // Of the substep.
    Vec aim_;
    Vec drag_; // kg·m²
};

} // namespace reference
