#include "support/builders.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace support {

std::vector<double> Chain::masses() const {
    std::vector<double> result(segments + 1, particle_mass);
    result.back() = end_mass > 0 ? end_mass : particle_mass;
    return result;
}

Asset Chain::build(const lks_allocator& allocator) const {
    std::vector<double> points;
    const Vector step = direction * (length / segments / direction.length());
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const Vector point = step * i;
        points.insert(points.end(), {point.x, point.y, point.z});
    }
    const std::vector<double> point_masses = masses();
    lks_rope_def def = lks_default_rope_def();
    def.segments = 0;
    def.length = 0;
    def.point_count = segments + 1;
    def.points = points.data();
    def.mass = 0;
    def.linear_density = 0;
    def.vertex_masses = point_masses.data();
    def.stretch = stretch;
    def.bend = bend;
    def.solver = solver;
    def.particle_radius = 0;
    def.allocator = allocator;
    return Asset(def);
}

lks_rope_def straight_rope(std::uint32_t segments, double length) {
    lks_rope_def def = lks_default_rope_def();
    def.segments = segments;
    def.length = length;
    return def;
}

Asset loose_points(const std::vector<Vector>& points, const std::vector<double>& masses, double radius) {
    std::vector<double> coordinates;
    for (const Vector& point : points) {
        coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    }
    lks_rope_def def = lks_default_rope_def();
    def.segments = 0;
    def.length = 0;
    def.point_count = static_cast<std::uint32_t>(points.size());
    def.points = coordinates.data();
    def.mass = 0;
    def.linear_density = 0;
    def.vertex_masses = masses.data();
    def.stretch = off;
    def.bend = off;
    def.particle_radius = radius;
    def.friction = 1;
    return Asset(def);
}

lks_cloth_def Net::def() const {
    lks_cloth_def result = lks_default_cloth_def();
    result.columns = side;
    result.rows = side;
    result.width = width;
    result.height = width;
    result.mass = 0;
    result.area_density = 0;
    result.vertex_masses = nullptr;
    result.stretch = stretch;
    result.shear = shear;
    result.bend = bend;
    result.particle_radius = radius;
    result.friction = friction;
    result.tether_anchors = anchors.empty() ? nullptr : anchors.data();
    result.tether_anchor_count = static_cast<std::uint32_t>(anchors.size());
    return result;
}

Asset Net::build(const lks_allocator& allocator) const {
    const std::vector<double> masses(std::size_t{side} * side, particle_mass);
    lks_cloth_def result = def();
    result.vertex_masses = masses.data();
    result.allocator = allocator;
    return Asset(result);
}

Asset Net::build(const std::vector<double>& masses) const {
    lks_cloth_def result = def();
    result.vertex_masses = masses.data();
    return Asset(result);
}

lks_cloth_def Mesh::def() const {
    lks_cloth_def result = lks_default_cloth_def();
    result.columns = 0;
    result.rows = 0;
    result.width = 0;
    result.height = 0;
    result.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
    result.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
    result.vertices = vertices.data();
    result.triangles = triangles.data();
    return result;
}

Mesh wavy_mesh(std::uint32_t side, double width) {
    Mesh mesh;
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            // Exact in binary where side - 1 is a power of two: the same doubles in every rounding mode.
            const double u = static_cast<double>(column) / (side - 1);
            const double v = static_cast<double>(row) / (side - 1);
            mesh.vertices.insert(mesh.vertices.end(), {width * (u - 0.5) + 0.125 * v * v,
                                                       width * (0.5 - v) + 0.0625 * u * u, 0.25 * u * v});
        }
    }
    for (std::uint32_t row = 0; row + 1 < side; ++row) {
        for (std::uint32_t column = 0; column + 1 < side; ++column) {
            const std::uint32_t corner = row * side + column;
            mesh.triangles.insert(mesh.triangles.end(), {corner, corner + side, corner + 1});
            mesh.triangles.insert(mesh.triangles.end(), {corner + 1, corner + side, corner + side + 1});
        }
    }
    return mesh;
}

Mesh irregular_mesh(std::uint32_t side, double width) {
    std::mt19937 chance(7); // its numbers are fixed by the standard
    Mesh mesh = wavy_mesh(side, width);
    for (std::size_t quad = 0; quad < mesh.triangles.size(); quad += 6) {
        if (chance() % 2 == 0) {
            std::uint32_t* corners = &mesh.triangles[quad];
            corners[2] = corners[5];
            corners[4] = corners[5];
            corners[5] = corners[3];
            corners[3] = corners[0];
        }
    }
    std::vector<std::uint32_t> place(mesh.vertices.size() / 3);
    std::iota(place.begin(), place.end(), 0u);
    for (std::size_t i = place.size(); i > 1; --i) {
        std::swap(place[i - 1], place[chance() % i]);
    }
    std::vector<double> vertices(mesh.vertices.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        std::copy_n(&mesh.vertices[3 * i], 3, &vertices[3 * std::size_t{place[i]}]);
    }
    mesh.vertices = vertices;
    for (std::uint32_t& vertex : mesh.triangles) {
        vertex = place[vertex];
    }
    return mesh;
}

} // namespace support
