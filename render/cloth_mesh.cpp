// A cloth with thickness: the sheet twice, half the thickness to either side along the normals, and a
// half-round hem around every border, so that an edge looks like folded cloth and not like paper.
#include "render/mesh.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace render {
namespace {

struct BorderEdge {
    std::uint32_t a; // counter-clockwise with its triangle, seen from the front
    std::uint32_t b;
    std::uint32_t opposite;
};

glm::vec3 vec3_at(const std::vector<float>& values, std::size_t index) {
    return {values[index * 3], values[index * 3 + 1], values[index * 3 + 2]};
}

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
    const float length = glm::length(v);
    return length > 1e-12f ? v / length : otherwise;
}

std::vector<glm::vec3> cloth_normals(const Cloth& cloth) {
    const std::size_t count = cloth.positions.size() / 3;
    std::vector<glm::vec3> normals(count, glm::vec3(0.0f));
    if (!cloth.normals.empty()) {
        for (std::size_t i = 0; i < count; ++i) {
            normals[i] = vec3_at(cloth.normals, i);
        }
    } else {
        for (std::size_t t = 0; t + 2 < cloth.triangles.size(); t += 3) {
            const std::array<std::uint32_t, 3> corner = {cloth.triangles[t], cloth.triangles[t + 1],
                                                         cloth.triangles[t + 2]};
            const glm::vec3 origin = vec3_at(cloth.positions, corner[0]);
            const glm::vec3 twice_area = glm::cross(vec3_at(cloth.positions, corner[1]) - origin,
                                                    vec3_at(cloth.positions, corner[2]) - origin);
            for (const std::uint32_t vertex : corner) {
                normals[vertex] += twice_area;
            }
        }
    }
    for (glm::vec3& normal : normals) {
        normal = unit_or(normal, glm::vec3(0.0f, 0.0f, 1.0f));
    }
    return normals;
}

// Edges of exactly one triangle, in the order of their vertices.
std::vector<BorderEdge> border_edges(const std::vector<std::uint32_t>& triangles) {
    struct HalfEdge {
        std::uint64_t key;
        BorderEdge edge;
    };
    std::vector<HalfEdge> edges;
    edges.reserve(triangles.size());
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t a = triangles[t + side];
            const std::uint32_t b = triangles[t + (side + 1) % 3];
            const std::uint32_t c = triangles[t + (side + 2) % 3];
            edges.push_back({(static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b), {a, b, c}});
        }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const HalfEdge& x, const HalfEdge& y) { return x.key < y.key; });
    std::vector<BorderEdge> border;
    for (std::size_t first = 0; first < edges.size();) {
        std::size_t last = first + 1;
        while (last < edges.size() && edges[last].key == edges[first].key) {
            ++last;
        }
        if (last - first == 1) {
            border.push_back(edges[first].edge);
        }
        first = last;
    }
    return border;
}

} // namespace

void append_cloth(Mesh& mesh, const Cloth& cloth) {
    const std::size_t count = cloth.positions.size() / 3;
    const float half = cloth.thickness * 0.5f;
    const std::vector<glm::vec3> normals = cloth_normals(cloth);
    const auto texture = [&](std::size_t i) {
        return glm::vec2(cloth.texture[i * 2], cloth.texture[i * 2 + 1]);
    };

    const auto front = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < count; ++i) {
        mesh.add(
            {vec3_at(cloth.positions, i) + normals[i] * half, normals[i], glm::vec3(0.0f), texture(i), 0.0f});
    }
    const auto back = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t i = 0; i < count; ++i) {
        mesh.add({vec3_at(cloth.positions, i) - normals[i] * half, -normals[i], glm::vec3(0.0f), texture(i),
                  1.0f});
    }
    for (std::size_t t = 0; t + 2 < cloth.triangles.size(); t += 3) {
        const std::uint32_t a = cloth.triangles[t];
        const std::uint32_t b = cloth.triangles[t + 1];
        const std::uint32_t c = cloth.triangles[t + 2];
        mesh.triangle(front + a, front + b, front + c);
        mesh.triangle(back + a, back + c, back + b);
    }

    // The hem: outwards in the sheet at every border vertex, from its two border edges.
    const std::vector<BorderEdge> border = border_edges(cloth.triangles);
    std::vector<glm::vec3> outward(count, glm::vec3(0.0f));
    for (const BorderEdge& edge : border) {
        const glm::vec3 a = vec3_at(cloth.positions, edge.a);
        const glm::vec3 along = unit_or(vec3_at(cloth.positions, edge.b) - a, glm::vec3(0.0f));
        const glm::vec3 inward = vec3_at(cloth.positions, edge.opposite) - a;
        const glm::vec3 out = unit_or(along * glm::dot(inward, along) - inward, glm::vec3(0.0f));
        outward[edge.a] += out;
        outward[edge.b] += out;
    }
    // Five points of a half circle from front to back.
    constexpr std::array<glm::vec2, 5> arc = {glm::vec2(1.0f, 0.0f), glm::vec2(0.70710678f, 0.70710678f),
                                              glm::vec2(0.0f, 1.0f), glm::vec2(-0.70710678f, 0.70710678f),
                                              glm::vec2(-1.0f, 0.0f)};
    std::vector<std::uint32_t> hem(count, 0xffffffffu);
    const auto hem_of = [&](std::uint32_t vertex) {
        if (hem[vertex] == 0xffffffffu) {
            const glm::vec3 normal = normals[vertex];
            const glm::vec3 out =
                unit_or(outward[vertex] - normal * glm::dot(outward[vertex], normal), glm::vec3(0.0f));
            for (std::size_t i = 0; i < arc.size(); ++i) {
                const glm::vec3 direction = normal * arc[i].x + out * arc[i].y;
                const std::uint32_t added =
                    mesh.add({vec3_at(cloth.positions, vertex) + direction * half, unit_or(direction, normal),
                              glm::vec3(0.0f), texture(vertex), 0.25f * static_cast<float>(i)});
                if (i == 0) {
                    hem[vertex] = added;
                }
            }
        }
        return hem[vertex];
    };
    for (const BorderEdge& edge : border) {
        const std::uint32_t a = hem_of(edge.a);
        const std::uint32_t b = hem_of(edge.b);
        for (std::uint32_t i = 0; i + 1 < arc.size(); ++i) {
            mesh.quad(a + i, a + i + 1, b + i + 1, b + i);
        }
    }
}

} // namespace render
