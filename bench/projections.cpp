#include "projections.h"

#include <cstring>
#include <new>
#include <utility>

#include "solver/side_by_side.h"

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
    side_by_side_.resize(work_.size(), 1);
    places_.resize(work_.size());
    put_side_by_side();
}

void Projections::run(std::uint32_t passes) {
    for (std::size_t first = 0; first < work_.size(); first += side_by_side_[first]) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            for (const lks::DistanceTask& task : work_[first].tasks) {
                world_->kernels->project_distances(task);
            }
        }
    }
}

void Projections::put_side_by_side() {
    const auto object = [this](std::size_t i) -> lks::Object& { return *world_->objects[i].object; };
    const auto may = [&](std::size_t i) { return may_go_side_by_side(*world_->kernels, object(i)); };
    for (std::size_t first = 0; first < work_.size(); first += side_by_side_[first]) {
        std::size_t end = first + 1;
        while (may(first) && end < work_.size() && end - first < lks::most_side_by_side && may(end) &&
               are_alike(object(first), object(end))) {
            ++end;
        }
        if (end - first < lks::least_side_by_side) {
            continue;
        }
        side_by_side_[first] = end - first;
        for (std::size_t i = first; i < end; ++i) {
            places_[i] = distance_between(object(first), object(i));
        }
        for (lks::DistanceTask& task : work_[first].tasks) {
            task.objects = places_.data() + first;
            task.object_count = static_cast<std::uint32_t>(end - first);
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
