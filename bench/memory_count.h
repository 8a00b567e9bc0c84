// How much memory things take, as the caller's allocator sees it.
#pragma once

#include "workloads.h"

namespace lks_bench {

struct MemoryUse {
    double asset = 0;  // bytes of one asset
    double object = 0; // bytes that one more object takes
};

MemoryUse count_memory(const Workload& workload);

// Of the constraints, how many stand in runs: 0 .. 1.
double share_in_runs(const lks_asset& asset);

} // namespace lks_bench
