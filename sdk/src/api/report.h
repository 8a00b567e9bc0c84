// One sentence for each failure: into the caller's lks_error, the world's last error and the log.
#pragma once

#include <lockstitch/base.h>

#include <cstdint>

namespace lks {

// Builds a sentence piece by piece in a fixed buffer; what does not fit is cut. No locale, no allocation.
class Sentence {
public:
    Sentence& operator<<(const char* text);
    Sentence& operator<<(std::int64_t value);
    Sentence& operator<<(std::uint64_t value);
    Sentence& operator<<(std::int32_t value) { return *this << static_cast<std::int64_t>(value); }
    Sentence& operator<<(std::uint32_t value) { return *this << static_cast<std::uint64_t>(value); }
    Sentence& hexadecimal(std::uint64_t value);
    // A World-format value as a decimal number, to the nearest: with up to six digits behind the point where
    // it is such a number to the last bit, else with up to twelve, which tell any two values apart.
    Sentence& world_value(std::int64_t value);

    const char* text() const { return text_; }

private:
    void append(char c);

    char text_[LKS_MESSAGE_CAPACITY] = {};
    std::uint32_t length_ = 0;
};

// Fills *error (where not null) and returns the result.
lks_result report(lks_error* error, lks_result result, const Sentence& sentence);

} // namespace lks
