// Rigid bodies, their joints with limits, and contacts in floating point: the twin that the integer solver is
// measured against.
//
// The same substeps in the same order: the implicit midpoint rule for spins, Cayley's map, the points of all
// joints by one linear solve with the velocities that follow, what hinges and fixed joints don't let turn by
// a block each, limits and contacts by rows whose pushes only push, carried pushes with a factor for each
// figure, impacts before the prediction, and errors undone without speed. What differs:
//   - the points' system is one dense matrix, where the SDK eliminates it along the trees;
//   - pushes are in kg·m, turns in radians: no shares, no units of length, no clamps; directions are as exact
//     as the numbers, where the SDK has 30 fraction bits;
//   - the SDK takes 2^-33 of a spin a substep, to be sure that roundings add nothing;
//   - the figures' factors are as exact as the numbers, where the SDK has motions of 26 fraction bits.
// There are no contacts but of spheres with each other and of bodies with planes, no motors, friction of
// joints, soft joints, loops, damping, sleep, and nothing that covers more than its own thickness in a tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "reference/rigid_free_motion.h"
#include "reference/rigid_joint.h"
#include "reference/rigid_search.h"

namespace reference {

template <typename Scalar>
class RigidSolver {
public:
    using Vec = Vector3<Scalar>;

    RigidSolver(const RigidModel& model, const Settings& settings)
        : settings_(settings), rate_(static_cast<Scalar>(settings.tick_rate_hz * settings.substeps)),
          motion_(Vec(settings.gravity), rate_), search_(model), body_count_(model.bodies.size()) {
        const support::Vector& g = settings.gravity;
        const double rate = settings.tick_rate_hz * settings.substeps;
        const double gravity_speed = (std::abs(g.x) + std::abs(g.y) + std::abs(g.z)) / rate;
        least_approach_ = static_cast<Scalar>(4 * gravity_speed + 0.01);
        least_motion_ = 2 * least_approach_ / rate_;
        for (const RigidBody& from : model.bodies) {
            bodies_.emplace_back(from);
        }
        for (const RigidPlane& from : model.planes) {
            RigidBody still;
            still.position = from.position;
            still.orientation = from.orientation;
            bodies_.emplace_back(still);
        }
        for (const RigidJoint& from : model.joints) {
            joints_.emplace_back(from);
        }
        find_figures();
    }

    void tick(int count = 1) {
        for (int i = 0; i < count; ++i) {
            for (Body& body : bodies_) {
                body.rotation = body.orientation.matrix();
                body.follow_rotation();
            }
            contacts_ = search_.find(bodies_, static_cast<Scalar>(settings_.tick_rate_hz), contacts_);
            for (Contact& contact : contacts_) {
                contact.jointed = is_jointed(contact);
            }
            for (int k = 0; k < settings_.substeps; ++k) {
                substep();
            }
            part_figures();
        }
    }

    std::size_t size() const { return body_count_; }
    support::Vector position(std::size_t body) const { return bodies_[body].position.widened(); }
    Rotation orientation(std::size_t body) const {
        const Quaternion<Scalar>& q = bodies_[body].orientation;
        return {q.x, q.y, q.z, q.w};
    }
    // Joules.
    double kinetic_energy() const {
        double energy = 0;
        for (std::size_t i = 0; i < body_count_; ++i) {
            const Body& body = bodies_[i];
            const Vec spin = body.rotation.back(body.spin);
            energy += body.moves ? 0.5 * static_cast<double>(body.mass * body.velocity.dot(body.velocity) +
                                                             spin.dot(products(body.inertia, spin)))
                                 : 0;
        }
        return energy;
    }

private:
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Contact = BodyContact<Scalar>;
    using Move = BodyMove<Scalar>;

    // Bodies that joints hold together have the number of one of them.
    void find_figures() {
        figures_.resize(bodies_.size());
        std::iota(figures_.begin(), figures_.end(), std::size_t{0});
        for (const Joint& joint : joints_) {
            if (bodies_[joint.a].moves && bodies_[joint.b].moves) {
                const std::size_t from = figures_[joint.b];
                std::replace(figures_.begin(), figures_.end(), from, figures_[joint.a]);
            }
        }
    }

    bool is_jointed(const Contact& contact) const {
        return std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
            return joint.a == contact.a || joint.a == contact.b || joint.b == contact.a ||
                   joint.b == contact.b;
        });
    }
    // Of two figures.
    bool is_shared(const Contact& contact) const {
        return bodies_[contact.a].moves && bodies_[contact.b].moves &&
               figures_[contact.a] != figures_[contact.b];
    }
    std::size_t figure_of(const Joint& joint) const {
        return figures_[bodies_[joint.a].moves ? joint.a : joint.b];
    }
    bool belongs_to(const Contact& contact, std::size_t figure) const {
        return (bodies_[contact.a].moves && figures_[contact.a] == figure) ||
               (bodies_[contact.b].moves && figures_[contact.b] == figure);
    }

    // use(joint, body a, body b), and the same of contacts.
    template <typename Use>
    void for_each_joint(const Use& use) {
        for (Joint& joint : joints_) {
            use(joint, bodies_[joint.a], bodies_[joint.b]);
        }
    }
    template <typename Use>
    void for_each_contact(const Use& use) {
        for (Contact& contact : contacts_) {
            use(contact, bodies_[contact.a], bodies_[contact.b]);
        }
    }

    void substep() {
        for_each_contact([this](Contact& contact, Body& a, Body& b) { contact.begin(a, b, rate_); });
        for_each_joint([](Joint& joint, Body& a, Body& b) { joint.begin(a, b); });
        strike_all();
        for (Body& body : bodies_) {
            motion_.predict(body);
        }
        factor_points();
        contact_moves_.resize(bodies_.size());
        carry_pushes_on();
        for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
            sweep();
        }
        for (Body& body : bodies_) {
            motion_.finish(body);
        }
        for_each_contact(
            [this](Contact& contact, Body& a, Body& b) { contact.restore_speed(a, b, least_approach_); });
        for (const bool shared : {false, true}) {
            for_each_contact([&](Contact& contact, Body& a, Body& b) {
                if (is_shared(contact) == shared) {
                    contact.undo_overlap(a, b, rate_);
                }
            });
        }
        undo_errors();
    }

    // As wholes, by the contacts of the last substep; what hangs on an anchor stays.
    void part_figures() {
        std::vector<Scalar> masses(bodies_.size());
        std::vector<Vec> shifts(bodies_.size());
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            masses[figures_[i]] += bodies_[i].moves ? bodies_[i].mass : 0;
        }
        std::vector<Scalar> weights(bodies_.size());
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            weights[i] = masses[i] > 0 ? 1 / masses[i] : 0;
        }
        for (const Joint& joint : joints_) {
            if (!bodies_[joint.a].moves || !bodies_[joint.b].moves) {
                weights[figures_[joint.a]] = weights[figures_[joint.b]] = 0;
            }
        }
        const auto part = [&](const Contact& contact) {
            const std::size_t a = figures_[contact.a];
            const std::size_t b = figures_[contact.b];
            const Scalar weight = weights[a] + weights[b];
            Scalar apart = 0;
            if (a == b || weight == 0 ||
                !contact.wants_apart(Scalar(0.4) / static_cast<Scalar>(settings_.tick_rate_hz), apart)) {
                return;
            }
            const Scalar missing = apart - contact.normal.dot(shifts[b] - shifts[a]);
            if (missing > 0) {
                shifts[a] = shifts[a] - contact.normal * (missing * weights[a] / weight);
                shifts[b] = shifts[b] + contact.normal * (missing * weights[b] / weight);
            }
        };
        for (int sweep = 0; sweep < 4; ++sweep) {
            std::for_each(contacts_.begin(), contacts_.end(), part);
            std::for_each(contacts_.rbegin(), contacts_.rend(), part);
        }
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (bodies_[i].moves) {
                bodies_[i].position = bodies_[i].position + shifts[figures_[i]];
            }
        }
    }

    // An impact may cause the next one: forward and back, until nothing strikes any more.
    void strike_all() {
        bool again = true;
        for (int pass = 0; pass < 8 && again; ++pass) {
            again = false;
            for (std::size_t i = 0; i < contacts_.size(); ++i) {
                Contact& contact = contacts_[pass % 2 == 0 ? i : contacts_.size() - 1 - i];
                again =
                    contact.strike(bodies_[contact.a], bodies_[contact.b], least_approach_, rate_) || again;
            }
        }
    }

    void sweep() {
        for_each_joint([](Joint& joint, Body& a, Body& b) { joint.project_turn(a, b); });
        solve_points(true);
        for_each_contact([](Contact& contact, const Body& a, const Body& b) { contact.measure(a, b); });
        project_contacts(false, false);
        project_contacts(true, false);
        project_contacts(true, true);
        project_contacts(false, true);
        apply_contact_moves();
        for (std::size_t i = joints_.size(); i-- > 0;) {
            joints_[i].project_turn(bodies_[joints_[i].a], bodies_[joints_[i].b]);
        }
        solve_points(true);
    }

    void project_contacts(bool shared, bool back) {
        for (std::size_t k = 0; k < contacts_.size(); ++k) {
            Contact& contact = contacts_[back ? contacts_.size() - 1 - k : k];
            if (is_shared(contact) == shared) {
                contact.project(contact_moves_[contact.a], contact_moves_[contact.b], back);
            }
        }
    }

    void apply_contact_moves() {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            contact_moves_[i].apply_to(bodies_[i]);
            contact_moves_[i] = {};
        }
    }

    // J·M⁻¹·Jᵀ of all joints' points, at the predicted pose.
    void factor_points() {
        const std::size_t size = 3 * joints_.size();
        std::vector<Scalar> matrix(size * size);
        for_each_joint([](Joint& joint, Body& a, Body& b) { joint.place_levers(a, b); });
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
        if (joints_.empty()) {
            return;
        }
        std::vector<Scalar> pushes;
        for_each_joint([&](const Joint& joint, const Body& a, const Body& b) {
            const Vec error = to_start ? joint.offset(a, b) - joint.start : joint.offset(a, b);
            pushes.insert(pushes.end(), {-error.x, -error.y, -error.z});
        });
        points_.solve(pushes);
        clear_pushes();
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            add_push(joints_[i], {pushes[3 * i], pushes[3 * i + 1], pushes[3 * i + 2]});
        }
        for (Body& body : bodies_) {
            Move{body.force * body.inverse_mass, body.world_inverse * body.torque}.apply_to(body);
        }
    }

    void carry_pushes_on() {
        for_each_joint([](Joint& joint, Body& a, Body& b) { joint.turn_again(a, b); });
        for_each_contact([](Contact& contact, const Body& a, const Body& b) { contact.make_rows(a, b); });
        for (const Contact& contact : contacts_) {
            contact.add_pushes(true, contact_moves_[contact.a]);
            contact.add_pushes(false, contact_moves_[contact.b]);
        }
        apply_contact_moves();
        solve_points(true);
        if (scale_carried_pushes()) {
            solve_points(true);
        }
    }

    // Figure by figure. Where one has been changed those that touch it think again.
    bool scale_carried_pushes() {
        std::vector<Scalar> shares(bodies_.size());
        for (std::size_t figure = 0; figure < bodies_.size(); ++figure) {
            shares[figure] = share_to_add(figure);
        }
        std::vector<bool> changed(bodies_.size());
        bool any = false;
        for (std::size_t figure = 0; figure < bodies_.size(); ++figure) {
            if (knows_changed(figure, changed)) {
                shares[figure] = share_to_add(figure);
            }
            if (shares[figure] == 0) {
                continue;
            }
            any = true;
            changed[figure] = true;
            for_each_joint([&](Joint& joint, Body& a, Body& b) {
                if (figure_of(joint) == figure) {
                    joint.carry_more(a, b, shares[figure]);
                }
            });
            for (const bool shared : {false, true}) {
                for_each_contact([&](Contact& contact, Body& a, Body& b) {
                    if (belongs_to(contact, figure) && is_shared(contact) == shared) {
                        contact.carry_more(a, b, shares[figure]);
                        changed[figures_[contact.a]] = changed[figures_[contact.a]] || shared;
                        changed[figures_[contact.b]] = changed[figures_[contact.b]] || shared;
                    }
                });
            }
        }
        return any;
    }

    bool knows_changed(std::size_t figure, const std::vector<bool>& changed) const {
        return changed[figure] || std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
                   return is_shared(c) && belongs_to(c, figure) &&
                          (changed[figures_[c.a]] || changed[figures_[c.b]]);
               });
    }

    // Products of motions in six dimensions with the mass matrix.
    struct Energies {
        Scalar g = 0, q = 0;

        // `part`: of its mass.
        void add(const Body& body, Scalar part, const Vec& pushed, const Vec& turned) {
            const Scalar mass = body.mass * part;
            const Vec turned_mass = products(body.inertia, turned) * part;
            g += mass * pushed.dot(body.position - body.start_position) +
                 turned_mass.dot(turn_since(body, body.start_orientation));
            q += mass * pushed.dot(pushed) + turned_mass.dot(turned);
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
        for (std::size_t i = 0; i < body_count_; ++i) {
            const Body& body = bodies_[i];
            if (body.moves && figures_[i] == figure) {
                energies.add(body, 1, body.position - body.uncarried_position,
                             turn_since(body, body.uncarried_orientation));
                mass += body.mass;
                heaviest = std::max(heaviest, body.mass);
            }
        }
        // What the contacts with other figures do to these. None counts as heavier than the figure's own.
        for (const Contact& contact : contacts_) {
            if (is_shared(contact) && belongs_to(contact, figure)) {
                const bool to_a = figures_[contact.a] != figure;
                const Body& neighbour = bodies_[to_a ? contact.a : contact.b];
                Move move;
                contact.add_pushes(to_a, move);
                energies.add(neighbour, std::min(heaviest / neighbour.mass, Scalar(1)), move.shift,
                             neighbour.rotation.back(move.angle));
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

    // Without giving speed: turns first, then the points. A limit that turns one bone back on its joint takes
    // the points along: some rounds bring both right.
    void undo_errors() {
        bool far_off = !joints_.empty();
        for (int round = 0; round < 6 && far_off; ++round) {
            far_off = false;
            for_each_joint([&](const Joint& joint, Body& a, Body& b) {
                far_off = joint.undo_turn(a, b) || far_off;
                a.orientation = a.orientation.normalised();
                b.orientation = b.orientation.normalised();
            });
            solve_points(false);
        }
        for (Body& body : bodies_) {
            body.orientation = body.orientation.normalised();
        }
    }

    Settings settings_;
    Scalar rate_; // substeps a second
    FreeMotion<Scalar> motion_;
    ContactSearch<Scalar> search_;
    std::size_t body_count_;
    Scalar least_approach_;
    Scalar least_motion_;
    std::vector<Body> bodies_; // planes behind them
    std::vector<std::size_t> figures_;
    std::vector<Joint> joints_;
    std::vector<Contact> contacts_;
    std::vector<Move> contact_moves_; // of a contact sweep, by body
    SymmetricSystem<Scalar> points_;
};

} // namespace reference
