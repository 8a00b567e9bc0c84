// A particle that is held at a point of a body, or at another particle, in the rigid reference solver: as
// sdk/src/rigid/attachment.h.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/rigid_joint_points.h"
#include "reference/xpbd.h"

namespace reference {

template <typename Scalar>
class HeldParticle {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Objects = std::vector<Solver<Scalar>>;
    using Bodies = std::vector<Body>;

    // rate: substeps a second.
    HeldParticle(const RigidAttachment& from, Scalar rate)
        : from_(from), point_(from.point), points_(Softness<Scalar>(from.compliance, from.damping, rate)) {}

    bool holds_in_tree = false; // solved with its body's (rigid_closures.h)

    bool is_of_pinned(const Objects& objects) const {
        return from_.to_body && objects[from_.object].inverse_mass(from_.particle) == 0;
    }
    std::size_t other() const { return from_.other; }
    bool holds(std::size_t body) const { return from_.to_body && from_.other == body; }

    void begin_tick(int substeps) {
        expected_ = pushed_ * (1 / static_cast<Scalar>(substeps));
        pushed_ = {};
    }
    // Before the prediction: what comes together by two metres a second at most.
    void measure_left(const Objects& objects, const Bodies& bodies, Scalar rate) {
        const Vec gap = offset(objects, bodies);
        const Scalar length = std::sqrt(gap.dot(gap));
        const Scalar most = 2 / rate;
        const Scalar other = from_.to_body ? bodies[from_.other].inverse_mass
                                           : objects[from_.other].inverse_mass(from_.other_particle);
        left_ =
            other > 0 && from_.compliance == 0 && length > most ? gap * ((length - most) / length) : Vec{};
    }
    // After the prediction.
    void begin_substep(const Objects& objects, const Bodies& bodies) {
        push_ = {};
        begin_ = error(objects, bodies);
        const Scalar own = objects[from_.object].inverse_mass(from_.particle);
        if (from_.to_body) {
            const Body& body = bodies[from_.other];
            lever_ = body.rotation * point_;
            points_.factor([&](const Vec& push, const Vec& soft) {
                return soft + push * own + JointPoints<Scalar>::motion_of(body, lever_, push);
            });
        } else {
            const Scalar other = objects[from_.other].inverse_mass(from_.other_particle);
            points_.factor([&](const Vec& push, const Vec& soft) { return soft + push * (own + other); });
        }
    }
    void project(Objects& objects, Bodies& bodies) {
        if (holds_in_tree) {
            return;
        }
        const Vec now = error(objects, bodies);
        const Vec next = points_.next_push(now, now - begin_, push_);
        const Vec more = next - push_;
        push_ = next;
        move(objects[from_.object], from_.particle, more * Scalar(-1));
        if (from_.to_body) {
            move_of(bodies[from_.other], more).apply_to(bodies[from_.other]);
        } else {
            move(objects[from_.other], from_.other_particle, more);
        }
    }

    // Where it holds in a tree: its body's lever, what is to be brought to zero, and what was pushed for it.
    void place_lever(const Bodies& bodies) { lever_ = bodies[from_.other].rotation * point_; }
    const Vec& lever() const { return lever_; }
    Vec left_in_tree(const Objects& objects, const Bodies& bodies, bool in_substep) const {
        const Vec now = error(objects, bodies);
        return !points_.is_soft() ? now : in_substep ? points_.left(now, now - begin_, push_) : Vec{};
    }
    Scalar give() const { return points_.give(); }
    void add_push(const Vec& more) { push_ = push_ + more; }

    void finish_substep() { pushed_ = pushed_ + push_; }

    // What it will about do to its body in this substep, by what it did in those of the tick before.
    BodyMove<Scalar> expected_move(const Body& body) const { return move_of(body, expected_); }

private:
    // The other side less the particle.
    Vec offset(const Objects& objects, const Bodies& bodies) const {
        const Vec& here = objects[from_.object].place_of(from_.particle);
        if (from_.to_body) {
            const Body& body = bodies[from_.other];
            return body.position - here + body.rotation * point_;
        }
        return objects[from_.other].place_of(from_.other_particle) - here;
    }
    Vec error(const Objects& objects, const Bodies& bodies) const { return offset(objects, bodies) - left_; }
    static void move(Solver<Scalar>& object, std::size_t particle, const Vec& push) {
        object.place_of(particle) = object.place_of(particle) + push * object.inverse_mass(particle);
    }
    BodyMove<Scalar> move_of(const Body& body, const Vec& push) const {
        return {push * body.inverse_mass, body.world_inverse * cross(lever_, push)};
    }

    RigidAttachment from_;
    Vec point_;
    JointPoints<Scalar> points_;
    Vec pushed_, expected_; // in this tick, and in a substep of the one before
    // Of the substep.
    Vec push_;
    Vec left_;  // how far the sides stay apart
    Vec begin_; // how far they are apart beyond that once they are predicted
    Vec lever_;
};

} // namespace reference
