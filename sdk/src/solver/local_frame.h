// The object's local frame follows it in whole metres, so that its particles stay in the middle of their
// range.
#pragma once

#include "solver/object.h"

namespace lks {

// Moves the origin where the middle of the bounds is further than 8 m from it on an axis, and shifts the
// bounds with it. Changes no particle's place in the world and no difference of coordinates. Counts pin
// targets that had to be clamped, and the world's edge where it is in the way.
void follow_object(Object& object, Bounds& bounds, lks_world_counters& counters);

// A World position in the object's frame, clamped to the range of coordinates; *clamped tells.
Coordinates to_local(const Object& object, const fixed::Vec3& position, bool& clamped);

} // namespace lks
