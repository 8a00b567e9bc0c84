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
};

struct Model {
    std::vector<support::Vector> positions;
    std::vector<double> masses;
    std::vector<Edge> edges;
};

enum class EdgeOrder {
    canonical, // as the SDK visits them: by colour
    index      // by vertex index, as a naive loop over a mesh has them
};

// Materials by lks_constraint_family.
using Materials = std::array<lks_distance_material, 3>;

// Starts where the object is now, relative to `place`.
Model model_of(const support::World& world, lks_object_id object, const support::Asset& asset,
               const lks_vec3& place, const std::vector<double>& masses, const Materials& materials,
               EdgeOrder order = EdgeOrder::canonical);

} // namespace reference
