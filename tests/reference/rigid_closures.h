// What closes loops in the rigid reference solver, solved with the trees of its figure
// (sdk/src/rigid/closures.h): the trees' points and what their joints don't let turn are one dense system, of
// which the rows of what closes loops, of attachments to what does not move, and of limits, make a smaller
// one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "reference/rigid_held.h"
#include "reference/rigid_joint_trees.h"

namespace reference {

template <typename Scalar>
class JointClosures {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Tree = JointTree<Scalar>;

    JointClosures(RigidParts<Scalar>& parts, JointTrees<Scalar>& trees)
        : parts_(parts), bodies_(parts.bodies), joints_(parts.joints), trees_(trees) {}

    // Of figures with up to 48 such rows; the others' are swept. Marks the trees.
    void find() {
        std::vector<bool> has_points(bodies_.size());
        for (const Joint& joint : joints_) {
            if (!joint.is_distance()) {
                has_points[joint.a] = has_points[joint.b] = true;
            }
        }
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const auto may_hold = [&](std::size_t body) {
                return !bodies_[body].moves || trees_.holds(body) ||
                       (!has_points[body] && !bodies_[body].pinned);
            };
            const Joint& joint = joints_[i];
            if (!joint.in_tree && joint.has_rigid_turns() && may_hold(joint.a) && may_hold(joint.b)) {
                figure_at(parts_.figure_of(joint)).closing.push_back(i);
            }
        }
        for (std::size_t i = 0; i < parts_.attachments.size(); ++i) {
            const HeldParticle<Scalar>& held = parts_.attachments[i];
            if (held.is_of_pinned(parts_.objects) && bodies_[held.other()].moves &&
                trees_.holds(held.other())) {
                figure_at(parts_.figures[held.other()]).pins.push_back(i);
            }
        }
        const auto is_full = [this](const Figure& figure) {
            std::size_t rows = 3 * figure.pins.size();
            for (const std::size_t i : figure.closing) {
                rows += joints_[i].closing_rows();
            }
            return rows > 48;
        };
        figures_.erase(std::remove_if(figures_.begin(), figures_.end(), is_full), figures_.end());
        for (Figure& figure : figures_) {
            for (const std::size_t i : figure.closing) {
                joints_[i].in_tree = joints_[i].closes = joints_[i].turns_in_tree = true;
                add_bodies(figure, joints_[i]);
            }
            for (const std::size_t i : figure.pins) {
                parts_.attachments[i].holds_in_tree = true;
                add_body(figure, parts_.attachments[i].other());
            }
            for (Tree& tree : trees_) {
                add_tree(figure, tree);
            }
        }
    }

    // At the predicted pose.
    void factor() {
        for (Figure& figure : figures_) {
            for (const std::size_t i : figure.closing) {
                joints_[i].place_levers(bodies_[joints_[i].a], bodies_[joints_[i].b]);
            }
            for (const std::size_t i : figure.pins) {
                parts_.attachments[i].place_lever(bodies_);
            }
            factor(figure, true);
        }
    }

    // take(figure)
    template <typename Take>
    void solve(const Take& take) {
        for (Figure& figure : figures_) {
            if (take(figure.name)) {
                solve(figure, true);
            }
        }
    }

    // Without giving speed.
    void undo_errors() {
        for (Figure& figure : figures_) {
            for (const std::size_t i : figure.closing) {
                Joint& joint = joints_[i];
                if (joint.has_soft_points()) {
                    joint.hold_spring(bodies_[joint.a], bodies_[joint.b]);
                }
            }
            if (figure.springs) {
                factor(figure, false);
            }
            for (int round = 0; round < 3; ++round) {
                solve(figure, false);
            }
        }
    }

private:
    enum class Kind { distance, point, pin, turn, limit };

    // b's point against a's along the axis, or b about it against a; of an attachment its body's.
    struct Row {
        std::size_t joint; // or attachment
        Kind kind;
        Vec axis;
        Scalar* kept = nullptr; // of limits: which
        Scalar sign = 1;
        Scalar give = 0; // what its bodies by themselves give way by
    };
    struct Figure {
        std::size_t name;
        std::vector<std::size_t> closing;
        std::vector<std::size_t> pins; // attachments
        std::vector<std::size_t> bodies;
        std::vector<std::size_t> joints; // of its trees
        bool springs = false;            // of its trees
        std::vector<Row> tree_rows;
        SymmetricSystem<Scalar> tree;
        std::vector<Row> rows;
        std::vector<Scalar> matrix; // without what rows are softened by, or springs give
    };

    static constexpr Scalar near_limit = Scalar(0x1p-5);
    static constexpr Scalar most_undone = Scalar(0.0625);

    Figure& figure_at(std::size_t name) {
        for (Figure& figure : figures_) {
            if (figure.name == name) {
                return figure;
            }
        }
        figures_.push_back({name, {}, {}, {}, {}, false, {}, {}, {}, {}});
        return figures_.back();
    }
    void add_bodies(Figure& figure, const Joint& joint) {
        add_body(figure, joint.a);
        add_body(figure, joint.b);
    }
    void add_body(Figure& figure, std::size_t body) {
        if (std::find(figure.bodies.begin(), figure.bodies.end(), body) == figure.bodies.end()) {
            figure.bodies.push_back(body);
        }
    }
    // Where one of its bodies is the figure's.
    void add_tree(Figure& figure, Tree& tree) {
        const auto is_part = [&](std::size_t i) { return parts_.figure_of(joints_[i]) == figure.name; };
        const auto closes = [&](std::size_t i) {
            return std::any_of(figure.closing.begin(), figure.closing.end(), [&](std::size_t c) {
                const Joint& closing = joints_[c];
                const auto is_of = [&](std::size_t body) {
                    return bodies_[body].moves && (body == closing.a || body == closing.b);
                };
                return is_of(joints_[i].a) || is_of(joints_[i].b);
            });
        };
        const auto is_pinned = [&](std::size_t i) {
            return std::any_of(figure.pins.begin(), figure.pins.end(), [&](std::size_t p) {
                const std::size_t body = parts_.attachments[p].other();
                return body == joints_[i].a || body == joints_[i].b;
            });
        };
        if (!is_part(tree.joints.front()) ||
            !std::any_of(tree.joints.begin(), tree.joints.end(),
                         [&](std::size_t i) { return closes(i) || is_pinned(i); })) {
            return;
        }
        tree.closed = true;
        figure.springs = figure.springs || tree.springs;
        for (const std::size_t i : tree.joints) {
            joints_[i].turns_in_tree = true;
            figure.joints.push_back(i);
            add_bodies(figure, joints_[i]);
        }
    }

    void clear(const Figure& figure) {
        for (const std::size_t i : figure.bodies) {
            bodies_[i].force = bodies_[i].torque = {};
        }
    }
    void push(const Row& row, const Vec& axis, Scalar size) {
        if (row.kind == Kind::pin) {
            const HeldParticle<Scalar>& held = parts_.attachments[row.joint];
            Body& body = bodies_[held.other()];
            body.force = body.force + axis * size;
            body.torque = body.torque + cross(held.lever(), axis * size);
            return;
        }
        Joint& joint = joints_[row.joint];
        if (row.kind == Kind::point || row.kind == Kind::distance) {
            trees_.add_push(joint, axis * size);
        } else {
            bodies_[joint.a].torque = bodies_[joint.a].torque - axis * size;
            bodies_[joint.b].torque = bodies_[joint.b].torque + axis * size;
        }
    }
    Scalar motion(const Row& row) const {
        if (row.kind == Kind::pin) {
            const HeldParticle<Scalar>& held = parts_.attachments[row.joint];
            const Body& body = bodies_[held.other()];
            return row.axis.dot(body.force * body.inverse_mass +
                                cross(body.world_inverse * body.torque, held.lever()));
        }
        const Joint& joint = joints_[row.joint];
        const Body& a = bodies_[joint.a];
        const Body& b = bodies_[joint.b];
        return row.axis.dot(row.kind == Kind::point || row.kind == Kind::distance
                                ? trees_.point_motion(joint)
                                : b.world_inverse * b.torque - a.world_inverse * a.torque);
    }

    // What the joints of the trees push beside what already pushes.
    std::vector<Scalar> push_trees(const Figure& figure, std::vector<Scalar> left) {
        for (std::size_t k = 0; k < left.size(); ++k) {
            left[k] = -left[k] - motion(figure.tree_rows[k]);
        }
        figure.tree.solve(left);
        for (std::size_t k = 0; k < left.size(); ++k) {
            push(figure.tree_rows[k], figure.tree_rows[k].axis, left[k]);
        }
        return left;
    }
    void keep_trees(const Figure& figure, const std::vector<Scalar>& pushes) {
        for (std::size_t k = 0; k < pushes.size(); ++k) {
            keep(figure.tree_rows[k], pushes[k]);
        }
    }
    void keep(const Row& row, Scalar more) {
        if (row.kind == Kind::pin) {
            parts_.attachments[row.joint].add_push(row.axis * more);
            return;
        }
        Joint& joint = joints_[row.joint];
        if (row.kind == Kind::point) {
            joint.push = joint.push + row.axis * more;
        } else {
            joint.keep_push({row.axis, 0, 0, nullptr, 1}, more);
        }
    }
    void move(const Figure& figure) {
        for (const std::size_t i : figure.bodies) {
            Body& body = bodies_[i];
            BodyMove<Scalar>{body.force * body.inverse_mass, body.world_inverse * body.torque}.apply_to(body);
            body.force = body.torque = {};
        }
    }

    std::vector<HeldRow<Scalar>> rows_of(std::size_t i, bool in_substep) {
        Joint& joint = joints_[i];
        std::vector<HeldRow<Scalar>> rows;
        joint.add_rows(bodies_[joint.a], bodies_[joint.b], in_substep, rows);
        return rows;
    }
    void add_points_and_turns(std::size_t i, std::vector<Row>& rows) {
        for (int axis = 0; axis < 3; ++axis) {
            rows.push_back({i, Kind::point, along_axis(axis, Scalar(1))});
        }
        for (const HeldRow<Scalar>& held : rows_of(i, true)) {
            if (!held.is_limit()) {
                rows.push_back({i, Kind::turn, held.axis});
            }
        }
    }

    void factor(Figure& figure, bool in_substep) {
        factor_trees(figure, in_substep);
        find_rows(figure, in_substep);
        const std::size_t size = figure.rows.size();
        figure.matrix.assign(size * size, 0);
        for (std::size_t column = 0; column < size; ++column) {
            Row& row = figure.rows[column];
            clear(figure);
            push(row, row.axis, 1);
            row.give = motion(row);
            push_trees(figure, std::vector<Scalar>(figure.tree_rows.size()));
            for (std::size_t i = 0; i < size; ++i) {
                figure.matrix[i * size + column] = motion(figure.rows[i]);
            }
        }
        clear(figure);
    }
    void factor_trees(Figure& figure, bool in_substep) {
        figure.tree_rows.clear();
        for (const std::size_t i : figure.joints) {
            add_points_and_turns(i, figure.tree_rows);
        }
        const std::size_t size = figure.tree_rows.size();
        std::vector<Scalar> matrix(size * size);
        for (std::size_t column = 0; column < size; ++column) {
            const Row& row = figure.tree_rows[column];
            clear(figure);
            push(row, row.axis, 1);
            for (std::size_t i = 0; i < size; ++i) {
                matrix[i * size + column] = motion(figure.tree_rows[i]);
            }
            const Joint& joint = joints_[row.joint];
            if (row.kind == Kind::turn) {
                matrix[column * size + column] += motion(row) * Scalar(0x1p-20);
            } else {
                matrix[column * size + column] += in_substep ? joint.points_give() : Scalar(0);
            }
        }
        figure.tree.factor(size, std::move(matrix));
    }
    // Of limits those that are near, or push.
    void find_rows(Figure& figure, bool in_substep) {
        figure.rows.clear();
        for (const std::size_t i : figure.closing) {
            Joint& joint = joints_[i];
            if (joint.is_distance()) {
                const auto left = distance_of(joint, in_substep);
                figure.rows.push_back({i, Kind::distance, left.way * Scalar(left.side < 0 ? -1 : 1)});
            } else {
                add_points_and_turns(i, figure.rows);
            }
            add_limits(i, in_substep, figure.rows);
        }
        for (const std::size_t i : figure.pins) {
            for (int axis = 0; axis < 3; ++axis) {
                figure.rows.push_back({i, Kind::pin, along_axis(axis, Scalar(1))});
            }
        }
        for (const std::size_t i : figure.joints) {
            add_limits(i, in_substep, figure.rows);
        }
    }
    void add_limits(std::size_t i, bool in_substep, std::vector<Row>& rows) {
        const std::vector<HeldRow<Scalar>> held = rows_of(i, in_substep);
        joints_[i].limits_in_tree = std::any_of(held.begin(), held.end(), [](const HeldRow<Scalar>& row) {
            return row.is_limit() && (row.error < near_limit || row.push > 0);
        });
        for (const HeldRow<Scalar>& row : held) {
            if (joints_[i].limits_in_tree && row.is_limit()) {
                rows.push_back({i, Kind::limit, row.axis, row.kept, row.sign});
            }
        }
    }
    typename JointDistance<Scalar>::Left distance_of(const Joint& joint, bool in_substep) const {
        auto left = joint.left_of_distance(bodies_[joint.a], bodies_[joint.b], in_substep);
        left.left = in_substep ? left.left : std::clamp(left.left, -most_undone, most_undone);
        return left;
    }

    void solve(Figure& figure, bool in_substep) {
        solve_trees(figure, in_substep);
        std::vector<HeldRow<Scalar>> rows;
        if (!measure(figure, in_substep, rows)) {
            factor(figure, in_substep);
            measure(figure, in_substep, rows);
        }
        std::vector<Scalar> errors;
        for (const HeldRow<Scalar>& row : rows) {
            errors.push_back(row.error);
        }
        std::vector<Scalar> pushes, tree_pushes;
        std::vector<Scalar> matrix = figure.matrix;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Row& row = figure.rows[i];
            if (in_substep && (row.kind == Kind::point || row.kind == Kind::distance)) {
                matrix[i * rows.size() + i] += joints_[row.joint].points_give();
            } else if (in_substep && row.kind == Kind::pin) {
                matrix[i * rows.size() + i] += parts_.attachments[row.joint].give();
            }
        }
        Scalar give = Scalar(0x1p-8);
        for (int round = 0; round < 3; ++round, give *= 8) {
            std::vector<Scalar> softness;
            for (const Row& row : figure.rows) {
                softness.push_back(row.give * give);
            }
            pushes = solve_held(matrix, errors, 0, rows, softness);
            tree_pushes = push_all(figure, rows, pushes);
            if (!bends_too_far(figure, rows, pushes)) {
                break;
            }
        }
        for (int i = 0; i < 8 && bends_too_far(figure, rows, pushes); ++i) {
            for (Scalar& push : pushes) {
                push /= 2;
            }
            tree_pushes = push_all(figure, rows, pushes);
        }
        move(figure);
        if (!in_substep) {
            return;
        }
        keep_trees(figure, tree_pushes);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Row& row = figure.rows[i];
            if (row.kind == Kind::distance) {
                joints_[row.joint].push = rows[i].axis * (rows[i].push + pushes[i]);
            } else if (row.kind == Kind::limit) {
                joints_[row.joint].keep_push(rows[i], pushes[i]);
            } else {
                keep(row, pushes[i]);
            }
        }
    }
    // What its trees push by that.
    std::vector<Scalar> push_all(Figure& figure, const std::vector<HeldRow<Scalar>>& rows,
                                 const std::vector<Scalar>& pushes) {
        clear(figure);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            push(figure.rows[i], rows[i].axis, pushes[i]);
        }
        return push_trees(figure, std::vector<Scalar>(figure.tree_rows.size()));
    }
    void solve_trees(Figure& figure, bool in_substep) {
        clear(figure);
        for (const std::size_t i : figure.bodies) {
            bodies_[i].torque = bodies_[i].carried_torque;
            bodies_[i].carried_torque = {};
        }
        std::vector<Scalar> left;
        for (const Row& row : figure.tree_rows) {
            const Joint& joint = joints_[row.joint];
            left.push_back(row.axis.dot(row.kind == Kind::point ? trees_.error_of(joint, in_substep)
                                                                : turned(row.joint, in_substep)));
        }
        const std::vector<Scalar> pushes = push_trees(figure, std::move(left));
        move(figure);
        if (in_substep) {
            keep_trees(figure, pushes);
        }
    }
    Vec turned(std::size_t i, bool in_substep) {
        Vec sum;
        for (const HeldRow<Scalar>& row : rows_of(i, in_substep)) {
            sum = row.is_limit() ? sum : sum + row.axis * row.error;
        }
        return sum;
    }

    // What each row is to bring to zero; those that push one way only are turned so that they push above
    // zero. False: an axis has turned too far.
    bool measure(const Figure& figure, bool in_substep, std::vector<HeldRow<Scalar>>& rows) {
        bool near = true;
        rows.clear();
        for (const Row& row : figure.rows) {
            HeldRow<Scalar> held{row.axis, 0, 0, nullptr, 1, row.joint};
            if (row.kind == Kind::pin) {
                const Vec left =
                    parts_.attachments[row.joint].left_in_tree(parts_.objects, bodies_, in_substep);
                held.error = row.axis.dot(within_most(left, in_substep));
            } else if (row.kind == Kind::distance) {
                const auto left = distance_of(joints_[row.joint], in_substep);
                const Scalar sign = left.side < 0 ? Scalar(-1) : Scalar(1);
                held.axis = left.way * sign;
                held.error = left.left * sign;
                held.push = left.pushed * sign;
                held.kept = left.side == 0 ? nullptr : &one_way_;
                near = near && held.axis.dot(row.axis) >= Scalar(1 - 0x1p-5);
            } else if (row.kind == Kind::limit) {
                near = measure_limit(row, in_substep, held) && near;
            } else if (row.kind == Kind::turn) {
                held.error = row.axis.dot(turned(row.joint, in_substep));
            } else {
                const Vec apart = trees_.error_of(joints_[row.joint], in_substep);
                held.error = row.axis.dot(within_most(apart, in_substep));
            }
            rows.push_back(held);
        }
        return near;
    }
    static Vec within_most(const Vec& apart, bool in_substep) {
        const auto within = [](Scalar c) { return std::clamp(c, -most_undone, most_undone); };
        return in_substep ? apart : Vec{within(apart.x), within(apart.y), within(apart.z)};
    }
    bool measure_limit(const Row& row, bool in_substep, HeldRow<Scalar>& held) {
        for (const HeldRow<Scalar>& found : rows_of(row.joint, in_substep)) {
            if (found.kept == row.kept && found.sign == row.sign) {
                held = found;
                held.joint = row.joint;
                const bool near = found.axis.dot(row.axis) >= Scalar(1 - 0x1p-5);
                held.axis = row.axis;
                return near;
            }
        }
        held.error = 1; // none
        held.kept = row.kept;
        held.sign = row.sign;
        return false;
    }

    // Its bodies, so far that what turns aside from the first order is several times what was to be moved.
    bool bends_too_far(const Figure& figure, const std::vector<HeldRow<Scalar>>& rows,
                       const std::vector<Scalar>& pushes) const {
        Scalar bent = 0;
        for (const std::size_t i : figure.bodies) {
            const Body& body = bodies_[i];
            const Vec turn = body.world_inverse * body.torque;
            const Scalar sum = std::abs(turn.x) + std::abs(turn.y) + std::abs(turn.z);
            bent = std::max(bent, body.moves ? sum * sum / 2 * body.reach() : Scalar(0));
        }
        Scalar most = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const bool pushes_on = !rows[i].is_limit() || rows[i].push + pushes[i] > 0;
            const Scalar moved = pushes_on ? rows[i].error : figure.matrix[i * rows.size() + i] * pushes[i];
            most = std::max(most, std::abs(moved) * length_of(figure.rows[i]));
        }
        return bent > 8 * most;
    }
    // What a radian counts as.
    Scalar length_of(const Row& row) const {
        if (row.kind == Kind::pin) {
            return 1;
        }
        const Body& a = bodies_[joints_[row.joint].a];
        const Body& b = bodies_[joints_[row.joint].b];
        return row.kind == Kind::point || row.kind == Kind::distance ? Scalar(1)
               : !a.moves                                            ? b.reach()
               : !b.moves                                            ? a.reach()
                                                                     : std::min(a.reach(), b.reach());
    }

    RigidParts<Scalar>& parts_;
    std::vector<Body>& bodies_;
    std::vector<Joint>& joints_;
    JointTrees<Scalar>& trees_;
    std::vector<Figure> figures_;
    Scalar one_way_ = 0; // marks distances that push one way only
};

} // namespace reference
