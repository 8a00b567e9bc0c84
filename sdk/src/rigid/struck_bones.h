// Bones that are struck so hard that they may go through something in that tick.
//
// Their joints hold them, and two figures that go into each other part again. But where a car drives someone
// against a fence, or someone is thrown at him, contacts have to know of the fence before he is struck. What
// a bone is carried off its way all of its figure may be, and those bones have room for it which may pass the
// middle of a collider, or of a body without joints, that is near.
#pragma once

#include "rigid/rigid_scene.h"

struct lks_world;

namespace lks {

// In the first search of a tick, once it is known where bodies go. Where nobody is so fast that he may drive
// a bone through anything, there is no wall.
void find_thinnest_wall(lks_world& world);
// By how much a bone may be carried off its way, and pass the middle of nothing in the world.
std::int64_t least_way_through(const RigidScene& scene, std::uint32_t bone);

// Among scene.spread_strikes:
// Every bone is carried as far as the one of its figure that is carried the furthest, if that may pass
// anything.
void carry_figures(RigidScene& scene);
// Finds the bones that may pass something near (Strike::is_near_wall).
void find_bones_near_walls(lks_world& world);

} // namespace lks
