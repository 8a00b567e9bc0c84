// The trees of joints of the rigid reference solver: all points of a tree by one linear solve. Its matrix is
// dense, where the SDK eliminates it along the tree (sdk/src/rigid/articulation.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "reference/rigid_parts.h"
#include "reference/symmetric_system.h"

namespace reference {

// The joints of a figure, or of a part of it.
template <typename Scalar>
struct JointTree {
    std::vector<std::size_t> joints;
    bool held = false;              // by one that does not move
    bool springs = false;           // in the points of some
    bool closed = false;            // by joints that close loops: solved with them (rigid_closures.h)
    SymmetricSystem<Scalar> points; // at the predicted pose
};

template <typename Scalar>
class JointTrees {
public:
    using Vec = Vector3<Scalar>;
    using Body = MovingBody<Scalar>;
    using Joint = HeldJoint<Scalar>;
    using Move = BodyMove<Scalar>;
    using Tree = JointTree<Scalar>;

    explicit JointTrees(RigidParts<Scalar>& parts) : bodies_(parts.bodies), joints_(parts.joints) {}

    // Distances and what has soft turns are left out, and so are joints that close loops, the soft ones
    // rather than the rigid. One joint holds a tree at what does not move.
    void find() {
        std::vector<std::size_t> roots(bodies_.size());
        std::iota(roots.begin(), roots.end(), std::size_t{0});
        for (const bool soft : {false, true}) {
            for (Joint& joint : joints_) {
                if (joint.has_soft_points() == soft) {
                    choose(joint, roots);
                }
            }
        }
        choose_anchors(roots);
        for (std::size_t root = 0; root < bodies_.size(); ++root) {
            if (roots[root] != root) {
                continue;
            }
            Tree tree;
            tree.joints = joints_from(root);
            for (const std::size_t i : tree.joints) {
                tree.springs = tree.springs || joints_[i].has_soft_points();
                tree.held = tree.held || is_anchor(joints_[i]);
            }
            for (const std::size_t i : tree.joints) {
                joints_[i].in_held_tree = tree.held;
            }
            if (!tree.joints.empty()) {
                trees_.push_back(std::move(tree));
            }
        }
    }

    auto begin() const { return trees_.begin(); }
    auto end() const { return trees_.end(); }
    auto begin() { return trees_.begin(); }
    auto end() { return trees_.end(); }
    // Of a tree.
    bool holds(std::size_t body) const {
        return std::any_of(joints_.begin(), joints_.end(), [body](const Joint& joint) {
            return joint.in_tree && (joint.a == body || joint.b == body);
        });
    }

    // J·M⁻¹·Jᵀ of the joints' points, at the predicted pose.
    void factor_points() {
        for (Joint& joint : joints_) {
            joint.place_levers(bodies_[joint.a], bodies_[joint.b]);
        }
        for (Body& body : bodies_) {
            body.load = body.found_load = 0;
        }
        for (const Joint& joint : joints_) {
            if (!joint.in_tree) {
                continue;
            }
            joint.add_loads(bodies_[joint.a], bodies_[joint.b]);
        }
        for (Tree& tree : trees_) {
            for_each_body(tree, [](Body& body) { body.stiffen(); });
            factor(tree, true);
        }
    }

    // What is undone strains no spring: their points stay as far apart as they are.
    void hold_springs() {
        for (Tree& tree : trees_) {
            if (!tree.springs) {
                continue;
            }
            for (const std::size_t i : tree.joints) {
                Joint& joint = joints_[i];
                if (joint.has_soft_points()) {
                    joint.start = joint.offset(bodies_[joint.a], bodies_[joint.b]);
                }
            }
            factor(tree, false);
        }
    }

    // To where they were at the substep's start, or together.
    void solve_points(const Tree& tree, bool to_start) {
        clear_pushes(tree);
        for_each_body(tree, [](Body& body) { body.torque = body.carried_torque; });
        std::vector<Scalar> pushes;
        for (const std::size_t i : tree.joints) {
            const Joint& joint = joints_[i];
            const Vec error = error_of(joint, to_start) + point_motion(joint);
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
    void solve_points() {
        for (const Tree& tree : trees_) {
            if (!tree.closed) {
                solve_points(tree, true);
            }
        }
    }

    // Without giving speed: turns first, then the points. A limit that turns one bone back on its joint takes
    // the points along: some rounds bring both right.
    void undo_errors(const Tree& tree) {
        bool far_off = true;
        for (int round = 0; round < 6 && far_off; ++round) {
            far_off = undo_turns(tree);
            solve_points(tree, false);
        }
    }

    // True: a limit was far off.
    bool undo_turns(const Tree& tree) {
        bool far_off = false;
        for (const std::size_t i : tree.joints) {
            const Joint& joint = joints_[i];
            Body& a = bodies_[joint.a];
            Body& b = bodies_[joint.b];
            far_off = joint.undo_turn(a, b) || far_off;
            a.normalise();
            b.normalise();
        }
        return far_off;
    }

    // How far its points are to come together: in this substep, or at all.
    Vec error_of(const Joint& joint, bool in_substep) const {
        const Body& a = bodies_[joint.a];
        const Body& b = bodies_[joint.b];
        if (in_substep) {
            return joint.left_of_points(a, b);
        }
        return joint.has_soft_points() ? joint.offset(a, b) - joint.start : joint.offset(a, b);
    }

    // What trees have in common with those that are held.
    template <typename Use>
    void for_each_body(const Tree& tree, const Use& use) {
        for (const std::size_t i : tree.joints) {
            use(bodies_[joints_[i].a]);
            use(bodies_[joints_[i].b]);
        }
    }

    void clear_pushes(const Tree& tree) {
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

    void move_bodies(const Tree& tree) {
        for_each_body(tree, [](Body& body) {
            // Once each.
            Move{body.force * body.inverse_mass, body.world_inverse * body.torque}.apply_to(body);
            body.force = body.torque = {};
        });
    }

private:
    bool is_anchor(const Joint& joint) const { return bodies_[joint.a].moves != bodies_[joint.b].moves; }

    // Rather a rigid one.
    void choose_anchors(const std::vector<std::size_t>& roots) {
        std::vector<bool> anchored(bodies_.size());
        for (const bool soft : {false, true}) {
            for (Joint& joint : joints_) {
                const std::size_t root = roots[bodies_[joint.a].moves ? joint.a : joint.b];
                if (joint.has_soft_points() == soft && joint.may_be_in_tree() && is_anchor(joint) &&
                    !anchored[root]) {
                    joint.in_tree = anchored[root] = true;
                }
            }
        }
    }

    // Unless it closes a loop.
    void choose(Joint& joint, std::vector<std::size_t>& roots) const {
        const bool joins = bodies_[joint.a].moves && bodies_[joint.b].moves;
        joint.in_tree = joint.may_be_in_tree() && joins && roots[joint.a] != roots[joint.b];
        if (joint.in_tree) {
            const auto [root, other] = std::minmax(roots[joint.a], roots[joint.b]);
            std::replace(roots.begin(), roots.end(), std::size_t{other}, std::size_t{root});
        }
    }

    void factor(Tree& tree, bool springs_give) {
        const std::size_t size = 3 * tree.joints.size();
        std::vector<Scalar> matrix(size * size);
        for (std::size_t column = 0; column < size; ++column) {
            const Joint& joint = joints_[tree.joints[column / 3]];
            clear_pushes(tree);
            add_push(joint, along_axis(static_cast<int>(column % 3), Scalar(1)));
            for (std::size_t row = column; row < size; ++row) {
                const Vec motion = point_motion(joints_[tree.joints[row / 3]]);
                matrix[row * size + column] = component(motion, static_cast<int>(row % 3));
            }
            matrix[column * size + column] += springs_give ? joint.points_give() : Scalar(0);
        }
        tree.points.factor(size, std::move(matrix));
    }

    // From the root on: all those of a body before those of its children.
    std::vector<std::size_t> joints_from(std::size_t root) const {
        std::vector<std::size_t> found;
        std::vector<std::size_t> bodies{root};
        for (std::size_t next = 0; next < bodies.size(); ++next) {
            for (std::size_t i = 0; i < joints_.size(); ++i) {
                const Joint& joint = joints_[i];
                const bool holds = joint.in_tree && bodies_[bodies[next]].moves &&
                                   (joint.a == bodies[next] || joint.b == bodies[next]);
                if (holds && std::find(found.begin(), found.end(), i) == found.end()) {
                    found.push_back(i);
                    bodies.push_back(joint.a == bodies[next] ? joint.b : joint.a);
                }
            }
        }
        return found;
    }

    std::vector<Body>& bodies_;
    std::vector<Joint>& joints_;
    std::vector<Tree> trees_;
};

} // namespace reference
