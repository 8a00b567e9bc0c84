// What resists a joint's turning by its speed, in the rigid reference solver (sdk/src/rigid/joint_drive.h).
#pragma once

#include "reference/rigid_body.h"

namespace reference {

template <typename Scalar>
class JointDrive {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;

    // rate: substeps a second.
    JointDrive(const RigidJoint& joint, Scalar rate)
        : drags_(joint.angular_damping > 0),
          drag_softness_(drags_ ? rate / static_cast<Scalar>(joint.angular_damping) : 0) {}

    // Drags begin each substep anew.
    void prepare() { drag_ = {}; }

    void project(Body& a, Body& b) {
        if (drags_) {
            drag(a, b);
        }
    }

private:
    // How much b has turned against a in this substep: as spins have it, by Cayley's map.
    static Vec turned_since_start(const Body& a, const Body& b) {
        return (half_turn_between(b.start_orientation, b.orientation) -
                half_turn_between(a.start_orientation, a.orientation)) *
               Scalar(2);
    }

    // A torque against the speed of turning.
    void drag(Body& a, Body& b) {
        const Vec turned = turned_since_start(a, b);
        const Scalar size = turned.length();
        if (size == 0) {
            return;
        }
        const Vec axis = turned * (1 / size);
        const Scalar weight = axis.dot(a.world_inverse * axis + b.world_inverse * axis) + drag_softness_;
        const Vec push = axis * (-(size + drag_softness_ * axis.dot(drag_)) / weight);
        drag_ = drag_ + push;
        turn_apart(a, b, push);
    }

    bool drags_;
    Scalar drag_softness_;
    Vec drag_; // kg·m², of the substep
};

} // namespace reference
