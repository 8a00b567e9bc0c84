// The report's plots, drawn by gnuplot.
#pragma once

#include <string>

#include "results.h"

namespace lks_bench {

struct Plot {
    const char* file; // NAME.svg
    const char* title;
};

// Those for which there is something to draw. False, with a sentence: gnuplot is missing or refuses.
bool draw_plots(const std::string& folder, const Results& results, std::vector<Plot>& drawn,
                std::string& error);

} // namespace lks_bench
