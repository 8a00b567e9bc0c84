// The ranges of colliders, for definitions and for images alike.
#pragma once

#include "api/checks.h"

namespace lks {

lks_result check_collider_def(const lks_world& world, const lks_collider_def& def);
// A kinematic motion of at most 100 m and 90° in one tick.
lks_result check_motion(const lks_world& world, const ColliderState& collider, const fixed::Vec3& position,
                        const fixed::Rotation& rotation);
// Could this collider have come about through the API?
bool collider_is_valid(const ColliderState& collider);

// Puts it there at rest.
void place_collider(ColliderState& collider, const fixed::Vec3& position, const fixed::Rotation& rotation);

} // namespace lks
