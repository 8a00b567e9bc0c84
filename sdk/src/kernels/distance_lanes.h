// Batches of constraints, groups of 2·L::half at a time: kernels/distance_scalar.h over lanes.
//
// L is one instruction set: registers of L::half 64-bit lanes and a few operations on them. A group of
// constraints is two registers of coordinates, A and B; what is 32 bits wide is kept where 32×32→64
// multiplications find it, and worked on in one register (kernels/factors.h). Some groups go through
// each stage together (differences, corrections, movements): a group's steps wait for each other, and the
// steps of its neighbours fill the time. Where many follow each other they roll (kernels/distance_rolling.h).
// A group in which a lane leaves the fast range (an edge 2^30 units
// long, or shorter than 2^16) is projected in plain integers, which gives the same bits.
#pragma once

#include <algorithm>

#include "kernels/distance_groups.h"
#include "kernels/distance_rolling.h"
#include "kernels/distance_scalar_loop.h"
#include "kernels/distance_side_by_side.h"

namespace lks {
namespace {

// Takes groups that touch no common particle through the stages together.
template <typename L, typename Groups, typename ProjectOne>
class Stages {
public:
    Stages(const Groups& groups, const ProjectOne& project_one, ConstraintRange unequal_shares)
        : groups_(groups), project_one_(project_one), unequal_(groups_into(unequal_shares)) {}

    template <typename Access>
    LKS_FORCE_INLINE void project(const Access* at, std::uint32_t count) const {
        if constexpr (Access::together == 1) {
            project_alone(*at);
            return;
        }
        StagedGroup<L> staged[Access::together];
        for (std::uint32_t i = 0; i < count; ++i) {
            groups_.find_differences(at[i], staged[i]);
        }
        find_corrections<L::interleaved>(at, staged, count);
        bool alike = true;
        for (std::uint32_t i = 0; i < count; ++i) {
            at[i].clear_done(staged[i].f);
            alike = alike && !may_differ(at[i]);
        }
        alike ? move_each<true>(at, staged, count) : move_each<false>(at, staged, count);
    }
    // By itself, in registers from one stage to the next.
    template <typename Access>
    LKS_FORCE_INLINE void project_alone(const Access& at) const {
        StagedGroup<L> group;
        groups_.find_differences(at, group);
        groups_.template find_corrections<1>(&at, &group);
        at.clear_done(group.f);
        move<false>(at, group);
    }
    // What is rare, and would only be in the way of what is not.
    template <typename Access>
    LKS_NEVER_INLINE void project_apart(const Access* at, std::uint32_t count) const {
        project(at, count);
    }
    template <typename Access>
    LKS_NEVER_INLINE void move_apart(const Access& at, const StagedGroup<L>& group) const {
        move<false>(at, group);
    }
    // Its ends may have shares of their own.
    template <typename Access>
    LKS_FORCE_INLINE bool may_differ(const Access& at) const {
        return is_in(unequal_, at.first_constraint());
    }
    LKS_NEVER_INLINE void project_one(std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b) const {
        project_one_(constraint, a, b);
    }

private:
    // Where groups begin that reach into the range.
    static ConstraintRange groups_into(ConstraintRange range) {
        if (range.first == range.last) {
            return range;
        }
        // Before the first constraint of all it wraps around, and is_in as well.
        return {range.first - (2 * L::half - 1), range.last};
    }

    // As many at once as can be.
    template <std::uint32_t n, typename Access>
    LKS_FORCE_INLINE void find_corrections(const Access* at, StagedGroup<L>* staged,
                                           std::uint32_t count) const {
        for (; count >= n; count -= n) {
            groups_.template find_corrections<n>(at, staged);
            at += n;
            staged += n;
        }
        if constexpr (n > 1) {
            find_corrections<n - 1>(at, staged, count);
        }
    }

    template <bool alike, typename Access>
    LKS_FORCE_INLINE void move_each(const Access* at, const StagedGroup<L>* staged,
                                    std::uint32_t count) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            move<alike>(at[i], staged[i]);
        }
    }

    // `alike`: its shares are known to be equal.
    template <bool alike, typename Access>
    LKS_FORCE_INLINE void move(const Access& at, const StagedGroup<L>& group) const {
        if (group.plain) {
            at.for_each([this](std::uint32_t constraint, std::ptrdiff_t a, std::ptrdiff_t b) {
                project_one(constraint, a, b);
            });
        } else if (alike || !may_differ(at)) {
            groups_.template move<true>(at, group);
        } else {
            groups_.template move<false>(at, group);
        }
    }

    const Groups& groups_;
    const ProjectOne& project_one_;
    ConstraintRange unequal_;
};

// Takes a part's runs apart: into whole groups, the last of a run over lanes that were in the one before it,
// into groups that are not filled where a run is shorter than a group, and into what is better off alone.
template <typename L, typename Stage>
class RunGroups {
public:
    RunGroups(const BatchPart& part, const Stage& stages) : part_(part), stages_(stages) {}

    // The next whole groups, of which there are fewer than L::together at the end only.
    LKS_FORCE_INLINE std::uint32_t take(RunAccess<L>* groups) {
        std::uint32_t taken = 0;
        for (;;) {
            for (; at_ < in_groups_; at_ += lanes) {
                if (taken == L::together) {
                    return taken;
                }
                groups[taken++] = group();
            }
            if (next_ == part_.run_count) {
                return taken;
            }
            begin_run(run_part(part_, next_++));
        }
    }

    // The next one. False: there is none.
    bool take_one(RunAccess<L>& next) {
        while (!take_more(next)) {
            if (next_ == part_.run_count) {
                return false;
            }
            begin_run(run_part(part_, next_++));
        }
        return true;
    }
    // The next one of the same run.
    LKS_FORCE_INLINE bool take_more(RunAccess<L>& next) {
        if (at_ >= in_groups_) {
            return false;
        }
        next = group();
        at_ += lanes;
        return true;
    }

    // All of them, one after the other.
    LKS_FORCE_INLINE void project_in_turn() {
        while (next_ != part_.run_count) {
            begin_run(run_part(part_, next_++));
            for (; at_ < in_groups_; at_ += lanes) {
                stages_.project_alone(group());
            }
        }
    }

    void finish() {
        if (short_count_ != 0) {
            stages_.project_apart(short_, short_count_);
        }
    }

private:
    static constexpr std::uint32_t lanes = 2 * L::half;

    LKS_FORCE_INLINE RunAccess<L> group() const {
        const std::uint32_t done = at_ + lanes > in_groups_ ? at_ + lanes - in_groups_ : 0;
        const std::uint32_t from = at_ - done;
        return {run_.constraint + from, place_of(run_.a + from), place_of(run_.b + from), done};
    }

    void begin_run(const RunPart& run) {
        run_ = run;
        at_ = 0;
        const std::uint32_t left = run.count % lanes;
        const bool alone = left < L::worth_a_group;
        in_groups_ = alone ? run.count - left : run.count < lanes ? 0 : run.count;
        if (alone) {
            for (std::uint32_t i = in_groups_; i < run.count; ++i) {
                stages_.project_one(run.constraint + i, place_of(run.a + i), place_of(run.b + i));
            }
        } else if (run.count < lanes) {
            add_short();
        }
    }

    void add_short() {
        const bool spares = run_.count + run_.spare >= lanes;
        // Lanes behind the end are read, so nobody else may write them meanwhile.
        short_[short_count_++] = {{run_.constraint, place_of(run_.a), place_of(run_.b), 0},
                                  run_.count,
                                  spares || part_.whole,
                                  spares};
        if (short_count_ == PartialAccess<L>::together) {
            stages_.project_apart(short_, short_count_);
            short_count_ = 0;
        }
    }

    const BatchPart& part_;
    const Stage& stages_;
    std::uint32_t next_ = 0; // run
    RunPart run_{};
    std::uint32_t at_ = 0;
    std::uint32_t in_groups_ = 0;
    std::uint32_t short_count_ = 0;
    PartialAccess<L> short_[PartialAccess<L>::together];
};

template <typename L, Ends ends, typename Groups, typename Stage>
LKS_NEVER_INLINE void project_rolling(const BatchPart& part, const Groups& groups, const Stage& stages) {
    RunGroups<L, Stage> runs(part, stages);
    Rolling<L, ends, RunAccess<L>, Groups, Stage>(groups, stages).project(runs);
    runs.finish();
}

template <typename L, typename Stage>
inline void project_in_stages(const BatchPart& part, const Stage& stages) {
    RunGroups<L, Stage> runs(part, stages);
    if constexpr (L::together == 1) {
        runs.project_in_turn();
    } else {
        RunAccess<L> groups[L::together];
        std::uint32_t count;
        while ((count = runs.take(groups)) == L::together) {
            stages.project(groups, L::together);
        }
        if (count != 0) {
            stages.project_apart(groups, count);
        }
    }
    runs.finish();
}

template <typename L, bool may_roll, typename Groups, typename Stage>
inline void project_runs(const BatchPart& part, const Groups& groups, const Stage& stages) {
    if constexpr (may_roll) {
        if (singles(part).first - part.range.first >= L::rolls_from) {
            const bool alike = part.unequal_shares.first == part.unequal_shares.last;
            alike              ? project_rolling<L, Ends::alike>(part, groups, stages)
            : part.few_unequal ? project_rolling<L, Ends::mixed>(part, groups, stages)
                               : project_rolling<L, Ends::by_parts>(part, groups, stages);
            return;
        }
    }
    project_in_stages<L>(part, stages);
}

template <typename L, typename Access, typename Stage>
inline void project_listed(const DistanceTask& task, ConstraintRange rest, const Stage& stages) {
    constexpr std::uint32_t lanes = Access::lanes;
    Access groups[Access::together];
    std::uint32_t count = 0;
    while (rest.first + L::worth_a_group <= rest.last) {
        const std::uint32_t number = std::min(rest.last - rest.first, lanes);
        groups[count++].take(task.constraints, rest.first, number);
        rest.first += number;
        if (count == Access::together || rest.first + L::worth_a_group > rest.last) {
            stages.project(groups, count);
            count = 0;
        }
    }
    for (; rest.first < rest.last; ++rest.first) {
        const Constraint& ends = task.constraints[rest.first];
        stages.project_one(rest.first, Access::stride * place_of(ends.a), Access::stride * place_of(ends.b));
    }
}

// Takes whole groups from the beginning of what is left of a batch.
template <typename Access>
class ListedGroups {
public:
    ListedGroups(const Constraint* constraints, ConstraintRange& rest)
        : constraints_(constraints), rest_(rest) {}

    bool take_one(Access& next) { return take_more(next); }
    LKS_FORCE_INLINE bool take_more(Access& next) {
        if (rest_.last - rest_.first < Access::lanes) {
            return false;
        }
        next.take(constraints_, rest_.first, Access::lanes);
        rest_.first += Access::lanes;
        return true;
    }

private:
    const Constraint* constraints_;
    ConstraintRange& rest_;
};

// What is left after it.
template <typename L, Ends ends, typename Groups, typename Stage>
LKS_NEVER_INLINE ConstraintRange project_rolling_rows(const DistanceTask& task, ConstraintRange rest,
                                                      const Groups& groups, const Stage& stages) {
    using Access = RowsAccess<L, true>;
    ListedGroups<Access> listed(task.constraints, rest);
    Rolling<L, ends, Access, Groups, Stage>(groups, stages).project(listed);
    return rest;
}

template <typename L, bool may_roll, typename Groups, typename Stage>
inline void project_rows(const DistanceTask& task, const BatchPart& part, const Groups& groups,
                         const Stage& stages) {
    ConstraintRange rest = part.range;
    if constexpr (may_roll) {
        if (rest.last - rest.first >= L::rolls_from) {
            rest = part.few_unequal ? project_rolling_rows<L, Ends::alike>(task, rest, groups, stages)
                                    : project_rolling_rows<L, Ends::by_parts>(task, rest, groups, stages);
        }
    }
    project_listed<L, RowsAccess<L, false>>(task, rest, stages);
}

template <typename L, bool soft, bool damped, bool multiplier>
inline void project_in_groups(const DistanceTask& task) {
    using Groups = DistanceGroups<L, soft, damped, multiplier>;
    using ProjectOne = Projection<soft, damped, multiplier>;
    const Groups groups(task);
    const ProjectOne project_one(task);
    for (std::uint32_t p = 0; p < task.part_count; ++p) {
        const BatchPart& part = task.parts[p];
        const Stages<L, Groups, ProjectOne> stages(groups, project_one, part.unequal_shares);
        if constexpr (L::has_rows) {
            if (task.in_rows) {
                project_rows<L, L::rolls_from != 0 && !multiplier>(task, part, groups, stages);
                continue;
            }
        }
        if constexpr (L::rolls_from != 0 && !multiplier) {
            if (task.objects != nullptr) {
                SideBySide<L, Groups, Stages<L, Groups, ProjectOne>>(task, part, groups, stages).project();
                continue;
            }
        }
        if (part.run_count != 0) {
            project_runs<L, L::rolls_from != 0 && !multiplier>(part, groups, stages);
        }
        if (part.first_single < part.range.last) {
            project_listed<L, SinglesAccess<L>>(task, singles(part), stages);
        }
    }
}

// One function for each kind of task, called through this table: linkers for WebAssembly would join what is
// called from one place alone, and engines allocate registers badly in functions of that size.
template <typename L>
constexpr void (*project_kinds[])(const DistanceTask&) = {
    project_in_groups<L, false, false, false>, project_in_groups<L, true, false, false>,
    project_in_groups<L, true, true, false>,   project_in_groups<L, false, false, true>,
    project_in_groups<L, true, false, true>,   project_in_groups<L, true, true, true>};

template <typename L>
inline void project_lanes(const DistanceTask& task) {
    const int softness = !task.soft ? 0 : !task.damped ? 1 : 2;
    project_kinds<L>[softness + (task.arrays.multipliers != nullptr ? 3 : 0)](task);
}

} // namespace
} // namespace lks
