// Which ropes are solved at once (solver/chain.h), and which are swept. Nobody else decides: whether an
// object's coefficients have a chain is what this has said of its asset in its world.
#pragma once

#include "asset/asset.h"

namespace lks {

// As the rope's description asks for, or by how far sweeps would stretch it; never where it lists no chain.
bool is_solved_directly(const lks_asset& asset, std::uint64_t substeps_per_second, std::uint32_t iterations);

} // namespace lks
