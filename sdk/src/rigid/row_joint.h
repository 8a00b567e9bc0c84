// A joint of a tree with a row for each direction that its points hold, and for what must not turn: what the
// solves of held trees (rigid/held_tree.h), and of what closes loops (rigid/closure_tree.h), have in common.
#pragma once

#include <algorithm>

#include "rigid/row_system.h"

namespace lks {

inline constexpr int point_rows = 3;

template <typename Rows>
struct RowJoint {
    // What pushes do to the parent: C, row by row; behind factor_rows() L⁻¹·C.
    fixed::Vec3 column_shift[most_rows];
    fixed::Vec3 column_turn[most_rows];
    RowSystem<Rows> system;       // L·D·Lᵀ
    std::int64_t push[most_rows]; // on the child, World, in the tree's unit; of fold_rows() Lᵀ times that
};

// What a push does: a force, and a torque.
struct Wrench {
    fixed::Vec3 force;
    fixed::Vec3 torque;
};

template <typename Rows>
class RowAlgebra {
public:
    using Vec3 = fixed::Vec3;
    static constexpr std::int64_t one = std::int64_t{1} << Rows::fraction_bits;

    static std::int64_t dot(const Vec3& a, const Vec3& b) {
        fixed::ProductSum sum;
        add(a, b, sum);
        return sum.shifted(Rows::fraction_bits);
    }
    static Vec3 multiply(std::int64_t a, const Vec3& v) {
        return {Rows::multiply(a, v.x), Rows::multiply(a, v.y), Rows::multiply(a, v.z)};
    }

    // Of unit pushes along the axes at a lever (rigid/articulation_algebra.h).
    static void find_point_wrenches(const Vec3& lever, Wrench (&wrenches)[most_rows]) {
        constexpr std::int64_t up = std::int64_t{1}
                                    << (Rows::fraction_bits - tree_detail::tree_fraction_bits);
        const Vec3 arm{lever.x * up, lever.y * up, lever.z * up};
        wrenches[0] = {{one, 0, 0}, {0, arm.z, -arm.y}};
        wrenches[1] = {{0, one, 0}, {-arm.z, 0, arm.x}};
        wrenches[2] = {{0, 0, one}, {arm.y, -arm.x, 0}};
    }

    static void respond(const ArticulatedInverse& w, const Wrench& push, Vec3& shift, Vec3& turn) {
        const std::int64_t(&s)[6] = w.shift;
        const std::int64_t(&t)[6] = w.turn;
        const std::int64_t(&m)[9] = w.mixed;
        const auto row = [&push](const Vec3& by_force, const Vec3& by_torque) {
            return along(push, by_force, by_torque);
        };
        shift = {row({s[0], s[1], s[2]}, {m[0], m[1], m[2]}), row({s[1], s[3], s[4]}, {m[3], m[4], m[5]}),
                 row({s[2], s[4], s[5]}, {m[6], m[7], m[8]})};
        turn = {row({m[0], m[3], m[6]}, {t[0], t[1], t[2]}), row({m[1], m[4], m[7]}, {t[1], t[3], t[4]}),
                row({m[2], m[5], m[8]}, {t[2], t[4], t[5]})};
    }
    static std::int64_t along(const Wrench& push, const Vec3& shift, const Vec3& turn) {
        fixed::ProductSum sum;
        add(push.force, shift, sum);
        add(push.torque, turn, sum);
        return sum.shifted(Rows::fraction_bits);
    }

    // W −= (a a^T) / pivot for the column a of L⁻¹Uᵀ.
    static void take_out(ArticulatedInverse& w, const Vec3& shift, const Vec3& turn,
                         const typename Rows::Pivot& pivot) {
        using tree_detail::minus;
        const std::int64_t a[6] = {shift.x, shift.y, shift.z, turn.x, turn.y, turn.z};
        std::int64_t divided[6];
        for (int i = 0; i < 6; ++i) {
            divided[i] = Rows::divide(a[i], pivot);
        }
        int entry = 0;
        for (int i = 0; i < 3; ++i) {
            for (int j = i; j < 3; ++j) {
                w.shift[entry] = minus(w.shift[entry], Rows::multiply(divided[i], a[j]));
                w.turn[entry] = minus(w.turn[entry], Rows::multiply(divided[3 + i], a[3 + j]));
                ++entry;
            }
            for (int j = 0; j < 3; ++j) {
                w.mixed[3 * i + j] = minus(w.mixed[3 * i + j], Rows::multiply(divided[i], a[3 + j]));
            }
        }
    }

    // Adds how rows move by pushes in each of them; leaves the columns of the body that comes last.
    static void add_motions(const ArticulatedInverse& inverse, const Wrench (&wrenches)[most_rows],
                            RowJoint<Rows>& joint, std::int64_t (&d)[most_rows][most_rows]) {
        for (int j = 0; j < joint.system.count; ++j) {
            respond(inverse, wrenches[j], joint.column_shift[j], joint.column_turn[j]);
            for (int i = j; i < joint.system.count; ++i) {
                d[i][j] = tree_detail::plus(d[i][j],
                                            along(wrenches[i], joint.column_shift[j], joint.column_turn[j]));
            }
        }
    }

    static void factor_rows(const std::int64_t (&d)[most_rows][most_rows], RowJoint<Rows>& joint) {
        factor(d, joint.system);
        for (int i = 0; i < joint.system.count; ++i) {
            for (int k = 0; k < i; ++k) {
                const std::int64_t l = joint.system.lower[i][k];
                joint.column_shift[i] = joint.column_shift[i] - multiply(l, joint.column_shift[k]);
                joint.column_turn[i] = joint.column_turn[i] - multiply(l, joint.column_turn[k]);
            }
        }
    }

    static void fold_in(ArticulatedInverse& inverse, const RowJoint<Rows>& joint) {
        for (int i = 0; i < joint.system.count; ++i) {
            take_out(inverse, joint.column_shift[i], joint.column_turn[i], joint.system.pivots[i]);
        }
    }

    // With what is left of its rows: its push if nothing pushed the parent, which that moves.
    static void fold_rows(std::int64_t (&left)[most_rows], std::int64_t most, RowJoint<Rows>& joint,
                          ArticulatedBody& parent) {
        solve_lower(joint.system, left);
        for (int row = 0; row < joint.system.count; ++row) {
            const std::int64_t push = Rows::divide(left[row], joint.system.pivots[row]);
            joint.push[row] = std::clamp(tree_detail::minus(0, push), -most, most);
            parent.shift = parent.shift - multiply(joint.push[row], joint.column_shift[row]);
            parent.turn = parent.turn - multiply(joint.push[row], joint.column_turn[row]);
        }
    }

    // With what the joints towards the root push the parent.
    static void push_more(std::int64_t most, RowJoint<Rows>& joint, const ArticulatedBody& parent) {
        using tree_detail::plus;
        for (int row = 0; row < joint.system.count; ++row) {
            const std::int64_t more =
                along({joint.column_shift[row], joint.column_turn[row]}, parent.force, parent.torque);
            joint.push[row] = plus(joint.push[row], Rows::divide(more, joint.system.pivots[row]));
        }
        solve_upper(joint.system, joint.push);
        for (int row = 0; row < joint.system.count; ++row) {
            joint.push[row] = std::clamp(joint.push[row], -most, most);
        }
    }

private:
    static void add(const Vec3& a, const Vec3& b, fixed::ProductSum& sum) {
        sum.add(a.x, b.x);
        sum.add(a.y, b.y);
        sum.add(a.z, b.z);
    }
};

} // namespace lks
