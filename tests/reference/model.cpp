#include "reference/model.h"

#include <algorithm>
#include <tuple>

namespace reference {

Triangle make_triangle(const std::array<std::uint32_t, 3>& corners,
                       const std::array<std::array<double, 2>, 3>& rest, double young, double poisson) {
    const double ux = rest[1][0] - rest[0][0];
    const double uy = rest[1][1] - rest[0][1];
    const double vx = rest[2][0] - rest[0][0];
    const double vy = rest[2][1] - rest[0][1];
    const double twice_area = ux * vy - uy * vx;
    Triangle triangle{};
    triangle.corners = corners;
    triangle.slopes[1] = {vy / twice_area, -vx / twice_area};
    triangle.slopes[2] = {-uy / twice_area, ux / twice_area};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        triangle.slopes[0][axis] = -triangle.slopes[1][axis] - triangle.slopes[2][axis];
    }
    const double scale = 2 / (young * twice_area);
    triangle.compliance = {
        {{scale, -poisson * scale, 0}, {-poisson * scale, scale, 0}, {0, 0, 2 * (1 + poisson) * scale}}};
    return triangle;
}

std::vector<Edge> edges_of(const lks_asset* asset, const Materials& materials, EdgeOrder order) {
    std::vector<Edge> edges;
    for (std::uint32_t i = 0; i < lks_asset_constraint_count(asset); ++i) {
        lks_constraint_info info{};
        lks_asset_constraint(asset, i, &info);
        const lks_distance_material& material = materials[info.family];
        edges.push_back({info.vertex_a, info.vertex_b, support::metres(info.rest_length), material.compliance,
                         material.damping, info.family});
    }
    if (order == EdgeOrder::index) {
        std::sort(edges.begin(), edges.end(), [](const Edge& left, const Edge& right) {
            const auto key = [](const Edge& edge) {
                return std::make_tuple(std::min(edge.a, edge.b), std::max(edge.a, edge.b));
            };
            return key(left) < key(right);
        });
    }
    return edges;
}

std::vector<Tether> tethers_of(const lks_asset* asset) {
    std::vector<Tether> found;
    for (std::uint32_t vertex = 0; vertex < lks_asset_vertex_count(asset); ++vertex) {
        lks_tether tethers[LKS_MAX_TETHERS_PER_VERTEX];
        const std::uint32_t count = lks_asset_vertex_tethers(asset, vertex, tethers);
        for (std::uint32_t i = 0; i < count; ++i) {
            found.push_back({vertex, tethers[i].anchor, support::metres(tethers[i].length)});
        }
    }
    return found;
}

std::vector<std::size_t> segments_of(const std::vector<Edge>& edges) {
    std::vector<std::size_t> segments;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (edges[i].family == LKS_CONSTRAINT_STRETCH) {
            segments.push_back(i);
        }
    }
    std::sort(segments.begin(), segments.end(), [&](std::size_t l, std::size_t r) {
        return std::min(edges[l].a, edges[l].b) < std::min(edges[r].a, edges[r].b);
    });
    return segments;
}

} // namespace reference
