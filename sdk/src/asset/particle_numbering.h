// The order of particles in memory, chosen so that batches consist of runs in which both ends advance by one.
#pragma once

#include "asset/build.h"

namespace lks {

// In blocks of every fourth column and every fourth row, the rows of a block one after the other. Neighbours
// of one colour (along rows, along columns, diagonal, next but one) are then runs as long as the block, or as
// one of its rows less the last, whose place nobody needs. Columns beyond a multiple of four come last, so
// that all rows of blocks have one length. A rope is one row.
[[nodiscard]] bool number_rows(Build& build, std::uint32_t columns, std::uint32_t rows);

// For meshes, whose first drafts [0, end) are the stretch edges: the first ends of colour 0's edges in
// breadth-first order, their second ends, and the rest. Colour 0 is then a single run, and neighbours in the
// mesh are near in memory.
[[nodiscard]] bool number_mesh(Build& build, std::size_t end);

} // namespace lks
