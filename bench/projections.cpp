#include "projections.h"

#include <cstring>

#include "solver/distance.h"

namespace lks_bench {

Projections::Projections(lks_world* world) : world_(world) {
    for (lks::ObjectSlot& slot : world->objects) {
        lks::Object& object = *slot.object;
        saved_.emplace_back(object.particles.begin(), object.particles.end());
        const lks::DistanceArrays arrays{object.axis(0),
                                         object.axis(1),
                                         object.axis(2),
                                         object.start_axis(0),
                                         object.start_axis(1),
                                         object.start_axis(2),
                                         object.multipliers.empty() ? nullptr : object.multipliers.data()};
        tasks_.emplace_back();
        for (std::uint32_t b = 0; b < object.asset().batches.size(); ++b) {
            tasks_.back().push_back(whole_batch(object.asset(), object.coefficients(), b, arrays));
        }
    }
}

void Projections::run(std::uint32_t passes) {
    for (const std::vector<lks::DistanceTask>& object : tasks_) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            for (const lks::DistanceTask& task : object) {
                world_->kernels->project_distances(task);
            }
        }
    }
}

void Projections::restore() {
    for (std::size_t i = 0; i < saved_.size(); ++i) {
        std::memcpy(world_->objects[i].object->particles.data(), saved_[i].data(),
                    saved_[i].size() * sizeof(std::int64_t));
    }
}

} // namespace lks_bench
