// Fills in Run::spare.
#pragma once

#include "asset/asset.h"

namespace lks {

// False: no memory.
[[nodiscard]] bool find_spare_particles(lks_asset& asset);

} // namespace lks
