// A joint of the rigid reference solver: where its points are, what it does not let turn, and its limits. The
// points of trees are brought together by the solver, all joints at once; those of joints that close loops,
// or have soft turns, by a block each. Soft ones and distances begin each substep from nothing, as XPBD has
// them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "reference/rigid_distance.h"
#include "reference/rigid_joint_drive.h"
#include "reference/rigid_joint_points.h"
#include "reference/rigid_limits.h"
#include "reference/symmetric_system.h"

namespace reference {

template <typename Scalar>
class HeldJoint {
public:
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;
    using Body = MovingBody<Scalar>;

    // rate: substeps a second.
    HeldJoint(const RigidJoint& from, Scalar rate)
        : a(from.a), b(from.b), limits(from, rate), kind_(from.kind), point_a_(from.point_a),
          point_b_(from.point_b), frame_a_(quaternion_of<Scalar>(from.frame_a)),
          frame_b_(quaternion_of<Scalar>(from.frame_b)),
          points_softness_(from.compliance, from.damping, rate),
          turn_softness_(from.angular_compliance, 0, rate), points_(points_softness_),
          distance_(from, points_softness_), drive_(from, rate) {}

    void set_motor(const RigidMotor& motor) { drive_.set_motor(motor); }

    // Its motor, or a spring.
    bool does_work() const {
        return drive_.is_motor() || points_softness_.is_soft() || turn_softness_.is_soft() ||
               (limits.is_soft() && !turns_in_tree);
    }

    // Turns without any resistance, but for limits.
    bool turns_freely() const {
        return (kind_ == LKS_JOINT_BALL || kind_ == LKS_JOINT_HINGE) && in_tree && !has_soft_points() &&
               !drive_.resists();
    }
    bool is_hinge() const { return kind_ == LKS_JOINT_HINGE; }
    Vec axis_of(const Body& body, bool is_a) const {
        return body.rotation * (is_a ? frame_a_ : frame_b_).matrix().column(1);
    }
    Vec point_of(const Body& body, bool is_a) const { return body.rotation * (is_a ? point_a_ : point_b_); }

    std::size_t a, b;
    bool in_tree = false; // its points are solved there
    bool in_held_tree = false;
    bool closes = false;        // a loop: it is solved behind its tree (rigid_closures.h)
    bool turns_in_tree = false; // what it turns is, too
    bool limits_in_tree = false;
    JointLimits<Scalar> limits;
    // Of the substep.
    Vec start;            // what the points are to keep apart
    Vec lever_a, lever_b; // at the predicted pose
    Vec push;             // kg·m, of the points
    Scalar tension = 0;   // the same of the substep before

    void begin(const Body& body_a, const Body& body_b) {
        tension = size_of(push);
        push = in_tree ? Vec{} : push;
        begin_ = offset(body_a, body_b);
        start = keeps_push() ? begin_ : Vec{};
        if (in_tree) {
            distance_.keep(begin_);
        } else {
            distance_.begin(body_a, body_a.rotation * point_a_, body_b, body_b.rotation * point_b_, begin_,
                            push);
        }
        turn_start_ = keeps_turn() ? turned_apart(body_a, body_b) : Vec{};
        limits.begin(body_a, body_b);
        drive_.begin(body_a, body_b);
    }

    // Trees are of these.
    bool may_be_in_tree() const { return !is_distance() && has_rigid_turns(); }
    bool has_rigid_turns() const { return !turn_softness_.is_soft(); }
    bool is_distance() const { return kind_ == LKS_JOINT_DISTANCE; }
    // Where it closes a loop.
    std::size_t closing_rows() const {
        return is_distance() ? 1 : kind_ == LKS_JOINT_FIXED ? 6 : kind_ == LKS_JOINT_HINGE ? 5 : 3;
    }
    typename JointDistance<Scalar>::Left left_of_distance(const Body& body_a, const Body& body_b,
                                                          bool in_substep) const {
        return distance_.left_of(offset(body_a, body_b), begin_, push, in_substep);
    }
    // What is undone strains no spring.
    void hold_spring(const Body& body_a, const Body& body_b) {
        start = offset(body_a, body_b);
        distance_.hold(start);
    }
    bool has_soft_points() const { return points_softness_.is_soft(); }
    Scalar points_give() const { return points_softness_.added; } // by a push of one
    // What a tree's solve is to bring to zero in a substep.
    Vec left_of_points(const Body& body_a, const Body& body_b) const {
        const Vec apart = offset(body_a, body_b);
        return has_soft_points() ? points_softness_.left(apart, apart - begin_, push) : apart - start;
    }

    // From substep to substep.
    bool keeps_push() const {
        return !is_distance() && !points_softness_.is_soft() && !turn_softness_.is_soft();
    }

    // How far b's point is from a's.
    Vec offset(const Body& body_a, const Body& body_b) const {
        return body_b.position - body_a.position + body_b.rotation * point_b_ - body_a.rotation * point_a_;
    }
    void place_levers(const Body& body_a, const Body& body_b) {
        lever_a = body_a.rotation * point_a_;
        lever_b = body_b.rotation * point_b_;
    }

    // With what has been pushed in this substep, if it is much more.
    void raise_tension() { tension = std::max(tension, size_of(push) / 4); }
    // (hω)² of each body's swing across the lever under the tension.
    void add_loads(Body& body_a, Body& body_b) const {
        body_a.found_load += tension * swing_arm(body_a, point_a_);
        body_b.found_load += tension * swing_arm(body_b, point_b_);
    }

    // After the prediction.
    void prepare(const Body& body_a, const Body& body_b) {
        limits.prepare(limits_in_tree);
        drive_.prepare(body_a);
        push = keeps_push() ? push : Vec{};
        if (!is_distance() && (!in_tree || drive_.is_motor())) {
            // Where the joints before it have turned them by what they carry on.
            block_lever_a_ = body_a.rotation * point_a_;
            block_lever_b_ = body_b.rotation * point_b_;
            points_.factor(body_a, block_lever_a_, body_b, block_lever_b_);
        }
        if (holds_turn()) {
            factor_turning(body_a, body_b);
            turn_ = keeps_turn() && !turns_in_tree ? turn_ : Vec{};
            if (kind_ == LKS_JOINT_HINGE) {
                const Vec u = hinge_axis(body_a);
                turn_ = turn_ - u * u.dot(turn_);
            }
        }
    }
    void push_again(Body& body_a, Body& body_b) {
        if (holds_turn()) {
            turn_apart(body_a, body_b, turn_);
        }
        limits.push_again(body_a, body_b);
        if (drives_before_points()) {
            push_drive_with_points(body_a, body_b);
            return;
        }
        turn_apart(body_a, body_b, drive_.pushed());
        if (!in_tree) {
            push_apart(body_a, body_b, push);
        }
    }
    // What turns b against a; and what is added to it by a share.
    Vec carried_turn(const Body& body_a, const Body& body_b) const {
        return (holds_turn() ? turn_ : Vec{}) + limits.pushed(body_a, body_b) + drive_.pushed();
    }
    Vec add_to_carried_turn(const Body& body_a, const Body& body_b, Scalar share) {
        const Vec before = carried_turn(body_a, body_b);
        turn_ = turn_ + turn_ * share;
        limits.scale(share);
        drive_.add(share);
        return carried_turn(body_a, body_b) - before;
    }
    void carry_more(Body& body_a, Body& body_b, Scalar share) {
        if (holds_turn()) {
            const Vec more = turn_ * share;
            turn_ = turn_ + more;
            turn_apart(body_a, body_b, more);
        }
        limits.carry_more(body_a, body_b, share);
        turn_apart(body_a, body_b, drive_.add(share));
        if (!in_tree) {
            const Vec more = push * share;
            push = push + more;
            push_apart(body_a, body_b, more);
        }
    }

    // A motor turns about the joint, and a row about the centres of mass: some rounds with the points in
    // between make one of the other.
    void project(Body& body_a, Body& body_b) {
        if (drives_before_points()) {
            project_turn(body_a, body_b);
            project_points(body_a, body_b);
        }
        for (int round = 0; round < 3 && drive_.is_motor(); ++round) {
            drive_.project(body_a, body_b);
            project_points(body_a, body_b);
        }
        drive_.project(body_a, body_b);
        project_turn(body_a, body_b);
        if (!limits_in_tree) {
            limits.project(body_a, body_b);
        }
        if (!in_tree) {
            project_points(body_a, body_b);
        }
    }

    // By how much it is strained, what must not turn or limits, in this substep; or at all.
    Scalar strain(const Body& body_a, const Body& body_b, bool in_substep) const {
        Scalar most = in_substep ? limits.exceeded(body_a, body_b) : limits.beyond(body_a, body_b);
        if (holds_turn()) {
            const Vec turned = turned_in(body_a, body_b, in_substep);
            for (const Vec& axis : held_axes(body_a)) {
                most = std::max(most, std::abs(axis.dot(turned)));
            }
        }
        return most;
    }
    // In this substep, or at all.
    void add_rows(const Body& body_a, const Body& body_b, bool in_substep,
                  std::vector<HeldRow<Scalar>>& rows) {
        if (holds_turn()) {
            const Vec turned = turned_in(body_a, body_b, in_substep);
            for (const Vec& axis : held_axes(body_a)) {
                rows.push_back({axis, axis.dot(turned), 0, nullptr, 1});
            }
        }
        limits.add_rows(body_a, body_b, in_substep, rows);
    }
    void keep_push(const HeldRow<Scalar>& row, Scalar more) {
        if (row.is_limit()) {
            *row.kept = std::max(row.push + more, Scalar(0)) * row.sign;
        } else {
            turn_ = turn_ + row.axis * more;
        }
    }

    // Without giving speed. True: a limit was exceeded by more than half a degree.
    bool undo_turn(Body& body_a, Body& body_b) const {
        if (holds_turn() && keeps_turn()) {
            turn_back(body_a, body_b, turned_apart(body_a, body_b));
        }
        return limits.undo(body_a, body_b);
    }
    // The same of its points, but for a figure that a pinned particle holds.
    void undo_points(Body& body_a, Body& body_b, bool pinned) const {
        if (is_distance()) {
            distance_.undo(body_a, body_a.rotation * point_a_, body_b, body_b.rotation * point_b_,
                           offset(body_a, body_b));
        } else if (keeps_push() && !pinned) {
            push_apart(body_a, body_b, points_.pushed_by(offset(body_a, body_b)) * Scalar(-1));
        }
    }

private:
    // |r|·(tr I⁻¹ − r̂ᵀI⁻¹r̂)
    static Scalar swing_arm(const Body& body, const Vec& point) {
        const Scalar length = point.length();
        if (length == 0) {
            return 0;
        }
        const Matrix<Scalar>& inverse = body.inverse_inertia;
        const Vec along = point * (1 / length);
        return length *
               (inverse.rows[0].x + inverse.rows[1].y + inverse.rows[2].z - along.dot(inverse * along));
    }

    bool holds_turn() const { return kind_ == LKS_JOINT_HINGE || kind_ == LKS_JOINT_FIXED; }
    bool keeps_turn() const { return !turn_softness_.is_soft(); }

    void push_apart(Body& body_a, Body& body_b, const Vec& more) const {
        JointPoints<Scalar>::push_apart(body_a, block_lever_a_, body_b, block_lever_b_, more);
    }
    void project_points(Body& body_a, Body& body_b) {
        const Vec apart = offset(body_a, body_b);
        if (is_distance()) {
            distance_.project(body_a, body_a.rotation * point_a_, body_b, body_b.rotation * point_b_, apart,
                              begin_, push);
            return;
        }
        const Vec before = push;
        push = points_.next_push(apart - start, apart - begin_, before);
        push_apart(body_a, body_b, push - before);
    }

    void project_turn(Body& body_a, Body& body_b) {
        if (holds_turn() && !turns_in_tree) {
            turn_ = turn_ + turn_back(body_a, body_b, left_to_turn(body_a, body_b));
        }
    }

    // Of a soft joint, whose points begin from nothing: what its friction carries on turns about the joint.
    bool drives_before_points() const { return drive_.acts() && !keeps_push() && !is_distance() && !in_tree; }
    void push_drive_with_points(Body& body_a, Body& body_b) {
        BodyMove<Scalar> move_a{{}, body_a.world_inverse * drive_.pushed() * Scalar(-1)};
        BodyMove<Scalar> move_b{{}, body_b.world_inverse * drive_.pushed()};
        const Vec apart = offset(body_a, body_b) + cross(move_b.angle, body_b.rotation * point_b_) -
                          cross(move_a.angle, body_a.rotation * point_a_);
        push = points_.next_push(apart, apart - begin_, {});
        move_a.shift = push * -body_a.inverse_mass;
        move_a.angle = move_a.angle - body_a.world_inverse * cross(block_lever_a_, push);
        move_b.shift = push * body_b.inverse_mass;
        move_b.angle = move_b.angle + body_b.world_inverse * cross(block_lever_b_, push);
        move_a.apply_to(body_a);
        move_b.apply_to(body_b);
    }

    static Scalar size_of(const Vec& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }
    // In this substep, or at all.
    Vec turned_in(const Body& body_a, const Body& body_b, bool in_substep) const {
        return turned_apart(body_a, body_b) - (in_substep ? turn_start_ : Vec{});
    }
    // About which b may not turn against a.
    std::vector<Vec> held_axes(const Body& body_a) const {
        if (kind_ != LKS_JOINT_HINGE) {
            return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        }
        const Vec u = hinge_axis(body_a);
        const Vec some = cross(u, std::abs(u.x) < std::abs(u.y) ? Vec{1, 0, 0} : Vec{0, 1, 0});
        const Vec across = some * (1 / some.length());
        return {across, cross(u, across)};
    }
    // From a's frame to b's, in a's.
    Quat turn_between_frames(const Body& body_a, const Body& body_b) const {
        return (body_a.orientation * frame_a_).conjugate() * (body_b.orientation * frame_b_);
    }
    // What hinges and fixed joints don't let turn: the sine between the axes, or twice the sine of half the
    // angle between the frames.
    Vec turned_apart(const Body& body_a, const Body& body_b) const {
        if (kind_ == LKS_JOINT_HINGE) {
            return cross(hinge_axis(body_a), body_b.rotation * frame_b_.matrix().column(1));
        }
        if (kind_ == LKS_JOINT_FIXED) {
            const Quat q = turn_between_frames(body_a, body_b);
            const Vec sine = q.vector() * Scalar(q.w < 0 ? -2 : 2);
            return body_a.rotation * (frame_a_.matrix() * sine);
        }
        return {};
    }

    // Soft ones give way by the angle.
    Vec soft_turned_apart(const Body& body_a, const Body& body_b) const {
        if (kind_ == LKS_JOINT_HINGE) {
            const Vec u = hinge_axis(body_a);
            const Vec v = body_b.rotation * frame_b_.matrix().column(1);
            const Vec across = cross(u, v);
            const Scalar sine = across.length();
            return sine == 0 ? Vec{} : across * (std::atan2(sine, u.dot(v)) / sine);
        }
        const Quat q = turn_between_frames(body_a, body_b);
        return body_a.rotation * (frame_a_.matrix() * q.vector()) * angle_by_vector(q);
    }
    Vec left_to_turn(const Body& body_a, const Body& body_b) const {
        return keeps_turn() ? turned_apart(body_a, body_b) - turn_start_
                            : soft_turned_apart(body_a, body_b) + turn_ * turn_softness_.added;
    }

    Vec hinge_axis(const Body& body_a) const { return body_a.rotation * frame_a_.matrix().column(1); }

    // What turning pushes do, in all directions. Hinges have a number of its own along their axis.
    void factor_turning(const Body& body_a, const Body& body_b) {
        const Vec axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const bool hinge = kind_ == LKS_JOINT_HINGE;
        const Vec u = hinge_axis(body_a);
        const auto across = [&](const Vec& v) { return hinge ? v - u * u.dot(v) : v; };
        const auto turned = [&](const Vec& push) {
            return body_a.world_inverse * push + body_b.world_inverse * push + push * turn_softness_.added;
        };
        // As large as the greatest across.
        const auto weight = [&](int i) { return component(turned(axes[i]), i); };
        const Scalar along = hinge ? std::max({weight(0), weight(1), weight(2)}) : Scalar(0);
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
    Softness<Scalar> points_softness_, turn_softness_;
    JointPoints<Scalar> points_;
    JointDistance<Scalar> distance_;
    JointDrive<Scalar> drive_;
    Vec turn_; // b against a: carried from substep to substep
    // Of the substep.
    Vec begin_; // how far the points were apart at its beginning
    Vec block_lever_a_, block_lever_b_;
    Vec turn_start_;
    SymmetricSystem<Scalar> turning_;
};

} // namespace reference
