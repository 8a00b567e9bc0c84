#include "float_runs_lanes.h"

#if defined(__AVX2__)
#include "float_lanes_avx2.h"

namespace lks_bench {

const FloatKernel float_runs_avx2 = {"float32 runs, AVX2", project_all<Avx2>, predict_all,
                                     push_out_all<Avx2>};

} // namespace lks_bench
#endif
