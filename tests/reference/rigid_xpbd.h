// Rigid bodies, their joints with limits, and contacts in floating point: the twin that the integer solver is
// measured against.
//
// The same substeps in the same order: the implicit midpoint rule for spins, Cayley's map, the points of all
// joints by one linear solve with the velocities that follow, what hinges and fixed joints don't let turn by
// a block each, limits and contacts by rows whose pushes only push, carried pushes with a factor for each
// figure, impacts before the prediction, and errors undone without speed. What differs:
//   - the points' system is a dense matrix for each figure, where the SDK eliminates it along its tree;
//   - pushes are in kg·m, turns in radians: no shares, no units of length, no clamps but of turns;
//     directions are as exact as the numbers, where the SDK has 30 fraction bits;
//   - the SDK takes 2^-33 of a spin a substep, to be sure that roundings add nothing;
//   - the figures' factors are as exact as the numbers, where the SDK has motions of 26 fraction bits.
// A body has one shape. There are no motors, friction of joints, soft joints, loops, damping and sleep, and
// no colliders that move.
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
        for (const RigidCollider& from : model.colliders) {
            add_still(from);
        }
        for (const RigidJoint& from : model.joints) {
            joints_.emplace_back(from);
            bodies_[from.a].jointed = bodies_[from.b].jointed = true;
        }
        find_figures();
    }

    void tick(int count = 1) {
        for (int i = 0; i < count; ++i) {
            for (Body& body : bodies_) {
                body.rotation = body.orientation.matrix();
                body.follow_rotation();
            }
            contacts_ = search_.find(bodies_, static_cast<Scalar>(settings_.tick_rate_hz), rate_, contacts_);
            for (int k = 0; k < settings_.substeps; ++k) {
                substep(k == 0);
            }
            part_figures();
        }
    }

    // Between two ticks.
    void add(const RigidCollider& collider) {
        search_.add(collider);
        figures_.push_back(bodies_.size());
        add_still(collider);
    }

    std::size_t size() const { return body_count_; }
    support::Vector position(std::size_t body) const { return bodies_[body].position.widened(); }
    support::Vector velocity(std::size_t body) const { return bodies_[body].velocity.widened(); }
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

    void add_still(const RigidCollider& collider) {
        RigidBody still;
        still.position = collider.position;
        still.orientation = collider.orientation;
        bodies_.emplace_back(still);
    }

    // The joints of a figure.
    struct JointTree {
        std::vector<std::size_t> joints;
        bool held = false;              // by one that does not move
        SymmetricSystem<Scalar> points; // at the predicted pose
    };

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
        for (std::size_t figure = 0; figure < bodies_.size(); ++figure) {
            if (figures_[figure] != figure) {
                continue;
            }
            JointTree tree;
            tree.joints = joints_from(figure);
            for (const std::size_t i : tree.joints) {
                tree.held = tree.held || bodies_[joints_[i].a].moves != bodies_[joints_[i].b].moves;
            }
            for (const std::size_t i : tree.joints) {
                joints_[i].in_held_tree = tree.held;
            }
            if (!tree.joints.empty()) {
                trees_.push_back(std::move(tree));
            }
        }
    }

    // From the root on: all those of a body before those of its children.
    std::vector<std::size_t> joints_from(std::size_t root) const {
        std::vector<std::size_t> found;
        std::vector<std::size_t> bodies{root};
        for (std::size_t next = 0; next < bodies.size(); ++next) {
            for (std::size_t i = 0; i < joints_.size(); ++i) {
                const Joint& joint = joints_[i];
                const bool holds =
                    bodies_[bodies[next]].moves && (joint.a == bodies[next] || joint.b == bodies[next]);
                if (holds && std::find(found.begin(), found.end(), i) == found.end()) {
                    found.push_back(i);
                    bodies.push_back(joint.a == bodies[next] ? joint.b : joint.a);
                }
            }
        }
        return found;
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

    void substep(bool first) {
        for_each_contact([&](Contact& contact, Body& a, Body& b) {
            if (contact.every_substep && !first) {
                search_.look_again(contact, bodies_, rate_);
            }
            contact.begin(a, b, rate_);
        });
        for_each_joint([](Joint& joint, Body& a, Body& b) { joint.begin(a, b); });
        strike_all();
        for (Body& body : bodies_) {
            motion_.predict(body);
        }
        factor_points();
        contact_moves_.resize(bodies_.size());
        carry_pushes_on();
        for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
            sweep([](std::size_t) { return true; });
        }
        relieve_held();
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
        for (const JointTree& tree : trees_) {
            undo_errors(tree);
        }
        for (Body& body : bodies_) {
            body.orientation = body.orientation.normalised();
        }
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
        const bool gentle = settings_.tick_rate_hz * settings_.substeps >= 400;
        std::vector<Scalar> pushed(contacts_.size());
        const auto part = [&](std::size_t k) {
            const Contact& contact = contacts_[k];
            const std::size_t a = figures_[contact.a];
            const std::size_t b = figures_[contact.b];
            const Scalar weight = weights[a] + weights[b];
            Scalar apart = 0;
            if (a == b || weight == 0 ||
                !contact.wants_apart(
                    Scalar(gentle ? 0.07 : 0.4) / static_cast<Scalar>(settings_.tick_rate_hz), apart)) {
                return;
            }
            const Scalar missing = apart - contact.normal.dot(shifts[b] - shifts[a]);
            const Scalar gently = std::max(apart > 0 ? (4 * missing - pushed[k]) / 5 : missing, -pushed[k]);
            const Scalar push = gentle ? gently : std::max(missing, Scalar(0));
            pushed[k] += push;
            shifts[a] = shifts[a] - contact.normal * (push * weights[a] / weight);
            shifts[b] = shifts[b] + contact.normal * (push * weights[b] / weight);
        };
        for (int sweep = 0; sweep < 4; ++sweep) {
            for (std::size_t k = 0; k < contacts_.size(); ++k) {
                part(k);
            }
            for (std::size_t k = contacts_.size(); k-- > 0;) {
                part(k);
            }
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

    // Of figures that take(figure) names; held ones with their turns or by rows.
    template <typename Take>
    void sweep(const Take& take, bool with_turns = false) {
        const auto takes = [&](const Contact& contact) {
            const bool a = !bodies_[contact.a].moves || take(figures_[contact.a]);
            const bool b = !bodies_[contact.b].moves || take(figures_[contact.b]);
            return a && b;
        };
        const auto turn = [&](Joint& joint) {
            if (take(figure_of(joint)) && !(with_turns && joint.in_held_tree)) {
                joint.project_turn(bodies_[joint.a], bodies_[joint.b]);
            }
        };
        const auto solve = [&] {
            for (const JointTree& tree : trees_) {
                if (!take(figure_of(joints_[tree.joints.front()]))) {
                    continue;
                }
                with_turns&& tree.held ? solve_with_turns(tree, true) : solve_points(tree, true);
            }
        };
        std::for_each(joints_.begin(), joints_.end(), turn);
        solve();
        for_each_contact([&](Contact& contact, const Body& a, const Body& b) {
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
            if (is_shared(contact) == shared && takes(contact)) {
                contact.project(contact_moves_[contact.a], contact_moves_[contact.b], back);
            }
        }
    }

    // More of it for figures that hang on what does not move: turns with their points.
    void relieve_held() {
        for (int round = 0; round < 16; ++round) {
            std::vector<bool> strained(bodies_.size());
            bool any = false;
            for (const JointTree& tree : trees_) {
                if (tree.held && is_strained(tree, true)) {
                    strained[figure_of(joints_[tree.joints.front()])] = any = true;
                }
            }
            if (!any) {
                return;
            }
            sweep([&](std::size_t figure) { return bool(strained[figure]); }, true);
        }
    }

    bool is_strained(const JointTree& tree, bool in_substep) const {
        return std::any_of(tree.joints.begin(), tree.joints.end(), [&](std::size_t i) {
            const Joint& joint = joints_[i];
            return joint.strain(bodies_[joint.a], bodies_[joint.b], in_substep) > far_turned;
        });
    }

    // Points and turns at once, in this substep or at all.
    void solve_with_turns(const JointTree& tree, bool in_substep) {
        if (in_substep) {
            stiffen_further(tree);
        }
        std::vector<HeldRow<Scalar>> rows;
        std::vector<Scalar> errors;
        for (const std::size_t i : tree.joints) {
            Joint& joint = joints_[i];
            const Vec offset = joint.offset(bodies_[joint.a], bodies_[joint.b]);
            const Vec error = in_substep ? offset - joint.start : offset;
            errors.insert(errors.end(), {error.x, error.y, error.z});
            const std::size_t first = rows.size();
            joint.add_rows(bodies_[joint.a], bodies_[joint.b], in_substep, rows);
            std::for_each(rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end(),
                          [i](HeldRow<Scalar>& row) {
                              row.joint = i;
                              row.error = std::clamp(row.error, Scalar(-0.25), Scalar(0.25));
                          });
        }
        const std::size_t points = errors.size();
        for (const HeldRow<Scalar>& row : rows) {
            errors.push_back(row.error);
        }
        const std::vector<Scalar> pushes = solve_held(motions_of(tree, rows, points), errors, points, rows);
        clear_pushes(tree);
        for (std::size_t k = 0; k < tree.joints.size(); ++k) {
            Joint& joint = joints_[tree.joints[k]];
            const Vec push{pushes[3 * k], pushes[3 * k + 1], pushes[3 * k + 2]};
            add_push(joint, push);
            joint.push = in_substep ? joint.push + push : joint.push;
        }
        for (std::size_t k = 0; k < rows.size(); ++k) {
            Joint& joint = joints_[rows[k].joint];
            add_torque(joint, rows[k].axis * pushes[points + k]);
            if (in_substep) {
                joint.keep_push(rows[k], pushes[points + k]);
            }
        }
        move_bodies(tree);
    }

    void stiffen_further(const JointTree& tree) {
        for_each_body(tree, [](Body& body) { body.found_load = 0; });
        for (const std::size_t i : tree.joints) {
            Joint& joint = joints_[i];
            joint.raise_tension();
            joint.add_loads(bodies_[joint.a], bodies_[joint.b]);
        }
        for_each_body(tree, [](Body& body) { body.stiffen(); });
    }

    // How all rows move by pushes in each of them; those of turns a millionth softer.
    std::vector<Scalar> motions_of(const JointTree& tree, const std::vector<HeldRow<Scalar>>& rows,
                                   std::size_t points) {
        const std::size_t size = points + rows.size();
        std::vector<Scalar> matrix(size * size);
        for (std::size_t column = 0; column < size; ++column) {
            clear_pushes(tree);
            if (column < points) {
                add_push(joints_[tree.joints[column / 3]],
                         along_axis(static_cast<int>(column % 3), Scalar(1)));
            } else {
                add_torque(joints_[rows[column - points].joint], rows[column - points].axis);
            }
            for (std::size_t row = 0; row < size; ++row) {
                matrix[row * size + column] =
                    row < points
                        ? component(point_motion(joints_[tree.joints[row / 3]]), static_cast<int>(row % 3))
                        : turn_motion(rows[row - points]);
            }
            if (column >= points) {
                const HeldRow<Scalar>& row = rows[column - points];
                const Joint& joint = joints_[row.joint];
                const Vec own =
                    bodies_[joint.a].world_inverse * row.axis + bodies_[joint.b].world_inverse * row.axis;
                matrix[column * size + column] += row.axis.dot(own) * Scalar(0x1p-20);
            }
        }
        return matrix;
    }

    Scalar turn_motion(const HeldRow<Scalar>& row) const {
        const Body& a = bodies_[joints_[row.joint].a];
        const Body& b = bodies_[joints_[row.joint].b];
        return row.axis.dot(b.world_inverse * b.torque - a.world_inverse * a.torque);
    }
    void add_torque(const Joint& joint, const Vec& push) {
        bodies_[joint.a].torque = bodies_[joint.a].torque - push;
        bodies_[joint.b].torque = bodies_[joint.b].torque + push;
    }

    void apply_contact_moves() {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            contact_moves_[i].apply_to(bodies_[i]);
            contact_moves_[i] = {};
        }
    }

    // J·M⁻¹·Jᵀ of the joints' points, at the predicted pose.
    void factor_points() {
        for_each_joint([](Joint& joint, Body& a, Body& b) { joint.place_levers(a, b); });
        for (Body& body : bodies_) {
            body.load = body.found_load = 0;
        }
        for_each_joint([](const Joint& joint, Body& a, Body& b) { joint.add_loads(a, b); });
        for (JointTree& tree : trees_) {
            for_each_body(tree, [](Body& body) { body.stiffen(); });
            const std::size_t size = 3 * tree.joints.size();
            std::vector<Scalar> matrix(size * size);
            for (std::size_t column = 0; column < size; ++column) {
                clear_pushes(tree);
                add_push(joints_[tree.joints[column / 3]],
                         along_axis(static_cast<int>(column % 3), Scalar(1)));
                for (std::size_t row = column; row < size; ++row) {
                    const Vec motion = point_motion(joints_[tree.joints[row / 3]]);
                    matrix[row * size + column] = component(motion, static_cast<int>(row % 3));
                }
            }
            tree.points.factor(size, std::move(matrix));
        }
    }

    template <typename Use>
    void for_each_body(const JointTree& tree, const Use& use) {
        for (const std::size_t i : tree.joints) {
            use(bodies_[joints_[i].a]);
            use(bodies_[joints_[i].b]);
        }
    }

    void clear_pushes(const JointTree& tree) {
        for_each_body(tree, [](Body& body) { body.force = body.torque = {}; });
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
    void solve_points(const JointTree& tree, bool to_start) {
        clear_pushes(tree);
        for_each_body(tree, [](Body& body) { body.torque = body.carried_torque; });
        std::vector<Scalar> pushes;
        for (const std::size_t i : tree.joints) {
            const Joint& joint = joints_[i];
            const Vec offset = joint.offset(bodies_[joint.a], bodies_[joint.b]);
            const Vec error = (to_start ? offset - joint.start : offset) + point_motion(joint);
            pushes.insert(pushes.end(), {-error.x, -error.y, -error.z});
        }
        tree.points.solve(pushes);
        for_each_body(tree, [](Body& body) { body.carried_torque = {}; });
        for (std::size_t k = 0; k < tree.joints.size(); ++k) {
            Joint& joint = joints_[tree.joints[k]];
            const Vec push{pushes[3 * k], pushes[3 * k + 1], pushes[3 * k + 2]};
            add_push(joint, push);
            joint.push = to_start ? joint.push + push : joint.push;
        }
        move_bodies(tree);
    }
    void move_bodies(const JointTree& tree) {
        for_each_body(tree, [](Body& body) {
            // Once each.
            Move{body.force * body.inverse_mass, body.world_inverse * body.torque}.apply_to(body);
            body.force = body.torque = {};
        });
    }
    void solve_points() {
        for (const JointTree& tree : trees_) {
            solve_points(tree, true);
        }
    }

    void carry_pushes_on() {
        for_each_joint([](Joint& joint, Body& a, Body& b) {
            joint.prepare_turn(a, b);
            if (joint.in_held_tree) {
                carry_torque(a, b, joint.carried_turn(a, b));
            } else {
                joint.turn_again(a, b);
            }
        });
        for_each_contact([](Contact& contact, const Body& a, const Body& b) { contact.make_rows(a, b); });
        for (const Contact& contact : contacts_) {
            contact.add_pushes(true, contact_moves_[contact.a]);
            contact.add_pushes(false, contact_moves_[contact.b]);
        }
        apply_contact_moves();
        solve_points();
        if (scale_carried_pushes()) {
            solve_points();
        }
    }

    static void carry_torque(Body& a, Body& b, const Vec& push) {
        a.carried_torque = a.carried_torque - push;
        b.carried_torque = b.carried_torque + push;
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
                if (figure_of(joint) != figure) {
                    return;
                }
                if (joint.in_held_tree) {
                    carry_torque(a, b, joint.add_to_carried_turn(a, b, shares[figure]));
                } else {
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
    void undo_errors(const JointTree& tree) {
        if (tree.held && undo_with_turns(tree)) {
            return;
        }
        bool far_off = true;
        for (int round = 0; round < 6 && far_off; ++round) {
            far_off = false;
            for (const std::size_t i : tree.joints) {
                const Joint& joint = joints_[i];
                Body& a = bodies_[joint.a];
                Body& b = bodies_[joint.b];
                far_off = joint.undo_turn(a, b) || far_off;
                a.orientation = a.orientation.normalised();
                b.orientation = b.orientation.normalised();
            }
            solve_points(tree, false);
        }
    }

    // False: rows that go in turn will do.
    bool undo_with_turns(const JointTree& tree) {
        int round = 0;
        for (; round < 3 && is_strained(tree, false); ++round) {
            solve_with_turns(tree, false);
        }
        if (round > 0) {
            for_each_body(tree, [](Body& body) { body.orientation = body.orientation.normalised(); });
            solve_points(tree, false);
        }
        return round > 0;
    }

    static constexpr Scalar far_turned = Scalar(1) / 458; // an eighth of a degree
    Settings settings_;
    Scalar rate_; // substeps a second
    FreeMotion<Scalar> motion_;
    ContactSearch<Scalar> search_;
    std::size_t body_count_;
    Scalar least_approach_;
    Scalar least_motion_;
    std::vector<Body> bodies_; // colliders behind them
    std::vector<std::size_t> figures_;
    std::vector<Joint> joints_;
    std::vector<JointTree> trees_;
    std::vector<Contact> contacts_;
    std::vector<Move> contact_moves_; // of a contact sweep, by body
};

} // namespace reference
