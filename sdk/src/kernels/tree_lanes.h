// Trees of joints solved L::half at a time: what rigid/articulation.cpp does with one, to the bit. Sums wrap
// as there. What is rotated is within 2^62: points are some units long, and trees too small for their pushes
// to turn a body by more.
#pragma once

#include "fixed/formats.h"
#include "kernels/force_inline.h"
#include "kernels/leave_lanes.h"
#include "kernels/tree_task.h"
#include "kernels/vector_lanes.h"
#include "rigid/push_limits.h"

namespace lks {
namespace {

template <typename L>
class WideTree : VectorLanes<L> {
    using V = VectorLanes<L>;
    using R = typename L::Register;
    using typename V::Halves;
    using typename V::Vector;
    using V::add, V::subtract, V::negate, V::clamp, V::halves, V::dot_30, V::multiply_narrow;
    using V::saturating_add, V::saturating_subtract;

public:
    WideTree(const TreeTask& task, std::uint32_t first) : task_(task), first_(first) {}

    void factor() {
        for (std::uint32_t i = 0; i <= task_.joint_count; ++i) {
            begin_inverse(task_.bodies[i]);
        }
        for (std::uint32_t i = task_.joint_count; i-- > 0;) {
            WideTreeJoint& joint = task_.joints[i];
            factor(joint, task_.bodies[joint.parent], task_.bodies[i + 1]);
            if (i != 0) {
                fold_in(task_.bodies[joint.parent], joint);
            }
        }
    }

    void solve() {
        const Vector none{L::set(0), L::set(0), L::set(0)};
        for (std::uint32_t i = 0; i <= task_.joint_count; ++i) {
            store(task_.bodies[i].shift, none);
            store(task_.bodies[i].turn, none);
        }
        store(task_.bodies[0].force, none);
        store(task_.bodies[0].torque, none);
        for (std::uint32_t i = task_.joint_count; i-- > 0;) {
            fold_error(task_.joints[i], task_.bodies[task_.joints[i].parent], task_.bodies[i + 1]);
        }
        for (std::uint32_t i = 0; i < task_.joint_count; ++i) {
            push(task_.joints[i], task_.bodies[task_.joints[i].parent], task_.bodies[i + 1]);
        }
        for (std::uint32_t i = 0; i <= task_.joint_count; ++i) {
            move(task_.bodies[i]);
        }
    }

private:
    LKS_FORCE_INLINE R load(const TreeLanes& v) const { return L::load(v + first_); }
    LKS_FORCE_INLINE Vector load(const TreeLanes (&v)[3]) const {
        return {load(v[0]), load(v[1]), load(v[2])};
    }
    LKS_FORCE_INLINE void store(TreeLanes& to, R v) const { L::store(to + first_, v); }
    LKS_FORCE_INLINE void store(TreeLanes (&to)[3], const Vector& v) const {
        store(to[0], v.x);
        store(to[1], v.y);
        store(to[2], v.z);
    }

    // a·b/2^32, `rounding` units of 2^-32 added, rounded down; wraps.
    LKS_FORCE_INLINE static R multiply_32(R a, R b, std::int64_t rounding = 0) {
        R low = L::multiply_unsigned(a, b);
        if (rounding != 0) {
            low = L::add(low, L::set(rounding));
        }
        low = L::template shift_right<32>(low);
        if constexpr (L::has_multiply_low_64) {
            const R a_low = L::bit_and(a, L::set(0xffffffff));
            return L::add(low, L::add(L::multiply_low_64(V::template shift_down<32>(a), b),
                                      L::multiply_low_64(a_low, V::template shift_down<32>(b))));
        } else {
            const R zero = L::set(0);
            const R a_high = L::template shift_right<32>(a);
            const R b_high = L::template shift_right<32>(b);
            // As if the upper halves had no sign, and less what that is too much.
            const R too_much = L::add(L::select_by_sign(zero, b, a), L::select_by_sign(zero, a, b));
            const R high = L::subtract(L::multiply_unsigned(a_high, b_high), too_much);
            return L::add(L::add(low, L::template shift_left<32>(high)),
                          L::add(L::multiply_unsigned(a_high, b), L::multiply_unsigned(a, b_high)));
        }
    }
    LKS_FORCE_INLINE static R dot_32(const Vector& a, const Vector& b) {
        return L::add(L::add(multiply_32(a.x, b.x), multiply_32(a.y, b.y)), multiply_32(a.z, b.z));
    }
    LKS_FORCE_INLINE static Vector cross_32(const Vector& a, const Vector& b) {
        return {L::subtract(multiply_32(a.y, b.z), multiply_32(a.z, b.y)),
                L::subtract(multiply_32(a.z, b.x), multiply_32(a.x, b.z)),
                L::subtract(multiply_32(a.x, b.y), multiply_32(a.y, b.x))};
    }
    LKS_FORCE_INLINE Vector symmetric_32(const TreeLanes (&m)[6], const Vector& v) const {
        const R xx = load(m[0]), xy = load(m[1]), xz = load(m[2]);
        const R yy = load(m[3]), yz = load(m[4]), zz = load(m[5]);
        return {dot_32({xx, xy, xz}, v), dot_32({xy, yy, yz}, v), dot_32({xz, yz, zz}, v)};
    }

    LKS_FORCE_INLINE Vector rotate(const TreeLanes (&m)[9], const Vector& v) const {
        const Halves x = halves(v.x), y = halves(v.y), z = halves(v.z);
        return {dot_30(load(m[0]), load(m[1]), load(m[2]), x, y, z),
                dot_30(load(m[3]), load(m[4]), load(m[5]), x, y, z),
                dot_30(load(m[6]), load(m[7]), load(m[8]), x, y, z)};
    }

    // v·2^up, rounded down; any v.
    LKS_FORCE_INLINE static R shift_up(R v, int up) {
        if (up >= 0) {
            return L::shift_left(v, L::make_shift(up));
        }
        const R lifted = L::exclusive_or(v, L::set(INT64_MIN));
        return L::subtract(L::shift_right(lifted, L::make_shift(-up)),
                           L::set(static_cast<std::int64_t>((std::uint64_t{1} << 63) >> -up)));
    }
    LKS_FORCE_INLINE static Vector shift_up(const Vector& v, int up) {
        return {shift_up(v.x, up), shift_up(v.y, up), shift_up(v.z, up)};
    }

    // Without what its joints carry.
    LKS_FORCE_INLINE void begin_inverse(WideTreeBody& body) const {
        const R zero = L::set(0);
        const R share = load(body.share);
        for (int i = 0; i < 6; ++i) {
            store(body.shift_inverse[i], i == 0 || i == 3 || i == 5 ? share : zero);
            store(body.turn_inverse[i],
                  multiply_32(share, shift_up(load(body.world_inverse[i]), body.inverse_shift)));
        }
        for (int i = 0; i < 9; ++i) {
            store(body.mixed_inverse[i], zero);
        }
    }

    struct Columns {
        Vector shift[3], turn[3];
    };
    // What a push along each axis at the lever does: its shift and its turn.
    LKS_FORCE_INLINE Columns push_columns(const WideTreeBody& body, const Vector& lever) const {
        const R w[6] = {load(body.shift_inverse[0]), load(body.shift_inverse[1]),
                        load(body.shift_inverse[2]), load(body.shift_inverse[3]),
                        load(body.shift_inverse[4]), load(body.shift_inverse[5])};
        const R t[6] = {load(body.turn_inverse[0]), load(body.turn_inverse[1]), load(body.turn_inverse[2]),
                        load(body.turn_inverse[3]), load(body.turn_inverse[4]), load(body.turn_inverse[5])};
        const Vector mixed[3] = {mixed_row(body, 0), mixed_row(body, 1), mixed_row(body, 2)};
        const Vector turn[3] = {{t[0], t[1], t[2]}, {t[1], t[3], t[4]}, {t[2], t[4], t[5]}};
        const Vector shift[3] = {{w[0], w[1], w[2]}, {w[1], w[3], w[4]}, {w[2], w[4], w[5]}};
        const Vector back = negate(lever);
        Columns columns;
        for (int axis = 0; axis < 3; ++axis) {
            const auto along = [&](const Vector& row) { return arm_product(axis, row, lever, back); };
            columns.shift[axis] = add(shift[axis], {along(mixed[0]), along(mixed[1]), along(mixed[2])});
            columns.turn[axis] = add(mixed[axis], {along(turn[0]), along(turn[1]), along(turn[2])});
        }
        return columns;
    }
    LKS_FORCE_INLINE Vector mixed_row(const WideTreeBody& body, int row) const {
        return {load(body.mixed_inverse[3 * row]), load(body.mixed_inverse[3 * row + 1]),
                load(body.mixed_inverse[3 * row + 2])};
    }
    // row · (lever × axis)
    LKS_FORCE_INLINE static R arm_product(int axis, const Vector& row, const Vector& lever,
                                          const Vector& back) {
        return axis == 0   ? L::add(multiply_32(row.y, lever.z), multiply_32(row.z, back.y))
               : axis == 1 ? L::add(multiply_32(row.x, back.z), multiply_32(row.z, lever.x))
                           : L::add(multiply_32(row.x, lever.y), multiply_32(row.y, back.x));
    }

    // How the point moves: xx, xy, xz, yy, yz, zz are added to.
    LKS_FORCE_INLINE static void add_point_motion(const Vector& lever, const Columns& columns, R (&d)[6]) {
        const Vector x = add(columns.shift[0], cross_32(columns.turn[0], lever));
        const Vector y = add(columns.shift[1], cross_32(columns.turn[1], lever));
        const Vector z = add(columns.shift[2], cross_32(columns.turn[2], lever));
        const R more[6] = {x.x, x.y, x.z, y.y, y.z, z.z};
        for (int i = 0; i < 6; ++i) {
            d[i] = L::add(d[i], more[i]);
        }
    }

    LKS_FORCE_INLINE Vector lever_of(const WideTreeBody& body, const TreeLanes (&point)[3]) const {
        return shift_up(rotate(body.rotation, load(point)), body.lever_shift);
    }

    LKS_FORCE_INLINE void factor(WideTreeJoint& joint, const WideTreeBody& parent,
                                 const WideTreeBody& child) const {
        store(joint.pair_share, L::maximum_signed(load(parent.share), load(child.share)));
        const R zero = L::set(0);
        R d[6] = {zero, zero, zero, zero, zero, zero};
        const Vector child_lever = lever_of(child, joint.child_point);
        store(joint.child_lever, child_lever);
        add_point_motion(child_lever, push_columns(child, child_lever), d);
        const Vector parent_lever = lever_of(parent, joint.parent_point);
        store(joint.parent_lever, parent_lever);
        const Columns columns = push_columns(parent, parent_lever);
        add_point_motion(parent_lever, columns, d);
        for (int axis = 0; axis < 3; ++axis) {
            store(joint.column_shift[axis], columns.shift[axis]);
            store(joint.column_turn[axis], columns.turn[axis]);
        }
        alignas(64) TreeLanes motion[6];
        for (int i = 0; i < 6; ++i) {
            store(motion[i], d[i]);
        }
        task_.invert(motion, first_, L::half, joint.inverse);
    }

    // W −= U·D⁻¹·Uᵀ.
    LKS_FORCE_INLINE void fold_in(WideTreeBody& parent, const WideTreeJoint& joint) const {
        Vector rows[6];
        Vector solved[6];
        for (int i = 0; i < 3; ++i) {
            rows[i] = {load(joint.column_shift[0][i]), load(joint.column_shift[1][i]),
                       load(joint.column_shift[2][i])};
            rows[3 + i] = {load(joint.column_turn[0][i]), load(joint.column_turn[1][i]),
                           load(joint.column_turn[2][i])};
        }
        for (int i = 0; i < 6; ++i) {
            solved[i] = symmetric_32(joint.inverse, rows[i]);
        }
        const auto less = [&](TreeLanes& entry, const Vector& a, const Vector& b) {
            store(entry, L::subtract(load(entry), dot_32(a, b)));
        };
        int entry = 0;
        for (int i = 0; i < 3; ++i) {
            for (int j = i; j < 3; ++j) {
                less(parent.shift_inverse[entry], solved[i], rows[j]);
                less(parent.turn_inverse[entry], solved[3 + i], rows[3 + j]);
                ++entry;
            }
            for (int j = 0; j < 3; ++j) {
                less(parent.mixed_inverse[3 * i + j], solved[i], rows[3 + j]);
            }
        }
    }

    // joint_offset.
    LKS_FORCE_INLINE Vector offset(const WideTreeBody& a, const TreeLanes (&point_a)[3],
                                   const WideTreeBody& b, const TreeLanes (&point_b)[3]) const {
        return saturating_add(saturating_subtract(load(b.position), load(a.position)),
                              subtract(rotate(b.rotation, load(point_b)), rotate(a.rotation, load(point_a))));
    }
    LKS_FORCE_INLINE Vector point_motion(const WideTreeBody& body, const Vector& lever) const {
        return add(load(body.shift), cross_32(load(body.turn), lever));
    }

    LKS_FORCE_INLINE void fold_error(WideTreeJoint& joint, WideTreeBody& parent, WideTreeBody& child) const {
        Vector apart = joint.child_is_a ? offset(child, joint.child_point, parent, joint.parent_point)
                                        : offset(parent, joint.parent_point, child, joint.child_point);
        if (task_.keeps_start) {
            apart = subtract(apart, load(joint.start));
        }
        apart = clamp(apart, greatest_step);
        if (joint.child_is_a) {
            apart = negate(apart);
        }
        const Vector left = add(subtract(apart, point_motion(parent, load(joint.parent_lever))),
                                point_motion(child, load(joint.child_lever)));
        const Vector push = clamp(negate(symmetric_32(joint.inverse, left)), greatest_push);
        store(joint.push, push);
        store(parent.shift, less_columns(load(parent.shift), push, joint.column_shift));
        store(parent.turn, less_columns(load(parent.turn), push, joint.column_turn));
    }
    LKS_FORCE_INLINE Vector less_columns(Vector sum, const Vector& push,
                                         const TreeLanes (&columns)[3][3]) const {
        const R along[3] = {push.x, push.y, push.z};
        for (int axis = 0; axis < 3; ++axis) {
            const Vector column = load(columns[axis]);
            sum = subtract(sum, {multiply_32(along[axis], column.x), multiply_32(along[axis], column.y),
                                 multiply_32(along[axis], column.z)});
        }
        return sum;
    }

    LKS_FORCE_INLINE void push(WideTreeJoint& joint, WideTreeBody& parent, WideTreeBody& child) const {
        const Vector force = load(parent.force);
        const Vector torque = load(parent.torque);
        const auto along = [&](int axis) {
            return L::add(dot_32(load(joint.column_shift[axis]), force),
                          dot_32(load(joint.column_turn[axis]), torque));
        };
        const Vector more = symmetric_32(joint.inverse, {along(0), along(1), along(2)});
        const Vector push = clamp(add(load(joint.push), more), greatest_push);
        const Vector back = negate(push);
        store(parent.force, add(force, back));
        store(parent.torque, add(torque, cross_32(load(joint.parent_lever), back)));
        // Nothing else has pushed it yet.
        store(child.force, push);
        store(child.torque, cross_32(load(joint.child_lever), push));
        const Vector& on_b = joint.child_is_a ? back : push;
        const R share = load(joint.pair_share);
        store(joint.push,
              {multiply_32(share, on_b.x), multiply_32(share, on_b.y), multiply_32(share, on_b.z)});
    }

    LKS_FORCE_INLINE Vector rounded_share(R share, const Vector& v) const {
        constexpr std::int64_t half = std::int64_t{1} << 31;
        return {multiply_32(share, v.x, half), multiply_32(share, v.y, half), multiply_32(share, v.z, half)};
    }

    // shifted() of rigid/pair.h
    LKS_FORCE_INLINE R shifted(R v, int up) const {
        if (up > 0) {
            return L::shift_left(clamp(v, greatest_shifted >> up), L::make_shift(up));
        }
        if (up == 0) {
            return v;
        }
        return L::add(shift_up(v, up), L::bit_and(L::shift_right(v, L::make_shift(-up - 1)), L::set(1)));
    }

    LKS_FORCE_INLINE void move(WideTreeBody& body) const {
        const R share = load(body.share);
        store(body.position, add(load(body.position), rounded_share(share, load(body.force))));
        const Vector torque = rounded_share(share, load(body.torque));
        const Halves x = halves(torque.x), y = halves(torque.y), z = halves(torque.z);
        const R xx = load(body.world_inverse[0]), xy = load(body.world_inverse[1]);
        const R xz = load(body.world_inverse[2]), yy = load(body.world_inverse[3]);
        const R yz = load(body.world_inverse[4]), zz = load(body.world_inverse[5]);
        turn(body, {shifted(dot_30(xx, xy, xz, x, y, z), body.turn_shift),
                    shifted(dot_30(xy, yy, yz, x, y, z), body.turn_shift),
                    shifted(dot_30(xz, yz, zz, x, y, z), body.turn_shift)});
    }

    // turn_body() of rigid/pair.h
    LKS_FORCE_INLINE void turn(WideTreeBody& body, const Vector& half_turn) const {
        const Vector near = clamp(half_turn, small_half_turn);
        const R far =
            L::bit_or(L::bit_or(L::exclusive_or(near.x, half_turn.x), L::exclusive_or(near.y, half_turn.y)),
                      L::exclusive_or(near.z, half_turn.z));
        R keeps = L::equal(L::bit_or(L::bit_or(near.x, near.y), near.z), L::set(0));
        std::uint32_t turns_far = first_ == 0 ? 0 : body.turns_far;
        if (L::any(far)) {
            const R is_near = L::equal(far, L::set(0));
            keeps = L::bit_or(keeps, L::exclusive_or(is_near, L::set(-1)));
            turns_far |= (~L::sign_bits(is_near) & ((1u << L::half) - 1)) << first_;
            store(body.turn, half_turn);
        }
        body.turns_far = turns_far;

        const R old[4] = {load(body.orientation[0]), load(body.orientation[1]), load(body.orientation[2]),
                          load(body.orientation[3])};
        const auto [x, y, z] = near;
        const R qx = narrow(old[0]), qy = narrow(old[1]), qz = narrow(old[2]), qw = narrow(old[3]);
        const auto m = [](R v, R q) { return multiply_narrow(v, q); };
        const R next[4] = {L::add(old[0], part(L::subtract(L::add(m(x, qw), m(y, qz)), m(z, qy)))),
                           L::add(old[1], part(L::subtract(L::add(m(y, qw), m(z, qx)), m(x, qz)))),
                           L::add(old[2], part(L::subtract(L::add(m(z, qw), m(x, qy)), m(y, qx)))),
                           L::subtract(old[3], part(L::add(L::add(m(x, qx), m(y, qy)), m(z, qz))))};
        for (int i = 0; i < 4; ++i) {
            store(body.orientation[i], L::select_by_sign(next[i], old[i], keeps));
        }
        follow_orientation(body, narrow(next[0]), narrow(next[1]), narrow(next[2]), narrow(next[3]), keeps);
    }
    LKS_FORCE_INLINE static R narrow(R c) {
        return V::template shift_down<30>(L::add(c, L::set(std::int64_t{1} << 29)));
    }
    LKS_FORCE_INLINE static R part(R c) {
        constexpr int down = half_turn_fraction_bits + 30 - 60;
        return V::template shift_down<down>(L::add(c, L::set(std::int64_t{1} << (down - 1))));
    }

    // fixed::to_matrix
    LKS_FORCE_INLINE void follow_orientation(WideTreeBody& body, R x, R y, R z, R w, R keeps) const {
        const R half = L::set(std::int64_t{1} << 59);
        const R xx = L::multiply_signed(x, x), yy = L::multiply_signed(y, y), zz = L::multiply_signed(z, z);
        const R xy = L::multiply_signed(x, y), yz = L::multiply_signed(y, z), zx = L::multiply_signed(z, x);
        const R wx = L::multiply_signed(w, x), wy = L::multiply_signed(w, y), wz = L::multiply_signed(w, z);
        const R entries[9] = {
            L::subtract(L::subtract(half, yy), zz), L::subtract(xy, wz), L::add(zx, wy),      L::add(xy, wz),
            L::subtract(L::subtract(half, zz), xx), L::subtract(yz, wx), L::subtract(zx, wy), L::add(yz, wx),
            L::subtract(L::subtract(half, xx), yy)};
        for (int i = 0; i < 9; ++i) {
            const R entry = L::template shift_right<29>(L::add(entries[i], L::set(std::int64_t{1} << 28)));
            store(body.rotation[i], L::select_by_sign(entry, load(body.rotation[i]), keeps));
        }
    }

    const TreeTask& task_;
    std::uint32_t first_;
};

template <typename L>
inline void factor_tree_lanes(const TreeTask& task) {
    for (std::uint32_t first = 0; first < task.trees; first += L::half) {
        WideTree<L>(task, first).factor();
    }
}

template <typename L>
inline void solve_tree_lanes(const TreeTask& task) {
    for (std::uint32_t first = 0; first < task.trees; first += L::half) {
        WideTree<L>(task, first).solve();
    }
}

template <typename L>
constexpr TreeKernels leaving_tree_lanes() {
    return {leaving<L, factor_tree_lanes<L>>, leaving<L, solve_tree_lanes<L>>};
}

} // namespace
} // namespace lks
