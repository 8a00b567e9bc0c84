// Planes: endless, and given by a position that may be thousands of kilometres from the object.
#pragma once

#include "collide/collider_motion.h"
#include "fixed/int128.h"

namespace lks {

// The height of a point (Coordinate, around `origin`) above the plane through `position` with normal n:
// exact, 86 fraction bits. The world positions enter as n·position - n·origin, which is linear and unrounded:
// moving both changes nothing.
fixed::Int128 height_above_plane(const fixed::Direction& normal, const fixed::Vec3& position,
                                 const fixed::Vec3& origin, const fixed::Vec3& point);
// The same of a World point, World, to the nearest; saturates.
std::int64_t world_height_above_plane(const fixed::Direction& normal, const fixed::Vec3& position,
                                      const fixed::Vec3& point);
inline constexpr int height_fraction_bits = coordinate_fraction_bits + direction_fraction_bits;

// The height of the lowest corner of the bounds.
fixed::Int128 lowest_height(const fixed::Direction& normal, const fixed::Vec3& position,
                            const fixed::Vec3& origin, const Bounds& bounds);

// The world's direction of the local y axis.
constexpr fixed::Direction plane_normal(const fixed::Matrix3& rotation) {
    return {rotation.m[0][1], rotation.m[1][1], rotation.m[2][1]};
}

// Sets the frame's centres, given its rotations: at the start the point of the plane nearest to the middle of
// the bounds; at the end where the motion has carried that point, put back into the plane against the
// rounding of a long lever. False: all of the bounds is above the plane at the end of the substep, and
// nothing touches.
//
// What is deeper than 32 m below a plane is lifted by 32 m a substep.
bool place_plane(ContactFrame& frame, const fixed::Vec3& start, const fixed::Vec3& end,
                 const fixed::Vec3& origin, const Bounds& bounds);

} // namespace lks
