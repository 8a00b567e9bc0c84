// Which particles of a cloth or rope a ball on its way may touch.
#pragma once

#include "kernels/kernels.h"
#include "query/near_way.h"
#include "solver/object.h"

namespace lks {

// Calls use(particle) for each that may be touched, in ascending order; those that are left out are not.
template <typename Use>
void visit_near_particles(const Object& object, const Kernels& kernels, const BallWay& way, const Use& use) {
    constexpr std::uint32_t at_once = 64;
    BallWay wider = way;
    wider.radius += world_from_coordinate(object.asset().particle_radius) + 1;
    const int halvings = wider.halvings();
    // The upper halves of coordinates of which the box holds none that are less, or more.
    const auto upper = [](std::int64_t end, std::int64_t origin) {
        const std::int64_t relative = saturating_subtract(end, origin) >> (32 - coordinate_from_world_shift);
        return static_cast<std::int32_t>(std::clamp<std::int64_t>(relative, INT32_MIN, INT32_MAX));
    };
    const fixed::Vec3& o = object.origin;
    const std::int64_t* axes[3] = {object.axis(0), object.axis(1), object.axis(2)};
    for (std::uint32_t first = 0; first < object.count(); first += at_once) {
        const std::uint32_t count = std::min(object.count() - first, at_once);
        constexpr int few = 2;
        std::uint64_t near = near_way(wider, halvings, few, [&](const Box& box) {
            const BoxTask task{{axes[0], axes[1], axes[2]},
                               {axes[0], axes[1], axes[2]},
                               {upper(box.low.x, o.x), upper(box.low.y, o.y), upper(box.low.z, o.z)},
                               {upper(box.high.x, o.x), upper(box.high.y, o.y), upper(box.high.z, o.z)}};
            return kernels.near_box(task, first, count);
        });
        for (; near != 0; near &= near - 1) {
            use(first + static_cast<std::uint32_t>(std::countr_zero(near)));
        }
    }
}

} // namespace lks
