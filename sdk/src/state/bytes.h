// Little-endian bytes in and out, the same on every machine, without unaligned access.
//
// Arrays of 64- and 32-bit integers are block copies where the host is little-endian.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lks {

inline constexpr bool host_is_little_endian = std::endian::native == std::endian::little;

// Writes into memory that was measured before: it cannot run out.
class ByteWriter {
public:
    explicit ByteWriter(unsigned char* at) : at_(at) {}

    void u32(std::uint32_t value) { integer(value); }
    void u64(std::uint64_t value) { integer(value); }
    void i64(std::int64_t value) { integer(static_cast<std::uint64_t>(value)); }

    void i64_array(const std::int64_t* values, std::size_t count) {
        if constexpr (host_is_little_endian) {
            if (count != 0) {
                std::memcpy(at_, values, count * sizeof(std::int64_t));
                at_ += count * sizeof(std::int64_t);
            }
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                i64(values[i]);
            }
        }
    }

    unsigned char* position() const { return at_; }

private:
    template <typename T>
    void integer(T value) {
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            at_[i] = static_cast<unsigned char>(value >> (8 * i));
        }
        at_ += sizeof(T);
    }

    unsigned char* at_;
};

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
            if (count != 0 && take(bytes)) {
                std::memcpy(values, at_ - bytes, bytes);
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
        if (!take(sizeof(T))) {
            return 0;
        }
        T value = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            value = static_cast<T>(value | (static_cast<T>(*(at_ - sizeof(T) + i)) << (8 * i)));
        }
        return value;
    }

    const unsigned char* at_;
    std::size_t left_;
    bool complete_ = true;
};

} // namespace lks
