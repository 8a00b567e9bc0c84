// A float32 Gauss-Seidel loop as it is written in an afternoon: an array of particles, a list of edges.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/asset.h"
#include "variant.h"

namespace lks_bench {

struct FloatParticle {
    float x, y, z;
    float inverse_mass;
};

struct FloatEdge {
    std::uint32_t a, b;
    float rest;
};

struct FloatSphere {
    float x, y, z;
    float radius;
};

struct FloatCloth {
    std::vector<FloatParticle> particles; // by vertex
    std::vector<FloatParticle> starts;    // where they were at the start of the substep
    std::vector<FloatEdge> edges;
};

enum class EdgeOrder { by_colour, by_index };

// The asset's particles at rest and its edges: in the solver's order by colours, or by their lower vertex.
FloatCloth make_float_cloth(const lks_asset& asset, const std::vector<std::uint32_t>& pinned,
                            EdgeOrder order);

// One pass over all edges, no compliance.
void project_float(FloatCloth& cloth);
// Out of the sphere, without friction.
void push_out_float(FloatCloth& cloth, const FloatSphere& sphere);
// x += v + g·h²: what a substep begins with. `fall` is g·h² on y.
void predict_float(FloatCloth& cloth, float fall);

// What stood upright lies level, as workloads with colliders begin: about x by 90°.
void lay_level(FloatCloth& cloth);

std::vector<Point> points_of(const FloatCloth& cloth); // by vertex

} // namespace lks_bench
