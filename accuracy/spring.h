// Work-precision of the paper's spring, against the analytic solution.
#pragma once

#include "particles.h"

namespace lks_accuracy {

// `seconds` after which places are compared.
Experiment measure_spring(const Grid& grid, const std::vector<int>& seconds, const Progress& progress);

} // namespace lks_accuracy
