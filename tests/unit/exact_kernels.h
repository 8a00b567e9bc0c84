// What tests need that compare kernels with integers that have no limit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "big_integer.h"
#include "fixed_samples.h"

namespace lks::test::exact {

using B = Big<6>;

inline B big(std::int64_t value) {
    return B::from_i64(value);
}
inline B power(int n) {
    return B::power_of_two(n);
}
inline std::int64_t low(const B& value) {
    return static_cast<std::int64_t>(value.low64());
}
// value / 2^right, half up; exact where that is a shift to the left.
inline B rounded(const B& value, int right) {
    return right > 0 ? shift_right_half_up(value, right) : value << -right;
}
inline B floored(const B& value, int right) {
    return right > 0 ? value >> right : value << -right;
}
inline B between(const B& value, const B& least, const B& greatest) {
    return value < least ? least : value > greatest ? greatest : value;
}

template <std::size_t n>
std::int64_t one_of(Random& random, const std::int64_t (&values)[n]) {
    return values[random.below(n)];
}

} // namespace lks::test::exact
