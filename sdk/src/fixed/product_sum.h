// Products added up exactly in 128 bits, and shifted once.
#pragma once

#include "fixed/int128.h"

namespace lks::fixed {

// Wraps modulo 2^128.
class HalvesProductSum {
public:
    constexpr void add(std::int64_t a, std::int64_t b) { sum_ = sum_ + multiply_signed(a, b); }
    // / 2^n, rounded down; wraps. 0 <= n < 128
    constexpr std::int64_t shifted(int n) const { return static_cast<std::int64_t>((sum_ >> n).lo); }

private:
    Int128 sum_{0, 0};
};

#if defined(__SIZEOF_INT128__) && !defined(__wasm__)
// The same by the machine's 128 bits.
class ProductSum {
public:
    constexpr void add(std::int64_t a, std::int64_t b) {
        sum_ += static_cast<Native>(static_cast<Signed>(a) * b);
    }
    constexpr std::int64_t shifted(int n) const {
        return static_cast<std::int64_t>(static_cast<Signed>(sum_) >> n);
    }

private:
    __extension__ using Native = unsigned __int128;
    __extension__ using Signed = __int128;
    Native sum_ = 0;
};
#else
using ProductSum = HalvesProductSum;
#endif

} // namespace lks::fixed
