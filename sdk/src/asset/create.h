// Each kind of asset from its definition. `build` is empty; on failure it has reported why.
#pragma once

#include "asset/build.h"

namespace lks {

lks_result build_cloth_grid(Build& build, const lks_cloth_def& def);
lks_result build_cloth_mesh(Build& build, const lks_cloth_def& def);
// After either of them: what def asks of tethers, which may be nothing.
lks_result build_tethers(Build& build, const lks_cloth_def& def);
lks_result build_rope(Build& build, const lks_rope_def& def);

} // namespace lks
