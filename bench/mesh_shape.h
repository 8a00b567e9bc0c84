// A square sheet of irregular triangles: points out of place, diagonals by chance, vertices in no order.
#pragma once

#include <cstdint>
#include <vector>

namespace lks_bench {

struct MeshShape {
    std::vector<double> vertices; // x, y, z each
    std::vector<std::uint32_t> triangles;
    std::uint32_t corners[2] = {}; // the two upper ones
};

// side² vertices and 2·(side - 1)² triangles on 2 m × 2 m. The same on every machine.
MeshShape make_mesh(std::uint32_t side);

} // namespace lks_bench
