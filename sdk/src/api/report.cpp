#include "api/report.h"

#include <cstring>

#include "fixed/formats.h"
#include "fixed/integer.h"

namespace lks {

void Sentence::append(char c) {
    if (length_ + 1 < sizeof(text_)) {
        text_[length_++] = c;
    }
}

Sentence& Sentence::operator<<(const char* text) {
    for (; *text != '\0'; ++text) {
        append(*text);
    }
    return *this;
}

Sentence& Sentence::operator<<(std::uint64_t value) {
    char digits[20];
    int count = 0;
    do {
        digits[count++] = static_cast<char>('0' + value % 10);
        value /= 10;
    } while (value != 0);
    while (count > 0) {
        append(digits[--count]);
    }
    return *this;
}

Sentence& Sentence::operator<<(std::int64_t value) {
    if (value < 0) {
        append('-');
        return *this << std::uint64_t{0} - static_cast<std::uint64_t>(value);
    }
    return *this << static_cast<std::uint64_t>(value);
}

Sentence& Sentence::hexadecimal(std::uint64_t value) {
    for (int shift = 60; shift >= 0; shift -= 4) {
        append("0123456789abcdef"[(value >> shift) & 15]);
    }
    return *this;
}

Sentence& Sentence::world_value(std::int64_t value) {
    constexpr std::uint64_t one = std::uint64_t{1} << world_fraction_bits;
    constexpr std::uint64_t million = 1000000;
    std::uint64_t whole = fixed::magnitude(value) / one;
    const std::uint64_t part = fixed::magnitude(value) % one;
    // The fraction has 40 bits, and a million 20.
    std::uint64_t fraction = (part * million + one / 2) / one;
    std::uint64_t power = million;
    const std::uint64_t back = fraction * one / million;
    const bool short_number = part == 0 || (fraction != 0 && back <= part + 1 && part <= back + 1);
    if (!short_number) {
        const std::uint64_t rest = part * million % one;
        fraction = part * million / one * million + (rest * million + one / 2) / one;
        power = million * million;
    }
    if (fraction == power) {
        ++whole;
        fraction = 0;
    }
    if (value < 0) {
        append('-');
    }
    *this << whole;
    if (fraction == 0) {
        return *this;
    }
    append('.');
    for (power /= 10; fraction != 0; power /= 10) {
        *this << fraction / power;
        fraction %= power;
    }
    return *this;
}

lks_result report(lks_error* error, lks_result result, const Sentence& sentence) {
    if (error != nullptr) {
        error->result = result;
        std::memset(error->message, 0, sizeof(error->message));
        std::memcpy(error->message, sentence.text(), std::strlen(sentence.text()));
    }
    return result;
}

} // namespace lks
