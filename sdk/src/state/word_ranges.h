// The ranges of a record's 64-bit words, checked as they stand in an image, without branches. Two 32-bit
// fields are one word, the first of them its low half.
#pragma once

#include "memory/bytes.h"

namespace lks {

template <std::size_t count>
class WordRanges {
public:
    // Of the next words; least ≤ 0 ≤ greatest.
    WordRanges& between(std::int64_t least, std::int64_t greatest, std::size_t words = 1) {
        for (std::size_t i = 0; i < words; ++i) {
            least_[next_] = least;
            greatest_[next_++] = greatest;
        }
        return *this;
    }
    WordRanges& within(std::int64_t limit, std::size_t words) { return between(-limit, limit, words); }

    // Whether the first words are. What is above its greatest is no less than 0, so that neither difference
    // whose sign is asked for leaves 64 bits.
    bool hold(const unsigned char* at, std::size_t words = count) const {
        std::uint64_t outside = 0;
        for (std::size_t i = 0; i < words; ++i) {
            const auto value = static_cast<std::uint64_t>(read_i64(at + 8 * i));
            outside |= (static_cast<std::uint64_t>(greatest_[i]) - value) & ~value;
            outside |= (value - static_cast<std::uint64_t>(least_[i])) & value;
        }
        return outside >> 63 == 0;
    }

private:
    std::int64_t least_[count] = {};
    std::int64_t greatest_[count] = {};
    std::size_t next_ = 0;
};

} // namespace lks
