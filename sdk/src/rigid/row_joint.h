// A joint of a tree with a row for each direction that its points hold, and for what must not turn: what the
// solves of held trees (rigid/held_tree.h), and of what closes loops (rigid/closure_tree.h), have in common.
#pragma once

#include <algorithm>

#include "rigid/row_system.h"

namespace lks {

inline constexpr int point_rows = 3;

template <typename Rows>
struct RowJoint {
    // What a push does to the parent, row by row.
    fixed::Vec3 column_shift[most_rows];
    fixed::Vec3 column_turn[most_rows];
    RowSystem<Rows> system;
    std::int64_t push[most_rows]; // on the child, World, in the tree's unit
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
        using tree_detail::plus;
        return plus(plus(Rows::multiply(a.x, b.x), Rows::multiply(a.y, b.y)), Rows::multiply(a.z, b.z));
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
        shift = symmetric(w.shift, push.force) + mixed(w.mixed, push.torque);
        turn = mixed_back(w.mixed, push.force) + symmetric(w.turn, push.torque);
    }
    static std::int64_t along(const Wrench& push, const Vec3& shift, const Vec3& turn) {
        return tree_detail::plus(dot(push.force, shift), dot(push.torque, turn));
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

    static void fold_in(ArticulatedInverse& inverse, const RowJoint<Rows>& joint) {
        Vec3 shift[most_rows];
        Vec3 turn[most_rows];
        for (int i = 0; i < joint.system.count; ++i) {
            shift[i] = joint.column_shift[i];
            turn[i] = joint.column_turn[i];
            for (int k = 0; k < i; ++k) {
                shift[i] = shift[i] - multiply(joint.system.lower[i][k], shift[k]);
                turn[i] = turn[i] - multiply(joint.system.lower[i][k], turn[k]);
            }
            take_out(inverse, shift[i], turn[i], joint.system.pivots[i]);
        }
    }

    // With what is left of its rows: its push if nothing pushed the parent, which that moves.
    static void fold_rows(std::int64_t (&left)[most_rows], std::int64_t most, RowJoint<Rows>& joint,
                          ArticulatedBody& parent) {
        lks::solve(joint.system, left);
        for (int row = 0; row < joint.system.count; ++row) {
            joint.push[row] = std::clamp(tree_detail::minus(0, left[row]), -most, most);
            parent.shift = parent.shift - multiply(joint.push[row], joint.column_shift[row]);
            parent.turn = parent.turn - multiply(joint.push[row], joint.column_turn[row]);
        }
    }

    // With what the joints towards the root push the parent.
    static void push_more(std::int64_t most, RowJoint<Rows>& joint, const ArticulatedBody& parent) {
        using tree_detail::plus;
        std::int64_t more[most_rows];
        for (int row = 0; row < joint.system.count; ++row) {
            more[row] =
                plus(dot(joint.column_shift[row], parent.force), dot(joint.column_turn[row], parent.torque));
        }
        lks::solve(joint.system, more);
        for (int row = 0; row < joint.system.count; ++row) {
            joint.push[row] = std::clamp(plus(joint.push[row], more[row]), -most, most);
        }
    }

private:
    static Vec3 symmetric(const std::int64_t (&m)[6], const Vec3& v) {
        return {dot({m[0], m[1], m[2]}, v), dot({m[1], m[3], m[4]}, v), dot({m[2], m[4], m[5]}, v)};
    }
    static Vec3 mixed(const std::int64_t (&m)[9], const Vec3& v) {
        return {dot({m[0], m[1], m[2]}, v), dot({m[3], m[4], m[5]}, v), dot({m[6], m[7], m[8]}, v)};
    }
    static Vec3 mixed_back(const std::int64_t (&m)[9], const Vec3& v) {
        return {dot({m[0], m[3], m[6]}, v), dot({m[1], m[4], m[7]}, v), dot({m[2], m[5], m[8]}, v)};
    }
};

} // namespace lks
