// Bytes of an image, little-endian, and their checksum.
#pragma once

#include "memory/bytes.h"
#include "state/checksum.h"

namespace lks {

// Writes into memory that was measured before: it cannot run out. A checksum is given what was written some
// kilobytes behind, while that is in the nearest cache, and not in a second pass over all of it.
class ByteWriter {
public:
    explicit ByteWriter(unsigned char* at) : at_(at), summed_(at) {}
    ByteWriter(unsigned char* at, Checksum& checksum) : at_(at), summed_(at), checksum_(&checksum) {}

    void u32(std::uint32_t value) { integer(value); }
    void u64(std::uint64_t value) { integer(value); }
    void i64(std::int64_t value) { integer(static_cast<std::uint64_t>(value)); }

    void i64_array(const std::int64_t* values, std::size_t count) {
        if constexpr (host_is_little_endian) {
            block(values, count * sizeof(std::int64_t));
        } else {
            for (std::size_t i = 0; i < count; ++i) {
                i64(values[i]);
            }
        }
    }

    // As they are.
    void block(const void* bytes, std::size_t size) {
        const auto* from = static_cast<const unsigned char*>(bytes);
        for (; size > distance; size -= distance) {
            copy(from, distance);
            from += distance;
        }
        if (size != 0) {
            copy(from, size);
        }
    }

    // Of all that has been written, where there is a checksum.
    std::uint64_t checksum() { return checksum_->finish(summed_, behind()); }

private:
    static constexpr std::size_t distance = 4096;

    std::size_t behind() const { return static_cast<std::size_t>(at_ - summed_); }

    void copy(const unsigned char* from, std::size_t size) {
        std::memcpy(at_, from, size);
        at_ += size;
        if (checksum_ != nullptr && behind() >= distance) {
            summed_ += checksum_->add(summed_, behind());
        }
    }

    template <typename T>
    void integer(T value) {
        if constexpr (host_is_little_endian) {
            std::memcpy(at_, &value, sizeof(T));
        } else {
            for (std::size_t i = 0; i < sizeof(T); ++i) {
                at_[i] = static_cast<unsigned char>(value >> (8 * i));
            }
        }
        at_ += sizeof(T);
    }

    unsigned char* at_;
    unsigned char* summed_; // up to here
    Checksum* checksum_ = nullptr;
};

} // namespace lks
