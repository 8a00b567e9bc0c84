// What the direct solve of a rope (solver/chain.h) has to know, for one asset at one substep length.
//
// Inverse masses and the compliance become shares of R = 2·w + α̃/(1+γ), where w is the lightest particle's:
// nothing exceeds one, whatever the masses. Multipliers are carried as the lengths R·λ.
#pragma once

#include <cstdint>

#include "asset/asset.h"
#include "solver/step_rate.h"

namespace lks {

// Of inverse masses, the compliance and what is made of them.
inline constexpr int chain_share_bits = 62;

// In the order of the rope.
struct ChainParticle {
    std::uint64_t weight;     // w/R = weight · 2^-(chain_share_bits + weight_exponent); 0: pinned
    std::uint64_t mass_share; // of the whole rope, 63 fraction bits
    std::uint32_t particle;
    std::uint32_t reserved;
};

struct ChainSegment {
    std::int64_t rest_length; // Coordinate
    std::int64_t slack;       // longer by more than this it is torn, Coordinate
    // What a multiplier M stiffens its ends by, κ = w·|λ|/L with the lighter end's w, is
    // |M| · mantissa / 2^(64 + shift) in Unit.
    std::uint64_t stiffness_mantissa;
    std::int32_t stiffness_shift;
    std::uint32_t near_share; // the ends' inverse masses as shares of the lighter one's, Unit
    std::uint32_t far_share;
    std::uint32_t constraint;
};

struct ChainCoefficients {
    explicit ChainCoefficients(const lks_allocator& allocator) : particles(allocator), segments(allocator) {}

    // Nothing pinned; `inverse_stiffness` is α̃/(1+γ). False: no memory.
    [[nodiscard]] bool build(const lks_asset& asset, const fixed::Scaled& inverse_stiffness);
    [[nodiscard]] bool copy(const ChainCoefficients& other);
    // After it was pinned or unpinned; `all_pinned` is how many are now.
    void update_particle(const lks_asset& asset, std::uint32_t particle, bool pinned, std::size_t all_pinned);

    bool empty() const { return segments.empty(); }

    Array<ChainParticle> particles;
    Array<ChainSegment> segments;
    fixed::Scaled reference{};  // R, 1/kg
    fixed::Scaled soft_part{};  // α̃/(1+γ), 1/kg
    std::uint64_t softness = 0; // the same as a share of R
    std::int32_t weight_exponent = 0;
    std::int32_t multiplier_exponent = 0; // multipliers count coordinate units of 2^multiplier_exponent
    std::size_t pinned_count = 0;

private:
    void update_weight(const lks_asset& asset, std::uint32_t index, bool pinned);
    void update_segment(const lks_asset& asset, std::uint32_t index);
};

} // namespace lks
