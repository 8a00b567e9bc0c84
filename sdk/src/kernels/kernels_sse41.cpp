#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_SSE41)

#include "kernels/chain_lanes.h"
#include "kernels/contact_lanes.h"
#include "kernels/distance_lanes.h"
#include "kernels/hash_update.h"
#include "kernels/lane_sums_lanes.h"
#include "kernels/lanes_sse41.h"
#include "kernels/prediction_lanes.h"
#include "kernels/range_lanes.h"
#include "kernels/response_lanes.h"
#include "kernels/tether_lanes.h"

namespace lks {

constinit const Kernels kernels_sse41{LKS_SIMD_SSE41,
                                      false,
                                      2048,
                                      project_lanes<LanesSse41>,
                                      predict_lanes<LanesSse41>,
                                      ranges_lanes<LanesSse41>,
                                      greatest_gap_lanes<LanesSse41>,
                                      near_box_lanes<LanesSse41>,
                                      near_plane_lanes<LanesSse41>,
                                      response_lanes_but_boxes<LanesSse41>(),
                                      beyond_tether_lanes<LanesSse41>,
                                      chain_lanes<LanesSse41>(),
                                      no_tree_kernels,
                                      no_contact_point_kernels,
                                      no_row_kernels,
                                      hash_update,
                                      sum_stripes_lanes<LanesSse41>};

} // namespace lks

#endif
