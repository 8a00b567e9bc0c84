// lockstitch/base.h: versions, and results in words.
#include <lockstitch/base.h>

extern "C" {

uint32_t lks_version(void) {
    return LKS_VERSION_MAJOR * 10000u + LKS_VERSION_MINOR * 100u + LKS_VERSION_PATCH;
}

uint32_t lks_solver_version(void) {
    return LKS_SOLVER_VERSION;
}

const char* lks_result_text(lks_result result) {
    switch (result) {
    case LKS_OK:
        return "ok";
    case LKS_ERROR_NULL_ARGUMENT:
        return "null argument";
    case LKS_ERROR_INVALID_ARGUMENT:
        return "invalid argument";
    case LKS_ERROR_STRUCT_SIZE:
        return "wrong struct size";
    case LKS_ERROR_STALE_ID:
        return "stale id";
    case LKS_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    case LKS_ERROR_BUFFER_TOO_SMALL:
        return "buffer too small";
    case LKS_ERROR_MISALIGNED:
        return "misaligned buffer";
    case LKS_ERROR_CORRUPT_IMAGE:
        return "corrupt image";
    case LKS_ERROR_FOREIGN_IMAGE:
        return "foreign image";
    case LKS_ERROR_LIMIT:
        return "limit reached";
    case LKS_ERROR_UNSUPPORTED:
        return "unsupported";
    }
    return "unknown result";
}

} // extern "C"
