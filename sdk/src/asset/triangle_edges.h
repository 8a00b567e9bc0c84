// The edges of a triangle mesh, each once, with the triangles beside it.
#pragma once

#include "asset/build.h"

namespace lks {

// One side of one triangle. Sorted by (low, high, triangle), the sides of one edge stand together.
struct TriangleSide {
    std::uint32_t low; // vertices
    std::uint32_t high;
    std::uint32_t triangle;
    std::uint32_t opposite; // the triangle's third vertex
    std::uint32_t longest;  // 1: strictly longer than the triangle's two other sides
};

// Checks indices, areas and duplicates on the way; every vertex must be part of a triangle.
lks_result list_triangle_sides(Build& build, Array<TriangleSide>& sides);

} // namespace lks
