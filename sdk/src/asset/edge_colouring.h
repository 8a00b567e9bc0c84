// Colours edges so that no two of one colour share a vertex: greedily, in the order given, with the lowest
// free colour.
#pragma once

#include "asset/build.h"

namespace lks {

// Colours the drafts [first, end) among themselves, from colour 0. False: no memory.
[[nodiscard]] bool colour_edges(Build& build, std::size_t first, std::size_t end);

} // namespace lks
