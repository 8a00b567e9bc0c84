#include "collide/shape.h"

namespace lks {

SurfacePoint nearest_surface(const Shape& shape, const fixed::Vec3& local_point, std::int64_t margin) {
    switch (shape.kind) {
    case LKS_SHAPE_SPHERE:
        return nearest_surface<LKS_SHAPE_SPHERE>(shape, local_point, margin);
    case LKS_SHAPE_CAPSULE:
        return nearest_surface<LKS_SHAPE_CAPSULE>(shape, local_point, margin);
    case LKS_SHAPE_BOX:
        return nearest_surface<LKS_SHAPE_BOX>(shape, local_point, margin);
    default:
        return nearest_surface<LKS_SHAPE_PLANE>(shape, local_point, margin);
    }
}

std::int64_t distance_only(const Shape& shape, const fixed::Vec3& local_point, std::int64_t margin) {
    return nearest_surface(shape, local_point, margin).distance;
}

std::int64_t bounding_radius(const Shape& shape, std::int64_t margin) {
    switch (shape.kind) {
    case LKS_SHAPE_SPHERE:
        return shape.radius + margin;
    case LKS_SHAPE_CAPSULE:
        return shape.half_length + shape.radius + margin;
    case LKS_SHAPE_BOX:
        // length() rounds to the nearest unit: one more is enough.
        return static_cast<std::int64_t>(fixed::length(shape.half_extents)) + 1 + margin;
    default:
        return INT64_MAX;
    }
}

} // namespace lks
