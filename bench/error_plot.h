// Cost against error: milliseconds a tick and the stretch that is left, for substeps × iterations.
#pragma once

#include "gnuplot.h"
#include "results.h"

namespace lks_bench {

void error_plot(const Results& results, Script& script);

} // namespace lks_bench
