// The solid shapes, and their exact signed distance.
//
// All but the plane are a core (a point, a segment, a box) with everything within a radius of it; a
// particle's radius, the `margin`, only makes that radius larger. So there is one formula for the outside of
// them: the way from the nearest point of the core to the particle has the length distance + radius + margin
// and the direction of the normal.
//
// Everything is in the shape's own frame and in Coordinate format. Distances are right to 1e-15 m + 2^-56 m
// for points within 72 m on each axis (a point further out is taken at the edge of that cube: no shape
// reaches past 61 m, so its distance only comes out too small, and positive still). Normals are right to 1.3
// units of 2^-30 an axis.
#pragma once

#include <lockstitch/collider.h>

#include <algorithm>
#include <cstdint>

#include "fixed/formats.h"
#include "fixed/vector.h"

namespace lks {

// Of radii, half lengths and half extents, in World format.
inline constexpr std::int64_t least_shape_size = world_one / 1000;
inline constexpr std::int64_t greatest_shape_size = world_one * 30;

struct Shape {
    std::uint32_t kind; // lks_shape_kind
    std::int64_t radius;
    std::int64_t half_length;
    fixed::Vec3 half_extents;
};

// A shape of Coordinate lengths with World ones.
constexpr Shape world_shape(const Shape& shape) {
    const fixed::Vec3& e = shape.half_extents;
    return {shape.kind,
            world_from_coordinate(shape.radius),
            world_from_coordinate(shape.half_length),
            {world_from_coordinate(e.x), world_from_coordinate(e.y), world_from_coordinate(e.z)}};
}

// From its middle to its nearest side; endless for planes. Of whatever has a shape's kind and sizes.
template <typename Solid>
constexpr std::int64_t thickness(const Solid& solid) {
    const fixed::Vec3& e = solid.half_extents;
    return solid.kind == LKS_SHAPE_PLANE ? INT64_MAX
           : solid.kind == LKS_SHAPE_BOX ? std::min({e.x, e.y, e.z})
                                         : solid.radius;
}

struct SurfacePoint {
    std::int64_t distance;   // negative inside
    fixed::Direction normal; // outwards
};

namespace shape_detail {

inline constexpr std::int64_t far_edge = coordinate_one * 72;

constexpr fixed::Vec3 within_far_edge(const fixed::Vec3& p) {
    return {std::clamp(p.x, -far_edge, far_edge), std::clamp(p.y, -far_edge, far_edge),
            std::clamp(p.z, -far_edge, far_edge)};
}

// From the nearest point of the core to p.
template <lks_shape_kind kind>
constexpr fixed::Vec3 offset_from_core(const Shape& shape, const fixed::Vec3& p) {
    if constexpr (kind == LKS_SHAPE_CAPSULE) {
        return {p.x, p.y - std::clamp(p.y, -shape.half_length, shape.half_length), p.z};
    } else if constexpr (kind == LKS_SHAPE_BOX) {
        const fixed::Vec3& h = shape.half_extents;
        return {p.x - std::clamp(p.x, -h.x, h.x), p.y - std::clamp(p.y, -h.y, h.y),
                p.z - std::clamp(p.z, -h.z, h.z)};
    } else {
        return p;
    }
}

// |v| from the direction that normalise() gave. Where that is off by an angle e, u·v is |v|·|u|·(1 - e²/2):
// with |u| taken out, of e = 2e-9 nothing is left.
constexpr std::int64_t length_along(const fixed::Direction& u, const fixed::Vec3& v) {
    const std::int64_t projected = fixed::dot(u, v);
    // |u|² - 1, Q60; half of it is what |u| is too long, to first order.
    const std::int64_t excess =
        std::int64_t{u.x} * u.x + std::int64_t{u.y} * u.y + std::int64_t{u.z} * u.z - (std::int64_t{1} << 60);
    return projected - (((projected >> 34) * excess) >> 27);
}

// p within the core of a box: the nearest face, on a tie x before y before z, and the positive one where p is
// in the middle.
constexpr SurfacePoint nearest_face(const fixed::Vec3& h, const fixed::Vec3& p) {
    const auto beyond = [](std::int64_t a, std::int64_t extent) { return (a < 0 ? -a : a) - extent; };
    const auto side = [](std::int64_t a) { return a < 0 ? -direction_one : direction_one; };
    const std::int64_t x = beyond(p.x, h.x), y = beyond(p.y, h.y), z = beyond(p.z, h.z);
    if (x >= y && x >= z) {
        return {x, {side(p.x), 0, 0}};
    }
    if (y >= z) {
        return {y, {0, side(p.y), 0}};
    }
    return {z, {0, 0, side(p.z)}};
}

// A vector along one axis, as a box's faces give it: exact, and no root.
constexpr bool along_one_axis(const fixed::Vec3& v, SurfacePoint& out) {
    const auto sign = [](std::int64_t a) { return a < 0 ? -direction_one : direction_one; };
    if (v.x == 0 && v.z == 0) {
        out = {v.y < 0 ? -v.y : v.y, {0, sign(v.y), 0}};
    } else if (v.y == 0 && v.z == 0) {
        out = {v.x < 0 ? -v.x : v.x, {sign(v.x), 0, 0}};
    } else if (v.x == 0 && v.y == 0) {
        out = {v.z < 0 ? -v.z : v.z, {0, 0, sign(v.z)}};
    } else {
        return false;
    }
    return true;
}

// Where p lies on the core itself. A sphere's centre has no nearest point: its +y pole stands in; +x on a
// capsule's axis.
template <lks_shape_kind kind>
constexpr SurfacePoint nearest_from_core(const Shape& shape, const fixed::Vec3& p) {
    if constexpr (kind == LKS_SHAPE_BOX) {
        return nearest_face(shape.half_extents, p);
    } else if constexpr (kind == LKS_SHAPE_CAPSULE) {
        return {0, {direction_one, 0, 0}};
    } else {
        return {0, {0, direction_one, 0}};
    }
}

} // namespace shape_detail

// The nearest point of the shape grown by `margin` (0 .. 1 m).
template <lks_shape_kind kind>
constexpr SurfacePoint nearest_surface(const Shape& shape, const fixed::Vec3& local_point,
                                       std::int64_t margin) {
    if constexpr (kind == LKS_SHAPE_PLANE) {
        const std::int64_t height = std::max(local_point.y, INT64_MIN + margin);
        return {height - margin, {0, direction_one, 0}};
    } else {
        const fixed::Vec3 p = shape_detail::within_far_edge(local_point);
        const fixed::Vec3 offset = shape_detail::offset_from_core<kind>(shape, p);
        const std::int64_t radius = shape.radius + margin;
        SurfacePoint nearest{};
        if ((offset.x | offset.y | offset.z) == 0) {
            nearest = shape_detail::nearest_from_core<kind>(shape, p);
            nearest.distance -= radius;
            return nearest;
        }
        if (kind == LKS_SHAPE_BOX && shape_detail::along_one_axis(offset, nearest)) {
            nearest.distance -= radius;
            return nearest;
        }
        fixed::NormalisedVector unit{};
        fixed::normalise(offset, unit);
        return {shape_detail::length_along(unit.direction, offset) - radius, unit.direction};
    }
}

// True only where distance >= reach, and nearly always there: decided on 24 fraction bits, without a root.
template <lks_shape_kind kind>
constexpr bool is_beyond(const Shape& shape, const fixed::Vec3& local_point, std::int64_t margin,
                         std::int64_t reach) {
    if constexpr (kind == LKS_SHAPE_PLANE) {
        return local_point.y >= fixed::saturating_add(margin, reach);
    } else {
        const fixed::Vec3 p = shape_detail::within_far_edge(local_point);
        const fixed::Vec3 offset = shape_detail::offset_from_core<kind>(shape, p);
        // Lengths rounded down against a reach rounded up.
        const std::uint64_t x = fixed::magnitude(offset.x) >> 32;
        const std::uint64_t y = fixed::magnitude(offset.y) >> 32;
        const std::uint64_t z = fixed::magnitude(offset.z) >> 32;
        const auto far =
            static_cast<std::uint64_t>(fixed::saturating_add(shape.radius + margin, reach) >> 32) + 1;
        return x * x + y * y + z * z > far * far;
    }
}

// The same for a shape whose kind is known at run time only.
SurfacePoint nearest_surface(const Shape& shape, const fixed::Vec3& local_point, std::int64_t margin);
std::int64_t distance_only(const Shape& shape, const fixed::Vec3& local_point, std::int64_t margin);

// The radius about its centre that contains the shape grown by `margin`; a plane has none (the greatest
// number).
std::int64_t bounding_radius(const Shape& shape, std::int64_t margin);

} // namespace lks
