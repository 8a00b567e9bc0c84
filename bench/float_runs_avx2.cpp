#include "float_runs_lanes.h"

#if defined(__AVX2__)
#include <immintrin.h>

namespace lks_bench {
namespace {

struct Avx2 {
    static constexpr std::uint32_t width = 8;
    using Register = __m256;
    static Register load(const float* p) { return _mm256_loadu_ps(p); }
    static void store(float* p, Register v) { _mm256_storeu_ps(p, v); }
    static Register set(float v) { return _mm256_set1_ps(v); }
    static Register add(Register a, Register b) { return _mm256_add_ps(a, b); }
    static Register subtract(Register a, Register b) { return _mm256_sub_ps(a, b); }
    static Register multiply(Register a, Register b) { return _mm256_mul_ps(a, b); }
    static Register multiply_add(Register a, Register b, Register c) { return _mm256_fmadd_ps(a, b, c); }
    static Register least(Register a, Register b) { return _mm256_min_ps(a, b); }
    static Register reciprocal_sqrt_estimate(Register v) { return _mm256_rsqrt_ps(v); }
    static Register first(Register v, std::uint32_t count) {
        const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        const __m256i mask = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane);
        return _mm256_and_ps(v, _mm256_castsi256_ps(mask));
    }
};

} // namespace

const FloatKernel float_runs_avx2 = {"float32 runs, AVX2", project_all<Avx2>, predict_all,
                                     push_out_all<Avx2>};

} // namespace lks_bench
#endif
