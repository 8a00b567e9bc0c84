// The shapes of bodies and colliders in their places, for manifolds.
#pragma once

#include "collide/collider_motion.h"
#include "collide/manifold.h"
#include "rigid/body.h"

namespace lks {

// Relative to `reference`.
Piece piece_of_body(const Body& body, const BodyShape& shape, const fixed::Vec3& reference);
// `body`: where it is (place_collider_bodies).
Piece piece_of_collider(const Body& body, const ColliderState& collider, const fixed::Vec3& reference);

} // namespace lks
