#include "collide/broad_phase.h"

#include <algorithm>

#include "collide/extent.h"
#include "collide/plane_motion.h"
#include "collide/saturation.h"
#include "solver/object.h"

namespace lks {
namespace {

// The ends of a tick's motion bound the height of each corner only where the plane does not turn; one that
// does is always a candidate, and left to each substep.
bool plane_may_touch(const ColliderState& collider, const fixed::Vec3& origin, const Bounds& bounds,
                     std::int64_t margin) {
    if (collider.rotates()) {
        return true;
    }
    const fixed::Direction normal = plane_normal(fixed::to_matrix(collider.rotation));
    const fixed::Int128 reach = fixed::to_int128(margin) << direction_fraction_bits;
    return lowest_height(normal, collider.position, origin, bounds) <= reach ||
           lowest_height(normal, collider.target_position, origin, bounds) <= reach;
}

// Half the size of the shape on each axis in every pose of the tick.
fixed::Vec3 swept_extent(const ColliderState& collider, std::int64_t margin) {
    if (collider.rotates()) {
        const std::int64_t radius = bounding_radius(collider.shape, margin);
        return {radius, radius, radius};
    }
    return axis_extent(collider.shape, fixed::to_matrix(collider.rotation), margin);
}

// One axis, World: everything is rounded away from the other.
bool axis_overlaps(std::int64_t position, std::int64_t target, std::int64_t origin, std::int64_t extent,
                   std::int64_t low, std::int64_t high) {
    // Room for the rotation's rounding: two units of 9e-13 m, and 2^-20 m.
    const std::int64_t reach =
        (extent >> coordinate_from_world_shift) + 2 + (std::int64_t{1} << (world_fraction_bits - 20));
    const std::int64_t least = saturating_subtract(std::min(position, target), origin);
    const std::int64_t greatest = saturating_subtract(std::max(position, target), origin);
    return saturating_subtract(least, reach) <= (high >> coordinate_from_world_shift) + 1 &&
           fixed::saturating_add(greatest, reach) >= (low >> coordinate_from_world_shift);
}

} // namespace

bool may_touch(const ColliderState& collider, const fixed::Vec3& origin, const Bounds& bounds,
               std::int64_t margin) {
    if (collider.shape.kind == LKS_SHAPE_PLANE) {
        return plane_may_touch(collider, origin, bounds, margin);
    }
    const fixed::Vec3 extent = swept_extent(collider, margin);
    const fixed::Vec3& p = collider.position;
    const fixed::Vec3& t = collider.target_position;
    return axis_overlaps(p.x, t.x, origin.x, extent.x, bounds.low.x, bounds.high.x) &&
           axis_overlaps(p.y, t.y, origin.y, extent.y, bounds.low.y, bounds.high.y) &&
           axis_overlaps(p.z, t.z, origin.z, extent.z, bounds.low.z, bounds.high.z);
}

} // namespace lks
