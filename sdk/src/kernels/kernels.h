// The inner loops, once for each instruction set. All give the same bits; which one runs is nobody's business
// but the clock's.
#pragma once

#include <lockstitch/simd.h>

#include "kernels/chain_task.h"
#include "kernels/contact_point_task.h"
#include "kernels/contact_task.h"
#include "kernels/coordinate_range.h"
#include "kernels/distance_task.h"
#include "kernels/lane_sums.h"
#include "kernels/prediction_task.h"
#include "kernels/response_task.h"
#include "kernels/row_task.h"
#include "kernels/tether_task.h"
#include "kernels/tree_task.h"

namespace lks {

struct Kernels {
    lks_simd level;
    // Whether project_distances takes objects side by side.
    bool side_by_side;
    // How many make some microseconds of work: enough to be worth another thread's while.
    std::uint32_t constraints_a_block;
    void (*project_distances)(const DistanceTask& task);
    PredictionClamps (*predict)(const PredictionTask& task);
    // Of one particle at least; y and z stand axis_stride and twice that behind x.
    CoordinateRanges (*ranges)(const std::int64_t* x, std::size_t axis_stride, std::size_t count);
    // Of a[i] and b[i].
    std::uint64_t (*greatest_gap)(const std::int64_t* a, const std::int64_t* b, std::size_t count);
    // Bit i: particle first + i may be touched; count ≤ 64.
    std::uint64_t (*near_box)(const BoxTask& task, std::uint32_t first, std::uint32_t count);
    std::uint64_t (*near_plane)(const PlaneTask& task, std::uint32_t first, std::uint32_t count);
    ResponseKernels respond;
    // Bit i: particle first + i may be beyond its tether; count ≤ 64.
    std::uint64_t (*beyond_tether)(const TetherTask& task, std::uint32_t first, std::uint32_t count);
    ChainKernels chain;
    TreeKernels trees;
    ContactPointKernels contact_points;
    RowKernels rows; // null where project_distances takes no rows
    // XXH3_64bits_update.
    void (*hash_update)(void* state, const void* bytes, std::size_t size);
    // Adds what `bytes`, aligned to 8, come to.
    void (*sum_stripes)(LaneSums& sums, const unsigned char* bytes, std::size_t stripes);
};

// Null where this build or this CPU has not got the level. LKS_SIMD_AUTO: the best there is, or what the
// environment variable LOCKSTITCH_SIMD names.
const Kernels* find_kernels(lks_simd level);

const char* simd_name(lks_simd level);

} // namespace lks
