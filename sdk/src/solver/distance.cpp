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

} // namespace

DistanceTask whole_batch(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t index,
                         const DistanceArrays& arrays) {
    const Batch& batch = asset.batches[index];
    const BatchCoefficients& batch_coefficients = coefficients.batches[index];
    const FamilyCoefficients& family = coefficients.families[batch.family];
    return {{batch.first, batch.first + batch.count},
            asset.runs.data() + batch.first_run,
            batch.run_count,
            true,
            batch.first_single - batch.first < batch.run_count * widest_group,
            batch.first_single,
            asset.constraints.data(),
            asset.rest_mantissas.data(),
            coefficients.shares_a.data(),
            coefficients.shares_b.data(),
            coefficients.relaxations.empty() ? nullptr : coefficients.relaxations.data(),
            batch_coefficients.parameters,
            arrays,
            batch_coefficients.equal_shares,
            family.soft,
            family.damping_share != 0};
}

DistanceTask part_of_batch(const DistanceTask& whole, const lks_asset& asset, std::uint32_t index,
                           ConstraintRange range) {
    const Batch& batch = asset.batches[index];
    DistanceTask part = whole;
    part.range = range;
    part.whole_batch = range.first == whole.range.first && range.last == whole.range.last;
    part.runs = find_run(asset, batch, range.first);
    part.run_count = batch.run_count - static_cast<std::uint32_t>(part.runs - whole.runs);
    return part;
}

} // namespace lks
