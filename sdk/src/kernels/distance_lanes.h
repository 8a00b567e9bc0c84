// A range of one batch, 2·L::half constraints at a time: kernels/distance_scalar.h over lanes.
//
// L is one instruction set: registers of L::half 64-bit lanes and a few operations on them. A group of
// constraints is two registers of coordinates, A and B; what is 32 bits wide is kept in one register, A's in
// the even halves and B's in the odd ones, where 32×32→64 multiplications find it. A group in which a lane
// leaves the fast range (an edge 2^30 units long, or shorter than 2^16) is projected in plain integers, which
// gives the same bits.
#pragma once

#include "kernels/distance_scalar_loop.h"

namespace lks {
namespace {

template <typename L>
struct Group {
    typename L::Register a, b;
};

// A stretch in which both ends advance by one.
template <typename L>
struct RunAccess {
    static constexpr bool contiguous = true;
    std::uint32_t constraint;
    std::uint32_t a;
    std::uint32_t b;

    Group<L> load_a(const std::int64_t* x) const { return {L::load(x + a), L::load(x + a + L::half)}; }
    Group<L> load_b(const std::int64_t* x) const { return {L::load(x + b), L::load(x + b + L::half)}; }
    void store(std::int64_t* x, const Group<L>& at_a, const Group<L>& at_b) const {
        L::store(x + a, at_a.a);
        L::store(x + a + L::half, at_a.b);
        L::store(x + b, at_b.a);
        L::store(x + b + L::half, at_b.b);
    }
    Group<L> load(const std::uint32_t* values) const {
        return {L::load_widened(values + constraint), L::load_widened(values + constraint + L::half)};
    }
};

// Constraints from anywhere in the batch. Lanes from `count` on repeat the first one and are not stored.
template <typename L>
struct ScatteredAccess {
    static constexpr bool contiguous = false;
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
    Group<L> load_a(const std::int64_t* x) const { return {L::gather(x, a), L::gather(x, a + L::half)}; }
    Group<L> load_b(const std::int64_t* x) const { return {L::gather(x, b), L::gather(x, b + L::half)}; }
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
    Group<L> load(const std::uint32_t* values) const {
        return {L::gather_widened(values, constraint), L::gather_widened(values, constraint + L::half)};
    }
};

// 1/√m for 32-bit lanes whose even and odd halves are also given by themselves, low in 64 bits:
// fixed/projection_reciprocal_sqrt.h.
template <typename L>
inline typename L::Register reciprocal_sqrt_lanes(typename L::Register even, typename L::Register odd,
                                                  typename L::Register m) {
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

    R operator()(R value) const {
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

template <typename L, bool equal_shares>
class StiffGroups {
    using R = typename L::Register;
    using G = Group<L>;

public:
    explicit StiffGroups(const DistanceTask& task)
        : task_(task), shift_(L::make_shift(task.parameters.difference_shift)),
          gain_shift_(task.parameters.gain_shift),
          rounded_gain_shift_(task.parameters.gain_shift,
                              std::int64_t{1} << (task.parameters.gain_shift - 1)),
          low_gain_shift_(L::make_shift(task.parameters.gain_shift - 31)),
          bias_(L::set((std::int64_t{1} << (task.parameters.difference_shift - 1)) +
                       (std::int64_t{1} << (task.parameters.difference_shift + 30)))),
          ratio_shift_(L::set(32 + task.parameters.rest_exponent)),
          gain_rounding_(L::set(std::int64_t{1} << (task.parameters.gain_shift - 1))) {}

    // False, and nothing is changed: a lane needs the plain way.
    template <typename Access>
    bool project(const Access& at) const {
        std::int64_t* const axes[3] = {task_.arrays.x, task_.arrays.y, task_.arrays.z};
        // d + 2^30, below 2^31 unless it does not fit.
        G d[3];
        for (int axis = 0; axis < 3; ++axis) {
            const G a = at.load_a(axes[axis]);
            const G b = at.load_b(axes[axis]);
            d[axis] = {biased_difference(a.a, b.a), biased_difference(a.b, b.b)};
        }
        const R too_far =
            L::bit_and(L::bit_or(L::bit_or(L::bit_or(d[0].a, d[0].b), L::bit_or(d[1].a, d[1].b)),
                                 L::bit_or(d[2].a, d[2].b)),
                       L::set(~std::int64_t{INT32_MAX}));
        for (G& difference : d) {
            difference = {L::subtract(difference.a, L::set(direction_one)),
                          L::subtract(difference.b, L::set(direction_one))};
        }
        const G u{squared_length(d[0].a, d[1].a, d[2].a), squared_length(d[0].b, d[1].b, d[2].b)};
        const R high_u = L::high_halves(u.a, u.b);
        if (L::any(L::bit_or(too_far, L::equal_32(high_u, L::set_32(0))))) {
            return false;
        }
        const G f = relative_correction(u, high_u, at.load(task_.rest_mantissas));
        if constexpr (equal_shares) {
            move_alike(at, axes, d, f, at.load(task_.shares_a));
        } else {
            const G share_a = at.load(task_.shares_a);
            const G share_b = at.load(task_.shares_b);
            const G alike{L::equal(share_a.a, share_b.a), L::equal(share_a.b, share_b.b)};
            if (L::all(L::bit_and(alike.a, alike.b))) {
                move_alike(at, axes, d, f, share_a);
            } else {
                move_by_share(at, axes, d, f, share_a, share_b, alike);
            }
        }
        return true;
    }

private:
    R biased_difference(R a, R b) const { return L::shift_right(L::add(L::subtract(a, b), bias_), shift_); }

    static R squared_length(R x, R y, R z) {
        return L::add(L::add(L::multiply_signed(x, x), L::multiply_signed(y, y)), L::multiply_signed(z, z));
    }

    // f in Direction format, within ±2^30, as 64-bit numbers.
    G relative_correction(const G& u, R high_u, const G& rest) const {
        const R twice_k = L::bit_and(L::leading_zeros_32(high_u), L::set_32(~1));
        const G twice{L::bit_and(twice_k, L::set(UINT32_MAX)), L::template shift_right<32>(twice_k)};
        const G aligned{L::shift_left_each(u.a, twice.a), L::shift_left_each(u.b, twice.b)};
        const R y = reciprocal_sqrt_lanes<L>(L::template shift_right<32>(aligned.a),
                                             L::template shift_right<32>(aligned.b),
                                             L::high_halves(aligned.a, aligned.b));
        return {ratio_less_one(L::multiply_unsigned(rest.a, y), twice.a),
                ratio_less_one(L::multiply_unsigned(rest.b, L::template shift_right<32>(y)), twice.b)};
    }

    R ratio_less_one(R product, R twice_k) const {
        const R ratio =
            L::shift_right_each(product, L::subtract(ratio_shift_, L::template shift_right<1>(twice_k)));
        const R two = L::set(2 * std::int64_t{direction_one});
        // Neither exceeds 2^63, so the sign of the difference decides.
        const R limited = L::select_by_sign(ratio, two, L::subtract(two, ratio));
        return L::subtract(limited, L::set(direction_one));
    }

    template <typename Access>
    void move_alike(const Access& at, std::int64_t* const* axes, const G* d, const G& f,
                    const G& share) const {
        const G gain{rounded_gain(share.a, f.a), rounded_gain(share.b, f.b)};
        for (int axis = 0; axis < 3; ++axis) {
            const R correction_a = L::multiply_signed(d[axis].a, gain.a);
            const R correction_b = L::multiply_signed(d[axis].b, gain.b);
            const G a = at.load_a(axes[axis]);
            const G b = at.load_b(axes[axis]);
            at.store(axes[axis], {L::add(a.a, correction_a), L::add(a.b, correction_b)},
                     {L::subtract(b.a, correction_a), L::subtract(b.b, correction_b)});
        }
    }

    R rounded_gain(R share, R f) const { return rounded_gain_shift_(L::multiply_signed(share, f)); }

    struct LongGain {
        R high, low;
    };

    // Where the shares are equal: the rounded gain, and no bits behind it.
    LongGain long_gain(R share, R f, R alike) const {
        const R product = L::add(L::multiply_signed(share, f), L::bit_and(gain_rounding_, alike));
        const R low = L::bit_and(L::shift_right(product, low_gain_shift_), L::set(INT32_MAX));
        return {gain_shift_(product), L::and_not(alike, low)};
    }

    R long_product(R difference, const LongGain& gain) const {
        return L::add(L::multiply_signed(difference, gain.high),
                      low_product_shift_(L::multiply_signed(difference, gain.low)));
    }

    template <typename Access>
    void move_by_share(const Access& at, std::int64_t* const* axes, const G* d, const G& f, const G& share_a,
                       const G& share_b, const G& alike) const {
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
    R bias_;
    R ratio_shift_;
    R gain_rounding_;
};

template <typename L, bool equal_shares>
inline void project_stiff_lanes(const DistanceTask& task) {
    constexpr std::uint32_t lanes = 2 * L::half;
    const StiffGroups<L, equal_shares> groups(task);
    const Projection<equal_shares, false, false, false> project_one(task);
    ScatteredAccess<L> scattered;
    const auto project_scattered = [&] {
        scattered.fill_up();
        if (!groups.project(scattered)) {
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
    visit_runs(task, [&](std::uint32_t constraint, std::uint32_t a, std::uint32_t b, std::uint32_t count) {
        std::uint32_t i = 0;
        for (; i + lanes <= count; i += lanes) {
            if (!groups.project(RunAccess<L>{constraint + i, a + i, b + i})) {
                for (std::uint32_t lane = i; lane < i + lanes; ++lane) {
                    project_one(constraint + lane, a + lane, b + lane);
                }
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

template <typename L>
inline void project_lanes(const DistanceTask& task) {
    if (task.soft || task.arrays.multipliers != nullptr) {
        project_scalar(task);
    } else if (task.equal_shares) {
        project_stiff_lanes<L, true>(task);
    } else {
        project_stiff_lanes<L, false>(task);
    }
}

} // namespace
} // namespace lks
