// The points of one joint by a block of its own, in the rigid reference solver: of those that close loops, or
// have soft turns, whose points no tree solves.
#pragma once

#include <utility>
#include <vector>

#include "reference/rigid_body.h"
#include "reference/rigid_softness.h"
#include "reference/symmetric_system.h"

namespace reference {

template <typename Scalar>
class JointPoints {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;

    explicit JointPoints(const Softness<Scalar>& softness) : softness_(softness) {}

    // At the predicted pose: K = Σ (1/m − r̂ I⁻¹ r̂), and what is soft.
    void factor(const Body& a, const Vec& lever_a, const Body& b, const Vec& lever_b) {
        factor([&](const Vec& axis, const Vec& soft) {
            return soft + motion_of(a, lever_a, axis) + motion_of(b, lever_b, axis);
        });
    }
    // motion(push, soft): how far it moves them apart, with what is soft.
    template <typename Motion>
    void factor(const Motion& motion) {
        std::vector<Scalar> k(9);
        for (int column = 0; column < 3; ++column) {
            const Vec axis = along_axis(column, Scalar(1));
            const Vec moved = motion(axis, axis * softness_.added);
            for (int row = 0; row < 3; ++row) {
                k[static_cast<std::size_t>(3 * row + column)] = component(moved, row);
            }
        }
        k_.factor(3, std::move(k));
    }

    bool is_soft() const { return softness_.is_soft(); }
    Scalar give() const { return softness_.added; } // by a push of one
    // XPBD of soft ones; `motion` is that of the substep.
    Vec left(const Vec& error, const Vec& motion, const Vec& push) const {
        return softness_.is_soft() ? softness_.left(error, motion, push) : error;
    }
    Vec next_push(const Vec& error, const Vec& motion, const Vec& push) const {
        return push - pushed_by(left(error, motion, push));
    }
    // What brings them together.
    Vec pushed_by(const Vec& error) const {
        std::vector<Scalar> push{error.x, error.y, error.z};
        k_.solve(push);
        return {push[0], push[1], push[2]};
    }

    // b forward and a back.
    static void push_apart(Body& a, const Vec& lever_a, Body& b, const Vec& lever_b, const Vec& push) {
        BodyMove<Scalar>{push * -a.inverse_mass, a.world_inverse * cross(lever_a, push * Scalar(-1))}
            .apply_to(a);
        BodyMove<Scalar>{push * b.inverse_mass, b.world_inverse * cross(lever_b, push)}.apply_to(b);
    }

    // What a push does to the body's point.
    static Vec motion_of(const Body& body, const Vec& lever, const Vec& push) {
        return push * body.inverse_mass + cross(body.world_inverse * cross(lever, push), lever);
    }

private:
    Softness<Scalar> softness_;
    SymmetricSystem<Scalar> k_;
};

} // namespace reference
