// lockstitch/simd.h.
#include <lockstitch/simd.h>

#include "kernels/kernels.h"

extern "C" {

uint32_t lks_simd_is_available(lks_simd simd) {
    return lks::find_kernels(simd) != nullptr ? 1u : 0u;
}

const char* lks_simd_name(lks_simd simd) {
    return lks::simd_name(simd);
}

} // extern "C"
