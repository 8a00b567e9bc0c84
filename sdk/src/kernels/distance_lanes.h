// A range of one batch, 2·L::half constraints at a time: kernels/distance_scalar.h over lanes.
//
// L is one instruction set: registers of L::half 64-bit lanes and a few operations on them. A group of
// constraints is two registers of coordinates, A and B; what is 32 bits wide is kept in one register, A's in
// the even halves and B's in the odd ones, where 32×32→64 multiplications find it. A group in which a lane
// leaves the fast range (an edge 2^30 units long, or shorter than 2^16) is projected in plain integers, which
// gives the same bits.
#pragma once

#include "kernels/distance_scalar_loop.h"
#include "kernels/force_inline.h"

namespace lks {
namespace {

template <typename L>
struct Group {
    typename L::Register a, b;
};

// A stretch in which both ends advance by one.
template <typename L>
struct RunAccess {
    std::uint32_t constraint;
    std::uint32_t a;
    std::uint32_t b;

    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::load(x + a), L::load(x + a + L::half)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::load(x + b), L::load(x + b + L::half)};
    }
    LKS_FORCE_INLINE void store(std::int64_t* x, const Group<L>& at_a, const Group<L>& at_b) const {
        L::store(x + a, at_a.a);
        L::store(x + a + L::half, at_a.b);
        L::store(x + b, at_b.a);
        L::store(x + b + L::half, at_b.b);
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        return {L::load(values + constraint), L::load(values + constraint + L::half)};
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        L::store(values + constraint, group.a);
        L::store(values + constraint + L::half, group.b);
    }
    LKS_FORCE_INLINE Group<L> load(const std::uint32_t* values) const {
        return {L::load_widened(values + constraint), L::load_widened(values + constraint + L::half)};
    }
};

// The end of a run: loads as a whole group does, and stores its own lanes only.
template <typename L>
struct TailAccess : RunAccess<L> {
    std::uint32_t count;

    LKS_FORCE_INLINE void store(std::int64_t* x, const Group<L>& at_a, const Group<L>& at_b) const {
        constexpr std::uint32_t lanes = 2 * L::half;
        std::int64_t values[2 * lanes];
        L::store(values, at_a.a);
        L::store(values + L::half, at_a.b);
        L::store(values + lanes, at_b.a);
        L::store(values + lanes + L::half, at_b.b);
        for (std::uint32_t i = 0; i < count; ++i) {
            x[this->a + i] = values[i];
            x[this->b + i] = values[lanes + i];
        }
    }
};

// Constraints from anywhere in the batch. Lanes from `count` on repeat the first one and are not stored.
template <typename L>
struct ScatteredAccess {
    static constexpr std::uint32_t lanes = 2 * L::half;
    std::uint32_t count = 0;
    std::uint32_t constraint[lanes];
    std::uint32_t a[lanes];
    std::uint32_t b[lanes];

    void push(std::uint32_t index, std::uint32_t end_a, std::uint32_t end_b) {
        constraint[count] = index;
        a[count] = end_a;
        b[count] = end_b;
        ++count;
    }
    void fill_up() {
        for (std::uint32_t i = count; i < lanes; ++i) {
            constraint[i] = constraint[0];
            a[i] = a[0];
            b[i] = b[0];
        }
    }
    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::gather(x, a), L::gather(x, a + L::half)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::gather(x, b), L::gather(x, b + L::half)};
    }
    void store(std::int64_t* x, const Group<L>& at_a, const Group<L>& at_b) const {
        std::int64_t values[2 * lanes];
        L::store(values, at_a.a);
        L::store(values + L::half, at_a.b);
        L::store(values + lanes, at_b.a);
        L::store(values + lanes + L::half, at_b.b);
        for (std::uint32_t i = 0; i < count; ++i) {
            x[a[i]] = values[i];
            x[b[i]] = values[lanes + i];
        }
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        return {L::gather(values, constraint), L::gather(values, constraint + L::half)};
    }
    void store_wide(std::int64_t* values, const Group<L>& group) const {
        std::int64_t parts[lanes];
        L::store(parts, group.a);
        L::store(parts + L::half, group.b);
        for (std::uint32_t i = 0; i < count; ++i) {
            values[constraint[i]] = parts[i];
        }
    }
    LKS_FORCE_INLINE Group<L> load(const std::uint32_t* values) const {
        return {L::gather_widened(values, constraint), L::gather_widened(values, constraint + L::half)};
    }
};

// 1/√m for 32-bit lanes whose even and odd halves are also given by themselves, low in 64 bits:
// fixed/projection_reciprocal_sqrt.h.
template <typename L>
LKS_FORCE_INLINE typename L::Register
reciprocal_sqrt_lanes(typename L::Register even, typename L::Register odd, typename L::Register m) {
    using R = typename L::Register;
    // Aligned, with the leading bit replaced by the octave.
    const R aligned = L::select_by_sign_32(L::add_32(m, L::add_32(m, L::set_32(INT32_MIN))), m, m);
    const R segment = L::template shift_right_32<29>(aligned);
    const R c0_c1 = L::lookup(fixed::projection_seeds.c0_c1, segment);
    const R c2_c3 = L::lookup(fixed::projection_seeds.c2_c3, segment);
    // t in the high 16 bits, and something else in the low ones.
    const R high_t = L::exclusive_or(L::template shift_left_32<3>(aligned), L::set_32(INT32_MIN));
    const R t = L::template shift_right_32<16>(high_t);
    const R quadratic =
        L::add_16(c2_c3, L::template shift_right_32<16>(L::rounding_multiply_16(high_t, c2_c3)));
    const R slope = L::add_16(L::template shift_right_32<16>(c0_c1), L::rounding_multiply_16(t, quadratic));
    const R correction = L::template shift_right_16_signed<3>(L::rounding_multiply_16(t, slope));
    const R y0 = L::bit_and(L::add_16(c0_c1, correction), L::set_32(0xffff));
    const R y0_squared = L::multiply_low_32(y0, y0);
    const R e =
        L::subtract_32(L::high_halves(L::multiply_unsigned(even, y0_squared),
                                      L::multiply_unsigned(odd, L::template shift_right<32>(y0_squared))),
                       L::set_32(1 << 30));
    const R step = L::multiply_low_32(y0, L::template shift_right_32_signed<1>(e));
    return L::subtract_32(L::template shift_left_32<15>(y0),
                          L::template shift_right_32_signed<15>(L::add_32(step, L::set_32(1 << 14))));
}

// value · 2^-count with its sign, rounded down after `rounding` was added; |value| < 2^62. Where there is no
// such shift the value is made positive, and back.
template <typename L>
class SignedShift {
    using R = typename L::Register;

public:
    explicit SignedShift(int count, std::int64_t rounding = 0)
        : count_(L::make_shift(count)), before_(L::set(rounding + lift)), after_(L::set(lift >> count)) {}

    LKS_FORCE_INLINE R operator()(R value) const {
        const R lifted = L::add(value, before_);
        if constexpr (L::has_signed_shift) {
            return L::shift_right_signed(lifted, count_);
        } else {
            return L::subtract(L::shift_right(lifted, count_), after_);
        }
    }

private:
    static constexpr std::int64_t lift = L::has_signed_shift ? 0 : std::int64_t{1} << 62;

    typename L::Shift count_;
    R before_;
    R after_;
};

// Loaded from widest_group − count on: all bits in the first `count` lanes, and none in the others.
constexpr std::int64_t first_lanes[2 * widest_group] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                        -1, -1, -1, -1, -1, -1, -1, -1};

// What f needs of an edge beside its stretch: its groups' lengths and directions.
template <typename L>
struct EdgeLanes {
    Group<L> wide[3]; // x_a − x_b
    Group<L> d[3];
    Group<L> u;
    Group<L> twice_k;
    Group<L> m; // Q2.30, low in each lane
    Group<L> y; // low in each lane, with something else above it
};

template <typename L, bool equal_shares, bool soft, bool damped, bool multiplier>
class DistanceGroups {
    using R = typename L::Register;
    using G = Group<L>;
    using Edge = EdgeLanes<L>;

public:
    explicit DistanceGroups(const DistanceTask& task)
        : task_(task), shift_(L::make_shift(task.parameters.difference_shift)),
          gain_shift_(task.parameters.gain_shift),
          rounded_gain_shift_(task.parameters.gain_shift,
                              std::int64_t{1} << (task.parameters.gain_shift - 1)),
          low_gain_shift_(L::make_shift(task.parameters.gain_shift - 31)),
          product_shift_(
              task.parameters.product_shift,
              task.parameters.product_shift > 0 ? std::int64_t{1} << (task.parameters.product_shift - 1) : 0),
          plain_(task.parameters.product_shift == 0), bias_(bias(task, 30)), motion_bias_(bias(task, 29)),
          ratio_shift_(L::set(32 + task.parameters.rest_exponent)),
          gain_rounding_(L::set(std::int64_t{1} << (task.parameters.gain_shift - 1))),
          error_share_(L::set(task.parameters.error_share)),
          damping_share_(L::set(task.parameters.damping_share)),
          length_shift_(L::set(30 - task.parameters.difference_shift)) {}

    // False, and nothing is changed: a lane needs the plain way. Lanes from `count` on are left as they are.
    template <bool whole = true, typename Access>
    LKS_FORCE_INLINE bool project(const Access& at, std::uint32_t count = 2 * L::half) const {
        std::int64_t* const axes[3] = {task_.arrays.x, task_.arrays.y, task_.arrays.z};
        Edge edge;
        R beyond = L::set(0);
        for (int axis = 0; axis < 3; ++axis) {
            const G a = at.load_a(axes[axis]);
            const G b = at.load_b(axes[axis]);
            edge.wide[axis] = {L::subtract(a.a, b.a), L::subtract(a.b, b.b)};
            if constexpr (!whole) {
                edge.wide[axis] = masked(edge.wide[axis], count);
            }
            edge.d[axis] = narrow(edge.wide[axis], bias_, direction_one, beyond);
        }
        edge.u = dot_product(edge.d, edge.d);
        const R high_u = L::high_halves(edge.u.a, edge.u.b);
        R too_short = L::equal_32(high_u, L::set_32(0));
        if constexpr (!whole) {
            const G all_bits{L::set(-1), L::set(-1)};
            const G mask = masked(all_bits, count);
            too_short = L::bit_and(too_short, L::high_halves(mask.a, mask.b));
        }
        if (L::any(L::bit_or(too_short, L::bit_and(beyond, L::set(~std::int64_t{INT32_MAX}))))) {
            return false;
        }
        measure(edge, high_u);
        G f = relative_error(edge, at.load(task_.rest_mantissas));
        if constexpr (soft && (damped || multiplier)) {
            if (!soften(at, edge, f)) {
                return false;
            }
        }
        if constexpr (multiplier) {
            add_to_multipliers(at, edge, f);
        }
        move<whole>(at, axes, edge.d, f, count);
        return true;
    }

private:
    // Half a unit to round, and what makes 2^bits units positive.
    LKS_FORCE_INLINE static R bias(const DistanceTask& task, int bits) {
        return L::set((std::int64_t{1} << (task.parameters.difference_shift - 1)) +
                      (std::int64_t{1} << (task.parameters.difference_shift + bits)));
    }

    // In difference units, within ±offset; else bits above the 31st of `beyond` are set. The bias adds offset
    // units.
    LKS_FORCE_INLINE G narrow(const G& wide, R with_bias, std::int64_t offset, R& beyond) const {
        const R a = L::shift_right(L::add(wide.a, with_bias), shift_);
        const R b = L::shift_right(L::add(wide.b, with_bias), shift_);
        // Twice the smaller offsets' lanes: the same bit tells.
        beyond = L::bit_or(beyond, offset == direction_one ? L::bit_or(a, b)
                                                           : L::add(L::bit_or(a, b), L::bit_or(a, b)));
        return {L::subtract(a, L::set(offset)), L::subtract(b, L::set(offset))};
    }

    LKS_FORCE_INLINE static G dot_product(const G* v, const G* w) {
        const auto sum = [](R x, R y, R z) { return L::add(L::add(x, y), z); };
        return {sum(L::multiply_signed(v[0].a, w[0].a), L::multiply_signed(v[1].a, w[1].a),
                    L::multiply_signed(v[2].a, w[2].a)),
                sum(L::multiply_signed(v[0].b, w[0].b), L::multiply_signed(v[1].b, w[1].b),
                    L::multiply_signed(v[2].b, w[2].b))};
    }

    LKS_FORCE_INLINE static void measure(Edge& edge, R high_u) {
        const R twice_k = L::bit_and(L::leading_zeros_32(high_u), L::set_32(~1));
        edge.twice_k = {L::bit_and(twice_k, L::set(UINT32_MAX)), L::template shift_right<32>(twice_k)};
        const G aligned{L::shift_left_each(edge.u.a, edge.twice_k.a),
                        L::shift_left_each(edge.u.b, edge.twice_k.b)};
        edge.m = {L::template shift_right<32>(aligned.a), L::template shift_right<32>(aligned.b)};
        const R y = reciprocal_sqrt_lanes<L>(edge.m.a, edge.m.b, L::high_halves(aligned.a, aligned.b));
        edge.y = {y, L::template shift_right<32>(y)};
    }

    // g = min(L/len, 2) − 1 in Direction format, as 64-bit numbers.
    LKS_FORCE_INLINE G relative_error(const Edge& edge, const G& rest) const {
        return {ratio_less_one(L::multiply_unsigned(rest.a, edge.y.a), edge.twice_k.a),
                ratio_less_one(L::multiply_unsigned(rest.b, edge.y.b), edge.twice_k.b)};
    }

    LKS_FORCE_INLINE R ratio_less_one(R product, R twice_k) const {
        const R ratio =
            L::shift_right_each(product, L::subtract(ratio_shift_, L::template shift_right<1>(twice_k)));
        const R two = L::set(2 * std::int64_t{direction_one});
        // Neither exceeds 2^63, so the sign of the difference decides.
        const R limited = L::select_by_sign(ratio, two, L::subtract(two, ratio));
        return L::subtract(limited, L::set(direction_one));
    }

    // f from g. False: a lane leaves the fast range.
    template <typename Access>
    LKS_FORCE_INLINE bool soften(const Access& at, const Edge& edge, G& f) const {
        R beyond = L::set(0);
        if constexpr (damped) {
            const std::int64_t* const starts[3] = {task_.arrays.start_x, task_.arrays.start_y,
                                                   task_.arrays.start_z};
            G motion[3];
            for (int axis = 0; axis < 3; ++axis) {
                const G a = at.load_a(starts[axis]);
                const G b = at.load_b(starts[axis]);
                const G wide{L::subtract(edge.wide[axis].a, L::subtract(a.a, b.a)),
                             L::subtract(edge.wide[axis].b, L::subtract(a.b, b.b))};
                motion[axis] = narrow(wide, motion_bias_, direction_one / 2, beyond);
            }
            const G dot = dot_product(edge.d, motion);
            f = {damp(f.a, dot.a, edge.y.a, edge.twice_k.a, beyond),
                 damp(f.b, dot.b, edge.y.b, edge.twice_k.b, beyond)};
        }
        if constexpr (multiplier) {
            if (task_.relaxations != nullptr) {
                const G lambda = at.load_wide(task_.arrays.multipliers);
                const G length = narrow(lambda, bias_, direction_one, beyond);
                const G relaxation = at.load(task_.relaxations);
                f = {relax(f.a, length.a, relaxation.a, edge.y.a, edge.twice_k.a),
                     relax(f.b, length.b, relaxation.b, edge.y.b, edge.twice_k.b)};
            }
        }
        // |f| ≤ 1, but for the upper end itself.
        beyond = L::bit_or(beyond,
                           L::bit_or(L::add(f.a, L::set(direction_one)), L::add(f.b, L::set(direction_one))));
        return !L::any(L::bit_and(beyond, L::set(~std::int64_t{INT32_MAX})));
    }

    // c·g − γ'·motion/len, the motion along the edge within ±len.
    LKS_FORCE_INLINE R damp(R g, R dot, R y, R twice_k, R& beyond) const {
        const LengthShift by(twice_k);
        const R rounded = L::shift_right_each(L::add(dot, by.half), by.right);
        const R along = L::template shift_right<30>(
            L::add(L::multiply_signed(rounded, y), L::set(std::int64_t{1} << 29)));
        const R motion = over_length(along, y, by);
        beyond = L::bit_or(beyond, L::add(motion, L::set(direction_one)));
        return rounded_unit_shift_(
            L::subtract(L::multiply_signed(error_share_, g), L::multiply_signed(damping_share_, motion)));
    }

    LKS_FORCE_INLINE R relax(R f, R length, R relaxation, R y, R twice_k) const {
        const R relaxed = rounded_unit_shift_(L::multiply_signed(relaxation, length));
        return L::subtract(f, over_length(relaxed, y, LengthShift(twice_k)));
    }

    // By 32 − k to the right, and half of what is lost.
    struct LengthShift {
        explicit LengthShift(R twice_k)
            : right(L::subtract(L::set(32), L::template shift_right<1>(twice_k))),
              half(L::shift_left_each(L::set(1), L::subtract(right, L::set(1)))) {}
        R right, half;
    };

    // Of values whose low halves count; the shift with its sign, by lanes.
    LKS_FORCE_INLINE static R over_length(R value, R y, const LengthShift& by) {
        const R lift = L::set(std::int64_t{1} << 62);
        const R lifted = L::add(L::multiply_signed(value, y), L::add(lift, by.half));
        return L::subtract(L::shift_right_each(lifted, by.right), L::shift_right_each(lift, by.right));
    }

    // Λ += f·len.
    template <typename Access>
    LKS_FORCE_INLINE void add_to_multipliers(const Access& at, const Edge& edge, const G& f) const {
        const G lambda = at.load_wide(task_.arrays.multipliers);
        at.store_wide(task_.arrays.multipliers,
                      {L::add(lambda.a, length_of(f.a, edge.m.a, edge.y.a, edge.twice_k.a)),
                       L::add(lambda.b, length_of(f.b, edge.m.b, edge.y.b, edge.twice_k.b))});
    }

    LKS_FORCE_INLINE R length_of(R f, R m, R y, R twice_k) const {
        const R root = L::template shift_right<31>(L::multiply_unsigned(m, y));
        const R product = L::multiply_signed(f, root);
        const R right = L::add(length_shift_, L::template shift_right<1>(twice_k));
        const R lift = L::set(std::int64_t{1} << 62);
        return L::subtract(L::shift_right_each(L::add(L::add(product, product), lift), right),
                           L::shift_right_each(lift, right));
    }

    // Nothing in lanes from `count` on.
    static LKS_FORCE_INLINE G masked(const G& values, std::uint32_t count) {
        const std::int64_t* mask = first_lanes + widest_group - count;
        return {L::bit_and(values.a, L::load(mask)), L::bit_and(values.b, L::load(mask + L::half))};
    }

    template <bool whole, typename Access>
    LKS_FORCE_INLINE G load_shares(const Access& at, const std::uint32_t* shares, std::uint32_t count) const {
        return whole ? at.load(shares) : masked(at.load(shares), count);
    }

    template <bool whole, typename Access>
    LKS_FORCE_INLINE void move(const Access& at, std::int64_t* const* axes, const G* d, const G& f,
                               std::uint32_t count) const {
        const G share_a = load_shares<whole>(at, task_.shares_a, count);
        if constexpr (equal_shares) {
            move_alike(at, axes, d, f, share_a);
        } else {
            const G share_b = load_shares<whole>(at, task_.shares_b, count);
            const G alike{L::equal(share_a.a, share_b.a), L::equal(share_a.b, share_b.b)};
            if (L::all(L::bit_and(alike.a, alike.b))) {
                move_alike(at, axes, d, f, share_a);
            } else {
                move_by_share(at, axes, d, f, share_a, share_b, alike);
            }
        }
    }

    template <typename Access>
    LKS_FORCE_INLINE void move_alike(const Access& at, std::int64_t* const* axes, const G* d, const G& f,
                                     const G& share) const {
        const G gain{rounded_gain_shift_(L::multiply_signed(share.a, f.a)),
                     rounded_gain_shift_(L::multiply_signed(share.b, f.b))};
        for (int axis = 0; axis < 3; ++axis) {
            const R correction_a = to_coordinate(L::multiply_signed(d[axis].a, gain.a));
            const R correction_b = to_coordinate(L::multiply_signed(d[axis].b, gain.b));
            const G a = at.load_a(axes[axis]);
            const G b = at.load_b(axes[axis]);
            at.store(axes[axis], {L::add(a.a, correction_a), L::add(a.b, correction_b)},
                     {L::subtract(b.a, correction_a), L::subtract(b.b, correction_b)});
        }
    }

    LKS_FORCE_INLINE R to_coordinate(R product) const {
        if constexpr (soft) {
            return plain_ ? product : product_shift_(product);
        } else {
            return product;
        }
    }

    struct LongGain {
        R high, low;
    };

    // Where the shares are equal: the rounded gain, and no bits behind it.
    LKS_FORCE_INLINE LongGain long_gain(R share, R f, R alike) const {
        const R product = L::add(L::multiply_signed(share, f), L::bit_and(gain_rounding_, alike));
        const R low = L::bit_and(L::shift_right(product, low_gain_shift_), L::set(INT32_MAX));
        return {gain_shift_(product), L::and_not(alike, low)};
    }

    LKS_FORCE_INLINE R long_product(R difference, const LongGain& gain) const {
        return to_coordinate(L::add(L::multiply_signed(difference, gain.high),
                                    low_product_shift_(L::multiply_signed(difference, gain.low))));
    }

    template <typename Access>
    LKS_FORCE_INLINE void move_by_share(const Access& at, std::int64_t* const* axes, const G* d, const G& f,
                                        const G& share_a, const G& share_b, const G& alike) const {
        const LongGain a_a = long_gain(share_a.a, f.a, alike.a);
        const LongGain a_b = long_gain(share_a.b, f.b, alike.b);
        const LongGain b_a = long_gain(share_b.a, f.a, alike.a);
        const LongGain b_b = long_gain(share_b.b, f.b, alike.b);
        for (int axis = 0; axis < 3; ++axis) {
            const G a = at.load_a(axes[axis]);
            const G b = at.load_b(axes[axis]);
            at.store(axes[axis],
                     {L::add(a.a, long_product(d[axis].a, a_a)), L::add(a.b, long_product(d[axis].b, a_b))},
                     {L::subtract(b.a, long_product(d[axis].a, b_a)),
                      L::subtract(b.b, long_product(d[axis].b, b_b))});
        }
    }

    const DistanceTask& task_;
    typename L::Shift shift_;
    SignedShift<L> gain_shift_;
    SignedShift<L> rounded_gain_shift_;
    typename L::Shift low_gain_shift_;
    SignedShift<L> low_product_shift_{31};
    SignedShift<L> rounded_unit_shift_{unit_fraction_bits, std::int64_t{1} << (unit_fraction_bits - 1)};
    SignedShift<L> product_shift_;
    bool plain_;
    R bias_;
    R motion_bias_;
    R ratio_shift_;
    R gain_rounding_;
    R error_share_;
    R damping_share_;
    R length_shift_;
};

template <typename L, bool equal_shares, bool soft, bool damped, bool multiplier>
inline void project_in_groups(const DistanceTask& task) {
    constexpr std::uint32_t lanes = 2 * L::half;
    const DistanceGroups<L, equal_shares, soft, damped, multiplier> groups(task);
    const Projection<equal_shares, soft, damped, multiplier> project_one(task);
    ScatteredAccess<L> scattered;
    const auto project_scattered = [&] {
        // A group costs as much as two or three constraints by themselves.
        bool done = false;
        if (scattered.count > 2) {
            scattered.fill_up();
            done = groups.project(scattered);
        }
        if (!done) {
            for (std::uint32_t i = 0; i < scattered.count; ++i) {
                project_one(scattered.constraint[i], scattered.a[i], scattered.b[i]);
            }
        }
        scattered.count = 0;
    };
    const auto add = [&](std::uint32_t constraint, std::uint32_t a, std::uint32_t b) {
        scattered.push(constraint, a, b);
        if (scattered.count == lanes) {
            project_scattered();
        }
    };
    visit_runs(task, [&](std::uint32_t constraint, std::uint32_t a, std::uint32_t b, std::uint32_t count,
                         std::uint32_t spare) {
        std::uint32_t i = 0;
        for (; i + lanes <= count; i += lanes) {
            if (!groups.project(RunAccess<L>{constraint + i, a + i, b + i})) {
                for (std::uint32_t lane = i; lane < i + lanes; ++lane) {
                    project_one(constraint + lane, a + lane, b + lane);
                }
            }
        }
        const RunAccess<L> rest{constraint + i, a + i, b + i};
        const std::uint32_t left = count - i;
        // Multipliers have nobody's lanes between them.
        if (!multiplier && left != 0) {
            if (left + spare >= lanes && groups.template project<false>(rest, left)) {
                return;
            }
            // Lanes beyond its end are read, so nobody else may write them meanwhile.
            if (task.whole_batch && left >= L::half &&
                groups.template project<false>(TailAccess<L>{rest, left}, left)) {
                return;
            }
        }
        for (; i < count; ++i) {
            add(constraint + i, a + i, b + i);
        }
    });
    visit_singles(task, [&](std::uint32_t constraint) {
        add(constraint, task.constraints[constraint].a, task.constraints[constraint].b);
    });
    if (scattered.count != 0) {
        project_scattered();
    }
}

template <typename L, bool equal_shares, bool multiplier>
inline void project_family_in_groups(const DistanceTask& task) {
    if (!task.soft) {
        project_in_groups<L, equal_shares, false, false, multiplier>(task);
    } else if (!task.damped) {
        project_in_groups<L, equal_shares, true, false, multiplier>(task);
    } else {
        project_in_groups<L, equal_shares, true, true, multiplier>(task);
    }
}

template <typename L>
inline void project_lanes(const DistanceTask& task) {
    if (task.arrays.multipliers == nullptr) {
        task.equal_shares ? project_family_in_groups<L, true, false>(task)
                          : project_family_in_groups<L, false, false>(task);
    } else {
        task.equal_shares ? project_family_in_groups<L, true, true>(task)
                          : project_family_in_groups<L, false, true>(task);
    }
}

} // namespace
} // namespace lks
