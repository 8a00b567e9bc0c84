#include "solver/distance.h"

#include <algorithm>

#include "fixed/formats.h"

namespace lks {
namespace {

DistanceParameters distance_parameters(const Batch& batch, const BatchCoefficients& batch_coefficients,
                                       const FamilyCoefficients& family) {
    DistanceParameters parameters{};
    parameters.difference_shift = batch.difference_shift;
    parameters.rest_exponent = batch.rest_exponent;
    parameters.error_share = family.error_share;
    parameters.damping_share = family.damping_share;
    // A gain of difference_shift bits makes the product a coordinate as it stands. Where a shift is needed
    // anyway, it has 30 bits.
    const bool plain = batch_coefficients.share_exponent == 0;
    const int gain_bits = plain ? batch.difference_shift : direction_fraction_bits;
    parameters.gain_shift = unit_fraction_bits + direction_fraction_bits - gain_bits;
    parameters.product_shift = gain_bits - batch.difference_shift + batch_coefficients.share_exponent;
    return parameters;
}

// The first of a batch's runs that reaches beyond `first`.
std::uint32_t find_run(const lks_asset& asset, const Batch& batch, std::uint32_t first) {
    const Run* runs = asset.runs.data();
    const Run* found =
        std::upper_bound(runs + batch.first_run, runs + batch.first_run + batch.run_count, first,
                         [](std::uint32_t i, const Run& run) { return i < run.first + run.count; });
    return static_cast<std::uint32_t>(found - runs);
}

} // namespace

void project_distances(const lks_asset& asset, const Coefficients& coefficients, std::uint32_t batch_index,
                       ConstraintRange range, const DistanceArrays& arrays, const Kernels& kernels) {
    const Batch& batch = asset.batches[batch_index];
    const BatchCoefficients& batch_coefficients = coefficients.batches[batch_index];
    const FamilyCoefficients& family = coefficients.families[batch.family];
    const std::uint32_t first_run = find_run(asset, batch, range.first);
    kernels.project_distances(
        DistanceTask{range, asset.runs.data() + first_run, batch.first_run + batch.run_count - first_run,
                     range.first == batch.first && range.last == batch.first + batch.count,
                     batch.first_single - batch.first < batch.run_count * widest_group, batch.first_single,
                     asset.constraints.data(), asset.rest_mantissas.data(), coefficients.shares_a.data(),
                     coefficients.shares_b.data(),
                     coefficients.relaxations.empty() ? nullptr : coefficients.relaxations.data(),
                     distance_parameters(batch, batch_coefficients, family), arrays,
                     batch_coefficients.equal_shares, family.soft, family.damping_share != 0});
}

} // namespace lks
