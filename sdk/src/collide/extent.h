// Half the size, along the object's axes, of a shape under a rotation.
#pragma once

#include "collide/shape.h"
#include "fixed/rotation.h"

namespace lks {

namespace extent_detail {

// |entry| · length, rounded up.
constexpr std::int64_t share(std::int32_t entry, std::int64_t length) {
    return fixed::scale_component(entry < 0 ? -entry : entry, length) + 1;
}

} // namespace extent_detail

// Of the shape grown by `margin`; not less than it is but for the matrix' own rounding (1e-9 of it). Not for
// planes.
constexpr fixed::Vec3 axis_extent(const Shape& shape, const fixed::Matrix3& rotation, std::int64_t margin) {
    std::int64_t extent[3] = {};
    for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t(&row)[3] = rotation.m[axis];
        extent[axis] = shape.radius + margin;
        if (shape.kind == LKS_SHAPE_CAPSULE) {
            extent[axis] += extent_detail::share(row[1], shape.half_length);
        } else if (shape.kind == LKS_SHAPE_BOX) {
            extent[axis] += extent_detail::share(row[0], shape.half_extents.x) +
                            extent_detail::share(row[1], shape.half_extents.y) +
                            extent_detail::share(row[2], shape.half_extents.z);
        }
    }
    return {extent[0], extent[1], extent[2]};
}

} // namespace lks
