// XXH3 with the registers of the file that includes this: the same values from all of them. Internal linkage,
// as kernels/distance_scalar.h says.
#pragma once

#include <cstddef>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace lks {
namespace {

// state: an XXH3_state_t.
inline void hash_update(void* state, const void* bytes, std::size_t size) {
    (void)XXH3_64bits_update(static_cast<XXH3_state_t*>(state), bytes, size);
}

} // namespace
} // namespace lks
