// Which kernels this build has.
#pragma once

#include "kernels/kernels.h"

// LKS_NO_SIMD leaves plain integers only, and LKS_NO_AVX512 all but the widest ones, which take longest to
// compile.
#if !defined(LKS_NO_SIMD)
#if defined(__x86_64__) || defined(_M_X64) || defined(__i386__) || defined(_M_IX86)
#define LKS_HAS_SSE41 1
#define LKS_HAS_AVX2 1
#if !defined(LKS_NO_AVX512)
#define LKS_HAS_AVX512 1
#endif
#elif (defined(__aarch64__) && !defined(__ARM_BIG_ENDIAN)) || defined(_M_ARM64)
#define LKS_HAS_NEON 1
#elif defined(__wasm_simd128__)
#define LKS_HAS_WASM 1
#endif
#endif

namespace lks {

extern const Kernels kernels_scalar;
extern const Kernels kernels_sse41;
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;
extern const Kernels kernels_neon;
extern const Kernels kernels_wasm;

} // namespace lks
