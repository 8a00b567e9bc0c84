// The ranges of an object's factors.
#pragma once

#include "api/checks.h"

namespace lks {

bool gravity_factor_is_valid(lks_fixed factor);
bool linear_damping_is_valid(lks_fixed damping);

// LKS_OK, or reported.
lks_result check_gravity_factor(const lks_world& world, lks_fixed factor);
lks_result check_linear_damping(const lks_world& world, lks_fixed damping);

} // namespace lks
