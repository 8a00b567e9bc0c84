// Where the mass of a body made of shapes is, in plain numbers (sdk/src/rigid/inertia.h).
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>

#include "support/numbers.h"

namespace reference {

// A symmetric matrix.
struct RigidInertia {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    RigidInertia operator+(const RigidInertia& m) const {
        return {xx + m.xx, xy + m.xy, xz + m.xz, yy + m.yy, yz + m.yz, zz + m.zz};
    }
    RigidInertia operator*(double f) const { return {xx * f, xy * f, xz * f, yy * f, yz * f, zz * f}; }
};

struct RigidMass {
    support::Vector centre; // in the frame that the shapes are given in
    RigidInertia inertia;   // of one kilogram about it, in the frame's axes
};

// The shapes share the mass by their volumes and densities.
RigidMass rigid_mass(const lks_body_shape* shapes, std::uint32_t count);

} // namespace reference
