// Small assets, described in one line each.
#pragma once

#include <cstdint>
#include <vector>

#include "support/handles.h"

namespace support {

inline constexpr lks_distance_material off{0, 0, 0, 0};
inline lks_distance_material stiff() {
    return {0, 0, 1, 0};
}
inline lks_distance_material soft(double compliance, double damping = 0) {
    return {compliance, damping, 1, 0};
}

// A rope along +x (or any other direction) without bend constraints and with no width: nothing but a chain.
struct Chain {
    std::uint32_t segments = 19;
    double length = 2;
    double particle_mass = 1;
    lks_distance_material stretch = stiff();
    Vector direction{1, 0, 0};
    std::uint32_t solver = LKS_ROPE_AUTOMATIC;
    double end_mass = 0; // of the last particle; 0: like the others
    lks_distance_material bend = off;

    std::vector<double> masses() const;

    Asset build(const lks_allocator& allocator = {}) const;
};

// The default rope in so many segments over a length.
lks_rope_def straight_rope(std::uint32_t segments, double length);

// Points that nothing holds together.
Asset loose_points(const std::vector<Vector>& points, const std::vector<double>& masses, double radius = 0);

// A square grid of `side` × `side` vertices with equal masses; stretch, shear and bend as given.
struct Net {
    std::uint32_t side = 64;
    double width = 2;
    double particle_mass = 0.001;
    lks_distance_material stretch = stiff();
    lks_distance_material shear = stiff();
    lks_distance_material bend = stiff();
    double radius = 0;
    double friction = 1;
    std::vector<std::uint32_t> anchors{}; // of tethers, two a vertex

    lks_cloth_def def() const; // its vertex_masses are null: build() adds them; points to `anchors`
    Asset build(const lks_allocator& allocator = {}) const;
    // With one mass a vertex instead of particle_mass.
    Asset build(const std::vector<double>& masses) const;
};

// An n × n quad mesh given as indexed triangles, wavy, so that no two rest lengths need be equal.
struct Mesh {
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;

    lks_cloth_def def() const;
};
Mesh wavy_mesh(std::uint32_t side, double width);
// The same with diagonals by chance and vertices in no order: hardly any of its constraints stand in runs.
Mesh irregular_mesh(std::uint32_t side, double width);

} // namespace support
