// A rope: a tube swept along a Catmull-Rom curve through the points, on frames carried along by parallel
// transport (no spin of their own), with half-round caps. The lay of the strands is shading, on the turn and
// the rest arc.
#include "render/mesh.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace render {
namespace {

constexpr std::uint32_t sides = 14;
constexpr std::uint32_t cap_rings = 4;
constexpr int most_steps_a_segment = 8;
constexpr float bend_a_step = 0.12f; // radians of bend that one straight piece may hide

struct CurvePoint {
    glm::vec3 position;
    glm::vec3 tangent;
    float arc;
};

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
    const float length = glm::length(v);
    return length > 1e-12f ? v / length : otherwise;
}

// Points that lie on each other have no direction between them and are merged.
void distinct_points(const Rope& rope, std::vector<glm::vec3>& points, std::vector<float>& arc) {
    const std::size_t count = rope.positions.size() / 3;
    float length = 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 point(rope.positions[i * 3], rope.positions[i * 3 + 1], rope.positions[i * 3 + 2]);
        const float step = points.empty() ? 0.0f : glm::distance(points.back(), point);
        if (!points.empty() && step < 1e-5f) {
            continue;
        }
        length += step;
        points.push_back(point);
        arc.push_back(rope.rest_arc.empty() ? length : rope.rest_arc[i]);
    }
    if (points.size() == 1) {
        points.push_back(points[0] + glm::vec3(0.0f, -1e-4f, 0.0f));
        arc.push_back(arc[0]);
    }
}

std::vector<CurvePoint> smooth_curve(const Rope& rope) {
    std::vector<glm::vec3> points;
    std::vector<float> arc;
    distinct_points(rope, points, arc);
    const std::size_t count = points.size();

    // How much the rope bends at a point decides how many steps its two segments get.
    std::vector<float> bend(count, 0.0f);
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const glm::vec3 before = unit_or(points[i] - points[i - 1], glm::vec3(0.0f));
        const glm::vec3 after = unit_or(points[i + 1] - points[i], glm::vec3(0.0f));
        bend[i] = std::acos(std::clamp(glm::dot(before, after), -1.0f, 1.0f));
    }
    std::vector<CurvePoint> curve;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const glm::vec3 p1 = points[i];
        const glm::vec3 p2 = points[i + 1];
        const glm::vec3 p0 = i > 0 ? points[i - 1] : p1 * 2.0f - p2;
        const glm::vec3 p3 = i + 2 < count ? points[i + 2] : p2 * 2.0f - p1;
        const glm::vec3 m1 = (p2 - p0) * 0.5f;
        const glm::vec3 m2 = (p3 - p1) * 0.5f;
        const float sharpest = std::max(bend[i], bend[i + 1]);
        const int steps =
            std::clamp(static_cast<int>(std::ceil(sharpest / bend_a_step)), 1, most_steps_a_segment);
        for (int step = 0; step < steps; ++step) {
            const float t = static_cast<float>(step) / static_cast<float>(steps);
            const float t2 = t * t;
            const float t3 = t2 * t;
            const glm::vec3 position = p1 * (2.0f * t3 - 3.0f * t2 + 1.0f) + m1 * (t3 - 2.0f * t2 + t) +
                                       p2 * (3.0f * t2 - 2.0f * t3) + m2 * (t3 - t2);
            const glm::vec3 slope = p1 * (6.0f * t2 - 6.0f * t) + m1 * (3.0f * t2 - 4.0f * t + 1.0f) +
                                    p2 * (6.0f * t - 6.0f * t2) + m2 * (3.0f * t2 - 2.0f * t);
            curve.push_back({position, unit_or(slope, unit_or(p2 - p1, glm::vec3(0.0f, 1.0f, 0.0f))),
                             arc[i] + (arc[i + 1] - arc[i]) * t});
        }
    }
    const glm::vec3 last_step = unit_or(points[count - 1] - points[count - 2], glm::vec3(0.0f, 1.0f, 0.0f));
    curve.push_back({points[count - 1], last_step, arc[count - 1]});
    return curve;
}

// The smallest rotation that takes one unit vector to another, applied to v.
glm::vec3 carry(glm::vec3 v, glm::vec3 from, glm::vec3 to) {
    const glm::vec3 axis = glm::cross(from, to);
    const float cosine = glm::dot(from, to);
    if (cosine < -0.9999f) {
        return -v;
    }
    return v * cosine + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1.0f + cosine));
}

std::uint32_t append_ring(Mesh& mesh, const CurvePoint& point, glm::vec3 side, float radius, float along,
                          float lean, float part) {
    const glm::vec3 other = glm::cross(point.tangent, side);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const float flat = std::sqrt(std::max(0.0f, 1.0f - lean * lean));
    for (std::uint32_t i = 0; i <= sides; ++i) {
        const float turn = static_cast<float>(i) / static_cast<float>(sides);
        const float angle = turn * glm::two_pi<float>();
        const glm::vec3 out = side * std::cos(angle) + other * std::sin(angle);
        mesh.add({point.position + out * radius + point.tangent * along,
                  out * flat + point.tangent * lean,
                  point.tangent,
                  {turn, point.arc + along},
                  part});
    }
    return first;
}

void join_rings(Mesh& mesh, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t i = 0; i < sides; ++i) {
        mesh.quad(from + i, from + i + 1, to + i + 1, to + i);
    }
}

} // namespace

void append_rope(Mesh& mesh, const Rope& rope) {
    const std::vector<CurvePoint> curve = smooth_curve(rope);
    // Starting from a fixed direction carried to the first tangent, and not from the axis the tangent is
    // farthest from, keeps the roll from jumping between two pictures.
    const glm::vec3 reference(0.0f, 1.0f, 0.0f);
    glm::vec3 side = carry(glm::vec3(1.0f, 0.0f, 0.0f), reference, curve.front().tangent);

    std::uint32_t previous = 0;
    for (std::uint32_t ring = 0; ring <= cap_rings; ++ring) {
        const float angle = static_cast<float>(ring) / static_cast<float>(cap_rings) * glm::half_pi<float>();
        const std::uint32_t current = append_ring(mesh, curve.front(), side, rope.radius * std::sin(angle),
                                                  -rope.radius * std::cos(angle), -std::cos(angle), 1.0f);
        if (ring > 0) {
            join_rings(mesh, previous, current);
        }
        previous = current;
    }
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (i > 0) {
            side = carry(side, curve[i - 1].tangent, curve[i].tangent);
            side = unit_or(side - curve[i].tangent * glm::dot(side, curve[i].tangent), side);
        }
        const std::uint32_t current = append_ring(mesh, curve[i], side, rope.radius, 0.0f, 0.0f, 0.0f);
        if (i > 0) {
            join_rings(mesh, previous, current);
        }
        previous = current;
    }
    for (std::uint32_t ring = 0; ring <= cap_rings; ++ring) {
        const float angle = static_cast<float>(ring) / static_cast<float>(cap_rings) * glm::half_pi<float>();
        const std::uint32_t current = append_ring(mesh, curve.back(), side, rope.radius * std::cos(angle),
                                                  rope.radius * std::sin(angle), std::sin(angle), 1.0f);
        if (ring > 0) {
            join_rings(mesh, previous, current);
        }
        previous = current;
    }
}

} // namespace render
