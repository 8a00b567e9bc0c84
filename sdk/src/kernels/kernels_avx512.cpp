#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_AVX512)

#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 warns of the undefined registers in its own header (GCC PR 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "kernels/chain_lanes.h"
#include "kernels/contact_lanes.h"
#include "kernels/contact_point_lanes.h"
#include "kernels/distance_lanes.h"
#include "kernels/hash_update.h"
#include "kernels/lane_sums_lanes.h"
#include "kernels/lanes_avx2.h"
#include "kernels/lanes_avx512.h"
#include "kernels/leave_lanes.h"
#include "kernels/prediction_lanes.h"
#include "kernels/range_lanes.h"
#include "kernels/response_lanes.h"
#include "kernels/row_lanes.h"
#include "kernels/tether_lanes.h"
#include "kernels/tree_lanes.h"

namespace lks {
namespace {

// Runs that don't fill a group, as of short ropes, go faster in groups of half the size.
void project_by_length(const DistanceTask& task) {
    if (task.short_runs) {
        kernels_avx2.project_distances(task);
    } else {
        leaving<LanesAvx512, project_lanes<LanesAvx512>>(task);
    }
}

} // namespace

constinit const Kernels kernels_avx512{LKS_SIMD_AVX512,
                                       true,
                                       8192,
                                       project_by_length,
                                       leaving<LanesAvx512, predict_lanes<LanesAvx512, LanesAvx2>>,
                                       leaving<LanesAvx512, ranges_lanes<LanesAvx512>>,
                                       leaving<LanesAvx512, greatest_gap_lanes<LanesAvx512>>,
                                       leaving<LanesAvx512, near_box_lanes<LanesAvx512>>,
                                       leaving<LanesAvx512, near_plane_lanes<LanesAvx512>>,
                                       leaving_response_lanes<LanesAvx512>(),
                                       leaving<LanesAvx512, beyond_tether_lanes<LanesAvx512>>,
                                       leaving_chain_lanes<LanesAvx512>(),
                                       leaving_tree_lanes<LanesAvx512>(),
                                       leaving_contact_point_lanes<LanesAvx512>(),
                                       leaving_row_lanes<LanesAvx512, LanesAvx2>(),
                                       leaving<LanesAvx512, hash_update>,
                                       leaving<LanesAvx512, sum_stripes_lanes<LanesAvx512>>};

} // namespace lks

#endif
