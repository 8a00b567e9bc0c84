// What the rigid reference solver works on, and which of it belongs together: bodies that joints hold
// together are a figure, with the contacts of its bodies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "reference/rigid_attachment.h"
#include "reference/rigid_contact.h"
#include "reference/rigid_joint.h"

namespace reference {

template <typename Scalar>
struct RigidParts {
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Contact = BodyContact<Scalar>;
    using Attachment = HeldParticle<Scalar>;

    std::vector<Body> bodies; // colliders behind them
    std::vector<Joint> joints;
    std::vector<Contact> contacts;
    std::vector<Solver<Scalar>> objects;
    std::vector<Attachment> attachments;
    std::vector<std::size_t> figures; // of each body: the number of one of its figure
    std::vector<bool> held;           // by the figure's number: by a joint to what does not move

    void find_figures() {
        figures.resize(bodies.size());
        std::iota(figures.begin(), figures.end(), std::size_t{0});
        for (const Joint& joint : joints) {
            if (bodies[joint.a].moves && bodies[joint.b].moves) {
                const std::size_t from = figures[joint.b];
                std::replace(figures.begin(), figures.end(), from, figures[joint.a]);
            }
        }
        held.resize(bodies.size());
        for (const Joint& joint : joints) {
            if (bodies[joint.a].moves != bodies[joint.b].moves) {
                held[figure_of(joint)] = true;
            }
        }
    }

    // Of two figures.
    bool is_shared(const Contact& contact) const {
        return bodies[contact.a].moves && bodies[contact.b].moves && figures[contact.a] != figures[contact.b];
    }
    std::size_t figure_of(const Joint& joint) const {
        return figures[bodies[joint.a].moves ? joint.a : joint.b];
    }
    // By an attachment to a particle that does not move.
    bool is_pinned(std::size_t figure) const {
        return std::any_of(attachments.begin(), attachments.end(), [&](const Attachment& attachment) {
            return attachment.is_of_pinned(objects) && figures[attachment.other()] == figure;
        });
    }
    bool belongs_to(const Contact& contact, std::size_t figure) const {
        return (bodies[contact.a].moves && figures[contact.a] == figure) ||
               (bodies[contact.b].moves && figures[contact.b] == figure);
    }

    // Of the objects with them.
    void begin_tick(int substeps) {
        for (Solver<Scalar>& object : objects) {
            object.begin_tick();
        }
        for (Attachment& attachment : attachments) {
            attachment.begin_tick(substeps);
        }
    }
    void measure_left(Scalar rate) {
        for (Attachment& attachment : attachments) {
            attachment.measure_left(objects, bodies, rate);
        }
    }
    void begin_substep(int substep) {
        for (Solver<Scalar>& object : objects) {
            object.begin_substep(substep);
        }
        for (Attachment& attachment : attachments) {
            attachment.begin_substep(objects, bodies);
        }
    }
    void project_attachments() {
        for (Attachment& attachment : attachments) {
            attachment.project(objects, bodies);
        }
    }
    void finish_substep() {
        for (Solver<Scalar>& object : objects) {
            object.finish_substep();
        }
        for (Attachment& attachment : attachments) {
            attachment.finish_substep();
        }
    }

    // use(joint, body a, body b), and the same of contacts.
    template <typename Use>
    void for_each_joint(const Use& use) {
        for (Joint& joint : joints) {
            use(joint, bodies[joint.a], bodies[joint.b]);
        }
    }
    template <typename Use>
    void for_each_contact(const Use& use) {
        for (Contact& contact : contacts) {
            use(contact, bodies[contact.a], bodies[contact.b]);
        }
    }
};

} // namespace reference
