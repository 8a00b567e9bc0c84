// A body of the rigid reference solver, in any number type, and what pushes do to it.
#pragma once

#include <cstddef>

#include "reference/rigid_numbers.h"

namespace reference {

// A turn within a substep goes no further about an axis: half a radian.
template <typename Scalar>
Vector3<Scalar> limited_turn(const Vector3<Scalar>& angle) {
    const auto part = [](Scalar c) { return std::clamp(c, Scalar(-0.5), Scalar(0.5)); };
    return {part(angle.x), part(angle.y), part(angle.z)};
}

template <typename Scalar>
struct MovingBody {
    using Vec = Vector3<Scalar>;
    using Quat = Quaternion<Scalar>;

    explicit MovingBody(const RigidBody& from)
        : moves(from.mass > 0), mass(static_cast<Scalar>(from.mass)),
          inertia(matrix_of<Scalar>(from.inertia)), position(from.position),
          orientation(quaternion_of<Scalar>(from.orientation)), target_position(position),
          target_orientation(orientation), velocity(from.velocity), spin(from.spin),
          gravity_factor(static_cast<Scalar>(from.gravity_factor)),
          linear_damping(static_cast<Scalar>(from.linear_damping)),
          angular_damping(static_cast<Scalar>(from.angular_damping)), rotation(orientation.matrix()) {
        if (moves) {
            inverse_mass = 1 / mass;
            inverse_inertia = inverse_of(inertia);
        }
        const RigidInertia& m = from.inertia;
        round = m.xy == 0 && m.xz == 0 && m.yz == 0 && m.xx == m.yy && m.yy == m.zz;
    }

    bool moves;
    bool round = false;
    bool jointed = false;
    bool attached = false; // particles are held at it
    bool pinned = false;   // so are some that do not move
    Scalar mass;
    Scalar inverse_mass = 0;
    Matrix<Scalar> inertia{}, inverse_inertia{}; // in its own axes
    Vec position;
    Quat orientation;
    // Of what is kinematic: at the end of the next tick.
    Vec target_position;
    Quat target_orientation;
    Vec velocity, spin;
    Scalar gravity_factor, linear_damping, angular_damping;
    Matrix<Scalar> rotation; // of the orientation
    // Of the tick.
    Vec tick_position;
    Quat tick_orientation;
    // Of the substep.
    Matrix<Scalar> world_inverse{}; // at the predicted pose
    Vec start_position, predicted_position, uncarried_position;
    Quat start_orientation, predicted_orientation, uncarried_orientation;
    Vec predicted_velocity, predicted_spin;
    Vec force, torque;
    Vec carried_torque; // of a held figure: what the next solve of its points begins with
    Scalar load = 0;    // (hω)² of its swing under what its joints pull: as heavily as that it turns
    Scalar found_load = 0;

    // About how far out its mass is.
    Scalar reach() const {
        return std::sqrt((inertia.rows[0].x + inertia.rows[1].y + inertia.rows[2].z) * inverse_mass);
    }

    void follow_rotation() { world_inverse = rotation.around(inverse_inertia); }
    // A light link under a great tension swings faster than a substep can follow: beyond that it turns as if
    // it were heavier.
    void stiffen() {
        if (found_load > load) {
            const auto heaviness = [](Scalar pull) { return 1 + std::max(pull - 2, Scalar(0)); };
            const Scalar left = heaviness(load) / heaviness(found_load);
            for (Vec& row : world_inverse.rows) {
                row = row * left;
            }
            load = found_load;
        }
    }

    // What is kinematic keeps what it was given, to the bit: else it would turn.
    void normalise() {
        if (moves) {
            orientation = orientation.normalised();
        }
    }
    // Where its rotation is asked for before it turns again.
    void settle() {
        normalise();
        rotation = moves ? orientation.matrix() : rotation;
    }

    // By an angle in world axes. Small turns leave the quaternion's length for the end of the substep.
    void turn(const Vec& angle) {
        const Vec half_turn = limited_turn(angle) * Scalar(0.5);
        orientation = orientation.moved(half_turn);
        if (greatest(half_turn) > Scalar(1) / 256) {
            orientation = orientation.normalised();
        }
        rotation = orientation.matrix();
    }
};

// b against a, by a turning push.
template <typename Scalar>
void turn_apart(MovingBody<Scalar>& a, MovingBody<Scalar>& b, const Vector3<Scalar>& push) {
    a.turn(a.world_inverse * push * Scalar(-1));
    b.turn(b.world_inverse * push);
}

// What one or several pushes do to a body, added up and then applied together.
template <typename Scalar>
struct BodyMove {
    Vector3<Scalar> shift, angle;

    void apply_to(MovingBody<Scalar>& body) const {
        if (body.moves) {
            body.position = body.position + shift;
            body.turn(angle);
        }
    }
};

// A push along a direction, b forward and a back, each at a lever from its centre of mass.
template <typename Scalar>
class PushRow {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;

    PushRow() = default;
    PushRow(const Vec& direction, const Body& a, const Vec& lever_a, const Body& b, const Vec& lever_b,
            Scalar softness = 0)
        : direction_(direction), mass_a_(a.inverse_mass), mass_b_(b.inverse_mass),
          arm_a_(cross(lever_a, direction)), arm_b_(cross(lever_b, direction)),
          turn_a_(a.world_inverse * arm_a_), turn_b_(b.world_inverse * arm_b_),
          weight_(mass_a_ + mass_b_ + arm_a_.dot(turn_a_) + arm_b_.dot(turn_b_) + softness) {}

    // What it takes to part them by this length, in kg·m; or by this speed, in N·s.
    Scalar push_for(Scalar length) const { return length / weight_; }
    void add(Scalar push, BodyMove<Scalar>& a, BodyMove<Scalar>& b) const {
        add(push, true, a);
        add(push, false, b);
    }
    void add(Scalar push, bool to_a, BodyMove<Scalar>& move) const {
        const Scalar p = to_a ? -push : push;
        move.shift = move.shift + direction_ * (p * (to_a ? mass_a_ : mass_b_));
        move.angle = limited_turn(move.angle + (to_a ? turn_a_ : turn_b_) * p);
    }
    // How far the moves part them, to first order.
    Scalar parted(const BodyMove<Scalar>& a, const BodyMove<Scalar>& b) const {
        return direction_.dot(b.shift - a.shift) + arm_b_.dot(b.angle) - arm_a_.dot(a.angle);
    }
    void accelerate(Scalar impulse, Body& a, Body& b) const {
        a.velocity = a.velocity - direction_ * (impulse * mass_a_);
        a.spin = a.spin - turn_a_ * impulse;
        b.velocity = b.velocity + direction_ * (impulse * mass_b_);
        b.spin = b.spin + turn_b_ * impulse;
    }

private:
    Vec direction_;
    Scalar mass_a_ = 0, mass_b_ = 0;
    Vec arm_a_, arm_b_;
    Vec turn_a_, turn_b_;
    Scalar weight_ = 1;
};

} // namespace reference
