// Batches of several objects of one asset, side by side: a group of one object is followed by the same group
// of the next, so that groups roll however short an object's runs are. What runs have left over goes over
// lanes, the same constraint of an object in each.
#pragma once

#include <algorithm>

#include "kernels/distance_rolling.h"
#include "kernels/distance_scalar_loop.h"

namespace lks {
namespace {

// One constraint of so many objects; lanes from `count` on are not stored.
template <typename L>
struct AcrossAccess {
    static constexpr std::uint32_t lanes = 2 * L::half;
    static constexpr std::uint32_t together = L::singles_together;
    static constexpr bool whole = true;
    static constexpr bool in_rows = false;

    std::uint32_t constraint;
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t count;
    const std::ptrdiff_t* objects; // by lane; those behind the last are somebody's

    std::uint32_t first_constraint() const { return constraint; }

    template <typename Use>
    void for_each(const Use& use) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            use(constraint, objects[i] + place_of(a), objects[i] + place_of(b));
        }
    }
    static void clear_done(const Factors<L>&) {}

    LKS_FORCE_INLINE Group<L> load_a(const std::int64_t* x) const {
        return {L::gather(x + a, objects), L::gather(x + a, objects + L::half)};
    }
    LKS_FORCE_INLINE Group<L> load_b(const std::int64_t* x) const {
        return {L::gather(x + b, objects), L::gather(x + b, objects + L::half)};
    }
    LKS_FORCE_INLINE void move(std::int64_t* x, const Group<L>& plus_a, const Group<L>& minus_b) const {
        const LaneValues<L> of_a(plus_a);
        const LaneValues<L> of_b(minus_b);
        for (std::uint32_t i = 0; i < count; ++i) {
            std::int64_t* at = x + objects[i];
            at[a] = wrapping_add(at[a], of_a.values[i]);
            at[b] = wrapping_subtract(at[b], of_b.values[i]);
        }
    }
    LKS_FORCE_INLINE Factors<L> load(const std::uint32_t* values) const {
        return FactorsOf<L>::splat(FactorsOf<L>::constant(values[constraint]));
    }
};

template <typename L, typename Groups, typename Stage>
class SideBySide {
public:
    SideBySide(const DistanceTask& task, const BatchPart& part, const Groups& groups, const Stage& stages)
        : part_(part), groups_(groups), stages_(stages), by_parts_(are_many_unequal(part)),
          object_count_(task.object_count) {
        for (std::uint32_t i = 0; i < most_side_by_side + lanes; ++i) {
            objects_[i] = task.objects[i < object_count_ ? i : 0];
        }
    }

    void project() { by_parts_ ? roll<Ends::by_parts>() : roll<Ends::alike>(); }

    // The next group that rolls. False: there is none.
    bool take_one(RunAccess<L>& next) {
        while (!take_more(next)) {
            finish_run();
            if (next_ == part_.run_count) {
                return false;
            }
            begin_run(run_part(part_, next_++));
        }
        return true;
    }
    // The next one of the same run.
    LKS_FORCE_INLINE bool take_more(RunAccess<L>& next) {
        if (object_ == object_count_) {
            object_ = 0;
            next_group();
        }
        if (at_ >= in_groups_) {
            return false;
        }
        next = of_object(object_++);
        return true;
    }

private:
    static constexpr std::uint32_t lanes = 2 * L::half;

    template <Ends ends>
    LKS_NEVER_INLINE void roll() {
        Rolling<L, ends, RunAccess<L>, Groups, Stage>(groups_, stages_).project(*this);
    }

    // Whether a quarter of the groups have ends with shares of their own: then all roll by parts.
    static bool are_many_unequal(const BatchPart& part) {
        const ConstraintRange range = part.range;
        const std::uint32_t first = std::max(range.first, part.unequal_shares.first);
        const std::uint32_t last = std::min(range.last, part.unequal_shares.last);
        if (first >= last) {
            return false;
        }
        const std::uint32_t unequal =
            (last - range.first + lanes - 1) / lanes - (first - range.first) / lanes;
        return 4 * unequal >= (range.last - range.first) / lanes;
    }

    LKS_FORCE_INLINE RunAccess<L> of_object(std::uint32_t object) const {
        const std::uint32_t done = at_ + lanes > in_groups_ ? at_ + lanes - in_groups_ : 0;
        const std::uint32_t from = at_ - done;
        return {run_.constraint + from, objects_[object] + place_of(run_.a + from),
                objects_[object] + place_of(run_.b + from), done};
    }

    void next_group() {
        at_ += lanes;
        if (at_ == first_apart_) {
            at_ = last_apart_;
        }
    }

    void begin_run(const RunPart& run) {
        run_ = run;
        object_ = 0;
        const std::uint32_t left = run.count % lanes;
        in_groups_ = left <= L::worth_across || run.count < lanes ? run.count - left : run.count;
        find_apart();
        for (at_ = first_apart_; at_ < last_apart_; at_ += lanes) {
            project_apart();
        }
        at_ = first_apart_ == 0 ? last_apart_ : 0;
    }

    // Groups of which ends may have shares of their own don't roll, unless all roll by parts.
    void find_apart() {
        const ConstraintRange unequal = part_.unequal_shares;
        const auto in_run = [&](std::uint32_t constraint) {
            return constraint <= run_.constraint ? 0 : std::min(constraint - run_.constraint, in_groups_);
        };
        const std::uint32_t first = in_run(unequal.first);
        const std::uint32_t last = in_run(unequal.last);
        first_apart_ = first / lanes * lanes;
        last_apart_ = (last + lanes - 1) / lanes * lanes;
        if (by_parts_ || first == last) {
            first_apart_ = last_apart_ = in_groups_ + lanes;
        }
    }

    void project_apart() {
        RunAccess<L> groups[L::together];
        for (std::uint32_t first = 0; first < object_count_; first += L::together) {
            const std::uint32_t count = std::min(object_count_ - first, L::together);
            for (std::uint32_t i = 0; i < count; ++i) {
                groups[i] = of_object(first + i);
            }
            stages_.project_apart(groups, count);
        }
    }

    void finish_run() {
        AcrossAccess<L> groups[AcrossAccess<L>::together];
        std::uint32_t count = 0;
        for (std::uint32_t i = in_groups_; i < run_.count; ++i) {
            for (std::uint32_t first = 0; first < object_count_; first += lanes) {
                groups[count++] = {run_.constraint + i, run_.a + i, run_.b + i,
                                   std::min(object_count_ - first, lanes), objects_ + first};
                if (count == AcrossAccess<L>::together) {
                    stages_.project_apart(groups, count);
                    count = 0;
                }
            }
        }
        if (count != 0) {
            stages_.project_apart(groups, count);
        }
        in_groups_ = run_.count = 0;
    }

    const BatchPart& part_;
    const Groups& groups_;
    const Stage& stages_;
    bool by_parts_;
    std::ptrdiff_t objects_[most_side_by_side + lanes];
    std::uint32_t object_count_;
    std::uint32_t next_ = 0; // run
    RunPart run_{};
    std::uint32_t object_ = 0;
    std::uint32_t at_ = 0;
    std::uint32_t in_groups_ = 0;
    std::uint32_t first_apart_ = 0;
    std::uint32_t last_apart_ = 0;
};

} // namespace
} // namespace lks
