// XXH3 (64 bits) over a canonical little-endian stream: the same on every machine, and at memory speed on
// little-endian ones, if it is given the update of the world's kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernels/hash_update.h"
#include "kernels/kernels.h"
#include "memory/bytes.h"

namespace lks {

class Hash {
public:
    Hash() : update_(hash_update) { XXH3_64bits_reset(&state_); }
    explicit Hash(const Kernels& kernels) : update_(kernels.hash_update) { XXH3_64bits_reset(&state_); }

    void add_bytes(const void* bytes, std::size_t size) { update_(&state_, bytes, size); }
    void add_u32(std::uint32_t value) { add_integer(value); }
    void add_u64(std::uint64_t value) { add_integer(value); }
    void add_i64(std::int64_t value) { add_integer(static_cast<std::uint64_t>(value)); }
    void add_i64_array(const std::int64_t* values, std::size_t count) { add_array(values, count); }
    void add_u32_array(const std::uint32_t* values, std::size_t count) { add_array(values, count); }

    std::uint64_t finish() const { return XXH3_64bits_digest(&state_); }

private:
    template <typename T>
    void add_integer(T value) {
        unsigned char bytes[sizeof(T)];
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            bytes[i] = static_cast<unsigned char>(value >> (8 * i));
        }
        add_bytes(bytes, sizeof(T));
    }

    template <typename T>
    void add_array(const T* values, std::size_t count) {
        if constexpr (host_is_little_endian) {
            if (count != 0) {
                add_bytes(values, count * sizeof(T));
            }
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                add_integer(static_cast<std::make_unsigned_t<T>>(values[i]));
            }
        }
    }

    XXH3_state_t state_;
    void (*update_)(void* state, const void* bytes, std::size_t size);
};

} // namespace lks
