#include "float_runs_lanes.h"

#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 warns of the undefined registers in its own header (GCC PR 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "float_lanes_avx2.h"

namespace lks_bench {
namespace {

struct Avx512 {
    static constexpr std::uint32_t width = 16;
    using Register = __m512;
    using Narrower = Avx2;
    // Sixteen rows in registers take 1.3 times as long as twice eight.
    using OfRows = Avx2;
    static Register load(const float* p) { return _mm512_loadu_ps(p); }
    static void store(float* p, Register v) { _mm512_storeu_ps(p, v); }
    static Register set(float v) { return _mm512_set1_ps(v); }
    static Register add(Register a, Register b) { return _mm512_add_ps(a, b); }
    static Register subtract(Register a, Register b) { return _mm512_sub_ps(a, b); }
    static Register multiply(Register a, Register b) { return _mm512_mul_ps(a, b); }
    static Register multiply_add(Register a, Register b, Register c) { return _mm512_fmadd_ps(a, b, c); }
    static Register least(Register a, Register b) { return _mm512_min_ps(a, b); }
    static Register reciprocal_sqrt_estimate(Register v) { return _mm512_rsqrt14_ps(v); }
    static Register first(Register v, std::uint32_t count) {
        return _mm512_maskz_mov_ps(static_cast<__mmask16>((1u << count) - 1), v);
    }
};

} // namespace

const FloatKernel float_runs_avx512 = {"float32 runs, AVX-512", project_all<Avx512>, predict_all,
                                       push_out_all<Avx512>};

} // namespace lks_bench
#endif
