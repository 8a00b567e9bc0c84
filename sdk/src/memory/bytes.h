// Little-endian bytes in and out, the same on every machine, without unaligned access.
//
// Integers, and arrays of 64-bit ones, are block copies where the host is little-endian.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lks {

inline constexpr bool host_is_little_endian = std::endian::native == std::endian::little;

template <typename T>
T read_integer(const unsigned char* at) {
    T value = 0;
    if constexpr (host_is_little_endian) {
        std::memcpy(&value, at, sizeof(T));
    } else {
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            value = static_cast<T>(value | (static_cast<T>(at[i]) << (8 * i)));
        }
    }
    return value;
}

inline std::uint32_t read_u32(const unsigned char* at) {
    return read_integer<std::uint32_t>(at);
}
inline std::int64_t read_i64(const unsigned char* at) {
    return static_cast<std::int64_t>(read_integer<std::uint64_t>(at));
}

// Reads what may be truncated: past the end everything is zero and `complete` is false.
class ByteReader {
public:
    ByteReader(const unsigned char* at, std::size_t size) : at_(at), left_(size) {}

    std::uint32_t u32() { return integer<std::uint32_t>(); }
    std::uint64_t u64() { return integer<std::uint64_t>(); }
    std::int64_t i64() { return static_cast<std::int64_t>(integer<std::uint64_t>()); }

    void i64_array(std::int64_t* values, std::size_t count) {
        if constexpr (host_is_little_endian) {
            const std::size_t bytes = count * sizeof(std::int64_t);
            if (const unsigned char* from = block(bytes); from != nullptr && count != 0) {
                std::memcpy(values, from, bytes);
            }
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                values[i] = i64();
            }
        }
    }

    // False, and nothing is skipped, where fewer are left.
    bool skip_i64(std::size_t count) {
        return count <= left_ / sizeof(std::int64_t) && take(count * sizeof(std::int64_t));
    }

    // The next bytes as they are; null where fewer are left.
    const unsigned char* block(std::size_t bytes) { return take(bytes) ? at_ - bytes : nullptr; }

    bool complete() const { return complete_; }
    std::size_t left() const { return left_; }

private:
    bool take(std::size_t bytes) {
        if (bytes > left_) {
            complete_ = false;
            left_ = 0;
            return false;
        }
        at_ += bytes;
        left_ -= bytes;
        return true;
    }

    template <typename T>
    T integer() {
        return take(sizeof(T)) ? read_integer<T>(at_ - sizeof(T)) : 0;
    }

    const unsigned char* at_;
    std::size_t left_;
    bool complete_ = true;
};

} // namespace lks
