// The inner loops, once for each instruction set. All give the same bits; which one runs is nobody's business
// but the clock's.
#pragma once

#include <lockstitch/simd.h>

#include "kernels/distance_task.h"
#include "kernels/prediction_task.h"

namespace lks {

struct Kernels {
    lks_simd level;
    void (*project_distances)(const DistanceTask& task);
    PredictionClamps (*predict)(const PredictionTask& task);
    // XXH3_64bits_update.
    void (*hash_update)(void* state, const void* bytes, std::size_t size);
};

// Null where this build or this CPU has not got the level. LKS_SIMD_AUTO: the best there is, or what the
// environment variable LOCKSTITCH_SIMD names.
const Kernels* find_kernels(lks_simd level);

const char* simd_name(lks_simd level);

} // namespace lks
