// What contacts have handed on to the next tick, when the game changes what they were between.
#pragma once

#include <span>

#include "fixed/scaled.h"
#include "rigid/rigid_scene.h"

namespace lks {

// 1/kg: the greater inverse mass of a body and a body, or a collider | other_is_collider. What a contact's
// pushes count in.
fixed::Scaled greater_inverse_mass(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other);
// As if both bodies were dynamic.
fixed::Scaled greater_dynamic_inverse_mass(const RigidScene& scene, std::uint32_t body_a,
                                           std::uint32_t other);

// Who touches a sleeper, and does not wake it, pushes as if that were a wall: in his own inverse mass, where
// memories and events count in the greater one of the two.
bool is_with_sleeper(const RigidScene& scene, const ContactKey& key);
// How many times that is his own.
fixed::Scaled wall_ratio(const RigidScene& scene, const ContactKey& key);
void scale_pushes(std::span<ContactPush> pushes, const fixed::Scaled& ratio);

// Before a body is put elsewhere, or becomes another: its contacts push nothing on, and end with the next
// tick if they do not touch again.
void forget_contacts(RigidScene& scene, std::uint32_t body);
// Of a body, or a collider | other_is_collider, that is no more: they end without an event.
void drop_contacts(RigidScene& scene, std::uint32_t other);

} // namespace lks
