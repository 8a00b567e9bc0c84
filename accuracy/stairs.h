// Work-precision of ragdolls that fall down stairs, beside Bullet's.
#pragma once

#include "particles.h"

namespace lks_accuracy {

Experiment measure_stairs(const Grid& grid, int ticks, const Progress& progress);

} // namespace lks_accuracy
