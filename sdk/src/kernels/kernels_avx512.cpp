#include "kernels/compiled_kernels.h"

#if defined(LKS_HAS_AVX512)

#include "kernels/distance_lanes.h"
#include "kernels/lanes_avx512.h"
#include "kernels/prediction_lanes.h"

namespace lks {

const Kernels kernels_avx512{LKS_SIMD_AVX512, project_lanes<LanesAvx512>, predict_lanes<LanesAvx512>};

} // namespace lks

#endif
