// A folder with what was measured: report.md, results.json, results.csv, and plots as SVG.
#pragma once

#include <string>

#include "results.h"

namespace lks_bench {

// False, with a sentence: the folder can't be written, or the plots can't be made. What can be written is.
bool write_report(const std::string& folder, const Results& results, std::string& error);

} // namespace lks_bench
