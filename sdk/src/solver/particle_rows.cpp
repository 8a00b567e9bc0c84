#include "solver/particle_rows.h"

#include <algorithm>
#include <iterator>

namespace lks {
namespace {

// With fewer, what taking them costs is more than what they save.
constexpr std::uint32_t least_constraints = 192;

bool gains_by_rows(const lks_asset& asset, const Coefficients& coefficients) {
    std::uint32_t in_runs = 0;
    for (const Batch& batch : asset.batches) {
        in_runs += batch.first_single - batch.first;
    }
    return coefficients.chain.empty() && asset.constraint_count() >= least_constraints &&
           in_runs < asset.constraint_count() / 2;
}

std::size_t words(const lks_asset& asset) {
    const std::size_t groups = (asset.vertex_count() + widest_group - 1) / widest_group;
    return groups * widest_group * row_length;
}

} // namespace

bool is_swept_in_rows(const Kernels& kernels, const lks_asset& asset, const Coefficients& coefficients) {
    return kernels.rows.take != nullptr && gains_by_rows(asset, coefficients);
}

std::size_t row_words(const lks_asset& asset, const Coefficients& coefficients) {
    const bool damped = std::any_of(std::begin(asset.families), std::end(asset.families),
                                    [](const Family& family) { return family.damping.mantissa != 0; });
    return gains_by_rows(asset, coefficients) ? (damped ? 2 : 1) * words(asset) : 0;
}

ParticleRows::ParticleRows(Object& object, std::int64_t* scratch)
    : positions_{object.axis(0), object.axis(1), object.axis(2), scratch}, starts_{object.start_axis(0),
                                                                                   object.start_axis(1),
                                                                                   object.start_axis(2),
                                                                                   nullptr},
      damped_(false), multipliers_(object.multipliers.empty() ? nullptr : object.multipliers.data()) {
    for (const FamilyCoefficients& family : object.coefficients().families) {
        damped_ = damped_ || family.damping_share != 0;
    }
    if (damped_) {
        starts_.rows = scratch + words(object.asset());
    }
}

DistanceArrays ParticleRows::arrays() const {
    const auto axis = [](std::int64_t* rows, int index) { return rows == nullptr ? nullptr : rows + index; };
    return {axis(positions_.rows, 0),
            axis(positions_.rows, 1),
            axis(positions_.rows, 2),
            axis(starts_.rows, 0),
            axis(starts_.rows, 1),
            axis(starts_.rows, 2),
            multipliers_};
}

void ParticleRows::take(const Kernels& kernels, std::uint32_t first, std::uint32_t count) const {
    kernels.rows.take(positions_, first, count);
    if (damped_) {
        kernels.rows.take(starts_, first, count);
    }
}

void ParticleRows::give_back(const Kernels& kernels, std::uint32_t first, std::uint32_t count) const {
    kernels.rows.give_back(positions_, first, count);
}

} // namespace lks
