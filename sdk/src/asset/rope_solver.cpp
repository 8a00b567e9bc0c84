#include "asset/rope_solver.h"

namespace lks {
namespace {

using fixed::Scaled;

// What a rope may weigh for the lightest of its points and the length of a segment that it has: above it a
// sweep leaves more than about 1 % of stretch in a rope that hangs by one end (docs/ropes.md). 400/m at 60 Hz
// × 20 substeps, as 1/h², and as the number of sweeps.
Scaled greatest_swept_load(std::uint64_t substeps_per_second, std::uint32_t iterations) {
    constexpr std::uint64_t usual = std::uint64_t{60 * 20} * (60 * 20);
    constexpr std::uint64_t greatest_at_usual = 400; // 1/m
    static_assert(usual % greatest_at_usual == 0);
    return Scaled::ratio(substeps_per_second * substeps_per_second * iterations, usual / greatest_at_usual);
}

} // namespace

bool is_solved_directly(const lks_asset& asset, std::uint64_t substeps_per_second, std::uint32_t iterations) {
    if (asset.chain.empty() || asset.solver != LKS_ROPE_AUTOMATIC) {
        return !asset.chain.empty();
    }
    const auto mass_of = [&](std::uint32_t point) { return asset.masses[asset.vertex_to_particle[point]]; };
    Scaled mass{};
    for (std::uint32_t i = 0; i < asset.vertex_count(); ++i) {
        mass = mass + mass_of(i);
    }
    const Scaled greatest = greatest_swept_load(substeps_per_second, iterations);
    for (std::uint32_t i = 0; i < asset.chain.size(); ++i) {
        const Scaled length = Scaled::from_fixed(
            static_cast<std::uint64_t>(asset.rest_lengths[asset.chain[i]]), coordinate_fraction_bits);
        const Scaled lighter = mass_of(i) < mass_of(i + 1) ? mass_of(i) : mass_of(i + 1);
        if (greatest * lighter * length < mass) {
            return true;
        }
    }
    return false;
}

} // namespace lks
