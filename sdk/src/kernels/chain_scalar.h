// The geometry of a rope's segments in plain integers: what kernels over lanes compare with and leave rare
// segments to. Functions of their own, compiled for every machine.
#pragma once

#include "kernels/chain_task.h"

namespace lks {

void measure_segments_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count);
void measure_turns_scalar(ChainSegments& segments, std::uint32_t first, std::uint32_t count);
void measure_chain_scalar(ChainSegments& segments);

} // namespace lks
