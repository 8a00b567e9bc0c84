// How deep bodies of one shape are in each other, in double precision: of capsules and boxes.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/bodies.h"

namespace support {

// A shape in its place.
struct Solid {
    bool box;
    Vector centre;
    Vector axes[3]; // a capsule lies along the second
    Vector half;    // of a box, metres
    double half_length, radius;

    double reach() const { return box ? half.length() : half_length + radius; }
};

inline Solid solid_of(const lks_body_shape& shape, const BodyState& state) {
    Solid solid{shape.shape == LKS_SHAPE_BOX, state.position, {}, metres(shape.half_extents), 0, 0};
    for (int i = 0; i < 3; ++i) {
        solid.axes[i] = rotate(state.rotation, {i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0});
    }
    if (!solid.box) {
        solid.half_length = shape.shape == LKS_SHAPE_CAPSULE ? metres(shape.half_length) : 0;
        solid.radius = metres(shape.radius);
    }
    return solid;
}

// Metres from a point to its surface, negative inside: convex in the point.
inline double distance_from(const Solid& solid, const Vector& point) {
    const Vector from = point - solid.centre;
    if (!solid.box) {
        const double along = std::clamp(from.dot(solid.axes[1]), -solid.half_length, solid.half_length);
        return (from - solid.axes[1] * along).length() - solid.radius;
    }
    const double half[3] = {solid.half.x, solid.half.y, solid.half.z};
    double outside = 0;
    double inside = -1e9;
    for (int i = 0; i < 3; ++i) {
        const double beyond = std::abs(from.dot(solid.axes[i])) - half[i];
        outside += beyond > 0 ? beyond * beyond : 0;
        inside = std::max(inside, beyond);
    }
    return outside > 0 ? std::sqrt(outside) : inside;
}

// The least along a capsule's axis, by thirds.
inline double capsule_gap(const Solid& capsule, const Solid& other) {
    double low = -capsule.half_length;
    double high = capsule.half_length;
    const auto at = [&](double s) { return distance_from(other, capsule.centre + capsule.axes[1] * s); };
    for (int i = 0; i < 60; ++i) {
        const double first = low + (high - low) / 3;
        const double second = high - (high - low) / 3;
        (at(first) < at(second) ? high : low) = at(first) < at(second) ? second : first;
    }
    return at((low + high) / 2) - capsule.radius;
}

// By the axes that may separate two boxes, edges upon edges among them.
inline double box_gap(const Solid& a, const Solid& b) {
    const auto width = [](const Solid& box, const Vector& n) {
        return std::abs(n.dot(box.axes[0])) * box.half.x + std::abs(n.dot(box.axes[1])) * box.half.y +
               std::abs(n.dot(box.axes[2])) * box.half.z;
    };
    double gap = -1e9;
    const auto look = [&](const Vector& n) {
        const double length = n.length();
        if (length > 1e-6) {
            const Vector unit = n * (1 / length);
            gap = std::max(gap, std::abs(unit.dot(b.centre - a.centre)) - width(a, unit) - width(b, unit));
        }
    };
    for (int i = 0; i < 3; ++i) {
        look(a.axes[i]);
        look(b.axes[i]);
        for (const Vector& axis : b.axes) {
            look(cross(a.axes[i], axis));
        }
    }
    return gap;
}

// Metres between them, negative where they overlap. (Of boxes that are apart it may be less than that.)
inline double gap_between(const Solid& a, const Solid& b) {
    return !a.box ? capsule_gap(a, b) : !b.box ? capsule_gap(b, a) : box_gap(a, b);
}

} // namespace support
