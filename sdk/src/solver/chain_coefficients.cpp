#include "solver/chain_coefficients.h"

#include <algorithm>

#include "fixed/formats.h"

namespace lks {
namespace {

using fixed::Scaled;

// Multipliers saturate where the whole rope would change its motion by so many metres a substep, or stretch
// by more than any two particles are apart.
constexpr std::uint64_t greatest_change = 4;
constexpr std::uint64_t greatest_stretch = 256;
constexpr int multiplier_bits = 61;

std::uint32_t to_unit(const Scaled& value) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(value.to_fixed(unit_fraction_bits), unit_one));
}

} // namespace

bool ChainCoefficients::build(const lks_asset& asset, const Scaled& inverse_stiffness) {
    const auto count = static_cast<std::uint32_t>(asset.chain.size());
    if (count == 0) {
        return true;
    }
    if (!particles.resize(std::size_t{count} + 1) || !segments.resize(count)) {
        return false;
    }
    Scaled lightest{};
    Scaled mass{};
    for (std::uint32_t i = 0; i <= count; ++i) {
        lightest = lightest < asset.inverse_masses[i] ? asset.inverse_masses[i] : lightest;
        mass = mass + asset.masses[i];
    }
    soft_part = inverse_stiffness;
    reference = lightest + lightest + soft_part;
    softness = (soft_part / reference).to_fixed(chain_share_bits);
    weight_exponent = std::clamp(-(lightest / reference).log2_floor(), 1, chain_share_bits);
    Scaled greatest = reference * mass * Scaled::from_u64(greatest_change);
    if (!soft_part.is_zero()) {
        const Scaled stretched = reference / soft_part * Scaled::from_u64(greatest_stretch);
        greatest = stretched < greatest ? stretched : greatest;
    }
    // At least one, so that equal masses move by exact halves of it.
    multiplier_exponent =
        std::clamp(greatest.log2_floor() + 1 + coordinate_fraction_bits - multiplier_bits, 1, 60);
    for (std::uint32_t i = 0; i <= count; ++i) {
        const std::uint32_t particle = asset.vertex_to_particle[i];
        particles[i] = {0, (asset.masses[particle] / mass).to_fixed(63), particle, 0};
        update_weight(asset, i, false);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        segments[i].constraint = asset.chain[i];
        segments[i].rest_length = asset.rest_lengths[asset.chain[i]];
        update_segment(asset, i);
    }
    return true;
}

bool ChainCoefficients::copy(const ChainCoefficients& other) {
    if (!particles.resize(other.particles.size()) || !segments.resize(other.segments.size())) {
        return false;
    }
    std::copy(other.particles.begin(), other.particles.end(), particles.begin());
    std::copy(other.segments.begin(), other.segments.end(), segments.begin());
    reference = other.reference;
    soft_part = other.soft_part;
    softness = other.softness;
    weight_exponent = other.weight_exponent;
    multiplier_exponent = other.multiplier_exponent;
    pinned_count = other.pinned_count;
    return true;
}

void ChainCoefficients::update_particle(const lks_asset& asset, std::uint32_t particle, bool pinned,
                                        std::size_t all_pinned) {
    if (empty()) {
        return;
    }
    const std::uint32_t index = asset.particle_to_vertex[particle];
    update_weight(asset, index, pinned);
    if (index > 0) {
        update_segment(asset, index - 1);
    }
    if (index < segments.size()) {
        update_segment(asset, index);
    }
    pinned_count = all_pinned;
}

void ChainCoefficients::update_weight(const lks_asset& asset, std::uint32_t index, bool pinned) {
    const Scaled share = asset.inverse_masses[particles[index].particle] / reference;
    particles[index].weight = pinned ? 0 : share.to_fixed(chain_share_bits + weight_exponent);
}

void ChainCoefficients::update_segment(const lks_asset& asset, std::uint32_t index) {
    const auto inverse_mass = [&](std::uint32_t i) {
        return particles[i].weight == 0 ? Scaled{} : asset.inverse_masses[particles[i].particle];
    };
    const Scaled near = inverse_mass(index);
    const Scaled far = inverse_mass(index + 1);
    const Scaled lighter = near < far ? far : near;
    ChainSegment& segment = segments[index];
    if (lighter.is_zero()) {
        segment.stiffness_mantissa = 0;
        segment.slack = INT64_MAX;
        return;
    }
    segment.near_share = to_unit(near / lighter);
    segment.far_share = to_unit(far / lighter);
    // w/R/L for a multiplier of 2^multiplier_exponent coordinate units, and the result in Unit.
    const Scaled length =
        Scaled::from_fixed(static_cast<std::uint64_t>(segment.rest_length), coordinate_fraction_bits);
    const Scaled both = near + far;
    segment.slack = (length * (both + soft_part) / both).to_i64_fixed(coordinate_fraction_bits);
    const Scaled factor =
        (lighter / reference / length)
            .times_power_of_two(multiplier_exponent - coordinate_fraction_bits + unit_fraction_bits);
    segment.stiffness_mantissa = factor.mantissa;
    segment.stiffness_shift = std::clamp(-factor.exponent - 64, -63, 63);
}

} // namespace lks
