// Sleep: islands of bodies that have stayed where they are are taken out of the simulation until something
// touches them.
//
// An island is what joints and pushing contacts hold together. It falls asleep when each of its bodies has
// been slower than ten centimetres a second, or has stayed within a centimetre and two degrees of one place,
// for half a second (but for a twitch below half a metre a second), and nothing kinematic that moves touches
// it; all its speeds become zero. What accelerates steadily, as on a slope, is at rest nowhere, however slow
// it is; what has turned round twice below half a metre a second trembles or rocks, and may rest. Where
// nothing pushes it, as what hangs or floats, it has to stay for two seconds, however slow. Where something
// is squeezed, overlaps have time to part: its bodies have to have rested for two seconds on the average, and
// what is squeezed may rattle within two centimetres. Of what overlaps by more than five millimetres only
// each fifth tick counts. It wakes as a whole: by an awake body or a moving collider that comes to touch one
// of its bodies, and by whatever the game does to one. A sleeping body's contacts keep their pushes, so that
// a pile wakes as it fell asleep.
#pragma once

#include "solver/world.h"

namespace lks {

// Start of a tick: islands with an awake body, or touched by what moves, are awake as a whole.
void wake_islands(lks_world& world);
// End of a tick.
void fall_asleep(lks_world& world);

void wake(Body& body);
// After what all bodies are drawn to may have changed.
void wake_all(RigidScene& scene);
// After what they rest on may have changed: those that meet a collider with this filter.
void wake_who_meets(RigidScene& scene, const lks_filter& filter);
// Those that have pushed this one in the last tick.
void wake_neighbours(RigidScene& scene, std::uint32_t other);
// Both sides of each of its joints.
void wake_jointed(RigidScene& scene, std::uint32_t body);

} // namespace lks
