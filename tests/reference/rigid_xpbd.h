// Rigid bodies and their joints in floating point: the twin that the integer solver is measured against.
//
// The same substeps in the same order: the implicit midpoint rule for spins, Cayley's map, the points of all
// joints by one linear solve with the velocities that follow, what hinges and fixed joints don't let turn by
// a block each, carried pushes, and errors undone without speed. What differs:
//   - the points' system is one dense matrix, where the SDK eliminates it along the tree;
//   - pushes are in kg·m, turns in radians: no shares, no units of length, no clamps;
//   - the SDK takes 2^-33 of a spin a substep, to be sure that roundings add nothing.
// There are no contacts, limits, motors, soft joints, damping and sleep.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reference/rigid_numbers.h"
#include "reference/symmetric_system.h"

namespace reference {

template <typename Scalar>
class RigidSolver {
public:
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;

    RigidSolver(const RigidModel& model, const Settings& settings)
        : settings_(settings), rate_(static_cast<Scalar>(settings.tick_rate_hz * settings.substeps)),
          gravity_(settings.gravity) {
        const support::Vector& g = settings.gravity;
        const double rate = settings.tick_rate_hz * settings.substeps;
        const double gravity_speed = (std::abs(g.x) + std::abs(g.y) + std::abs(g.z)) / rate;
        least_motion_ = static_cast<Scalar>(2 * (4 * gravity_speed + 0.01) / rate);
        for (const RigidBody& from : model.bodies) {
            bodies_.emplace_back(from);
        }
        for (const RigidJoint& from : model.joints) {
            joints_.emplace_back(from);
        }
    }

    void tick(int count = 1) {
        for (int i = 0; i < count; ++i) {
            for (Body& body : bodies_) {
                body.rotation = body.orientation.matrix();
            }
            for (int k = 0; k < settings_.substeps; ++k) {
                substep();
            }
        }
    }

    std::size_t size() const { return bodies_.size(); }
    support::Vector position(std::size_t body) const { return bodies_[body].position.widened(); }
    Rotation orientation(std::size_t body) const {
        const Quat& q = bodies_[body].orientation;
        return {q.x, q.y, q.z, q.w};
    }

private:
    struct Body {
        explicit Body(const RigidBody& from)
            : moves(from.mass > 0), mass(static_cast<Scalar>(from.mass)), inertia(from.inertia),
              position(from.position), orientation(quaternion_of<Scalar>(from.orientation)),
              velocity(from.velocity), spin(from.spin), rotation(orientation.matrix()) {
            if (moves) {
                inverse_mass = 1 / mass;
                inverse_inertia = {1 / inertia.x, 1 / inertia.y, 1 / inertia.z};
            }
            round = from.inertia.x == from.inertia.y && from.inertia.y == from.inertia.z;
        }

        bool moves;
        bool round = false;
        Scalar mass;
        Scalar inverse_mass = 0;
        Vec inertia, inverse_inertia; // about its own axes
        Vec position;
        Quat orientation;
        Vec velocity, spin;
        Matrix<Scalar> rotation; // of the orientation
        // Of the substep.
        Matrix<Scalar> world_inverse{}; // at the predicted pose
        Vec start_position, predicted_position, uncarried_position;
        Quat start_orientation, predicted_orientation, uncarried_orientation;
        Vec force, torque;
    };

    struct Joint {
        explicit Joint(const RigidJoint& from)
            : kind(from.kind), a(from.a), b(from.b), point_a(from.point_a), point_b(from.point_b),
              frame_a(quaternion_of<Scalar>(from.frame_a)), frame_b(quaternion_of<Scalar>(from.frame_b)) {}

        std::uint32_t kind;
        std::size_t a, b;
        Vec point_a, point_b;
        Quat frame_a, frame_b;
        Vec turn; // b against a: carried from substep to substep
        // Of the substep.
        Vec start, turn_start;
        Vec lever_a, lever_b; // at the predicted pose
        SymmetricSystem<Scalar> turning;
    };

    void substep() {
        for (Joint& joint : joints_) {
            joint.start = offset(joint);
            joint.turn_start = turned_apart(joint);
        }
        for (Body& body : bodies_) {
            predict(body);
        }
        factor_points();
        carry_pushes_on();
        for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
            for (std::size_t i = 0; i < joints_.size(); ++i) {
                project_turn(joints_[i]);
            }
            solve_points(true);
            for (std::size_t i = joints_.size(); i-- > 0;) {
                project_turn(joints_[i]);
            }
            solve_points(true);
        }
        for (Body& body : bodies_) {
            finish(body);
        }
        undo_errors();
    }

    // I⁻¹(IΩ × hΩ/2), in the body's axes; none where it would be more than a quarter of Ω.
    Vec gyroscopic_change(const Body& body, const Vec& spin) const {
        const Vec torque = cross(products(body.inertia, spin), spin * (Scalar(0.5) / rate_));
        const Vec change = products(body.inverse_inertia, torque);
        return greatest(change) > greatest(spin) / 4 ? Vec{} : change;
    }

    bool turns_freely(const Body& body) const {
        return body.moves && !body.round && greatest(body.spin) >= Scalar(1) / 1024;
    }

    void predict(Body& body) {
        body.start_position = body.position;
        body.start_orientation = body.orientation;
        if (body.moves) {
            body.velocity = body.velocity + gravity_ * (1 / rate_);
            if (turns_freely(body)) {
                // Ω_mid = Ω + I⁻¹(IΩ_mid × hΩ_mid/2)
                const Vec spin = body.rotation.back(body.spin);
                Vec change;
                for (int i = 0; i < 10; ++i) {
                    change = gyroscopic_change(body, spin + change);
                }
                body.spin = body.spin + body.rotation * change;
            }
            body.position = body.position + body.velocity * (1 / rate_);
            body.orientation = body.orientation.moved(body.spin * (Scalar(0.5) / rate_)).normalised();
        }
        body.rotation = body.orientation.matrix();
        body.predicted_position = body.position;
        body.predicted_orientation = body.orientation;
        body.world_inverse = body.rotation.around(body.inverse_inertia);
    }

    void finish(Body& body) {
        if (!body.moves) {
            return;
        }
        body.velocity = body.velocity + (body.position - body.predicted_position) * rate_;
        if (!(body.orientation == body.predicted_orientation)) {
            body.orientation = body.orientation.normalised();
            body.rotation = body.orientation.matrix();
            body.spin = half_turn_between(body.start_orientation, body.orientation) * (2 * rate_);
        }
        if (turns_freely(body)) {
            // From the middle of the substep to its end.
            const Vec change = gyroscopic_change(body, body.rotation.back(body.spin));
            body.spin = body.spin + body.rotation * change;
        }
    }

    // By an angle in world axes. Small turns leave the quaternion's length for the end of the substep.
    static void turn_body(Body& body, const Vec& angle) {
        const Vec half_turn = angle * Scalar(0.5);
        body.orientation = body.orientation.moved(half_turn);
        if (greatest(half_turn) > Scalar(1) / 256) {
            body.orientation = body.orientation.normalised();
        }
        body.rotation = body.orientation.matrix();
    }

    // b against a, by a turning push.
    void turn_apart(const Joint& joint, const Vec& push) {
        turn_body(bodies_[joint.a], bodies_[joint.a].world_inverse * push * Scalar(-1));
        turn_body(bodies_[joint.b], bodies_[joint.b].world_inverse * push);
    }

    // How far b's point is from a's.
    Vec offset(const Joint& joint) const {
        const Body& a = bodies_[joint.a];
        const Body& b = bodies_[joint.b];
        return b.position - a.position + b.rotation * joint.point_b - a.rotation * joint.point_a;
    }

    // What hinges and fixed joints don't let turn: the sine between the axes, or twice the sine of half the
    // angle between the frames.
    Vec turned_apart(const Joint& joint) const {
        const Body& a = bodies_[joint.a];
        const Body& b = bodies_[joint.b];
        if (joint.kind == LKS_JOINT_HINGE) {
            return cross(a.rotation * joint.frame_a.matrix().column(1),
                         b.rotation * joint.frame_b.matrix().column(1));
        }
        if (joint.kind == LKS_JOINT_FIXED) {
            const Quat q = (a.orientation * joint.frame_a).conjugate() * (b.orientation * joint.frame_b);
            const Vec sine = q.vector() * Scalar(q.w < 0 ? -2 : 2);
            return a.rotation * (joint.frame_a.matrix() * sine);
        }
        return {};
    }

    Vec hinge_axis(const Joint& joint) const {
        return bodies_[joint.a].rotation * joint.frame_a.matrix().column(1);
    }

    // What turning pushes do, in all directions. Hinges have a number of its own along their axis.
    void factor_turning(Joint& joint) {
        const Vec axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const Vec u = hinge_axis(joint);
        const auto across = [&](const Vec& v) {
            return joint.kind == LKS_JOINT_HINGE ? v - u * u.dot(v) : v;
        };
        const auto turned = [&](const Vec& push) {
            return bodies_[joint.a].world_inverse * push + bodies_[joint.b].world_inverse * push;
        };
        const Scalar along = joint.kind == LKS_JOINT_HINGE ? greatest(turned({1, 1, 1})) : Scalar(0);
        std::vector<Scalar> matrix(9);
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                matrix[3 * row + column] = across(axes[row]).dot(turned(across(axes[column]))) +
                                           along * u.dot(axes[row]) * u.dot(axes[column]);
            }
        }
        joint.turning.factor(3, std::move(matrix));
    }

    // The push that turns it back.
    Vec turn_back(const Joint& joint, const Vec& error) {
        std::vector<Scalar> push{-error.x, -error.y, -error.z};
        joint.turning.solve(push);
        turn_apart(joint, {push[0], push[1], push[2]});
        return {push[0], push[1], push[2]};
    }

    void project_turn(Joint& joint) {
        joint.turn = joint.turn + turn_back(joint, turned_apart(joint) - joint.turn_start);
    }

    // J·M⁻¹·Jᵀ of all joints' points, at the predicted pose.
    void factor_points() {
        const std::size_t size = 3 * joints_.size();
        std::vector<Scalar> matrix(size * size);
        for (Joint& joint : joints_) {
            joint.lever_a = bodies_[joint.a].rotation * joint.point_a;
            joint.lever_b = bodies_[joint.b].rotation * joint.point_b;
        }
        const Vec axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (std::size_t column = 0; column < size; ++column) {
            clear_pushes();
            add_push(joints_[column / 3], axes[column % 3]);
            for (std::size_t row = column; row < size; ++row) {
                matrix[row * size + column] = point_motion(joints_[row / 3]).dot(axes[row % 3]);
            }
        }
        points_.factor(size, std::move(matrix));
    }

    void clear_pushes() {
        for (Body& body : bodies_) {
            body.force = {};
            body.torque = {};
        }
    }

    void add_push(const Joint& joint, const Vec& push) {
        Body& a = bodies_[joint.a];
        Body& b = bodies_[joint.b];
        a.force = a.force - push;
        a.torque = a.torque - cross(joint.lever_a, push);
        b.force = b.force + push;
        b.torque = b.torque + cross(joint.lever_b, push);
    }

    // What the pushes do to b's point against a's.
    Vec point_motion(const Joint& joint) const {
        const auto motion = [](const Body& body, const Vec& lever) {
            return body.force * body.inverse_mass + cross(body.world_inverse * body.torque, lever);
        };
        return motion(bodies_[joint.b], joint.lever_b) - motion(bodies_[joint.a], joint.lever_a);
    }

    // To where they were at the substep's start, or together.
    void solve_points(bool to_start) {
        std::vector<Scalar> pushes;
        for (const Joint& joint : joints_) {
            const Vec error = to_start ? offset(joint) - joint.start : offset(joint);
            pushes.insert(pushes.end(), {-error.x, -error.y, -error.z});
        }
        points_.solve(pushes);
        clear_pushes();
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            add_push(joints_[i], {pushes[3 * i], pushes[3 * i + 1], pushes[3 * i + 2]});
        }
        for (Body& body : bodies_) {
            if (body.moves && !joints_.empty()) {
                body.position = body.position + body.force * body.inverse_mass;
                turn_body(body, body.world_inverse * body.torque);
            }
        }
    }

    void carry_pushes_on() {
        for (Body& body : bodies_) {
            body.uncarried_position = body.position;
            body.uncarried_orientation = body.orientation;
        }
        for (Joint& joint : joints_) {
            if (joint.kind == LKS_JOINT_BALL) {
                continue;
            }
            factor_turning(joint);
            if (joint.kind == LKS_JOINT_HINGE) {
                const Vec u = hinge_axis(joint);
                joint.turn = joint.turn - u * u.dot(joint.turn);
            }
            turn_apart(joint, joint.turn);
        }
        solve_points(true);
        const Scalar share = share_to_add();
        if (share != 0) {
            for (Joint& joint : joints_) {
                const Vec more = joint.turn * share;
                joint.turn = joint.turn + more;
                turn_apart(joint, more);
            }
            solve_points(true);
        }
    }

    // What of the carried pushes is missing to the least energy: −G/Q; none where next to nothing is gained.
    Scalar share_to_add() const {
        Scalar g = 0, q = 0, mass = 0;
        for (const Body& body : bodies_) {
            const auto turn_since = [&](const Quat& then) {
                const Quat d = then.conjugate() * body.orientation;
                return d.vector() * Scalar(d.w < 0 ? -2 : 2);
            };
            const Vec pushed = body.position - body.uncarried_position;
            const Vec turned = turn_since(body.uncarried_orientation);
            const Vec turned_mass = products(body.inertia, turned);
            g += body.mass * pushed.dot(body.position - body.start_position) +
                 turned_mass.dot(turn_since(body.start_orientation));
            q += body.mass * pushed.dot(pushed) + turned_mass.dot(turned);
            mass += body.mass;
        }
        if (joints_.empty() || !(q > 0)) {
            return 0;
        }
        const Scalar share = std::clamp(-g / q, Scalar(-1), Scalar(1));
        const bool worth =
            std::abs(share) >= Scalar(0.125) && std::abs(g * share) >= least_motion_ * least_motion_ * mass;
        return worth ? share : 0;
    }

    // Without giving speed: turns first, then the points.
    void undo_errors() {
        for (const Joint& joint : joints_) {
            turn_back(joint, turned_apart(joint));
            for (const std::size_t body : {joint.a, joint.b}) {
                bodies_[body].orientation = bodies_[body].orientation.normalised();
            }
        }
        solve_points(false);
        for (Body& body : bodies_) {
            body.orientation = body.orientation.normalised();
        }
    }

    Settings settings_;
    Scalar rate_; // substeps a second
    Vec gravity_;
    Scalar least_motion_;
    std::vector<Body> bodies_;
    std::vector<Joint> joints_;
    SymmetricSystem<Scalar> points_;
};

} // namespace reference
