#include "rigid/closure_matrix.h"

#include <algorithm>
#include <bit>

namespace lks {

using namespace tree_detail;
using fixed::Vec3;

namespace {

using Algebra = RowAlgebra<FineRows>;

// What a push in a row does: to a body that it acts on, or, once joints are folded, to one nearer to the
// root.
struct Follower {
    std::uint32_t row;
    std::uint32_t body; // or none: it has met its row's other side
    Wrench push;
    Vec3 shift;
    Vec3 turn;
};
constexpr std::uint32_t no_follower_body = UINT32_MAX;

// Of a row: its column of B at a joint, and of D⁻¹ B.
struct Reduced {
    std::uint32_t row;
    std::int64_t rows[most_rows];
    std::int64_t divided[most_rows];
};

class TreeMatrix : public ArticulationWalk {
public:
    TreeMatrix(RigidScene& scene, const ArticulatedTree& tree, std::int64_t* matrix)
        : ArticulationWalk(scene, tree), matrix_(matrix) {
        // Half of the share's exponent to either side, so that both stay about one.
        const auto share = static_cast<std::uint64_t>(std::max<std::int64_t>(tree.figure_share, 1));
        half_exponent_ = (std::countl_zero(share) - (63 - tree_fraction_bits)) / 2;
        share_ = tree.figure_share * (std::int64_t{1} << (2 * half_exponent_));
    }

    // A side of a row, with its unit push; rows come in their order.
    void add(const ClosureSide& side, const ClosureRow& row, std::uint32_t number, const Wrench& unit) {
        const Wrench push = push_times(unit, scaled_by(world_one, row.scale - half_exponent_));
        const OwnMotion own = ClosureTree(scene_, range_).own_motion(side.body, push);
        followers_[count_++] = {number, side.body, push, own.shift, own.turn};
    }

    void find() {
        add_own();
        for_each_joint_back([this](const ArticulatedJoint& part, const Joint&) {
            const auto number = static_cast<std::size_t>(&part - scene_.tree_joints.begin());
            fold(part, scene_.closure_tree_joints[number]);
        });
    }

private:
    // C M⁻¹ Cᵀ
    void add_own() {
        for (std::uint32_t i = 0; i < count_; ++i) {
            for (std::uint32_t j = 0; j < count_; ++j) {
                const Follower& a = followers_[i];
                const Follower& b = followers_[j];
                if (a.body == b.body && a.row >= b.row) {
                    add(a.row, b.row, Algebra::along(a.push, b.shift, b.turn));
                }
            }
        }
    }
    void add(std::uint32_t row, std::uint32_t column, std::int64_t value) {
        std::int64_t& entry = matrix_[entry_of(row, column)];
        entry = plus(entry, multiply_32(share_, value));
    }

    void fold(const ArticulatedJoint& part, const ClosureTreeJoint& joint) {
        const std::uint32_t found = reduce(part, joint);
        if (found == 0) {
            return;
        }
        for (std::uint32_t i = 0; i < found; ++i) {
            for (std::uint32_t j = 0; j <= i; ++j) {
                fixed::ProductSum sum;
                for (int k = 0; k < joint.system.count; ++k) {
                    sum.add(reduced_[i].rows[k], reduced_[j].divided[k]);
                }
                add(reduced_[i].row, reduced_[j].row, minus(0, sum.shifted(fine_fraction_bits)));
            }
        }
        if (&part != &scene_.tree_joints[range_.first_joint]) {
            hand_on(part, joint);
        }
    }

    static bool is_at_child(const ArticulatedJoint& part, const Follower& follower) {
        return part.child_moves && follower.body == part.child;
    }
    static bool is_at(const ArticulatedJoint& part, const Follower& follower) {
        return follower.body == part.parent || is_at_child(part, follower);
    }

    // Of all rows whose pushes have come to it; how many.
    std::uint32_t reduce(const ArticulatedJoint& part, const ClosureTreeJoint& joint) {
        std::uint32_t found = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Follower& follower = followers_[i];
            if (!is_at(part, follower)) {
                continue;
            }
            if (found == 0 || reduced_[found - 1].row != follower.row) {
                reduced_[found++] = {follower.row, {}, {}};
            }
            if (is_at_child(part, follower)) {
                add_motion(joint, joint.child_lever, joint.child_axes, follower.shift, follower.turn,
                           reduced_[found - 1]);
            } else {
                add_motion(joint, joint.parent_lever, joint.parent_axes, -follower.shift, -follower.turn,
                           reduced_[found - 1]);
            }
        }
        for (std::uint32_t i = 0; i < found; ++i) {
            Reduced& reduced = reduced_[i];
            solve_lower(joint.system, reduced.rows);
            for (int k = 0; k < joint.system.count; ++k) {
                reduced.divided[k] = divide(reduced.rows[k], joint.system.pivots[k]);
            }
        }
        return found;
    }

    static void add_motion(const ClosureTreeJoint& joint, const Vec3& lever,
                           const Vec3 (&axes)[most_held_rows], const Vec3& shift, const Vec3& turn,
                           Reduced& reduced) {
        const Vec3 point = shift + cross_32(turn, lever);
        const std::int64_t more[point_rows] = {point.x, point.y, point.z};
        for (int k = 0; k < point_rows; ++k) {
            reduced.rows[k] = plus(reduced.rows[k], more[k]);
        }
        for (std::uint32_t k = 0; k < joint.turn_count; ++k) {
            reduced.rows[point_rows + k] = plus(reduced.rows[point_rows + k], Algebra::dot(axes[k], turn));
        }
    }

    // To the parent, with what the joint makes of it.
    void hand_on(const ArticulatedJoint& part, const ClosureTreeJoint& joint) {
        std::uint32_t found = 0;
        Follower* last = nullptr;
        for (std::uint32_t i = 0; i < count_; ++i) {
            Follower& follower = followers_[i];
            if (!is_at(part, follower)) {
                continue;
            }
            if (is_at_child(part, follower)) {
                follower.shift = follower.turn = {0, 0, 0};
                follower.body = part.parent;
            }
            if (last != nullptr && last->row == follower.row) {
                last->shift = last->shift + follower.shift;
                last->turn = last->turn + follower.turn;
                follower.body = no_follower_body;
                continue;
            }
            last = &follower;
            const Reduced& reduced = reduced_[found++];
            for (int k = 0; k < joint.system.count; ++k) {
                follower.shift =
                    follower.shift + Algebra::multiply(reduced.divided[k], joint.column_shift[k]);
                follower.turn = follower.turn + Algebra::multiply(reduced.divided[k], joint.column_turn[k]);
            }
        }
    }

    std::int64_t* matrix_;
    int half_exponent_;
    std::int64_t share_; // the tree's unit in the figure's, times 4^half_exponent_
    std::uint32_t count_ = 0;
    Follower followers_[2 * most_closure_rows];
    Reduced reduced_[most_closure_rows];
};

} // namespace

void find_closure_matrix(RigidScene& scene, const FigureRange& figure, ClosureRows& rows,
                         std::int64_t* matrix) {
    std::fill_n(matrix, entry_of(rows.count(), 0), 0);
    for_each_part(scene, figure, Part::tree, [&](std::uint32_t index) {
        if (!scene.trees[index].has_closures()) {
            return;
        }
        TreeMatrix tree(scene, scene.trees[index], matrix);
        rows.for_each_row([&](const Closure& closure, const ClosureRow& row, std::uint32_t number) {
            ClosureRows::for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
                if (side.tree == index) {
                    tree.add(side, row, number, ClosureRows::push_of(row, is_a));
                }
            });
        });
        tree.find();
    });
}

} // namespace lks
