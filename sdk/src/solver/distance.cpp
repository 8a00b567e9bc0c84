#include "solver/distance.h"

#include <algorithm>

namespace lks {
namespace {

// The first of a batch's runs that reaches beyond `first`.
const Run* find_run(const lks_asset& asset, const Batch& batch, std::uint32_t first) {
    const Run* runs = asset.runs.data() + batch.first_run;
    return std::upper_bound(runs, runs + batch.run_count, first,
                            [](std::uint32_t i, const Run& run) { return i < run.first + run.count; });
}

BatchPart whole_batch(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t index) {
    const Batch& batch = asset.batches[index];
    return {{batch.first, batch.first + batch.count},
            asset.runs.data() + batch.first_run,
            batch.run_count,
            batch.first_single,
            coefficients.batches[index].unequal_shares,
            coefficients.batches[index].unequal_count <= batch.count / 32,
            true};
}

DistanceTask task_of_batch(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t index,
                           const DistanceArrays& arrays, bool in_rows) {
    const Batch& batch = asset.batches[index];
    const FamilyCoefficients& family = coefficients.families[batch.family];
    return {nullptr,
            0,
            !in_rows && batch.first_single - batch.first < batch.run_count * widest_group,
            family.soft,
            family.damping_share != 0,
            in_rows,
            coefficients.batches[index].parameters,
            asset.constraints.data(),
            asset.rest_mantissas.data(),
            coefficients.shares.data(),
            coefficients.parts_b.data(),
            coefficients.relaxations.empty() ? nullptr : coefficients.relaxations.data(),
            arrays,
            nullptr,
            1};
}

bool alike(const DistanceTask& a, const DistanceTask& b) {
    return a.short_runs == b.short_runs && a.soft == b.soft && a.damped == b.damped &&
           a.parameters == b.parameters;
}

} // namespace

void DistanceWork::set_allocator(const lks_allocator& allocator) {
    parts.set_allocator(allocator);
    tasks.set_allocator(allocator);
}

bool DistanceWork::reserve(std::size_t batches) {
    return parts.reserve(batches) && tasks.reserve(batches);
}

void prepare_distances(const lks_asset& asset, const Coefficients& coefficients, const DistanceArrays& arrays,
                       bool in_rows, DistanceWork& work) {
    work.parts.clear();
    work.tasks.clear();
    for (std::uint32_t index = 0; index < asset.batches.size(); ++index) {
        const DistanceTask task = task_of_batch(asset, coefficients, index, arrays, in_rows);
        const bool goes_on = index != 0 && asset.batches[index].family == asset.batches[index - 1].family &&
                             alike(task, work.tasks[work.tasks.size() - 1]);
        if (!goes_on) {
            work.tasks.push_reserved(task);
            work.tasks[work.tasks.size() - 1].parts = work.parts.data() + index;
        }
        work.parts.push_reserved(whole_batch(asset, coefficients, index));
        ++work.tasks[work.tasks.size() - 1].part_count;
    }
}

BatchPart part_of_batch(const BatchPart& whole, const lks_asset& asset, std::uint32_t index,
                        ConstraintRange range) {
    const Batch& batch = asset.batches[index];
    BatchPart part = whole;
    part.range = range;
    part.whole = range.first == whole.range.first && range.last == whole.range.last;
    part.runs = find_run(asset, batch, range.first);
    part.run_count = batch.run_count - static_cast<std::uint32_t>(part.runs - whole.runs);
    return part;
}

} // namespace lks
