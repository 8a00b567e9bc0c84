// Reads memory ahead of time, where strides are too long for the processor to see: nothing waits for it.
#pragma once

#include <cstddef>

namespace lks {

inline void prefetch(const void* memory, std::size_t size) {
    constexpr std::size_t cache_line = 64;
    const auto* bytes = static_cast<const volatile unsigned char*>(memory);
    for (std::size_t i = 0; i < size; i += cache_line) {
        static_cast<void>(bytes[i]);
    }
}

} // namespace lks
