// The second pass along a chain: tensions that are more than it stands by itself are taken implicitly across
// the rope (solver/chain.h).
#pragma once

#include "solver/chain.h"

namespace lks {

// Changes the movements in `work`, which are in units of 2^units coordinate units, to coordinate units. True:
// a segment was left off its length.
bool move_across(const ChainCoefficients& chain, const Kernels& kernels, const ChainWork& work, int units);

} // namespace lks
