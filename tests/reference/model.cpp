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
                               material.compliance, material.damping});
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

} // namespace reference
