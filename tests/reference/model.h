// What a reference solver simulates: an asset's particles and constraints, read back through the public API.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "support/handles.h"
#include "support/numbers.h"

namespace reference {

struct Edge {
    std::uint32_t a, b;
    double rest;
    double compliance;
    double damping;
    std::uint32_t family = LKS_CONSTRAINT_STRETCH;
};

struct Model {
    std::vector<support::Vector> positions;
    std::vector<double> masses;
    std::vector<Edge> edges;
    // Of a rope that is solved directly: the edges of its segments, in their order. Otherwise empty.
    std::vector<std::size_t> chain;
};

enum class EdgeOrder {
    canonical, // as the SDK visits them: by colour
    index      // by vertex index, as a naive loop over a mesh has them
};

// The edges of a rope's segments in their order.
std::vector<std::size_t> segments_of(const std::vector<Edge>& edges);

// Materials by lks_constraint_family.
using Materials = std::array<lks_distance_material, 3>;

// Starts where the object is now, relative to `place`.
Model model_of(const support::World& world, lks_object_id object, const support::Asset& asset,
               const lks_vec3& place, const std::vector<double>& masses, const Materials& materials,
               EdgeOrder order = EdgeOrder::canonical);

} // namespace reference
