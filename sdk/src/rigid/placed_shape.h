// One shape where it is: everything in World.
#pragma once

#include "collide/shape.h"
#include "rigid/body.h"

namespace lks {

struct PlacedShape {
    Shape shape;
    fixed::Vec3 centre;
    fixed::Matrix3 axes;
};

inline PlacedShape place_shape(const Body& body, const BodyShape& s) {
    return {{s.kind, s.radius, s.half_length, s.half_extents},
            body.position + fixed::rotate(body.rotation, s.position),
            shape_axes(body.rotation, s)};
}

} // namespace lks
