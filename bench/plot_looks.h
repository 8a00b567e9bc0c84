// What all plots share: which variants there are, and how each looks.
#pragma once

#include <string>
#include <vector>

#include "results.h"

namespace lks_bench {

// In the order in which they were measured, each once; of all workloads whose names begin so.
std::vector<std::string> variants_of(const Results& results, const std::string& workload,
                                     const std::string& measured);
bool is_ours(const std::string& variant);
std::string name_in_plots(const std::string& variant);
// For gnuplot: blue is ours, orange float32 with the same care, grey plain float32, green what comes in
// packages.
std::string colour_of(const std::string& variant);

} // namespace lks_bench
