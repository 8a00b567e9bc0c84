// Where a group of constraints finds the coordinates of its ends and its coefficients, and leaves what it
// changes: a stretch of a run, some of one, or constraints with ends anywhere, in arrays or in rows.
#pragma once

#include <type_traits>

#include "kernels/distance_task.h"
#include "kernels/factors.h"
#include "kernels/force_inline.h"
#include "kernels/row_task.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

template <typename L>
struct LaneValues {
    LKS_FORCE_INLINE explicit LaneValues(const Group<L>& group) {
        L::store(values, group.a);
        L::store(values + L::half, group.b);
    }
    std::int64_t values[2 * L::half];
};

// All bits in the first lanes that are loaded from widest_group on, and none before and behind.
constexpr std::int64_t lane_bits[3 * widest_group] = {0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,
                                                      0,  0,  0,  0,  0,  -1, -1, -1, -1, -1, -1,
                                                      -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

// From `first` of them on.
template <typename L>
LKS_FORCE_INLINE Group<L> lane_mask(std::uint32_t first) {
    return {L::load(lane_bits + first), L::load(lane_bits + first + L::half)};
}

// How far both ends of a group are from each other along an axis.
template <typename L, typename Access>
struct AxisDifferences {
    const Access& at;
    const std::int64_t* const* axes;

    LKS_FORCE_INLINE Group<L> operator()(int axis) const {
        const Group<L> a = at.load_a(axes[axis]);
        const Group<L> b = at.load_b(axes[axis]);
        return {L::subtract(a.a, b.a), L::subtract(a.b, b.b)};
    }
};

// A stretch in which both ends advance by one.
template <typename L>
struct RunAccess {
    static constexpr std::uint32_t together = L::together;
    static constexpr bool whole = true;
    static constexpr bool in_rows = false;

    std::uint32_t constraint;
    std::ptrdiff_t a;
    std::ptrdiff_t b;
    // So many at its beginning have been in a group before, and stay as they are.
    std::uint32_t done;

    std::uint32_t first_constraint() const { return constraint; }

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t lane = done; lane < 2 * L::half; ++lane) {
            use(constraint + lane, a + place_of(lane), b + place_of(lane));
        }
    }
    // Nothing for them.
    LKS_FORCE_INLINE void clear_done(Factors<L>& values) const {
        if (done != 0) {
            values = FactorsOf<L>::where(FactorsOf<L>::low(lane_mask<L>(widest_group - done)), values);
        }
    }

    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::load(x + a), L::load(x + a + L::half)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::load(x + b), L::load(x + b + L::half)};
    }
    // x_a += plus_a, x_b −= minus_b.
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        std::int64_t* x_a = as_it_stands(x + a);
        std::int64_t* x_b = as_it_stands(x + b);
        const Group<L> at_a{L::load(x_a), L::load(x_a + L::half)};
        const Group<L> at_b{L::load(x_b), L::load(x_b + L::half)};
        L::store(x_a, L::add(at_a.a, plus_a.a));
        L::store(x_a + L::half, L::add(at_a.b, plus_a.b));
        L::store(x_b, L::subtract(at_b.a, minus_b.a));
        L::store(x_b + L::half, L::subtract(at_b.b, minus_b.b));
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        return {L::load(values + constraint), L::load(values + constraint + L::half)};
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        L::store(values + constraint, group.a);
        L::store(values + constraint + L::half, group.b);
    }
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const {
        return FactorsOf<L>::load(values + constraint);
    }
};

// The first `count` lanes of a stretch; the others are not part of it, and do not move.
template <typename L>
struct PartialAccess {
    static constexpr std::uint32_t together = L::together;
    static constexpr bool whole = false;
    static constexpr bool in_rows = false;

    RunAccess<L> run;
    std::uint32_t count;
    // Whether the particles of the other lanes may be read, and written as they are.
    bool loads_whole;
    bool stores_whole;

    std::uint32_t first_constraint() const { return run.constraint; }
    LKS_FORCE_INLINE Group<L> masked(const Group<L>& values) const {
        const Group<L> mask = lane_mask<L>(2 * widest_group - count);
        return {L::bit_and(values.a, mask.a), L::bit_and(values.b, mask.b)};
    }
    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return loads_whole ? run.load_a(x) : load_lanes(x + run.a);
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return loads_whole ? run.load_b(x) : load_lanes(x + run.b);
    }
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        if (stores_whole) {
            run.move(x, plus_a, minus_b);
            return;
        }
        const LaneValues<L> a(plus_a);
        const LaneValues<L> b(minus_b);
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            std::int64_t* x_a = x + run.a + lane;
            std::int64_t* x_b = x + run.b + lane;
            *x_a = wrapping_add(*x_a, a.values[lane]);
            *x_b = wrapping_subtract(*x_b, b.values[lane]);
        }
    }
    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        return load_lanes(values + run.constraint);
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        store_lanes(values + run.constraint, group);
    }
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const { return run.load(values); }
    // Those have no difference.
    static void clear_done(const Factors<L>&) {}

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            use(run.constraint + lane, run.a + place_of(lane), run.b + place_of(lane));
        }
    }

private:
    Group<L> load_lanes(const std::int64_t* x) const {
        std::int64_t values[2 * L::half] = {};
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            values[lane] = x[lane];
        }
        return {L::load(values), L::load(values + L::half)};
    }
    void store_lanes(std::int64_t* x, const Group<L>& group) const {
        const LaneValues<L> lanes(group);
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            x[lane] = lanes.values[lane];
        }
    }
};

// Constraints that follow each other in the batch, with ends anywhere. `full`: there are as many as lanes;
// otherwise lanes from `count` on repeat the first one and are not moved.
template <typename L, bool full>
struct ListedConstraints {
    static constexpr std::uint32_t lanes = 2 * L::half;
    static constexpr bool whole = true;

    std::uint32_t constraint;
    std::uint32_t count;
    std::conditional_t<full, const Constraint*, Constraint[lanes]> ends;

    std::uint32_t first_constraint() const { return constraint; }
    static void clear_done(const Factors<L>&) {}

    void take(const Constraint* constraints, std::uint32_t first, std::uint32_t number) {
        constraint = first;
        count = number;
        if constexpr (full) {
            ends = constraints + first;
        } else {
            for (std::uint32_t i = 0; i < lanes; ++i) {
                ends[i] = constraints[first + (i < number ? i : 0)];
            }
        }
    }

    LKS_FORCE_INLINE Group<L> load_wide(const std::int64_t* values) const {
        std::int64_t parts[lanes] = {};
        for (std::uint32_t i = 0; i < count; ++i) {
            parts[i] = values[constraint + i];
        }
        return {L::load(parts), L::load(parts + L::half)};
    }
    LKS_FORCE_INLINE void store_wide(std::int64_t* values, const Group<L>& group) const {
        const LaneValues<L> parts(group);
        for (std::uint32_t i = 0; i < count; ++i) {
            values[constraint + i] = parts.values[i];
        }
    }
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const {
        return FactorsOf<L>::load(values + constraint);
    }

protected:
    // Each with the places of its ends in arrays with `stride` numbers a particle.
    template <std::ptrdiff_t stride, typename Use>
    LKS_FORCE_INLINE void for_each_place(const Use& use) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            use(constraint + i, stride * place_of(ends[i].a), stride * place_of(ends[i].b));
        }
    }
    template <std::ptrdiff_t stride>
    LKS_FORCE_INLINE void move_each(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        const LaneValues<L> a(plus_a);
        const LaneValues<L> b(minus_b);
        for (std::uint32_t i = 0; i < count; ++i) {
            std::int64_t* x_a = x + stride * place_of(ends[i].a);
            std::int64_t* x_b = x + stride * place_of(ends[i].b);
            *x_a = wrapping_add(*x_a, a.values[i]);
            *x_b = wrapping_subtract(*x_b, b.values[i]);
        }
    }
};

// In arrays, from which each lane is gathered.
template <typename L>
struct SinglesAccess : ListedConstraints<L, false> {
    static constexpr std::uint32_t together = L::singles_together;
    static constexpr std::ptrdiff_t stride = 1;
    static constexpr bool in_rows = false;

    template <typename Use>
    void for_each(const Use& use) const {
        this->template for_each_place<stride>(use);
    }
    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::gather(x, &this->ends[0].a), L::gather(x, &this->ends[L::half].a)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::gather(x, &this->ends[0].b), L::gather(x, &this->ends[L::half].b)};
    }
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        this->template move_each<stride>(x, plus_a, minus_b);
    }
};

// In rows.
template <typename L, bool full>
struct RowsAccess : ListedConstraints<L, full> {
    static constexpr std::uint32_t together = L::together;
    static constexpr std::ptrdiff_t stride = row_length;
    static constexpr bool in_rows = true;

    template <typename Use>
    void for_each(const Use& use) const {
        this->template for_each_place<stride>(use);
    }

    // Of both ends, along each axis.
    struct Differences {
        Group<L> along[3];
        LKS_FORCE_INLINE const Group<L>& operator()(int axis) const { return along[axis]; }
    };
    LKS_FORCE_INLINE Differences differences(const std::int64_t* rows) const {
        typename L::Register a[3];
        typename L::Register b[3];
        L::row_differences(rows, &this->ends[0].a, a);
        L::row_differences(rows, &this->ends[L::half].a, b);
        return {{{a[0], b[0]}, {a[1], b[1]}, {a[2], b[2]}}};
    }
    LKS_FORCE_INLINE void move(std::int64_t* rows, const Group<L>& plus_x, const Group<L>& plus_y,
                               const Group<L>& plus_z, const Group<L>& minus_x, const Group<L>& minus_y,
                               const Group<L>& minus_z) const {
        if (full || this->count == this->lanes) [[likely]] {
            L::move_rows(rows, &this->ends[0].a, {plus_x.a, plus_y.a, plus_z.a},
                         {minus_x.a, minus_y.a, minus_z.a});
            L::move_rows(rows, &this->ends[L::half].a, {plus_x.b, plus_y.b, plus_z.b},
                         {minus_x.b, minus_y.b, minus_z.b});
        } else {
            this->template move_each<stride>(rows, plus_x, minus_x);
            this->template move_each<stride>(rows + 1, plus_y, minus_y);
            this->template move_each<stride>(rows + 2, plus_z, minus_z);
        }
    }
};

} // namespace
} // namespace lks
