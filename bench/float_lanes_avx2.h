// Eight lanes, for float_runs_lanes.h and float_rows_lanes.h.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace lks_bench {
namespace {

struct Avx2 {
    static constexpr std::uint32_t width = 8;
    using Register = __m256;
    // What goes on where a group is too wide, and what goes over rows.
    using Narrower = void;
    using OfRows = Avx2;
    static Register load(const float* p) { return _mm256_loadu_ps(p); }
    static void store(float* p, Register v) { _mm256_storeu_ps(p, v); }
    static Register set(float v) { return _mm256_set1_ps(v); }
    static Register add(Register a, Register b) { return _mm256_add_ps(a, b); }
    static Register subtract(Register a, Register b) { return _mm256_sub_ps(a, b); }
    static Register multiply(Register a, Register b) { return _mm256_mul_ps(a, b); }
    static Register multiply_add(Register a, Register b, Register c) { return _mm256_fmadd_ps(a, b, c); }
    static Register least(Register a, Register b) { return _mm256_min_ps(a, b); }
    static Register reciprocal_sqrt_estimate(Register v) { return _mm256_rsqrt_ps(v); }
    // c − a·b
    static Register subtract_product(Register a, Register b, Register c) { return _mm256_fnmadd_ps(a, b, c); }
    static Register unpack_low(Register a, Register b) { return _mm256_unpacklo_ps(a, b); }
    static Register unpack_high(Register a, Register b) { return _mm256_unpackhi_ps(a, b); }
    static Register low_halves(Register a, Register b) { return _mm256_shuffle_ps(a, b, 0x44); }
    static Register high_halves(Register a, Register b) { return _mm256_shuffle_ps(a, b, 0xee); }
    // Number k of each quarter to the whole quarter.
    template <int k>
    static Register spread(Register v) {
        return _mm256_permute_ps(v, k * 0x55);
    }
    // Rows at places[0] and four constraints on.
    static Register load_rows(const float* rows, const std::uint32_t* places) {
        const __m256 low = _mm256_castps128_ps256(_mm_loadu_ps(rows + places[0]));
        return _mm256_insertf128_ps(low, _mm_loadu_ps(rows + places[8]), 1);
    }
    static void store_rows(float* rows, const std::uint32_t* places, Register v) {
        _mm_storeu_ps(rows + places[0], _mm256_castps256_ps128(v));
        _mm_storeu_ps(rows + places[8], _mm256_extractf128_ps(v, 1));
    }
    static Register first(Register v, std::uint32_t count) {
        const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        const __m256i mask = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane);
        return _mm256_and_ps(v, _mm256_castsi256_ps(mask));
    }
};

} // namespace
} // namespace lks_bench
