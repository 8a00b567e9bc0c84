#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_NEON)

#include "kernels/chain_lanes.h"
#include "kernels/contact_lanes.h"
#include "kernels/distance_lanes.h"
#include "kernels/hash_update.h"
#include "kernels/lane_sums_lanes.h"
#include "kernels/lanes_neon.h"
#include "kernels/prediction_lanes.h"
#include "kernels/range_lanes.h"
#include "kernels/response_lanes.h"
#include "kernels/tether_lanes.h"

namespace lks {

constinit const Kernels kernels_neon{LKS_SIMD_NEON,
                                     false,
                                     2048,
                                     project_lanes<LanesNeon>,
                                     predict_lanes<LanesNeon>,
                                     ranges_lanes<LanesNeon>,
                                     greatest_gap_lanes<LanesNeon>,
                                     near_box_lanes<LanesNeon>,
                                     near_plane_lanes<LanesNeon>,
                                     response_lanes_but_boxes<LanesNeon>(),
                                     beyond_tether_lanes<LanesNeon>,
                                     chain_lanes<LanesNeon>(),
                                     no_tree_kernels,
                                     no_contact_point_kernels,
                                     no_row_kernels,
                                     hash_update,
                                     sum_stripes_lanes<LanesNeon>};

} // namespace lks

#endif
