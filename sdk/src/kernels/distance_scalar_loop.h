// Batches by plain integers, one constraint after the other.
#pragma once

#include "kernels/distance_scalar.h"

namespace lks {
namespace {

// What a part has of one run.
struct RunPart {
    std::uint32_t constraint;
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t count;
    std::uint32_t spare;
};

// Of the run of this number; nothing where the part ends before it.
inline RunPart run_part(const BatchPart& part, std::uint32_t index) {
    const Run run = part.runs[index];
    if (run.first >= part.range.last) {
        return {};
    }
    const std::uint32_t first = run.first < part.range.first ? part.range.first : run.first;
    const std::uint32_t end = run.first + run.count;
    const std::uint32_t last = end < part.range.last ? end : part.range.last;
    // What follows a run that the range cuts is another one's to touch.
    return {first, run.a + (first - run.first), run.b + (first - run.first), last - first,
            last == end ? run.spare : 0};
}

// The constraints of the part that belong to no run.
inline ConstraintRange singles(const BatchPart& part) {
    const std::uint32_t first = part.first_single < part.range.first ? part.range.first : part.first_single;
    return {first < part.range.last ? first : part.range.last, part.range.last};
}

template <bool soft, bool damped, bool multiplier>
inline void project_in_turn(const DistanceTask& task) {
    const Projection<soft, damped, multiplier> project(task);
    for (std::uint32_t p = 0; p < task.part_count; ++p) {
        const BatchPart& part = task.parts[p];
        for (std::uint32_t r = 0; r < part.run_count; ++r) {
            const RunPart run = run_part(part, r);
            for (std::uint32_t i = 0; i < run.count; ++i) {
                project(run.constraint + i, place_of(run.a + i), place_of(run.b + i));
            }
        }
        const ConstraintRange rest = singles(part);
        for (std::uint32_t i = rest.first; i < rest.last; ++i) {
            project(i, place_of(task.constraints[i].a), place_of(task.constraints[i].b));
        }
    }
}

template <bool multiplier>
inline void project_family_in_turn(const DistanceTask& task) {
    if (!task.soft) {
        project_in_turn<false, false, multiplier>(task);
    } else if (!task.damped) {
        project_in_turn<true, false, multiplier>(task);
    } else {
        project_in_turn<true, true, multiplier>(task);
    }
}

inline void project_scalar(const DistanceTask& task) {
    if (task.arrays.multipliers == nullptr) {
        project_family_in_turn<false>(task);
    } else {
        project_family_in_turn<true>(task);
    }
}

} // namespace
} // namespace lks
