// How large shapes in their places are, and whether two of them pass each other by.
#pragma once

#include "collide/manifold.h"

namespace lks {

// From its middle to its farthest point, or further. Not for planes.
std::int64_t reach(const Piece& piece);
// Half its size along the axes of the world. Not for planes.
fixed::Vec3 extent(const Piece& piece);

// Whether what is `between` two middles, and changes by `way` from there, in a straight line, stays outside
// of a box of half the size `room`: along an axis of the world. False for some that do: at corners.
bool passes_by(const fixed::Vec3& between, const fixed::Vec3& way, const fixed::Vec3& room);

} // namespace lks
