// The coefficients of distance constraints for one asset at one substep length: XPBD eq. 26 with everything
// in [0, 1].
//
// With W = w_a + w_b, α̃ = α/h², γ = αβ/h and D = W + α̃/(1+γ), the multiplier is a length Λ = D·λ:
//
//     ΔΛ  = −c·C − r·Λ − γ'·n·(Δx_a − Δx_b)        c = 1/(1+γ)   r = α̃/((1+γ)D)   γ' = γ/(1+γ)
//     Δx_a = s_a·n·ΔΛ,  Δx_b = −s_b·n·ΔΛ            s = w/D
//
// No coefficient can overflow for any mass ratio, compliance or damping. Soft constraints make s tiny, so a
// batch keeps its s with a common exponent.
#pragma once

#include <cstdint>

#include "asset/asset.h"
#include "kernels/distance_task.h"
#include "solver/chain_coefficients.h"
#include "solver/particle_masses.h"
#include "solver/step_rate.h"

namespace lks {

struct FamilyCoefficients {
    std::uint32_t error_share = unit_one; // c, Unit
    std::uint32_t damping_share = 0;      // γ', Unit
    bool soft = false;                    // compliance > 0
};

struct BatchCoefficients {
    DistanceParameters parameters{};
    std::int32_t share_exponent = 0; // share · 2^-(31 + share_exponent)
    // Outside of these both ends move alike, so that nobody need look. Within it says nothing.
    ConstraintRange unequal_shares{};
    std::uint32_t unequal_count = 0; // constraints whose ends don't
};

class Coefficients {
public:
    explicit Coefficients(const lks_allocator& allocator)
        : shares(allocator), parts_b(allocator), relaxations(allocator), batches(allocator),
          chain(allocator) {}

    // All constraints, nothing pinned. False: no memory.
    [[nodiscard]] bool build(const lks_asset& asset, const StepRate& rate);
    // Becomes a copy of `other`. False: no memory, unchanged.
    [[nodiscard]] bool copy(const Coefficients& other);
    // Recomputes what depends on `particle`'s mass, after it was pinned, unpinned or loaded.
    void update_particle(const lks_asset& asset, const StepRate& rate, const PinnedParticles& pinned,
                         std::uint32_t particle);

    FamilyCoefficients families[family_count];
    FamilyCoefficients tethers; // as the family has them that is damped most
    // By constraint; padded, as kernels read on.
    Array<std::uint32_t> shares;  // mantissas: s_a where both ends move alike, else s_a + s_b; without
                                  // compliance that is a half and one
    Array<std::uint32_t> parts_b; // s_b / (s_a + s_b), Direction
    Array<std::uint32_t>
        relaxations; // r, Unit, by constraint, padded; empty where one iteration makes it needless
    Array<BatchCoefficients> batches;
    ChainCoefficients chain; // of a rope that is solved directly (asset/rope_solver.h); otherwise empty

private:
    void update_constraint(const lks_asset& asset, const StepRate& rate, const PinnedParticles& pinned,
                           std::uint32_t constraint, std::uint32_t batch);
};

// D of one constraint in 1/kg, for the read-out of its force λ/h² = Λ/(D·h²). For the segments of a rope that
// is solved directly the R that their multipliers are carried with (solver/chain_coefficients.h).
fixed::Scaled multiplier_scale(const Coefficients& coefficients, const lks_asset& asset, const StepRate& rate,
                               const PinnedParticles& pinned, std::uint32_t constraint);

} // namespace lks
