#include "projections.h"

#include <cstring>
#include <new>
#include <utility>

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
        lks::DistanceWork work;
        work.set_allocator(world->allocator);
        if (!work.reserve(object.asset().batches.size())) {
            throw std::bad_alloc();
        }
        prepare_distances(object.asset(), object.coefficients(), arrays, work);
        work_.push_back(std::move(work));
    }
}

void Projections::run(std::uint32_t passes) {
    for (const lks::DistanceWork& object : work_) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            for (const lks::DistanceTask& task : object.tasks) {
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
