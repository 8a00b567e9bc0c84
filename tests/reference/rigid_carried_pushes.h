// How much of its carried pushes a figure is to begin a substep with, in the rigid reference solver: what
// leaves the least kinetic energy (sdk/src/rigid/carried_pushes.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/rigid_parts.h"

namespace reference {

template <typename Scalar>
class CarriedPushes {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Contact = BodyContact<Scalar>;
    using Move = BodyMove<Scalar>;

    // rate: substeps a second. least_motion: metres of a substep, below which nothing is gained.
    CarriedPushes(RigidParts<Scalar>& parts, Scalar rate, Scalar least_motion)
        : parts_(parts), rate_(rate), least_motion_(least_motion) {}

    // What a held tree begins its next solve with.
    static void carry_torque(Body& a, Body& b, const Vec& push) {
        a.carried_torque = a.carried_torque - push;
        b.carried_torque = b.carried_torque + push;
    }

    // Figure by figure. Where one has been changed those that touch it think again.
    bool scale() {
        std::vector<Scalar> shares(parts_.bodies.size());
        for (std::size_t figure = 0; figure < parts_.bodies.size(); ++figure) {
            shares[figure] = share_to_add(figure);
        }
        std::vector<bool> changed(parts_.bodies.size());
        bool any = false;
        for (std::size_t figure = 0; figure < parts_.bodies.size(); ++figure) {
            if (knows_changed(figure, changed)) {
                shares[figure] = share_to_add(figure);
            }
            if (shares[figure] == 0) {
                continue;
            }
            any = true;
            changed[figure] = true;
            parts_.for_each_joint([&](Joint& joint, Body& a, Body& b) {
                if (parts_.figure_of(joint) != figure) {
                    return;
                }
                if (joint.in_held_tree) {
                    carry_torque(a, b, joint.add_to_carried_turn(a, b, shares[figure]));
                } else {
                    joint.carry_more(a, b, shares[figure]);
                }
            });
            for (const bool shared : {false, true}) {
                parts_.for_each_contact([&](Contact& contact, Body& a, Body& b) {
                    if (parts_.belongs_to(contact, figure) && parts_.is_shared(contact) == shared) {
                        contact.carry_more(a, b, shares[figure]);
                        changed[parts_.figures[contact.a]] = changed[parts_.figures[contact.a]] || shared;
                        changed[parts_.figures[contact.b]] = changed[parts_.figures[contact.b]] || shared;
                    }
                });
            }
        }
        return any;
    }

private:
    bool knows_changed(std::size_t figure, const std::vector<bool>& changed) const {
        return changed[figure] ||
               std::any_of(parts_.contacts.begin(), parts_.contacts.end(), [&](const Contact& c) {
                   return parts_.is_shared(c) && parts_.belongs_to(c, figure) &&
                          (changed[parts_.figures[c.a]] || changed[parts_.figures[c.b]]);
               });
    }

    // Products of motions in six dimensions with the mass matrix.
    struct Energies {
        Scalar g = 0, q = 0;

        // `part`: of its mass.
        void add(const Body& body, Scalar part, const Vec& pushed, const Vec& turned) {
            const Scalar mass = body.mass * part;
            const Vec turned_mass = body.inertia * turned * part;
            g += mass * pushed.dot(body.position - body.start_position) +
                 turned_mass.dot(turn_since(body, body.start_orientation));
            q += mass * pushed.dot(pushed) + turned_mass.dot(turned);
        }
        // What a kinematic body pushes counts beside its own motion.
        void move_with(const Body& holder, const Body& body, Scalar rate, const Move& by_push) {
            const Vec lever = body.start_position - holder.start_position;
            const Vec shift = (holder.velocity + cross(holder.spin, lever)) * (1 / rate);
            const Vec turn = body.rotation.back(holder.spin * (1 / rate));
            g -= body.mass * by_push.shift.dot(shift) +
                 (body.inertia * body.rotation.back(by_push.angle)).dot(turn);
        }
        // Of an attachment, which begins each substep from nothing.
        void add_expected(const Body& body, const Vec& pushed, const Vec& turned, const Move& expected) {
            g += body.mass * pushed.dot(expected.shift) +
                 (body.inertia * turned).dot(body.rotation.back(expected.angle));
        }
    };

    // In the body's axes.
    static Vec turn_since(const Body& body, const Quaternion<Scalar>& then) {
        const Quaternion<Scalar> d = then.conjugate() * body.orientation;
        return d.vector() * Scalar(d.w < 0 ? -2 : 2);
    }

    // What of a figure's carried pushes is missing to the least energy: −G/Q; none where next to nothing is
    // gained.
    Scalar share_to_add(std::size_t figure) const {
        Energies energies;
        Scalar mass = 0;
        Scalar heaviest = 0;
        for (std::size_t i = 0; i < parts_.bodies.size(); ++i) {
            const Body& body = parts_.bodies[i];
            if (body.moves && parts_.figures[i] == figure) {
                const Vec pushed = body.position - body.uncarried_position;
                const Vec turned = turn_since(body, body.uncarried_orientation);
                energies.add(body, 1, pushed, turned);
                for (const HeldParticle<Scalar>& attachment : parts_.attachments) {
                    if (attachment.holds(i) && !attachment.holds_in_tree) {
                        energies.add_expected(body, pushed, turned, attachment.expected_move(body));
                    }
                }
                mass += body.mass;
                heaviest = std::max(heaviest, body.mass);
            }
        }
        for (const Contact& contact : parts_.contacts) {
            if (!parts_.belongs_to(contact, figure) || parts_.is_shared(contact)) {
                continue;
            }
            const bool pushes_a = parts_.bodies[contact.a].moves;
            const Body& body = parts_.bodies[pushes_a ? contact.a : contact.b];
            const Body& holder = parts_.bodies[pushes_a ? contact.b : contact.a];
            if (!holder.moves) {
                Move by_push;
                contact.add_pushes(pushes_a, by_push);
                energies.move_with(holder, body, rate_, by_push);
            }
        }
        // What the contacts with other figures do to these. None counts as heavier than the figure's own.
        // Those of the same two bodies stand together.
        Move move;
        for (std::size_t k = 0; k < parts_.contacts.size(); ++k) {
            const Contact& contact = parts_.contacts[k];
            if (!parts_.is_shared(contact) || !parts_.belongs_to(contact, figure)) {
                continue;
            }
            const bool to_a = parts_.figures[contact.a] != figure;
            const Body& neighbour = parts_.bodies[to_a ? contact.a : contact.b];
            contact.add_pushes(to_a, move);
            if (k + 1 == parts_.contacts.size() || !contact.is_of_same_bodies(parts_.contacts[k + 1])) {
                energies.add(neighbour, std::min(heaviest / neighbour.mass, Scalar(1)), move.shift,
                             neighbour.rotation.back(move.angle));
                move = {};
            }
        }
        if (!(energies.q > 0)) {
            return 0;
        }
        const Scalar share = std::clamp(-energies.g / energies.q, Scalar(-1), Scalar(1));
        const bool worth = std::abs(share) >= Scalar(0.125) &&
                           std::abs(energies.g * share) >= least_motion_ * least_motion_ * mass;
        return worth ? share : 0;
    }

    RigidParts<Scalar>& parts_;
    Scalar rate_;
    Scalar least_motion_;
};

} // namespace reference
