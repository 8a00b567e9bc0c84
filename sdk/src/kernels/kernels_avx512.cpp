#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_AVX512)

#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 warns of the undefined registers in its own header (GCC PR 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "kernels/contact_lanes.h"
#include "kernels/distance_lanes.h"
#include "kernels/hash_update.h"
#include "kernels/lanes_avx512.h"
#include "kernels/prediction_lanes.h"

namespace lks {

const Kernels kernels_avx512{LKS_SIMD_AVX512,
                             project_lanes<LanesAvx512>,
                             predict_lanes<LanesAvx512>,
                             near_box_lanes<LanesAvx512>,
                             near_plane_lanes<LanesAvx512>,
                             hash_update};

} // namespace lks

#endif
