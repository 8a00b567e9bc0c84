#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_WASM)

#include "kernels/chain_lanes.h"
#include "kernels/contact_lanes.h"
#include "kernels/distance_lanes.h"
#include "kernels/hash_update.h"
#include "kernels/lane_sums_lanes.h"
#include "kernels/lanes_wasm.h"
#include "kernels/prediction_lanes.h"
#include "kernels/range_lanes.h"
#include "kernels/response_lanes.h"
#include "kernels/tether_lanes.h"
#include "kernels/twice_lanes.h"

namespace lks {

constinit const Kernels kernels_wasm{LKS_SIMD_WASM,
                                     false,
                                     2048,
                                     project_lanes<TwiceLanes<LanesWasm>>,
                                     predict_lanes<LanesWasm>,
                                     ranges_lanes<LanesWasm>,
                                     greatest_gap_lanes<LanesWasm>,
                                     near_box_lanes<LanesWasm>,
                                     near_plane_lanes<LanesWasm>,
                                     response_lanes_but_boxes<LanesWasm>(),
                                     beyond_tether_lanes<LanesWasm>,
                                     chain_lanes<LanesWasm>(),
                                     no_tree_kernels,
                                     no_contact_point_kernels,
                                     no_row_kernels,
                                     hash_update,
                                     sum_stripes_lanes<LanesWasm>};

} // namespace lks

#endif
