// Rigid bodies, their joints with limits, and contacts in floating point: the twin that the integer solver is
// measured against.
//
// The same substeps in the same order: the implicit midpoint rule for spins, Cayley's map, the points of a
// tree's joints by one linear solve with the velocities that follow, those of joints that close loops, or
// have soft turns, by a block each, distances by a row each, what hinges and fixed joints don't let turn by
// another, limits and contacts by rows whose pushes only push, carried pushes with a factor for each figure,
// impacts before the prediction, and errors undone without speed. What differs:
//   - the points' system is a dense matrix for each tree, where the SDK eliminates it along its tree;
//   - pushes are in kg·m, turns in radians: no shares, no units of length, no clamps but of turns;
//     directions are as exact as the numbers, where the SDK has 30 fraction bits;
//   - the SDK takes 2^-33 of a spin a substep, to be sure that roundings add nothing;
//   - what damping keeps of a speed is as exact as the numbers, where the SDK has a multiple of 2^-31;
//   - the figures' factors are as exact as the numbers, where the SDK has motions of 26 fraction bits.
// Particles go with it by xpbd.h, held by attachments; they touch nothing. There is no sleep, and there are
// no iterations more after hard impacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/rigid_carried_pushes.h"
#include "reference/rigid_closures.h"
#include "reference/rigid_figure_overlaps.h"
#include "reference/rigid_free_figures.h"
#include "reference/rigid_free_motion.h"
#include "reference/rigid_held_trees.h"
#include "reference/rigid_joint_trees.h"
#include "reference/rigid_search.h"

namespace reference {

template <typename Scalar>
class RigidSolver {
public:
    using Vec = Vector3<Scalar>;

    RigidSolver(const RigidSolver&) = delete;
    RigidSolver& operator=(const RigidSolver&) = delete;
    RigidSolver(const RigidModel& model, const Settings& settings)
        : settings_(settings), rate_(static_cast<Scalar>(settings.tick_rate_hz * settings.substeps)),
          motion_(Vec(settings.gravity), rate_, settings.substeps), search_(model),
          body_count_(model.bodies.size()),
          carried_(parts_, rate_, static_cast<Scalar>(8 * gravity_speed(settings) + 0.02) / rate_) {
        for (const RigidBody& from : model.bodies) {
            bodies_.emplace_back(from);
        }
        for (const RigidCollider& from : model.colliders) {
            add_still(from);
        }
        for (const RigidJoint& from : model.joints) {
            joints_.emplace_back(from, rate_);
            bodies_[from.a].jointed = bodies_[from.b].jointed = true;
        }
        for (const Model& from : model.objects) {
            parts_.objects.emplace_back(from, settings);
        }
        for (const RigidAttachment& from : model.attachments) {
            parts_.attachments.emplace_back(from, rate_);
            if (from.to_body) {
                bodies_[from.other].attached = true;
                if (parts_.attachments.back().is_of_pinned(parts_.objects)) {
                    bodies_[from.other].pinned = true;
                }
            }
        }
        parts_.find_figures();
        trees_.find();
        closures_.find();
    }

    void tick(int count = 1) {
        for (int i = 0; i < count; ++i) {
            for (Body& body : bodies_) {
                body.rotation = body.orientation.matrix();
                body.follow_rotation();
                motion_.aim(body);
            }
            contacts_ = search_.find(bodies_, static_cast<Scalar>(settings_.tick_rate_hz), rate_, contacts_);
            parts_.begin_tick(settings_.substeps);
            for (int k = 1; k <= settings_.substeps; ++k) {
                substep(k);
            }
            part_figures(parts_, settings_);
        }
    }

    // Between two ticks.
    void add(const RigidCollider& collider) {
        search_.add(collider);
        parts_.figures.push_back(bodies_.size());
        parts_.held.push_back(false);
        add_still(collider);
    }

    // What is kinematic: a body's centre of mass, or a collider, is to be there at the end of the next tick.
    void lead_body(std::size_t body, const support::Vector& position, const Rotation& orientation) {
        bodies_[body].target_position = Vec(position);
        bodies_[body].target_orientation = quaternion_of<Scalar>(orientation);
    }
    void lead_collider(std::size_t collider, const support::Vector& position, const Rotation& orientation) {
        lead_body(body_count_ + collider, position, orientation);
    }

    // Between two ticks; joints by their order in the model.
    void drive(std::size_t joint, const RigidMotor& motor) { joints_[joint].set_motor(motor); }

    std::size_t size() const { return body_count_; }
    support::Vector position(std::size_t body) const { return bodies_[body].position.widened(); }
    support::Vector velocity(std::size_t body) const { return bodies_[body].velocity.widened(); }
    Rotation orientation(std::size_t body) const {
        const Quaternion<Scalar>& q = bodies_[body].orientation;
        return {q.x, q.y, q.z, q.w};
    }
    support::Vector particle(std::size_t object, std::size_t particle) const {
        return parts_.objects[object].position(particle);
    }
    // Joules.
    double kinetic_energy() const {
        double energy = 0;
        for (std::size_t i = 0; i < body_count_; ++i) {
            const Body& body = bodies_[i];
            const Vec spin = body.rotation.back(body.spin);
            energy += body.moves ? 0.5 * static_cast<double>(body.mass * body.velocity.dot(body.velocity) +
                                                             spin.dot(body.inertia * spin))
                                 : 0;
        }
        return energy;
    }

private:
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Contact = BodyContact<Scalar>;
    using Move = BodyMove<Scalar>;

    // What a substep of gravity alone gives bodies is no impact, and no sliding.
    static double gravity_speed(const Settings& settings) {
        const support::Vector& g = settings.gravity;
        return (std::abs(g.x) + std::abs(g.y) + std::abs(g.z)) / (settings.tick_rate_hz * settings.substeps);
    }
    Scalar gravity_speed(const Contact& contact) const {
        const auto factor = [this](std::size_t i) {
            return bodies_[i].moves ? std::abs(bodies_[i].gravity_factor) : Scalar(0);
        };
        return static_cast<Scalar>(settings_.gravity.length()) / rate_ *
               std::max(factor(contact.a), factor(contact.b));
    }
    Scalar least_approach(const Contact& contact) const { return 4 * gravity_speed(contact) + Scalar(0.01); }
    Scalar slow_slip(const Contact& contact) const { return (gravity_speed(contact) + Scalar(0.01)) / rate_; }

    void add_still(const RigidCollider& collider) {
        RigidBody still;
        still.position = collider.position;
        still.orientation = collider.orientation;
        bodies_.emplace_back(still);
    }

    // 1 .. substeps
    void substep(int number) {
        parts_.for_each_contact([&](Contact& contact, Body& a, Body& b) {
            if (contact.every_substep && number > 1) {
                search_.look_again(contact, bodies_, rate_);
            }
            contact.begin(a, b, rate_);
        });
        parts_.for_each_joint([](Joint& joint, Body& a, Body& b) { joint.begin(a, b); });
        free_.begin_substep(number);
        parts_.measure_left(rate_);
        strike_all();
        for (Body& body : bodies_) {
            motion_.predict(body, number);
        }
        parts_.begin_substep(number);
        trees_.factor_points();
        closures_.factor();
        contact_moves_.resize(bodies_.size());
        carry_pushes_on();
        for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
            for (Solver<Scalar>& object : parts_.objects) {
                object.project();
            }
            parts_.project_attachments();
            sweep([](std::size_t) { return true; });
            parts_.project_attachments();
        }
        relieve_held();
        for (Body& body : bodies_) {
            body.predicted_velocity = body.velocity;
            body.predicted_spin = body.spin;
            motion_.finish(body);
        }
        free_.finish_substep(number);
        restore_speeds();
        parts_.for_each_joint([this](const Joint& joint, Body& a, Body& b) {
            if (!joint.in_tree || joint.closes) {
                joint.undo_turn(a, b);
                if (!joint.in_tree) {
                    joint.undo_points(a, b, parts_.is_pinned(parts_.figure_of(joint)));
                }
                a.settle();
                b.settle();
            }
        });
        for (const bool shared : {false, true}) {
            parts_.for_each_contact([&](Contact& contact, Body& a, Body& b) {
                if (parts_.is_shared(contact) == shared) {
                    contact.undo_overlap(a, b, rate_);
                }
            });
        }
        trees_.hold_springs();
        for (const JointTree<Scalar>& tree : trees_) {
            if (tree.closed) { // by closures_
                static_cast<void>(trees_.undo_turns(tree));
            } else if (!tree.held || !held_.undo_errors(tree)) {
                trees_.undo_errors(tree);
            }
        }
        closures_.undo_errors();
        for (Body& body : bodies_) {
            body.normalise();
        }
        parts_.finish_substep();
    }

    // An impact may cause the next one: forward and back, until nothing strikes any more. What several strike
    // at once takes them together, behind the sweeps.
    void strike_all() {
        std::vector<int> impacts(bodies_.size());
        for (const Contact& contact : contacts_) {
            if (contact.is_about_to_strike(bodies_[contact.a], bodies_[contact.b], least_approach(contact),
                                           rate_)) {
                ++impacts[contact.a];
                ++impacts[contact.b];
            }
        }
        const auto takes_one = [&](std::size_t i) { return !bodies_[i].moves || impacts[i] < 2; };
        bool again = true;
        for (int pass = 0; pass < 8 && again; ++pass) {
            again = false;
            for (std::size_t i = 0; i < contacts_.size(); ++i) {
                Contact& contact = contacts_[pass % 2 == 0 ? i : contacts_.size() - 1 - i];
                if (takes_one(contact.a) && takes_one(contact.b)) {
                    again = contact.strike(bodies_[contact.a], bodies_[contact.b], least_approach(contact),
                                           rate_) ||
                            again;
                }
            }
        }
    }

    // All contacts together.
    void restore_speeds() {
        parts_.for_each_contact([this](Contact& contact, Body& a, Body& b) {
            contact.begin_impact(a, b, least_approach(contact), rate_);
        });
        parts_.for_each_contact([](Contact& contact, Body& a, Body& b) { contact.give_alike(a, b); });
        bool more = true;
        for (int round = 0; round < 32 && more; ++round) {
            more = false;
            parts_.for_each_contact(
                [&](Contact& contact, Body& a, Body& b) { more = contact.give_each(a, b) || more; });
        }
        parts_.for_each_contact([](Contact& contact, Body& a, Body& b) { contact.rub_by_impact(a, b); });
    }

    // Of figures that take(figure) names; held ones with their turns or by rows.
    template <typename Take>
    void sweep(const Take& take, bool with_turns = false) {
        const auto takes = [&](const Contact& contact) {
            const bool a = !bodies_[contact.a].moves || take(parts_.figures[contact.a]);
            const bool b = !bodies_[contact.b].moves || take(parts_.figures[contact.b]);
            return a && b;
        };
        const auto turn = [&](Joint& joint) {
            if (take(parts_.figure_of(joint)) && !(with_turns && joint.in_held_tree)) {
                joint.project(bodies_[joint.a], bodies_[joint.b]);
            }
        };
        const auto solve = [&] {
            for (const JointTree<Scalar>& tree : trees_) {
                if (tree.closed || !take(parts_.figure_of(joints_[tree.joints.front()]))) {
                    continue;
                }
                if (with_turns && tree.held) {
                    held_.solve(tree, true);
                } else {
                    trees_.solve_points(tree, true);
                }
            }
            closures_.solve(take);
        };
        std::for_each(joints_.begin(), joints_.end(), turn);
        solve();
        parts_.for_each_contact([&](Contact& contact, const Body& a, const Body& b) {
            if (takes(contact)) {
                contact.measure(a, b);
            }
        });
        project_contacts(false, false, takes);
        project_contacts(true, false, takes);
        project_contacts(true, true, takes);
        project_contacts(false, true, takes);
        apply_contact_moves();
        std::for_each(joints_.rbegin(), joints_.rend(), turn);
        solve();
    }

    template <typename Takes>
    void project_contacts(bool shared, bool back, const Takes& takes) {
        for (std::size_t k = 0; k < contacts_.size(); ++k) {
            Contact& contact = contacts_[back ? contacts_.size() - 1 - k : k];
            if (parts_.is_shared(contact) == shared && takes(contact)) {
                contact.project(contact_moves_[contact.a], contact_moves_[contact.b], back,
                                slow_slip(contact));
            }
        }
    }

    // More of it for figures that hang on what does not move: turns with their points.
    void relieve_held() {
        for (int round = 0; round < 16; ++round) {
            std::vector<bool> strained(bodies_.size());
            bool any = false;
            for (const Joint& joint : joints_) {
                const std::size_t figure = parts_.figure_of(joint);
                if (parts_.held[figure] && held_.is_strained(joint, true)) {
                    strained[figure] = any = true;
                }
            }
            if (!any) {
                return;
            }
            sweep([&](std::size_t figure) { return bool(strained[figure]); }, true);
        }
    }

    void apply_contact_moves() {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            contact_moves_[i].apply_to(bodies_[i]);
            contact_moves_[i] = {};
        }
    }

    void carry_pushes_on() {
        parts_.for_each_joint([](Joint& joint, Body& a, Body& b) {
            joint.prepare(a, b);
            if (joint.in_held_tree) {
                CarriedPushes<Scalar>::carry_torque(a, b, joint.carried_turn(a, b));
            } else {
                joint.push_again(a, b);
            }
        });
        parts_.for_each_contact(
            [](Contact& contact, const Body& a, const Body& b) { contact.make_rows(a, b); });
        for (const Contact& contact : contacts_) {
            contact.add_pushes(true, contact_moves_[contact.a]);
            contact.add_pushes(false, contact_moves_[contact.b]);
        }
        apply_contact_moves();
        solve_all();
        if (carried_.scale()) {
            solve_all();
        }
    }

    void solve_all() {
        trees_.solve_points();
        closures_.solve([](std::size_t) { return true; });
    }

    Settings settings_;
    Scalar rate_; // substeps a second
    FreeMotion<Scalar> motion_;
    ContactSearch<Scalar> search_;
    std::size_t body_count_;
    RigidParts<Scalar> parts_;
    std::vector<Body>& bodies_ = parts_.bodies;
    std::vector<Joint>& joints_ = parts_.joints;
    std::vector<Contact>& contacts_ = parts_.contacts;
    JointTrees<Scalar> trees_{parts_};
    HeldTrees<Scalar> held_{parts_, trees_};
    JointClosures<Scalar> closures_{parts_, trees_};
    CarriedPushes<Scalar> carried_;
    FreeFigures<Scalar> free_{parts_, Vec(settings_.gravity), rate_, settings_.substeps};
    std::vector<Move> contact_moves_; // of a contact sweep, by body
};

} // namespace reference
