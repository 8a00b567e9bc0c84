/* Lockstitch: instruction sets. The same bits on all of them; only the speed differs.
 *
 * A world uses the widest one that the CPU has. lks_world_def.simd asks for another one; where it is
 * LKS_SIMD_AUTO, the environment variable LOCKSTITCH_SIMD may name one ("scalar", "sse4.1", "avx2",
 * "avx512", "neon", "wasm"; a name that is unknown or not available here is ignored).
 */
#ifndef LOCKSTITCH_SIMD_H
#define LOCKSTITCH_SIMD_H

#include <lockstitch/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lks_simd {
    LKS_SIMD_AUTO = 0,
    LKS_SIMD_SCALAR = 1, /* plain integers: everywhere */
    LKS_SIMD_SSE41 = 2,
    LKS_SIMD_AVX2 = 3,
    LKS_SIMD_AVX512 = 4, /* F, BW, CD, DQ, VL */
    LKS_SIMD_NEON = 5,   /* 64-bit arm */
    LKS_SIMD_WASM = 6    /* WebAssembly built with -msimd128 */
} lks_simd;

/* 1 if this build of the library and this CPU have it (AUTO and SCALAR: always). */
LKS_API uint32_t lks_simd_is_available(lks_simd simd);

/* The name as LOCKSTITCH_SIMD takes it; "unknown" for other values. Static memory. */
LKS_API const char* lks_simd_name(lks_simd simd);

#ifdef __cplusplus
}
#endif
#endif
