#include "projections.h"

#include <cstring>

#include "solver/distance.h"

namespace lks_bench {

Projections::Projections(lks_world* world) : world_(world) {
    for (lks::ObjectSlot& slot : world->objects) {
        saved_.emplace_back(slot.object->particles.begin(), slot.object->particles.end());
    }
}

void Projections::run(std::uint32_t passes) {
    for (lks::ObjectSlot& slot : world_->objects) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            project(*slot.object);
        }
    }
}

void Projections::restore() {
    for (std::size_t i = 0; i < saved_.size(); ++i) {
        std::memcpy(world_->objects[i].object->particles.data(), saved_[i].data(),
                    saved_[i].size() * sizeof(std::int64_t));
    }
}

void Projections::project(lks::Object& object) const {
    const lks_asset& asset = object.asset();
    const lks::DistanceArrays arrays{object.axis(0),
                                     object.axis(1),
                                     object.axis(2),
                                     object.start_axis(0),
                                     object.start_axis(1),
                                     object.start_axis(2),
                                     object.multipliers.empty() ? nullptr : object.multipliers.data()};
    for (std::uint32_t b = 0; b < asset.batches.size(); ++b) {
        const lks::Batch& batch = asset.batches[b];
        project_distances(asset, object.coefficients(), b, {batch.first, batch.first + batch.count}, arrays,
                          *world_->kernels);
    }
}

} // namespace lks_bench
