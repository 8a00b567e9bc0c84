#include <cstdlib>
#include <cstring>

#include "kernels/compiled_kernels.h"
#include "kernels/x86_features.h"

namespace lks {
namespace {

struct Level {
    lks_simd level;
    const char* name;
    const Kernels* kernels; // null: not in this build
};

#if defined(LKS_HAS_AVX2)
#define LKS_X86_KERNELS(kernels) &kernels
#else
#define LKS_X86_KERNELS(kernels) nullptr
#endif
#if defined(LKS_HAS_NEON)
#define LKS_NEON_KERNELS &kernels_neon
#else
#define LKS_NEON_KERNELS nullptr
#endif
#if defined(LKS_HAS_AVX512)
#define LKS_AVX512_KERNELS &kernels_avx512
#else
#define LKS_AVX512_KERNELS nullptr
#endif
#if defined(LKS_HAS_WASM)
#define LKS_WASM_KERNELS &kernels_wasm
#else
#define LKS_WASM_KERNELS nullptr
#endif

// The best one last.
constexpr Level levels[] = {
    {LKS_SIMD_SCALAR, "scalar", &kernels_scalar},
    {LKS_SIMD_SSE41, "sse4.1", LKS_X86_KERNELS(kernels_sse41)},
    {LKS_SIMD_AVX2, "avx2", LKS_X86_KERNELS(kernels_avx2)},
    {LKS_SIMD_AVX512, "avx512", LKS_AVX512_KERNELS},
    {LKS_SIMD_NEON, "neon", LKS_NEON_KERNELS},
    {LKS_SIMD_WASM, "wasm", LKS_WASM_KERNELS},
};

bool cpu_has(lks_simd level) {
#if defined(LKS_HAS_AVX2)
    const X86Features features = detect_x86_features();
    switch (level) {
    case LKS_SIMD_SSE41:
        return features.sse41;
    case LKS_SIMD_AVX2:
        return features.avx2;
    case LKS_SIMD_AVX512:
        return features.avx512;
    default:
        return true;
    }
#else
    (void)level;
    return true;
#endif
}

const Kernels* available(const Level& level) {
    return level.kernels != nullptr && cpu_has(level.level) ? level.kernels : nullptr;
}

const Kernels* named_by_environment() {
    const char* name = std::getenv("LOCKSTITCH_SIMD");
    if (name == nullptr) {
        return nullptr;
    }
    for (const Level& level : levels) {
        if (std::strcmp(name, level.name) == 0) {
            return available(level);
        }
    }
    return nullptr;
}

const Kernels* best() {
    const Kernels* found = nullptr;
    for (const Level& level : levels) {
        if (const Kernels* kernels = available(level)) {
            found = kernels;
        }
    }
    return found;
}

} // namespace

const Kernels* find_kernels(lks_simd simd) {
    if (simd == LKS_SIMD_AUTO) {
        const Kernels* named = named_by_environment();
        return named != nullptr ? named : best();
    }
    for (const Level& level : levels) {
        if (level.level == simd) {
            return available(level);
        }
    }
    return nullptr;
}

const char* simd_name(lks_simd simd) {
    if (simd == LKS_SIMD_AUTO) {
        return "auto";
    }
    for (const Level& level : levels) {
        if (level.level == simd) {
            return level.name;
        }
    }
    return "unknown";
}

} // namespace lks
