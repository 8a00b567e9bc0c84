#include "solver/coefficients.h"

#include <algorithm>

#include "asset/rope_solver.h"
#include "fixed/formats.h"

namespace lks {
namespace {

using fixed::Scaled;

struct FamilyTerms {
    Scaled one_plus_gamma;
    Scaled gamma;
    Scaled softness; // α̃/(1+γ)
};

FamilyTerms family_terms(const Family& family, const StepRate& rate) {
    const Scaled inverse_h = rate.inverse_h();
    FamilyTerms terms;
    terms.gamma = family.compliance * family.damping * inverse_h;
    terms.one_plus_gamma = Scaled::from_u64(1) + terms.gamma;
    terms.softness = family.compliance * inverse_h * inverse_h / terms.one_plus_gamma;
    return terms;
}

// Unit, and below one by a unit at least, so that it is a positive 32-bit integer in the kernels.
std::uint32_t to_share(const Scaled& value, int extra_bits = 0) {
    const std::uint64_t raw = value.to_fixed(unit_fraction_bits + extra_bits);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(raw, unit_one - 1));
}

void include(ConstraintRange& range, std::uint32_t constraint) {
    if (range.first == range.last) {
        range = {constraint, constraint + 1};
    } else {
        range = {std::min(range.first, constraint), std::max(range.last, constraint + 1)};
    }
}

// ρ. Where nothing moves it is not a half: what moves alike and stiffly has a share that nobody reads.
std::uint32_t part_of_b(const Scaled& w_a, const Scaled& w_b) {
    if (w_a == w_b) {
        return w_a.is_zero() ? 0 : half_part;
    }
    return static_cast<std::uint32_t>((w_b / (w_a + w_b)).to_fixed(direction_fraction_bits));
}

DistanceParameters distance_parameters(const Batch& batch, std::int32_t share_exponent,
                                       const FamilyCoefficients& family) {
    // A gain of difference_shift bits makes the product a coordinate as it stands. Where a shift is needed
    // anyway, it has 30 bits.
    const int gain_bits = share_exponent == 0 ? batch.difference_shift : direction_fraction_bits;
    DistanceParameters parameters{};
    parameters.difference_shift = batch.difference_shift;
    parameters.rest_exponent = batch.rest_exponent;
    parameters.gain_shift = unit_fraction_bits + direction_fraction_bits - gain_bits;
    parameters.product_shift = gain_bits - batch.difference_shift + share_exponent;
    parameters.error_share = family.error_share;
    parameters.damping_share = family.damping_share;
    return parameters;
}

} // namespace

bool Coefficients::build(const lks_asset& asset, const StepRate& rate) {
    const std::size_t count = asset.constraints.size();
    const std::size_t padded = count + widest_group - 1;
    if (!shares.resize(padded) || !parts_b.resize(padded) || !batches.resize(asset.batches.size())) {
        return false;
    }
    bool any_soft = false;
    FamilyTerms terms[family_count];
    for (std::uint32_t f = 0; f < family_count; ++f) {
        const Family& family = asset.families[f];
        terms[f] = family_terms(family, rate);
        families[f].soft = family.enabled && !family.compliance.is_zero();
        families[f].error_share = to_share(Scaled::from_u64(1) / terms[f].one_plus_gamma);
        families[f].damping_share = to_share(terms[f].gamma / terms[f].one_plus_gamma);
        any_soft = any_soft || families[f].soft;
        if (family.enabled && families[f].damping_share > tethers.damping_share) {
            tethers = families[f];
        }
    }
    // In the first iteration of a substep Λ is zero, so r plays no part.
    if (rate.iterations > 1 && any_soft && !relaxations.resize(padded)) {
        return false;
    }
    std::fill(parts_b.begin(), parts_b.end(), half_part);
    const PinnedParticles none;
    for (std::uint32_t b = 0; b < asset.batches.size(); ++b) {
        const Batch& batch = asset.batches[b];
        Scaled largest{};
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            const Constraint& constraint = asset.constraints[i];
            const Scaled w = asset.inverse_masses[constraint.a] + asset.inverse_masses[constraint.b];
            const Scaled share =
                w / (w + terms[batch.family].softness); // of both ends; pinned ones make it less
            largest = largest < share ? share : largest;
        }
        // s_a + s_b ≤ 2^-exponent; beyond 40 a correction would be under one coordinate unit for any length.
        const std::int32_t exponent = largest.is_zero() ? 0 : -largest.log2_floor() - 1;
        batches[b].share_exponent = std::clamp(exponent, 0, 40);
        batches[b].parameters = distance_parameters(batch, batches[b].share_exponent, families[batch.family]);
        batches[b].unequal_shares = {};
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            update_constraint(asset, rate, none, i, b);
        }
    }
    return !is_solved_directly(asset, rate.substeps_per_second, rate.iterations) ||
           chain.build(asset, terms[LKS_CONSTRAINT_STRETCH].softness);
}

bool Coefficients::copy(const Coefficients& other) {
    if (!shares.copy(other.shares) || !parts_b.copy(other.parts_b) || !relaxations.copy(other.relaxations) ||
        !batches.copy(other.batches) || !chain.copy(other.chain)) {
        return false;
    }
    std::copy(std::begin(other.families), std::end(other.families), std::begin(families));
    tethers = other.tethers;
    return true;
}

void Coefficients::update_particle(const lks_asset& asset, const StepRate& rate,
                                   const PinnedParticles& pinned, std::uint32_t particle) {
    chain.update_particle(asset, pinned, particle);
    const std::uint32_t first = asset.incident_offsets[particle];
    const std::uint32_t last = asset.incident_offsets[particle + 1];
    std::uint32_t batch = 0;
    for (std::uint32_t i = first; i < last; ++i) {
        const std::uint32_t constraint = asset.incident_constraints[i]; // ascending, like the batches
        while (constraint >= asset.batches[batch].first + asset.batches[batch].count) {
            ++batch;
        }
        update_constraint(asset, rate, pinned, constraint, batch);
    }
}

void Coefficients::update_constraint(const lks_asset& asset, const StepRate& rate,
                                     const PinnedParticles& pinned, std::uint32_t constraint,
                                     std::uint32_t batch) {
    const Constraint& ends = asset.constraints[constraint];
    const std::uint32_t family = asset.batches[batch].family;
    const Scaled w_a = pinned.inverse_mass(asset, ends.a);
    const Scaled w_b = pinned.inverse_mass(asset, ends.b);
    const FamilyTerms terms = family_terms(asset.families[family], rate);
    const Scaled effective = w_a + w_b + terms.softness;
    BatchCoefficients& of_batch = batches[batch];
    const std::int32_t exponent = of_batch.share_exponent;
    const bool was_unequal = parts_b[constraint] != half_part;
    parts_b[constraint] = part_of_b(w_a, w_b);
    const bool is_unequal = parts_b[constraint] != half_part;
    shares[constraint] = to_share((w_a + w_b) / effective, exponent - (is_unequal ? 0 : 1));
    if (is_unequal) {
        // Never taken back: that would need a look at the whole batch.
        include(of_batch.unequal_shares, constraint);
    }
    of_batch.unequal_count += (is_unequal ? 1U : 0U) - (was_unequal ? 1U : 0U);
    if (!relaxations.empty()) {
        relaxations[constraint] = effective.is_zero() ? 0 : to_share(terms.softness / effective);
    }
}

fixed::Scaled multiplier_scale(const Coefficients& coefficients, const lks_asset& asset, const StepRate& rate,
                               const PinnedParticles& pinned, std::uint32_t constraint) {
    const Constraint& ends = asset.constraints[constraint];
    const Batch* batch = std::upper_bound(asset.batches.begin(), asset.batches.end(), constraint,
                                          [](std::uint32_t i, const Batch& b) { return i < b.first; });
    const std::uint32_t family = (batch - 1)->family;
    if (!coefficients.chain.empty() && family == LKS_CONSTRAINT_STRETCH) {
        return coefficients.chain.reference.times_power_of_two(-coefficients.chain.multiplier_exponent);
    }
    return pinned.inverse_mass(asset, ends.a) + pinned.inverse_mass(asset, ends.b) +
           family_terms(asset.families[family], rate).softness;
}

} // namespace lks
