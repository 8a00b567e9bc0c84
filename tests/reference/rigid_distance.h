// The points of a distance joint of the rigid reference solver: rods, ropes that only pull, struts that only
// push (sdk/src/rigid/joint_distance.cpp). One row along the way between the points, which begins each
// substep from nothing; what it can't have left itself of an error is undone without speed.
#pragma once

#include <algorithm>
#include <cmath>

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

    // From a's point to b's at levers as the bodies stand; `push`: what was pushed in the substep before,
    // which is as much as it may have left of the error.
    void begin(const Body& a, const Vec& lever_a, const Body& b, const Vec& lever_b, const Vec& offset,
               const Vec& push) {
        const Row row(*this, a, lever_a, b, lever_b, offset);
        const Scalar error = error_of(row.length);
        const Scalar moved = std::abs(row.way.dot(push)) / row.push.push_for(1);
        kept_ = softness_.is_soft() ? Scalar(0) : error - std::clamp(error, -moved, moved);
    }

    // `begin`: the offset at the substep's beginning, `push`: what has been pushed in it, which is replaced.
    void project(Body& a, const Vec& lever_a, Body& b, const Vec& lever_b, const Vec& offset,
                 const Vec& begin, Vec& push) const {
        const Row row(*this, a, lever_a, b, lever_b, offset);
        const Scalar before = row.way.dot(push);
        const Hold hold = hold_at(row.length, before);
        if (hold == Hold::nothing) {
            push = {};
            return;
        }
        const Scalar error = row.length - (hold == Hold::back ? most() : least());
        const Scalar left = softness_.left(error, row.way.dot(offset - begin), before);
        const Scalar more = allowed(before - row.push.push_for(left), hold) - before;
        push = row.way * (before + more);
        row.apply(more, a, b);
    }

    // What a solve of several at once (rigid_closures.h) is to bring to zero along the way from a to b, in a
    // substep or without speed. `side`: -1: a rope, which pushes less than zero; 1: a strut; 0: a rod.
    struct Left {
        Vec way;
        Scalar left, pushed;
        int side;
    };
    Left left_of(const Vec& offset, const Vec& begin, const Vec& push, bool in_substep) const {
        const Scalar length = offset.length();
        const Vec way = length == 0 ? Vec{1, 0, 0} : offset * (1 / length);
        const auto side_of = [&](Scalar least, Scalar most, Scalar pushed) {
            return is_rod()                          ? 0
                   : pushed != 0                     ? (pushed < 0 ? -1 : 1)
                   : most - length <= length - least ? -1
                                                     : 1;
        };
        if (!in_substep && softness_.is_soft()) {
            return {way, length - kept_, 0, 0};
        }
        const Scalar pushed = in_substep ? way.dot(push) : Scalar(0);
        const int side = in_substep ? side_of(least(), most(), pushed) : side_of(min_, max_, 0);
        const Scalar to = side > 0 ? (in_substep ? least() : min_) : (in_substep ? most() : max_);
        return {way, in_substep ? softness_.left(length - to, way.dot(offset - begin), pushed) : length - to,
                pushed, side};
    }
    // What is undone leaves it as long as it is.
    void hold(const Vec& offset) { kept_ = offset.length(); }
    // What it is off by when a substep begins is kept in it.
    void keep(const Vec& offset) { kept_ = softness_.is_soft() ? Scalar(0) : error_of(offset.length()); }

    // What was kept, without giving speed.
    void undo(Body& a, const Vec& lever_a, Body& b, const Vec& lever_b, const Vec& offset) const {
        const Row row(*this, a, lever_a, b, lever_b, offset);
        const Scalar error = error_of(row.length);
        row.apply(
            -row.push.push_for(std::clamp(error, std::min(kept_, Scalar(0)), std::max(kept_, Scalar(0)))), a,
            b);
    }

private:
    enum class Hold { nothing, back, off };

    struct Row {
        Row(const JointDistance& joint, const Body& a, const Vec& lever_a, const Body& b, const Vec& lever_b,
            const Vec& offset)
            : length(offset.length()), way(length == 0 ? Vec{1, 0, 0} : offset * (1 / length)),
              push(way, a, lever_a, b, lever_b, joint.softness_.added) {}

        void apply(Scalar p, Body& a, Body& b) const {
            BodyMove<Scalar> move_a, move_b;
            push.add(p, move_a, move_b);
            move_a.apply_to(a);
            move_b.apply_to(b);
        }

        Scalar length;
        Vec way;
        PushRow<Scalar> push;
    };

    bool is_rod() const { return min_ == max_; }
    // By how much it is too long, or, below zero, too short.
    Scalar error_of(Scalar length) const { return length - std::clamp(length, min_, max_); }
    // What the substep lets be.
    Scalar most() const { return max_ + (is_rod() ? kept_ : std::max(kept_, Scalar(0))); }
    Scalar least() const { return min_ + (is_rod() ? kept_ : std::min(kept_, Scalar(0))); }
    // What has been pushed may be taken back, even where the distance is right by now.
    Hold hold_at(Scalar length, Scalar before) const {
        if (is_rod() || length > most() || before < 0) {
            return Hold::back;
        }
        return length < least() || before > 0 ? Hold::off : Hold::nothing;
    }
    Scalar allowed(Scalar push, Hold hold) const {
        if (is_rod()) {
            return push;
        }
        return hold == Hold::back ? std::min(push, Scalar(0)) : std::max(push, Scalar(0));
    }

    Scalar min_, max_;
    Softness<Scalar> softness_;
    Scalar kept_ = 0; // of the substep's error
};

} // namespace reference
