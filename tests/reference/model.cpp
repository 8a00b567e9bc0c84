#include "reference/model.h"

#include <algorithm>
#include <tuple>

namespace reference {

Model model_of(const support::World& world, lks_object_id object, const support::Asset& asset,
               const lks_vec3& place, const std::vector<double>& masses, const Materials& materials,
               EdgeOrder order) {
    Model model;
    model.positions = world.positions_from(object, place);
    model.masses = masses;
    for (const lks_constraint_info& info : asset.constraints()) {
        const lks_distance_material& material = materials[info.family];
        model.edges.push_back({info.vertex_a, info.vertex_b, support::metres(info.rest_length),
                               material.compliance, material.damping, info.family});
    }
    if (order == EdgeOrder::index) {
        std::sort(model.edges.begin(), model.edges.end(), [](const Edge& left, const Edge& right) {
            const auto key = [](const Edge& edge) {
                return std::make_tuple(std::min(edge.a, edge.b), std::max(edge.a, edge.b));
            };
            return key(left) < key(right);
        });
    }
    return model;
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
