// Numbers as text, exactly.
#pragma once

#include <lockstitch/fixed.h>

#include <cstdint>
#include <string>

namespace lks_golden {

// 16 lower-case hexadecimal digits.
std::string hexadecimal(std::uint64_t value);
// 8 of them.
std::string short_hexadecimal(std::uint32_t value);
// False unless the text is exactly 16 hexadecimal digits.
bool parse_hexadecimal(const std::string& text, std::uint64_t& value);

// A fixed-point value with `digits` (0 to 18) behind the point, to the nearest. Twelve tell any two values
// apart.
std::string decimal(lks_fixed value, int digits = 12);
std::string decimal(const lks_vec3& value, int digits = 12);

// A decimal number with up to nine digits before and behind the point, times `scale`, to the nearest unit.
// False: not such a number, or beyond the range of lks_fixed.
bool parse_decimal(const std::string& text, std::int64_t scale, lks_fixed& value);

} // namespace lks_golden
