#include "reference/asset_model.h"

namespace reference {

Model model_of(const support::World& world, lks_object_id object, const support::Asset& asset,
               const lks_vec3& place, const std::vector<double>& masses, const Materials& materials,
               EdgeOrder order) {
    Model model{world.positions_from(object, place), masses, edges_of(asset, materials, order)};
    model.tethers = tethers_of(asset);
    return model;
}

} // namespace reference
