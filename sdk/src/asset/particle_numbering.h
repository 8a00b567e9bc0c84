// The order of particles in memory, chosen so that batches consist of runs in which both ends advance by one.
#pragma once

#include "asset/build.h"

namespace lks {

// In blocks of one column in `stride` and one row in `stride`, the rows of a block one after the other.
// Neighbours of one colour are then runs as long as the block, or as one of its rows less the last, whose
// place nobody needs: with a stride of two along rows, along columns and diagonally, with a stride of four
// also next but one. Columns beyond a multiple of the stride come last, so that all rows of blocks have one
// length. A rope is one row.
[[nodiscard]] bool number_rows(Build& build, std::uint32_t columns, std::uint32_t rows, std::uint32_t stride);

// For meshes, whose first drafts [0, end) are the stretch edges: the first ends of colour 0's edges in
// breadth-first order, their second ends, and the rest. Colour 0 is then a single run, and neighbours in the
// mesh are near in memory.
[[nodiscard]] bool number_mesh(Build& build, std::size_t end);

} // namespace lks
