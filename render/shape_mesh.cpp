// Spheres, capsules and boxes are one solid: a box of some inner half extents, rounded by a radius. A sphere
// has no box inside, a capsule has a line, and a box gets a fine bevel that catches the light.
#include "render/mesh.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

namespace render {
namespace {

// Latitudes and longitudes with every octant boundary doubled; the doubles move apart with the inner box, and
// the strips between them are its faces.
void append_rounded_box(Mesh& mesh, glm::vec3 inner, float radius, std::uint32_t steps) {
    const std::uint32_t rows = 2 * (steps + 1);
    const std::uint32_t columns = 4 * (steps + 1);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const float step_angle = glm::half_pi<float>() / static_cast<float>(steps);
    for (std::uint32_t row = 0; row < rows; ++row) {
        const bool upper = row <= steps;
        const float polar = static_cast<float>(upper ? row : row - 1) * step_angle;
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t quadrant = column / (steps + 1);
            const float azimuth = static_cast<float>(column - quadrant) * step_angle;
            const glm::vec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                      -std::sin(polar) * std::sin(azimuth));
            const glm::vec3 corner((quadrant == 0 || quadrant == 3) ? inner.x : -inner.x,
                                   upper ? inner.y : -inner.y, quadrant < 2 ? -inner.z : inner.z);
            const glm::vec3 position = corner + direction * radius;
            mesh.add({position, direction, position, {0.0f, 0.0f}, 0.0f});
        }
    }
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t next = (column + 1) % columns;
            const std::uint32_t top = first + row * columns;
            const std::uint32_t bottom = top + columns;
            mesh.quad(top + column, bottom + column, bottom + next, top + next);
        }
    }
    // The flat top and bottom, between the four corners that the poles have become.
    const std::uint32_t top = first;
    const std::uint32_t bottom = first + (rows - 1) * columns;
    const std::uint32_t quarter = steps + 1;
    mesh.quad(top, top + quarter, top + 2 * quarter, top + 3 * quarter);
    mesh.quad(bottom + 3 * quarter, bottom + 2 * quarter, bottom + quarter, bottom);
}

} // namespace

void append_shape(Mesh& mesh, const Shape& shape) {
    switch (shape.kind) {
    case ShapeKind::sphere:
        append_rounded_box(mesh, glm::vec3(0.0f), shape.radius, 14);
        break;
    case ShapeKind::capsule:
        append_rounded_box(mesh, glm::vec3(0.0f, shape.half_length, 0.0f), shape.radius, 10);
        break;
    case ShapeKind::box: {
        const glm::vec3 half = shape.half_extents;
        const float bevel = std::min(0.015f, 0.25f * std::min({half.x, half.y, half.z}));
        append_rounded_box(mesh, half - bevel, bevel, 4);
        break;
    }
    case ShapeKind::plane:
        break;
    }
}

void append_plane(Mesh& mesh, const Shape& shape, glm::vec3 centre, float half_size) {
    glm::vec2 middle(0.0f);
    glm::vec2 half(shape.half_extents.x, shape.half_extents.z);
    if (shape.endless) {
        const glm::vec3 local = glm::vec3(glm::inverse(shape.matrix) * glm::vec4(centre, 1.0f));
        middle = glm::vec2(local.x, local.z);
        half = glm::vec2(half_size);
    }
    const auto corner = [&](float x, float z) {
        const glm::vec2 point = middle + half * glm::vec2(x, z);
        return mesh.add(
            {{point.x, 0.0f, point.y}, {0.0f, 1.0f, 0.0f}, {point.x, 0.0f, point.y}, point, 0.0f});
    };
    const std::uint32_t a = corner(-1.0f, 1.0f);
    const std::uint32_t b = corner(1.0f, 1.0f);
    const std::uint32_t c = corner(1.0f, -1.0f);
    const std::uint32_t d = corner(-1.0f, -1.0f);
    mesh.quad(a, b, c, d);
}

} // namespace render
