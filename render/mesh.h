// Triangles on their way to the card. One vertex format for everything, so one buffer holds a whole frame.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/frame.h"

namespace render {

struct Vertex {
    glm::vec3 position; // world, or local for shapes
    glm::vec3 normal;
    glm::vec3 axis;    // cloth: nothing; rope: unit tangent; shape: local position, for markings
    glm::vec2 texture; // cloth: u, v in metres; rope: turn around the axis 0..1, rest arc in metres; plane:
                       // local x, z
    float part;        // cloth: 0 front .. 1 back; rope: 0 body .. 1 end cap
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;

    void clear() {
        vertices.clear();
        indices.clear();
    }
    std::uint32_t add(const Vertex& vertex) {
        vertices.push_back(vertex);
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices.insert(indices.end(), {a, b, c});
    }
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
};

// All append to the mesh. Triangles are counter-clockwise from outside.
void append_cloth(Mesh& mesh, const Cloth& cloth);
void append_rope(Mesh& mesh, const Rope& rope);
void append_shape(Mesh& mesh, const Shape& shape);
// An endless plane is a large square around the point of the plane under `centre`.
void append_plane(Mesh& mesh, const Shape& shape, glm::vec3 centre, float half_size);

} // namespace render
