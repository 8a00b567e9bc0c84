// How a body of the rigid reference solver moves by itself in a substep: the implicit midpoint rule for its
// spin in its own axes, and Cayley's map, after gravity and damping. What is kinematic goes evenly to its
// target.
#pragma once

#include "reference/rigid_body.h"

namespace reference {

template <typename Scalar>
class FreeMotion {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;

    // rate: substeps a second.
    FreeMotion(const Vec& gravity, Scalar rate, int substeps)
        : gravity_(gravity), rate_(rate), substeps_(substeps) {}

    // At the beginning of a tick: as fast as it takes what is kinematic to its target.
    void aim(Body& body) const {
        if (!body.moves) {
            body.tick_position = body.position;
            body.tick_orientation = body.orientation;
            follow(body, body.position, body.orientation, body.target_position, body.target_orientation,
                   rate_ / static_cast<Scalar>(substeps_));
        }
    }

    // substep: 1 .. substeps
    void predict(Body& body, int substep) const {
        body.start_position = body.position;
        body.start_orientation = body.orientation;
        if (!body.moves) {
            place(body, substep);
        } else {
            const Vec falling = gravity_ * (body.gravity_factor / rate_);
            body.velocity = (body.velocity + falling) * kept(body.linear_damping);
            body.spin = body.spin * kept(body.angular_damping);
            if (turns_freely(body)) {
                // Ω_mid = Ω + I⁻¹(IΩ_mid × hΩ_mid/2)
                const Vec spin = body.rotation.back(body.spin);
                Vec change;
                for (int i = 0; i < 10; ++i) {
                    change = gyroscopic_change(body, spin + change);
                }
                body.spin = body.spin + body.rotation * change;
            }
            body.spin = limited(body.spin);
            body.position = body.position + body.velocity * (1 / rate_);
            body.orientation = body.orientation.moved(body.spin * (Scalar(0.5) / rate_)).normalised();
        }
        body.rotation = body.orientation.matrix();
        body.predicted_position = body.uncarried_position = body.position;
        body.predicted_orientation = body.uncarried_orientation = body.orientation;
        body.follow_rotation();
    }

    void finish(Body& body) const {
        if (!body.moves) {
            return;
        }
        body.velocity = body.velocity + (body.position - body.predicted_position) * rate_;
        if (!(body.orientation == body.predicted_orientation)) {
            body.normalise();
            body.rotation = body.orientation.matrix();
            body.spin = limited(half_turn_between(body.start_orientation, body.orientation) * (2 * rate_));
        }
        if (turns_freely(body)) {
            // From the middle of the substep to its end.
            const Vec change = gyroscopic_change(body, body.rotation.back(body.spin));
            body.spin = body.spin + body.rotation * change;
        }
    }

private:
    // Where it is at the end of this substep.
    void place(Body& body, int substep) const {
        const bool last = substep == substeps_;
        const Scalar share = static_cast<Scalar>(substep) / static_cast<Scalar>(substeps_);
        const Vec way = body.target_position - body.tick_position;
        body.position = last ? body.target_position : body.tick_position + way * share;
        body.orientation = last || body.tick_orientation == body.target_orientation
                               ? body.target_orientation
                               : body.tick_orientation.towards(body.target_orientation, share);
        follow(body, body.start_position, body.start_orientation, body.position, body.orientation, rate_);
    }

    // The speeds of what goes from here to there, so many times a second.
    void follow(Body& body, const Vec& from, const Quaternion<Scalar>& turned_from, const Vec& to,
                const Quaternion<Scalar>& turned_to, Scalar rate) const {
        body.velocity = limited((to - from) * rate, std::min(16 * rate_, Scalar(1000)));
        body.spin = limited(half_turn_between(turned_from, turned_to) * (2 * rate));
    }

    // What a substep leaves of a speed.
    Scalar kept(Scalar damping) const { return std::max(1 - damping / rate_, Scalar(0)); }

    // A radian a substep about each axis, and 1000 rad/s.
    Vec limited(const Vec& spin) const { return limited(spin, std::min(rate_, Scalar(1000))); }
    static Vec limited(const Vec& speed, Scalar most) {
        const auto part = [most](Scalar c) { return std::clamp(c, -most, most); };
        return {part(speed.x), part(speed.y), part(speed.z)};
    }

    // I⁻¹(IΩ × hΩ/2), in the body's axes; none where it would be more than a quarter of Ω.
    Vec gyroscopic_change(const Body& body, const Vec& spin) const {
        const Vec torque = cross(body.inertia * spin, spin * (Scalar(0.5) / rate_));
        const Vec change = body.inverse_inertia * torque;
        return greatest(change) > greatest(spin) / 4 ? Vec{} : change;
    }

    static bool turns_freely(const Body& body) {
        return body.moves && !body.round && greatest(body.spin) >= Scalar(1) / 1024;
    }

    Vec gravity_;
    Scalar rate_;
    int substeps_;
};

} // namespace reference
