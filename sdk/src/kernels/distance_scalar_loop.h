// A range of one batch by plain integers, one constraint after the other.
#pragma once

#include "kernels/distance_scalar.h"

namespace lks {
namespace {

// Calls use(constraint, particle a, particle b, count, spare) for the stretches of the range in which both
// ends advance by one.
template <typename Use>
inline void visit_runs(const DistanceTask& task, const Use& use) {
    for (std::uint32_t r = 0; r < task.run_count; ++r) {
        const Run run = task.runs[r];
        if (run.first >= task.range.last) {
            return;
        }
        const std::uint32_t first = run.first < task.range.first ? task.range.first : run.first;
        const std::uint32_t end = run.first + run.count;
        const std::uint32_t last = end < task.range.last ? end : task.range.last;
        // What follows a run that the range cuts is another one's to touch.
        const std::uint32_t spare = last == end ? run.spare : 0;
        use(first, run.a + (first - run.first), run.b + (first - run.first), last - first, spare);
    }
}

// Calls use(constraint) for the constraints of the range that belong to no run.
template <typename Use>
inline void visit_singles(const DistanceTask& task, const Use& use) {
    const std::uint32_t first = task.first_single < task.range.first ? task.range.first : task.first_single;
    for (std::uint32_t i = first; i < task.range.last; ++i) {
        use(i);
    }
}

template <bool equal_shares, bool soft, bool damped, bool multiplier>
inline void project_in_turn(const DistanceTask& task) {
    const Projection<equal_shares, soft, damped, multiplier> project(task);
    visit_runs(task, [&](std::uint32_t constraint, std::uint32_t a, std::uint32_t b, std::uint32_t count,
                         std::uint32_t) {
        for (std::uint32_t i = 0; i < count; ++i) {
            project(constraint + i, a + i, b + i);
        }
    });
    visit_singles(task, [&](std::uint32_t constraint) {
        project(constraint, task.constraints[constraint].a, task.constraints[constraint].b);
    });
}

template <bool equal_shares, bool multiplier>
inline void project_family_in_turn(const DistanceTask& task) {
    if (!task.soft) {
        project_in_turn<equal_shares, false, false, multiplier>(task);
    } else if (!task.damped) {
        project_in_turn<equal_shares, true, false, multiplier>(task);
    } else {
        project_in_turn<equal_shares, true, true, multiplier>(task);
    }
}

inline void project_scalar(const DistanceTask& task) {
    if (task.arrays.multipliers == nullptr) {
        task.equal_shares ? project_family_in_turn<true, false>(task)
                          : project_family_in_turn<false, false>(task);
    } else {
        task.equal_shares ? project_family_in_turn<true, true>(task)
                          : project_family_in_turn<false, true>(task);
    }
}

} // namespace
} // namespace lks
