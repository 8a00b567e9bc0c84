// Trees of joints that hang on what does not move, in the rigid reference solver: where one is strained its
// points are solved with what its joints do not let turn and with their limits (sdk/src/rigid/held_tree.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "reference/rigid_held.h"
#include "reference/rigid_joint_trees.h"

namespace reference {

template <typename Scalar>
class HeldTrees {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Tree = JointTree<Scalar>;

    HeldTrees(RigidParts<Scalar>& parts, JointTrees<Scalar>& points)
        : bodies_(parts.bodies), joints_(parts.joints), points_(points) {}

    // A joint of a figure that is held: something is turned by more than an eighth of a degree, in this
    // substep or at all. Of those that no held tree has only limits count.
    bool is_strained(const Joint& joint, bool in_substep) const {
        const Body& a = bodies_[joint.a];
        const Body& b = bodies_[joint.b];
        return (joint.in_held_tree ? joint.strain(a, b, in_substep) : joint.limits.exceeded(a, b)) >
               far_turned;
    }

    // Points and turns at once, in this substep or at all.
    void solve(const Tree& tree, bool in_substep) {
        if (in_substep) {
            stiffen_further(tree);
        }
        std::vector<HeldRow<Scalar>> rows;
        std::vector<Scalar> errors;
        for (const std::size_t i : tree.joints) {
            Joint& joint = joints_[i];
            const Vec error = points_.error_of(joint, in_substep);
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
        const std::vector<Scalar> pushes =
            solve_held(motions_of(tree, rows, points, in_substep), errors, points, rows);
        points_.clear_pushes(tree);
        for (std::size_t k = 0; k < tree.joints.size(); ++k) {
            Joint& joint = joints_[tree.joints[k]];
            const Vec push{pushes[3 * k], pushes[3 * k + 1], pushes[3 * k + 2]};
            points_.add_push(joint, push);
            joint.push = in_substep ? joint.push + push : joint.push;
        }
        for (std::size_t k = 0; k < rows.size(); ++k) {
            Joint& joint = joints_[rows[k].joint];
            add_torque(joint, rows[k].axis * pushes[points + k]);
            if (in_substep) {
                joint.keep_push(rows[k], pushes[points + k]);
            }
        }
        points_.move_bodies(tree);
    }

    // What is off at all, without giving speed. False: rows that go in turn will do.
    bool undo_errors(const Tree& tree) {
        int round = 0;
        for (; round < 3 && is_strained(tree); ++round) {
            solve(tree, false);
        }
        if (round > 0) {
            points_.for_each_body(tree, [](Body& body) { body.normalise(); });
            points_.solve_points(tree, false);
        }
        return round > 0;
    }

private:
    bool is_strained(const Tree& tree) const {
        return std::any_of(tree.joints.begin(), tree.joints.end(),
                           [this](std::size_t i) { return is_strained(joints_[i], false); });
    }

    void stiffen_further(const Tree& tree) {
        points_.for_each_body(tree, [](Body& body) { body.found_load = 0; });
        for (const std::size_t i : tree.joints) {
            Joint& joint = joints_[i];
            joint.raise_tension();
            joint.add_loads(bodies_[joint.a], bodies_[joint.b]);
        }
        points_.for_each_body(tree, [](Body& body) { body.stiffen(); });
    }

    // How all rows move by pushes in each of them; those of turns a millionth softer, and in a substep those
    // of soft points by what they give.
    std::vector<Scalar> motions_of(const Tree& tree, const std::vector<HeldRow<Scalar>>& rows,
                                   std::size_t points, bool in_substep) {
        const std::size_t size = points + rows.size();
        std::vector<Scalar> matrix(size * size);
        for (std::size_t column = 0; column < size; ++column) {
            points_.clear_pushes(tree);
            if (column < points) {
                points_.add_push(joints_[tree.joints[column / 3]],
                                 along_axis(static_cast<int>(column % 3), Scalar(1)));
            } else {
                add_torque(joints_[rows[column - points].joint], rows[column - points].axis);
            }
            for (std::size_t row = 0; row < size; ++row) {
                matrix[row * size + column] =
                    row < points ? component(points_.point_motion(joints_[tree.joints[row / 3]]),
                                             static_cast<int>(row % 3))
                                 : turn_motion(rows[row - points]);
            }
            if (column < points) {
                matrix[column * size + column] +=
                    in_substep ? joints_[tree.joints[column / 3]].points_give() : Scalar(0);
            } else {
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

    static constexpr Scalar far_turned = Scalar(1) / 458;

    std::vector<Body>& bodies_;
    std::vector<Joint>& joints_;
    JointTrees<Scalar>& points_;
};

} // namespace reference
