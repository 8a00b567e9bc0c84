// The masses that an asset gives its particles, for the peers.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/asset.h"

namespace lks_bench {

// By particle, in kg.
std::vector<double> masses_of(const lks_asset& asset);
// By particle, in 1/kg; 0 of what is pinned.
std::vector<double> inverse_masses_of(const lks_asset& asset,
                                      const std::vector<std::uint32_t>& pinned_vertices);

} // namespace lks_bench
