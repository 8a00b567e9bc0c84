// The bodies and colliders of a demo scene as shapes in their places, in double precision.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "scenes/scene.h"
#include "support/overlaps.h"

namespace support {

// Of a look: a body's first shape, in the body's middle, or a collider.
template <typename ShapeLook>
Solid scene_solid(const ShapeLook& look, const lks_transform& transform) {
    lks_body_shape shape = lks_default_body_shape();
    shape.shape = look.shape;
    shape.radius = fixed(look.radius);
    shape.half_length = fixed(look.half_length);
    shape.half_extents = fixed(look.half_extents[0], look.half_extents[1], look.half_extents[2]);
    return solid_of(shape, {metres(transform.position), {}, {}, transform.rotation});
}

// Bodies of one shape; behind it a figure's looks have the balls that are drawn where it turns.
inline std::vector<Solid> body_solids(const lks_demo::Scene& scene) {
    std::vector<Solid> solids;
    for (const lks_demo::BodyLook& look : scene.bodies()) {
        REQUIRE(std::abs(look.shapes[0].position[0]) + std::abs(look.shapes[0].position[1]) +
                    std::abs(look.shapes[0].position[2]) ==
                0);
        lks_transform transform{};
        REQUIRE(lks_body_transform(scene.world(), look.id, &transform) == LKS_OK);
        solids.push_back(scene_solid(look.shapes[0], transform));
    }
    return solids;
}

// How deep it is below a plane through a point.
inline double depth_below(const Solid& solid, const Vector& point, const Vector& normal) {
    double reach = solid.radius;
    if (solid.box) {
        reach = std::abs(normal.dot(solid.axes[0])) * solid.half.x +
                std::abs(normal.dot(solid.axes[1])) * solid.half.y +
                std::abs(normal.dot(solid.axes[2])) * solid.half.z;
    } else {
        reach += std::abs(normal.dot(solid.axes[1])) * solid.half_length;
    }
    return reach - (solid.centre - point).dot(normal);
}

// How deep any body is in another or in a collider, but for those of which neighbours(i, j), i > j, says that
// they share a joint.
template <typename Neighbours>
double deepest_overlap(const lks_demo::Scene& scene, const Neighbours& neighbours) {
    const std::vector<Solid> solids = body_solids(scene);
    double deepest = 0;
    for (const lks_demo::ColliderLook& look : scene.colliders()) {
        lks_transform transform{};
        REQUIRE(lks_collider_transform(scene.world(), look.id, &transform) == LKS_OK);
        const bool plane = look.shape == LKS_SHAPE_PLANE;
        const Solid collider = plane ? Solid{} : scene_solid(look, transform);
        for (const Solid& solid : solids) {
            deepest = std::max(deepest, plane ? depth_below(solid, metres(transform.position),
                                                            rotate(transform.rotation, {0, 1, 0}))
                                              : -gap_between(solid, collider));
        }
    }
    for (std::size_t i = 0; i < solids.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double apart = (solids[i].centre - solids[j].centre).length();
            if (apart < solids[i].reach() + solids[j].reach() && !neighbours(i, j)) {
                deepest = std::max(deepest, -gap_between(solids[i], solids[j]));
            }
        }
    }
    return deepest;
}

} // namespace support
