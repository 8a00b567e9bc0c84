// Which shapes may touch in a tick, and where.
#pragma once

#include "solver/world.h"

namespace lks {

// Colliders as bodies of infinite mass, at the beginning of the tick.
void place_collider_bodies(lks_world& world);
// Fills the scene's contacts, in ascending order of keys, with what is near enough to touch in this tick.
// Sleeping bodies that something touches are woken, with their islands. `team`: null, or who helps.
void find_contacts(lks_world& world, Team* team);

// Those asleep that a kinematic body touches where the game has put it. It does not move, and no tick would
// look for them; whom a dynamic one touches is woken by the search.
void wake_touched(lks_world& world, std::uint32_t body);

// The body that a contact's or a pair's second number names; the collider, if it is one.
Body& other_body(RigidScene& scene, std::uint32_t other);
const Body& other_body(const RigidScene& scene, std::uint32_t other);
const ColliderState& collider_of(const lks_world& world, std::uint32_t other);

} // namespace lks
