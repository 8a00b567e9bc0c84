#include "golden/text.h"

#include <algorithm>
#include <cctype>

namespace lks_golden {

std::string hexadecimal(std::uint64_t value) {
    std::string text(16, '0');
    for (std::size_t i = 16; i-- > 0; value >>= 4) {
        text[i] = "0123456789abcdef"[value & 15];
    }
    return text;
}

std::string short_hexadecimal(std::uint32_t value) {
    return hexadecimal(value).substr(8);
}

bool parse_hexadecimal(const std::string& text, std::uint64_t& value) {
    if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos) {
        return false;
    }
    value = 0;
    for (const char c : text) {
        value = value << 4 | static_cast<std::uint64_t>(c <= '9' ? c - '0' : c - 'a' + 10);
    }
    return true;
}

std::string decimal(lks_fixed value, int digits) {
    const std::uint64_t magnitude =
        value < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    constexpr std::uint64_t mask = (std::uint64_t{1} << LKS_FIXED_FRACTION_BITS) - 1;
    std::uint64_t whole = magnitude >> LKS_FIXED_FRACTION_BITS;
    std::uint64_t rest = magnitude & mask;
    std::uint64_t fraction = 0;
    std::uint64_t one = 1;
    for (int i = 0; i < digits; ++i) {
        rest *= 10;
        fraction = fraction * 10 + (rest >> LKS_FIXED_FRACTION_BITS);
        rest &= mask;
        one *= 10;
    }
    fraction += rest * 2 > mask ? 1u : 0u;
    whole += fraction / one;
    const std::string behind_point = std::to_string(fraction % one);
    std::string text;
    if (value < 0) {
        text += '-';
    }
    text += std::to_string(whole);
    if (digits > 0) {
        text += '.';
        text.append(static_cast<std::size_t>(digits) - behind_point.size(), '0');
        text += behind_point;
    }
    return text;
}

std::string decimal(const lks_vec3& value, int digits) {
    return decimal(value.x, digits) + " " + decimal(value.y, digits) + " " + decimal(value.z, digits);
}

bool parse_decimal(const std::string& text, std::int64_t scale, lks_fixed& value) {
    const bool negative = !text.empty() && text[0] == '-';
    const std::string number = text.substr(negative ? 1 : 0);
    const std::size_t point = std::min(number.find('.'), number.size());
    const std::string whole = number.substr(0, point);
    const std::string fraction = point < number.size() ? number.substr(point + 1) : "";
    const auto only_digits = [](const std::string& s) {
        return std::all_of(s.begin(), s.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    };
    if ((whole.empty() && fraction.empty()) || !only_digits(whole) || !only_digits(fraction) ||
        whole.size() > 9 || fraction.size() > 9) {
        return false;
    }
    std::uint64_t billionths = whole.empty() ? 0 : std::stoull(whole) * 1000000000u;
    billionths += fraction.empty() ? 0 : std::stoull(fraction + std::string(9 - fraction.size(), '0'));
    // value = billionths · scale · 2^40 / 10^9, digit by digit to stay within 64 bits.
    const std::uint64_t scaled = billionths * static_cast<std::uint64_t>(scale);
    if (scale <= 0 || scaled / static_cast<std::uint64_t>(scale) != billionths) {
        return false;
    }
    const std::uint64_t metres = scaled / 1000000000u;
    if (metres > 8388607u) {
        return false;
    }
    std::uint64_t rest = scaled % 1000000000u;
    std::uint64_t bits = metres;
    for (int i = 0; i < LKS_FIXED_FRACTION_BITS; ++i) {
        rest *= 2;
        bits = bits << 1 | rest / 1000000000u;
        rest %= 1000000000u;
    }
    bits += rest * 2 >= 1000000000u ? 1u : 0u;
    value = negative ? -static_cast<lks_fixed>(bits) : static_cast<lks_fixed>(bits);
    return true;
}

} // namespace lks_golden
