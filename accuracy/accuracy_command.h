// `lockstitch accuracy`.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lks_accuracy {

struct AccuracyOptions {
    std::vector<std::string> parts; // experiments; empty: all
    bool quick = false;             // a small grid, and the small one of what the paper has
    bool long_times = false;        // the spring for 60 s, the hanging cloth for 10
    bool list = false;
    bool json = false;
    std::string report; // a folder; empty: none
};

// The exit code; `complain` gets one sentence where it is not 0, `progress` what is measured next.
int run_accuracy(const AccuracyOptions& options, const std::function<void(const std::string&)>& complain,
                 const std::function<void(const std::string&)>& progress);

} // namespace lks_accuracy
