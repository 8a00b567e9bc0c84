// A pennant as a triangle mesh that is no grid: columns of fewer and fewer vertices, shaken by a hash.
#pragma once

#include <cstdint>
#include <vector>

namespace lks_demo {

// In the x-y plane, metres; the hoist is the first column, at x = 0, centred on y = 0. Every coordinate is a
// whole number of 1/1024 m, so that the doubles are exact and the same on every compiler.
struct PennantMesh {
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles; // counter-clockwise, seen from +z
    std::uint32_t hoist_vertices = 0;     // those of the first column, from the top down
};

PennantMesh make_pennant();

} // namespace lks_demo
