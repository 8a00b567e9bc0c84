// The limit of a swing that is no cone: an ellipse with half axes towards the two axes across of a's frame,
// of swings as vectors s: their angle θ, the way φ in which b's axis v has left a's, u. With n the normal of
// the ellipse at the point e next to s, C = n·(s − e) is how far s is beyond it.
//
// A turn about k = u×v/|u×v| changes θ as much, one about m = v×t, t being the way in which φ grows, changes
// φ by 1/sin θ. So C changes the fastest about n_r·k + n_φ·θ/sin θ·m, and by the length of that. A push about
// k alone, towards the middle, would do work on what leans on the edge and moves along it: such chains fed on
// it. In a cone the two are the same.
#pragma once

#include "rigid/joint.h"

namespace lks {

// How far the axes are apart, and about which axis. Square to the edge of an ellipse: along its normal.
struct Swing {
    fixed::Direction axis;
    std::int64_t angle; // World, radians
    std::int64_t limit;
};

// Of a swing by an angle about k; `sine` of the angle has 30 fraction bits.
Swing square_to_edge(const JointConstants& c, const Body& a, const fixed::Direction& v,
                     const fixed::Direction& k, std::int64_t angle, std::int64_t sine);

// The point of a cone's or an ellipse's edge that is next to a swing, and how far the swing is beyond it:
// towards local x and z, World, radians.
struct SwingEdge {
    std::int64_t x, z;
    std::int64_t beyond;
};

SwingEdge nearest_edge(const JointConstants& c, std::int64_t x, std::int64_t z);

} // namespace lks
