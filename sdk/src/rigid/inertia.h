// Mass, centre and inertia of a body made of shapes.
//
// Lengths are taken in units of 2^scale m, in which every shape lies within half a unit of the centre of
// mass; the inertia is that of one kilogram in these units (squares of gyration radii), and its inverse has
// an exponent of its own. So everything the solver multiplies is below one, whatever the body's size and
// mass.
#pragma once

#include <cstdint>

#include "collide/shape.h"
#include "fixed/rotation.h"
#include "fixed/scaled.h"

namespace lks {

// One shape of a body, in its own frame: sizes in World format (radius, half_length and half_extents of
// lks_shape_kind), where it is in the body, and how heavy.
struct BodyShape {
    std::uint32_t kind; // lks_shape_kind, no plane
    std::int64_t radius;
    std::int64_t half_length;
    fixed::Vec3 half_extents;
    fixed::Vec3 position; // World, from the centre of mass once the body is made
    fixed::Rotation rotation;
    std::int64_t density; // World, kg/m³
};

// xx, xy, xz, yy, yz, zz of a symmetric matrix, 30 fraction bits.
struct SymmetricMatrix {
    std::int32_t xx, xy, xz, yy, yz, zz;

    friend constexpr bool operator==(const SymmetricMatrix&, const SymmetricMatrix&) = default;
};

struct MassProperties {
    fixed::Scaled mass;         // kg
    fixed::Vec3 centre;         // World, in the frame that the shapes were given in
    std::int32_t scale;         // lengths are in units of 2^scale m
    std::int32_t inverse_shift; // the inverse is inverse_inertia · 2^inverse_shift
    SymmetricMatrix inertia;    // of one kilogram, below one half
    SymmetricMatrix inverse_inertia;
    bool round; // the same about every axis
};

// The radius of a ball about the shape's own centre that contains it; World.
std::int64_t bounding_radius(const BodyShape& shape);

// At most eight shapes, within 64 m of the frame's origin, sizes from 1 mm to 30 m, densities above zero.
MassProperties mass_properties(const BodyShape* shapes, std::uint32_t count);

// R·m·Rᵀ.
SymmetricMatrix rotated(const SymmetricMatrix& m, const fixed::Matrix3& rotation);

// m·v, v of any 64-bit format below 2^62.
constexpr fixed::Vec3 multiply(const SymmetricMatrix& m, const fixed::Vec3& v) {
    return {fixed::dot_components(m.xx, m.xy, m.xz, v), fixed::dot_components(m.xy, m.yy, m.yz, v),
            fixed::dot_components(m.xz, m.yz, m.zz, v)};
}

} // namespace lks
