// An object carried along by a frame that jumps from one transform to another.
//
// Where the frame does not turn, the object's origin jumps by as much and no coordinate changes. Else the
// object turns about the middle of its particles, which becomes its new origin: so that what reaches far is
// in range wherever it was in its local frame. What the origin is rounded by is added to the coordinates
// before they are rounded, so that each is rounded once.
#pragma once

#include "fixed/turn_between.h"
#include "solver/object.h"

namespace lks {

struct Carrying {
    fixed::TurnBetween turn;
    fixed::Vec3 origin; // the new one, World; saturated
    // Where the frame turns:
    fixed::Vec3 middle;    // about the old origin, whole World units, Coordinate
    fixed::Int128 rest[3]; // by which the new origin is too low, with turn_matrix_bits more than Coordinate
};

// A place in the world, and how it is turned.
struct Frame {
    fixed::Vec3 position; // World, within ±world_position_limit
    fixed::Rotation rotation;
};

Carrying plan_carrying(const Kernels& kernels, const Object& object, const Frame& from, const Frame& to);
// Where a particle will be about the new origin; saturates.
Coordinates carried_position(const Carrying& carrying, const Coordinates& position);
// Positions, the motions of the last substep and pin targets. How many of these left the range and were
// clamped.
std::uint64_t carry(Object& object, const Carrying& carrying);

} // namespace lks
