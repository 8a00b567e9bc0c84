// `lockstitch bench`.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lks_bench {

struct BenchOptions {
    std::vector<std::string> parts; // workloads and sections; empty: the workloads, snapshots and overhead
    std::uint32_t rounds = 0;       // 0: 21, and fewer of what is long
    bool list = false;
    bool json = false;
    std::string report; // a folder; empty: none
    std::string once;   // a variant to run once, for those who count instructions
    std::string program;
};

// The exit code; `complain` gets one sentence where it is not 0, `progress` what is measured next.
int run_bench(const BenchOptions& options, const std::function<void(const std::string&)>& complain,
              const std::function<void(const std::string&)>& progress);

} // namespace lks_bench
