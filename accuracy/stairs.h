// Work-precision of ragdolls that fall down stairs, beside their twin's and Bullet's.
#pragma once

#include "particles.h"

namespace lks_accuracy {

// Joints and energy of the SDK's alone.
Row fall_of_ours(const reference::Schedule& schedule, int ticks);

Experiment measure_stairs(const Grid& grid, int ticks, const Progress& progress);

} // namespace lks_accuracy
