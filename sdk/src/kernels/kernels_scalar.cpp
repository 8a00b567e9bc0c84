#include "kernels/chain_scalar.h"
#include "kernels/compiled_kernels.h"
#include "kernels/contact_scalar.h"
#include "kernels/distance_scalar_loop.h"
#include "kernels/hash_update.h"
#include "kernels/lane_sums_scalar.h"
#include "kernels/lanes_plain.h"
#include "kernels/prediction_lanes.h"
#include "kernels/tether_scalar.h"

namespace lks {

constinit const Kernels kernels_scalar{LKS_SIMD_SCALAR,
                                       false,
                                       1024,
                                       project_scalar,
                                       predict_lanes<LanesPlain>,
                                       ranges_scalar,
                                       greatest_gap_scalar,
                                       near_box_scalar,
                                       near_plane_scalar,
                                       no_response_kernels,
                                       beyond_tether_scalar,
                                       chain_scalar,
                                       no_tree_kernels,
                                       no_contact_point_kernels,
                                       no_row_kernels,
                                       hash_update,
                                       sum_stripes_scalar};

} // namespace lks
