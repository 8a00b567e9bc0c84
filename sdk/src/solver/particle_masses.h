// Which particles move otherwise than by the masses that their asset gives them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "asset/asset.h"

namespace lks {

// A particle that a body hangs on, while its rope is solved (rigid/rope_loads.h).
struct ParticleLoad {
    std::uint32_t particle;
    std::uint32_t reserved;
    fixed::Scaled inverse_mass; // with what hangs there, 1/kg; zero: it does not move
};

// Particles that have infinite mass, and those that bear loads, each in ascending order.
struct PinnedParticles {
    const std::uint32_t* particles = nullptr;
    std::size_t count = 0;
    const ParticleLoad* loads = nullptr;
    std::size_t load_count = 0;

    bool contains(std::uint32_t particle) const;
    fixed::Scaled inverse_mass(const lks_asset& asset, std::uint32_t particle) const;
    // All that don't move.
    std::size_t immovable_count() const;
};

} // namespace lks
