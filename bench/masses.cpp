#include "masses.h"

#include <cmath>

namespace lks_bench {
namespace {

std::vector<double> numbers(const lks::Array<lks::fixed::Scaled>& values) {
    std::vector<double> found;
    for (const lks::fixed::Scaled& value : values) {
        found.push_back(std::ldexp(static_cast<double>(value.mantissa), value.exponent));
    }
    return found;
}

} // namespace

std::vector<double> masses_of(const lks_asset& asset) {
    return numbers(asset.masses);
}

std::vector<double> inverse_masses_of(const lks_asset& asset,
                                      const std::vector<std::uint32_t>& pinned_vertices) {
    std::vector<double> found = numbers(asset.inverse_masses);
    for (const std::uint32_t vertex : pinned_vertices) {
        found[asset.vertex_to_particle[vertex]] = 0;
    }
    return found;
}

} // namespace lks_bench
