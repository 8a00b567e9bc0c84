#include "projections.h"

#include <cstring>
#include <new>

#include "solver/object_arrays.h"
#include "solver/side_by_side.h"

namespace lks_bench {

Projections::Projections(lks_world* world) : world_(world) {
    const auto prepare = [this](lks::Object* const* objects, std::uint32_t count) {
        work_.push_back(work_of(objects, count));
    };
    lks::Neighbours neighbours(*world->kernels, prepare);
    for (lks::ObjectSlot& slot : world->objects) {
        saved_.emplace_back(slot.object->particles.begin(), slot.object->particles.end());
        neighbours.add(*slot.object);
    }
    neighbours.finish();
}

Projections::Work Projections::work_of(lks::Object* const* objects, std::uint32_t count) const {
    lks::Object& object = *objects[0];
    Work work;
    work.distances.set_allocator(world_->allocator);
    work.places.resize(count);
    work.scratch.set_allocator(world_->allocator);
    if (!work.distances.reserve(object.asset().batches.size()) ||
        !work.scratch.reserve(lks::row_words(object.asset(), object.coefficients()))) {
        throw std::bad_alloc();
    }
    if (is_swept_in_rows(*world_->kernels, object.asset(), object.coefficients())) {
        work.particles = object.count();
        work.rows.emplace(object, work.scratch.data());
    }
    prepare_distances(object.asset(), object.coefficients(),
                      work.rows ? work.rows->arrays() : distance_arrays(object), work.rows.has_value(),
                      work.distances);
    put_side_by_side(objects, count, work.distances, work.places.data());
    return work;
}

void Projections::run(std::uint32_t passes) {
    for (const Work& work : work_) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            if (work.rows) {
                work.rows->take(*world_->kernels, 0, work.particles);
            }
            for (const lks::DistanceTask& task : work.distances.tasks) {
                world_->kernels->project_distances(task);
            }
            if (work.rows) {
                work.rows->give_back(*world_->kernels, 0, work.particles);
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
