// What the reference solvers simulate: particles and constraints in plain numbers.
#pragma once

#include <lockstitch/lockstitch.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/numbers.h"

namespace reference {

struct Edge {
    std::uint32_t a, b;
    double rest;
    double compliance;
    double damping;
    std::uint32_t family = LKS_CONSTRAINT_STRETCH;
};

// St. Venant-Kirchhoff, plane stress: the constraint is Green's strain (εxx, εyy, 2εxy) in the axes of the
// triangle's rest shape, its compliance the inverse of the elasticity matrix times the area (XPBD eq. 27,
// 28).
struct Triangle {
    std::array<std::uint32_t, 3> corners;
    std::array<std::array<double, 2>, 3> slopes; // of the corners' shape functions, 1/m
    std::array<std::array<double, 3>, 3> compliance;
};

// Of a 2-D rest shape; Young's modulus in N/m (that of the material times the thickness).
Triangle make_triangle(const std::array<std::uint32_t, 3>& corners,
                       const std::array<std::array<double, 2>, 3>& rest, double young, double poisson);

// A closed surface whose enclosed volume is held at `rest`.
struct Volume {
    std::vector<std::uint32_t> particles;
    std::vector<std::array<std::uint32_t, 3>> triangles; // of indices into `particles`, outwards
    double rest;                                         // m³
    double compliance;                                   // m⁶/J
};

// A frictionless ball that particles stay out of.
struct Ball {
    support::Vector centre;
    double radius; // with the particles' own; 0: none
};

// A particle is no further than this from the anchor while that is pinned.
struct Tether {
    std::uint32_t particle;
    std::uint32_t anchor; // particle
    double length;
};

struct Model {
    std::vector<support::Vector> positions;
    std::vector<double> masses;
    std::vector<Edge> edges;
    std::vector<Triangle> triangles{};
    std::vector<Volume> volumes{};
    std::vector<std::uint32_t> pins{};
    Ball ball{};
    // Of a rope that is solved directly: the edges of its segments, in their order. Otherwise empty.
    std::vector<std::size_t> chain{};
    std::vector<Tether> tethers{}; // by particle, and then by anchor; followed by xpbd.h
};

enum class EdgeOrder {
    canonical, // as the SDK visits them: by colour
    index      // by vertex index, as a naive loop over a mesh has them
};

// The edges of a rope's segments in their order.
std::vector<std::size_t> segments_of(const std::vector<Edge>& edges);

// Materials by lks_constraint_family.
using Materials = std::array<lks_distance_material, 3>;

std::vector<Tether> tethers_of(const lks_asset* asset);

std::vector<Edge> edges_of(const lks_asset* asset, const Materials& materials,
                           EdgeOrder order = EdgeOrder::canonical);

} // namespace reference
