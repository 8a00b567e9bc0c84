// What the benchmark can't do without.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdio>
#include <cstdlib>

namespace lks_bench {

// Exits with a sentence where the library has refused.
inline void demand(lks_result result, const char* what, const char* message) {
    if (result != LKS_OK) {
        std::fprintf(stderr, "lockstitch: the benchmark can't make %s: %s\n", what, message);
        std::exit(1);
    }
}

} // namespace lks_bench
