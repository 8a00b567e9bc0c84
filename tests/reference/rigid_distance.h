// The points of a distance joint of the rigid reference solver: rods, ropes that only pull, struts that only
// push (sdk/src/rigid/joint.cpp). One row along the way between the points, which begins each substep from
// nothing.
#pragma once

#include <algorithm>

#include "reference/rigid_body.h"
#include "reference/rigid_softness.h"

namespace reference {

template <typename Scalar>
class JointDistance {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;

    JointDistance(const RigidJoint& joint, const Softness<Scalar>& softness)
        : min_(static_cast<Scalar>(joint.distance_min)), max_(static_cast<Scalar>(joint.distance_max)),
          softness_(softness) {}

    // From a's point to b's at levers as the bodies stand; `begin`: the same at the substep's beginning,
    // `push`: what has been pushed in it, which is replaced.
    void project(Body& a, const Vec& lever_a, Body& b, const Vec& lever_b, const Vec& offset,
                 const Vec& begin, Vec& push) const {
        const Scalar length = offset.length();
        const Vec way = length == 0 ? Vec{1, 0, 0} : offset * (1 / length);
        const Scalar before = way.dot(push);
        const Hold hold = hold_at(length, before);
        if (hold == Hold::nothing) {
            push = {};
            return;
        }
        const Scalar error = length - (hold == Hold::back ? max_ : min_);
        const Scalar left = softness_.left(error, way.dot(offset - begin), before);
        const PushRow<Scalar> row(way, a, lever_a, b, lever_b, softness_.added);
        const Scalar more = allowed(before - row.push_for(left), hold) - before;
        push = way * (before + more);
        BodyMove<Scalar> move_a, move_b;
        row.add(more, move_a, move_b);
        move_a.apply_to(a);
        move_b.apply_to(b);
    }

private:
    enum class Hold { nothing, back, off };

    bool is_rod() const { return min_ == max_; }
    // What has been pushed may be taken back, even where the distance is right by now.
    Hold hold_at(Scalar length, Scalar before) const {
        if (is_rod() || length > max_ || before < 0) {
            return Hold::back;
        }
        return length < min_ || before > 0 ? Hold::off : Hold::nothing;
    }
    Scalar allowed(Scalar push, Hold hold) const {
        if (is_rod()) {
            return push;
        }
        return hold == Hold::back ? std::min(push, Scalar(0)) : std::max(push, Scalar(0));
    }

    Scalar min_, max_;
    Softness<Scalar> softness_;
};

} // namespace reference
