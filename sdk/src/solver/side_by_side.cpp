#include "solver/side_by_side.h"

#include <algorithm>

namespace lks {
namespace {

// Larger ones are no faster for it, and all of a group should stay in the second cache.
constexpr std::uint32_t greatest_count = 512; // particles

bool in_runs_only(const lks_asset& asset) {
    return std::all_of(asset.batches.begin(), asset.batches.end(),
                       [](const Batch& batch) { return batch.first_single == batch.first + batch.count; });
}

// In elements, of one object's particles from another's. They are parts of no common array, but all are
// aligned.
std::ptrdiff_t distance_between(const std::int64_t* from, const std::int64_t* to) {
    const auto bytes = static_cast<std::intptr_t>(reinterpret_cast<std::uintptr_t>(to) -
                                                  reinterpret_cast<std::uintptr_t>(from));
    return bytes / static_cast<std::intptr_t>(sizeof(std::int64_t));
}

} // namespace

bool may_go_side_by_side(const Kernels& kernels, const Object& object) {
    return kernels.side_by_side && object.count() <= greatest_count && object.multipliers.empty() &&
           object.coefficients().chain.empty() && in_runs_only(object.asset());
}

bool are_alike(const Object& a, const Object& b) {
    return &a.asset() == &b.asset() && a.pins().size() == b.pins().size() &&
           std::equal(a.pins().begin(), a.pins().end(), b.pins().begin(),
                      [](const Pin& p, const Pin& q) { return p.particle == q.particle; });
}

void put_side_by_side(const Object* const* objects, std::uint32_t count, DistanceWork& work,
                      std::ptrdiff_t* places) {
    if (count == 1) {
        return;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        places[i] = distance_between(objects[0]->axis(0), objects[i]->axis(0));
    }
    for (DistanceTask& task : work.tasks) {
        task.objects = places;
        task.object_count = count;
    }
}

} // namespace lks
