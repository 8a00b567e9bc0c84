// A float32 Gauss-Seidel loop as it is written in an afternoon: an array of particles, a list of edges.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/asset.h"

namespace lks_bench {

struct FloatParticle {
    float x, y, z;
    float inverse_mass;
};

struct FloatEdge {
    std::uint32_t a, b;
    float rest;
};

struct FloatCloth {
    std::vector<FloatParticle> particles;
    std::vector<FloatEdge> edges;
};

// The asset's particles at rest and its edges: in the solver's order by colours, or by their lower vertex.
FloatCloth make_float_cloth(const lks_asset& asset, bool by_colour);

// One pass over all edges, no compliance.
void project_float(FloatCloth& cloth);

} // namespace lks_bench
