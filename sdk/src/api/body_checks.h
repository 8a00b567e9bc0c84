// The ranges of bodies.
#pragma once

#include "api/checks.h"

namespace lks {

// All but where it stands, which is check_body_place's once it is described.
lks_result check_body_def(const lks_world& world, const lks_body_def& def);
// A unit quaternion, and a position with which the body's centre of mass is in the world: its frame may be
// beyond.
lks_result check_body_place(const lks_world& world, const BodyDescription& description,
                            const lks_transform& transform);
// Of what has no centre of mass, a ragdoll or a bone's pose: a position within the world, a unit quaternion.
lks_result check_body_frame(const lks_world& world, const lks_transform& transform);
lks_result check_body_kind(const lks_world& world, std::uint32_t kind);
lks_result check_body_velocities(const lks_world& world, const lks_vec3& velocity, const lks_vec3& spin);
// A kinematic motion of at most 100 m and 90° in one tick.
lks_result check_body_motion(const lks_world& world, const Body& body, const fixed::Vec3& position,
                             const fixed::Rotation& rotation);

// LKS_OK, or reported: the id is stale.
lks_result require_body(const lks_world* world, lks_body_id id);

} // namespace lks
