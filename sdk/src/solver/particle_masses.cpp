#include "solver/particle_masses.h"

#include <algorithm>

namespace lks {

using fixed::Scaled;

bool PinnedParticles::contains(std::uint32_t particle) const {
    return count != 0 && std::binary_search(particles, particles + count, particle);
}

Scaled PinnedParticles::inverse_mass(const lks_asset& asset, std::uint32_t particle) const {
    if (contains(particle)) {
        return {};
    }
    const ParticleLoad* const end = loads + load_count;
    const ParticleLoad* const load = std::lower_bound(
        loads, end, particle, [](const ParticleLoad& l, std::uint32_t of) { return l.particle < of; });
    return load != end && load->particle == particle ? load->inverse_mass : asset.inverse_masses[particle];
}

std::size_t PinnedParticles::immovable_count() const {
    std::size_t sum = count;
    for (std::size_t i = 0; i < load_count; ++i) {
        sum += loads[i].inverse_mass.is_zero() && !contains(loads[i].particle) ? 1u : 0u;
    }
    return sum;
}

} // namespace lks
