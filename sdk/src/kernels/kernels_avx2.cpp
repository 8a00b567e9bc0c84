#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_AVX2)

#include "kernels/chain_lanes.h"
#include "kernels/contact_lanes.h"
#include "kernels/contact_point_lanes.h"
#include "kernels/distance_lanes.h"
#include "kernels/hash_update.h"
#include "kernels/lane_sums_lanes.h"
#include "kernels/lanes_avx2.h"
#include "kernels/leave_lanes.h"
#include "kernels/prediction_lanes.h"
#include "kernels/range_lanes.h"
#include "kernels/response_lanes.h"
#include "kernels/row_lanes.h"
#include "kernels/tether_lanes.h"
#include "kernels/tree_lanes.h"

namespace lks {

constinit const Kernels kernels_avx2{LKS_SIMD_AVX2,
                                     true,
                                     4096,
                                     leaving<LanesAvx2, project_lanes<LanesAvx2>>,
                                     leaving<LanesAvx2, predict_lanes<LanesAvx2>>,
                                     leaving<LanesAvx2, ranges_lanes<LanesAvx2>>,
                                     leaving<LanesAvx2, greatest_gap_lanes<LanesAvx2>>,
                                     leaving<LanesAvx2, near_box_lanes<LanesAvx2>>,
                                     leaving<LanesAvx2, near_plane_lanes<LanesAvx2>>,
                                     leaving_response_lanes<LanesAvx2>(),
                                     leaving<LanesAvx2, beyond_tether_lanes<LanesAvx2>>,
                                     leaving_chain_lanes<LanesAvx2>(),
                                     leaving_tree_lanes<LanesAvx2>(),
                                     leaving_contact_point_lanes<LanesAvx2>(),
                                     leaving_row_lanes<LanesAvx2>(),
                                     leaving<LanesAvx2, hash_update>,
                                     leaving<LanesAvx2, sum_stripes_lanes<LanesAvx2>>};

} // namespace lks

#endif
