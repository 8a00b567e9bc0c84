// What the direct solve of a rope (solver/chain.h) has to know, for one asset at one substep length.
//
// Inverse masses and the compliance become shares of R = 2·w + α̃/(1+γ), where w is the lightest particle's:
// nothing exceeds one, whatever the masses. Multipliers are carried as the lengths R·λ.
#pragma once

#include <cstdint>

#include "asset/asset.h"
#include "fixed/formats.h"
#include "kernels/chain_task.h"
#include "solver/particle_masses.h"
#include "solver/step_rate.h"

namespace lks {

// Where arrays go on behind the end of a rope for kernels: nothing moves or stretches by more.
inline constexpr std::int64_t rest_behind_the_end = substep_motion_limit;

struct ChainCoefficients {
    explicit ChainCoefficients(const lks_allocator& allocator)
        : particles(allocator), weights(allocator), weight_shifts(allocator), weight_shares(allocator),
          mass_shares(allocator), constraints(allocator), rest_lengths(allocator), slacks(allocator),
          stiffness(allocator), near_shares(allocator), far_shares(allocator) {}

    // Nothing pinned; `inverse_stiffness` is α̃/(1+γ). False: no memory.
    [[nodiscard]] bool build(const lks_asset& asset, const fixed::Scaled& inverse_stiffness);
    [[nodiscard]] bool copy(const ChainCoefficients& other);
    // After it was pinned, unpinned or loaded.
    void update_particle(const lks_asset& asset, const PinnedParticles& pinned, std::uint32_t particle);
    // What each has of the mass of all with the loads, which nothing pinned knows; `own` is that without any.
    void share_mass(const lks_asset& asset, const PinnedParticles& pinned, const ChainCoefficients& own);

    bool empty() const { return constraints.empty(); }
    std::uint32_t count() const { return static_cast<std::uint32_t>(constraints.size()); }

    // Of particles, in the order of the rope; those that kernels read with chain_padding behind them.
    Array<std::uint32_t> particles;
    Array<std::uint32_t> weights; // as ChainWeights has them
    Array<std::uint32_t> weight_shifts;
    Array<std::uint64_t> weight_shares; // w/R, chain_share_bits
    Array<std::int64_t> mass_shares;    // of the whole rope, 63 fraction bits

    // Of segments.
    Array<std::uint32_t> constraints;
    Array<std::int64_t> rest_lengths; // Coordinate
    Array<std::int64_t> slacks;       // longer by more than this it is torn, Coordinate
    // What a multiplier M stiffens its ends by, κ = w·|λ|/L with the lighter end's w, is
    // |M| · stiffness / 2^(32 + stiffness_bits).
    Array<std::uint32_t> stiffness;
    Array<std::uint32_t> near_shares; // the ends' inverse masses as shares of the lighter one's, Unit
    Array<std::uint32_t> far_shares;

    fixed::Scaled mass{};                 // of the rope by itself, kg
    fixed::Scaled reference{};            // R, 1/kg
    fixed::Scaled soft_part{};            // α̃/(1+γ), 1/kg
    std::uint64_t softness = 0;           // the same as a share of R
    std::int32_t multiplier_exponent = 0; // multipliers count coordinate units of 2^multiplier_exponent
    std::int32_t stiffness_bits = 0;
    std::size_t pinned_count = 0;
    std::uint32_t pinned_within = 0; // those that are no end

private:
    void update_weight(const lks_asset& asset, const PinnedParticles& pinned, std::uint32_t index);
    void update_segment(const lks_asset& asset, const PinnedParticles& pinned, std::uint32_t index);
};

} // namespace lks
