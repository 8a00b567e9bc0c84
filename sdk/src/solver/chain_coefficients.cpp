#include "solver/chain_coefficients.h"

#include <algorithm>

#include "fixed/formats.h"

namespace lks {
namespace {

using fixed::Scaled;

// Multipliers saturate where the whole rope would change its motion by so many metres a substep, or stretch
// by more than any two particles are apart.
constexpr std::uint64_t greatest_change = 2;
constexpr std::uint64_t greatest_stretch = 256;
constexpr int multiplier_bits = 60;

std::uint32_t to_unit(const Scaled& value) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(value.to_fixed(unit_fraction_bits), unit_one));
}

// At least one significant bit of κ = 1/4 is left, and a κ of 2^60 beyond it.
constexpr int least_stiffness_bits = 8;
constexpr int greatest_stiffness_bits = 58;

} // namespace

bool ChainCoefficients::build(const lks_asset& asset, const Scaled& inverse_stiffness) {
    const auto count = static_cast<std::uint32_t>(asset.chain.size());
    const std::size_t points = std::size_t{count} + 1;
    const std::size_t padded = points + chain_padding;
    if (!particles.resize(points) || !weights.resize(padded) || !weight_shifts.resize(padded) ||
        !weight_shares.resize(points) || !mass_shares.resize(points) || !constraints.resize(count) ||
        !rest_lengths.resize(padded) || !slacks.resize(padded) || !stiffness.resize(padded) ||
        !near_shares.resize(padded) || !far_shares.resize(padded)) {
        return false;
    }
    Scaled lightest{};
    mass = {};
    for (std::uint32_t i = 0; i <= count; ++i) {
        lightest = lightest < asset.inverse_masses[i] ? asset.inverse_masses[i] : lightest;
        mass = mass + asset.masses[i];
    }
    soft_part = inverse_stiffness;
    reference = lightest + lightest + soft_part;
    softness = static_cast<std::uint64_t>((soft_part / reference).to_i64_fixed(chain_share_bits));
    Scaled greatest = reference * mass * Scaled::from_u64(greatest_change);
    if (!soft_part.is_zero()) {
        const Scaled stretched = reference / soft_part * Scaled::from_u64(greatest_stretch);
        greatest = stretched < greatest ? stretched : greatest;
    }
    // At least one, so that equal masses move by exact halves of it.
    multiplier_exponent =
        std::clamp(greatest.log2_floor() + 1 + coordinate_fraction_bits - multiplier_bits, 1, 60);
    std::int64_t shortest = INT64_MAX;
    for (std::uint32_t i = 0; i < count; ++i) {
        constraints[i] = asset.chain[i];
        rest_lengths[i] = asset.rest_lengths[asset.chain[i]];
        shortest = std::min(shortest, rest_lengths[i]);
    }
    const Scaled stiffest =
        lightest / reference /
        Scaled::from_fixed(static_cast<std::uint64_t>(shortest), coordinate_fraction_bits);
    stiffness_bits = std::clamp(coordinate_fraction_bits - 1 - multiplier_exponent - stiffest.log2_floor(),
                                least_stiffness_bits, greatest_stiffness_bits);
    std::fill(weight_shifts.begin(), weight_shifts.end(), static_cast<std::uint32_t>(greatest_weight_shift));
    std::fill(rest_lengths.begin() + count, rest_lengths.end(), rest_behind_the_end);
    const PinnedParticles none;
    for (std::uint32_t i = 0; i <= count; ++i) {
        const std::uint32_t particle = asset.vertex_to_particle[i];
        particles[i] = particle;
        mass_shares[i] = (asset.masses[particle] / mass).to_i64_fixed(63);
        update_weight(asset, none, i);
        pinned_within += i > 0 && i < count && weights[i] == 0 ? 1u : 0u; // too heavy to move
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        update_segment(asset, none, i);
    }
    return true;
}

bool ChainCoefficients::copy(const ChainCoefficients& other) {
    if (!particles.copy(other.particles) || !weights.copy(other.weights) ||
        !weight_shifts.copy(other.weight_shifts) || !weight_shares.copy(other.weight_shares) ||
        !mass_shares.copy(other.mass_shares) || !constraints.copy(other.constraints) ||
        !rest_lengths.copy(other.rest_lengths) || !slacks.copy(other.slacks) ||
        !stiffness.copy(other.stiffness) || !near_shares.copy(other.near_shares) ||
        !far_shares.copy(other.far_shares)) {
        return false;
    }
    mass = other.mass;
    reference = other.reference;
    soft_part = other.soft_part;
    softness = other.softness;
    multiplier_exponent = other.multiplier_exponent;
    stiffness_bits = other.stiffness_bits;
    pinned_count = other.pinned_count;
    pinned_within = other.pinned_within;
    return true;
}

void ChainCoefficients::update_particle(const lks_asset& asset, const PinnedParticles& pinned,
                                        std::uint32_t particle) {
    if (empty()) {
        return;
    }
    const std::uint32_t index = asset.particle_to_vertex[particle];
    const bool within = index > 0 && index < count();
    pinned_within -= within && weights[index] == 0 ? 1u : 0u;
    update_weight(asset, pinned, index);
    pinned_within += within && weights[index] == 0 ? 1u : 0u;
    if (index > 0) {
        update_segment(asset, pinned, index - 1);
    }
    if (index < count()) {
        update_segment(asset, pinned, index);
    }
    pinned_count = pinned.immovable_count();
}

void ChainCoefficients::share_mass(const lks_asset& asset, const PinnedParticles& pinned,
                                   const ChainCoefficients& own) {
    if (empty() || pinned_count != 0) {
        return;
    }
    const Scaled one = Scaled::from_u64(1);
    Scaled all = mass;
    for (std::size_t i = 0; i < pinned.load_count; ++i) {
        const ParticleLoad& load = pinned.loads[i];
        all = all + subtract_or_zero(one / load.inverse_mass, asset.masses[load.particle]);
    }
    const std::int64_t left = (mass / all).to_i64_fixed(63);
    for (std::uint32_t i = 0; i <= count(); ++i) {
        mass_shares[i] =
            pinned.load_count == 0 ? own.mass_shares[i] : fixed::multiply_shift(own.mass_shares[i], left, 63);
    }
    for (std::size_t i = 0; i < pinned.load_count; ++i) {
        const ParticleLoad& load = pinned.loads[i];
        mass_shares[asset.particle_to_vertex[load.particle]] =
            (one / load.inverse_mass / all).to_i64_fixed(63);
    }
}

void ChainCoefficients::update_weight(const lks_asset& asset, const PinnedParticles& pinned,
                                      std::uint32_t index) {
    const Scaled share = pinned.inverse_mass(asset, particles[index]) / reference;
    // At most a half, unless rounding has made it more.
    const int shift = share.is_zero() ? 0 : std::clamp(-share.log2_floor() - 1, 0, greatest_weight_shift);
    const std::uint64_t weight = std::min<std::uint64_t>(share.to_fixed(chain_weight_bits + shift),
                                                         (std::uint64_t{1} << chain_weight_bits) - 1);
    const bool moves = weight != 0;
    weights[index] = moves ? static_cast<std::uint32_t>(weight) : 0;
    weight_shifts[index] = static_cast<std::uint32_t>(moves ? shift : greatest_weight_shift);
    weight_shares[index] = std::uint64_t{weights[index]} << 32 >> weight_shifts[index];
}

void ChainCoefficients::update_segment(const lks_asset& asset, const PinnedParticles& pinned,
                                       std::uint32_t index) {
    const auto inverse_mass = [&](std::uint32_t i) {
        return weights[i] == 0 ? Scaled{} : pinned.inverse_mass(asset, particles[i]);
    };
    const Scaled near = inverse_mass(index);
    const Scaled far = inverse_mass(index + 1);
    const Scaled lighter = near < far ? far : near;
    if (lighter.is_zero()) {
        stiffness[index] = 0;
        slacks[index] = INT64_MAX;
        return;
    }
    near_shares[index] = to_unit(near / lighter);
    far_shares[index] = to_unit(far / lighter);
    const Scaled length =
        Scaled::from_fixed(static_cast<std::uint64_t>(rest_lengths[index]), coordinate_fraction_bits);
    const Scaled both = near + far;
    slacks[index] = (length * (both + soft_part) / both).to_i64_fixed(coordinate_fraction_bits);
    // w/R/L for a multiplier of 2^multiplier_exponent coordinate units.
    const Scaled factor = lighter / reference / length;
    stiffness[index] = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        factor.to_fixed(multiplier_exponent - coordinate_fraction_bits + stiffness_bits + 32), UINT32_MAX));
}

} // namespace lks
