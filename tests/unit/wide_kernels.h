// The kernels of this build and this processor beside plain integers.
#pragma once

#include <vector>

#include "kernels/compiled_kernels.h"
#include "kernels/kernels.h"

namespace lks::test {

// Looked for once: where this machine is a guest of another, a question to its processor takes as long as
// moving thousands of particles.
inline const std::vector<const Kernels*>& wide_kernels() {
    static const std::vector<const Kernels*> kernels = [] {
        std::vector<const Kernels*> found;
        for (const lks_simd level :
             {LKS_SIMD_SSE41, LKS_SIMD_AVX2, LKS_SIMD_AVX512, LKS_SIMD_NEON, LKS_SIMD_WASM}) {
            if (const Kernels* available = find_kernels(level)) {
                found.push_back(available);
            }
        }
        return found;
    }();
    return kernels;
}

// Plain integers too.
inline std::vector<const Kernels*> all_kernels() {
    std::vector<const Kernels*> all = wide_kernels();
    all.push_back(&kernels_scalar);
    return all;
}

// What a world takes, looked for once.
inline const Kernels& best_kernels() {
    static const Kernels& kernels = *find_kernels(LKS_SIMD_AUTO);
    return kernels;
}

} // namespace lks::test
