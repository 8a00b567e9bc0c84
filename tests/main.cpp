#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <climits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

// Samples allocate and free large arrays again and again. The C library would return each to the system and
// be given pages of zeros anew, which took nine tenths of the time of the kernels' tests.
void keep_freed_memory() {
#if defined(__GLIBC__)
    mallopt(M_MMAP_THRESHOLD, INT_MAX);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
#endif
}

} // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    return doctest::Context(argc, argv).run();
}
