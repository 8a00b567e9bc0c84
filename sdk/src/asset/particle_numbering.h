// The order of particles in memory, chosen so that batches consist of runs in which both ends advance by one.
#pragma once

#include "asset/build.h"

namespace lks {

// Within each row of `columns` vertices: columns 0, 4, 8 …, then 1, 5, 9 …, 2, 6 …, 3, 7 …. Neighbours along
// the row, diagonal neighbours and next-but-one neighbours of a colour are then runs of a quarter row, and
// those across rows of a whole one. A rope is one row.
[[nodiscard]] bool number_rows(Build& build, std::uint32_t columns, std::uint32_t rows);

// For meshes, whose first drafts [0, end) are the stretch edges: the first ends of colour 0's edges in
// breadth-first order, their second ends, and the rest. Colour 0 is then a single run, and neighbours in the
// mesh are near in memory.
[[nodiscard]] bool number_mesh(Build& build, std::size_t end);

} // namespace lks
