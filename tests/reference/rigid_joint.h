// A joint of the rigid reference solver: where its points are, what it does not let turn, and its limits. The
// points are brought together by the solver, all joints at once.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "reference/rigid_limits.h"
#include "reference/symmetric_system.h"

namespace reference {

template <typename Scalar>
class HeldJoint {
public:
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;
    using Body = MovingBody<Scalar>;

    explicit HeldJoint(const RigidJoint& from)
        : a(from.a), b(from.b), limits(from), kind_(from.kind), point_a_(from.point_a),
          point_b_(from.point_b), frame_a_(quaternion_of<Scalar>(from.frame_a)),
          frame_b_(quaternion_of<Scalar>(from.frame_b)) {}

    std::size_t a, b;
    JointLimits<Scalar> limits;
    // Of the substep.
    Vec start;            // how far the points were apart at its beginning
    Vec lever_a, lever_b; // at the predicted pose
    Vec push;             // kg·m, of the points
    Scalar tension = 0;   // the same of the substep before

    void begin(const Body& body_a, const Body& body_b) {
        tension = std::abs(push.x) + std::abs(push.y) + std::abs(push.z);
        push = {};
        start = offset(body_a, body_b);
        turn_start_ = turned_apart(body_a, body_b);
        limits.begin(body_a, body_b);
    }

    // How far b's point is from a's.
    Vec offset(const Body& body_a, const Body& body_b) const {
        return body_b.position - body_a.position + body_b.rotation * point_b_ - body_a.rotation * point_a_;
    }
    void place_levers(const Body& body_a, const Body& body_b) {
        lever_a = body_a.rotation * point_a_;
        lever_b = body_b.rotation * point_b_;
    }

    // (hω)² of each body's swing across the lever under the tension.
    void add_loads(Body& body_a, Body& body_b) const {
        body_a.load += tension * swing_arm(body_a, point_a_);
        body_b.load += tension * swing_arm(body_b, point_b_);
    }

    // After the prediction.
    void turn_again(Body& body_a, Body& body_b) {
        if (holds_turn()) {
            factor_turning(body_a, body_b);
            if (kind_ == LKS_JOINT_HINGE) {
                const Vec u = hinge_axis(body_a);
                turn_ = turn_ - u * u.dot(turn_);
            }
            turn_apart(body_a, body_b, turn_);
        }
        limits.push_again(body_a, body_b);
    }
    void carry_more(Body& body_a, Body& body_b, Scalar share) {
        if (holds_turn()) {
            const Vec more = turn_ * share;
            turn_ = turn_ + more;
            turn_apart(body_a, body_b, more);
        }
        limits.carry_more(body_a, body_b, share);
    }

    void project_turn(Body& body_a, Body& body_b) {
        if (holds_turn()) {
            turn_ = turn_ + turn_back(body_a, body_b, turned_apart(body_a, body_b) - turn_start_);
        }
        limits.project(body_a, body_b);
    }

    // Without giving speed. True: a limit was exceeded by more than half a degree.
    bool undo_turn(Body& body_a, Body& body_b) const {
        if (holds_turn()) {
            turn_back(body_a, body_b, turned_apart(body_a, body_b));
        }
        return limits.undo(body_a, body_b);
    }

private:
    // |r|·(tr I⁻¹ − r̂ᵀI⁻¹r̂)
    static Scalar swing_arm(const Body& body, const Vec& point) {
        const Scalar length = point.length();
        if (length == 0) {
            return 0;
        }
        const Vec& inverse = body.inverse_inertia;
        const Vec along = point * (1 / length);
        return length * (inverse.x + inverse.y + inverse.z - along.dot(products(inverse, along)));
    }

    bool holds_turn() const { return kind_ != LKS_JOINT_BALL; }

    // b against a, by a turning push.
    static void turn_apart(Body& body_a, Body& body_b, const Vec& push) {
        body_a.turn(body_a.world_inverse * push * Scalar(-1));
        body_b.turn(body_b.world_inverse * push);
    }

    // What hinges and fixed joints don't let turn: the sine between the axes, or twice the sine of half the
    // angle between the frames.
    Vec turned_apart(const Body& body_a, const Body& body_b) const {
        if (kind_ == LKS_JOINT_HINGE) {
            return cross(hinge_axis(body_a), body_b.rotation * frame_b_.matrix().column(1));
        }
        if (kind_ == LKS_JOINT_FIXED) {
            const Quat q = (body_a.orientation * frame_a_).conjugate() * (body_b.orientation * frame_b_);
            const Vec sine = q.vector() * Scalar(q.w < 0 ? -2 : 2);
            return body_a.rotation * (frame_a_.matrix() * sine);
        }
        return {};
    }

    Vec hinge_axis(const Body& body_a) const { return body_a.rotation * frame_a_.matrix().column(1); }

    // What turning pushes do, in all directions. Hinges have a number of its own along their axis.
    void factor_turning(const Body& body_a, const Body& body_b) {
        const Vec axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const bool hinge = kind_ == LKS_JOINT_HINGE;
        const Vec u = hinge_axis(body_a);
        const auto across = [&](const Vec& v) { return hinge ? v - u * u.dot(v) : v; };
        const auto turned = [&](const Vec& push) {
            return body_a.world_inverse * push + body_b.world_inverse * push;
        };
        const Scalar along = hinge ? greatest(turned({1, 1, 1})) : Scalar(0);
        std::vector<Scalar> matrix(9);
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                matrix[3 * row + column] = across(axes[row]).dot(turned(across(axes[column]))) +
                                           along * u.dot(axes[row]) * u.dot(axes[column]);
            }
        }
        turning_.factor(3, std::move(matrix));
    }

    // The push that turns it back.
    Vec turn_back(Body& body_a, Body& body_b, const Vec& error) const {
        std::vector<Scalar> push{-error.x, -error.y, -error.z};
        turning_.solve(push);
        turn_apart(body_a, body_b, {push[0], push[1], push[2]});
        return {push[0], push[1], push[2]};
    }

    std::uint32_t kind_;
    Vec point_a_, point_b_;
    Quat frame_a_, frame_b_;
    Vec turn_; // b against a: carried from substep to substep
    // Of the substep.
    Vec turn_start_;
    SymmetricSystem<Scalar> turning_;
};

} // namespace reference
