// Integers of N * 32 bits for references that must be exact: two's complement, schoolbook, slow and obvious.
// Independent of sdk/src/fixed on purpose, and of compiler extensions.
#pragma once

#include <cmath>
#include <cstdint>

namespace lks::test {

template <int N>
struct Big {
    std::uint32_t digit[N] = {};

    static constexpr Big from_u64(std::uint64_t a) {
        Big r;
        r.digit[0] = static_cast<std::uint32_t>(a);
        r.digit[1] = static_cast<std::uint32_t>(a >> 32);
        return r;
    }

    static constexpr Big from_i64(std::int64_t a) {
        Big r = from_u64(static_cast<std::uint64_t>(a));
        for (int i = 2; i < N; ++i)
            r.digit[i] = a < 0 ? 0xffffffffu : 0u;
        return r;
    }

    // hi * 2^64 + lo.
    static constexpr Big from_halves(std::uint64_t hi, std::uint64_t lo) {
        Big r = from_u64(lo);
        r.digit[2] = static_cast<std::uint32_t>(hi);
        r.digit[3] = static_cast<std::uint32_t>(hi >> 32);
        return r;
    }

    static constexpr Big power_of_two(int n) {
        Big r;
        r.digit[n / 32] = std::uint32_t{1} << (n % 32);
        return r;
    }

    constexpr bool negative() const { return (digit[N - 1] >> 31) != 0; }
    constexpr bool is_zero() const { return *this == Big{}; }
    constexpr bool bit(int n) const { return ((digit[n / 32] >> (n % 32)) & 1) != 0; }
    constexpr std::uint64_t low64() const { return digit[0] | (static_cast<std::uint64_t>(digit[1]) << 32); }

    friend constexpr bool operator==(const Big&, const Big&) = default;

    friend constexpr Big operator+(const Big& a, const Big& b) {
        Big r;
        std::uint64_t carry = 0;
        for (int i = 0; i < N; ++i) {
            carry += static_cast<std::uint64_t>(a.digit[i]) + b.digit[i];
            r.digit[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        return r;
    }

    friend constexpr Big operator-(const Big& a) {
        Big r;
        for (int i = 0; i < N; ++i)
            r.digit[i] = ~a.digit[i];
        return r + from_u64(1);
    }

    friend constexpr Big operator-(const Big& a, const Big& b) { return a + (-b); }

    friend constexpr Big operator*(const Big& a, const Big& b) {
        Big r;
        for (int i = 0; i < N; ++i) {
            std::uint64_t carry = 0;
            for (int j = 0; i + j < N; ++j) {
                carry += static_cast<std::uint64_t>(a.digit[i]) * b.digit[j] + r.digit[i + j];
                r.digit[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
        }
        return r;
    }

    friend constexpr Big operator<<(const Big& a, int n) {
        Big r;
        const int whole = n / 32, part = n % 32;
        for (int i = N - 1; i >= whole; --i) {
            const std::uint64_t upper = a.digit[i - whole];
            const std::uint64_t lower = i - whole > 0 ? a.digit[i - whole - 1] : 0;
            r.digit[i] = static_cast<std::uint32_t>((((upper << 32) | lower) << part) >> 32);
        }
        return r;
    }

    // Arithmetic.
    friend constexpr Big operator>>(const Big& a, int n) {
        Big r;
        const std::uint32_t fill = a.negative() ? 0xffffffffu : 0u;
        const int whole = n / 32, part = n % 32;
        for (int i = 0; i < N; ++i) {
            const std::uint64_t lower = i + whole < N ? a.digit[i + whole] : fill;
            const std::uint64_t upper = i + whole + 1 < N ? a.digit[i + whole + 1] : fill;
            r.digit[i] = static_cast<std::uint32_t>(((upper << 32) | lower) >> part);
        }
        return r;
    }

    // Signed order.
    friend constexpr bool operator<(const Big& a, const Big& b) {
        if (a.negative() != b.negative())
            return a.negative();
        for (int i = N - 1; i >= 0; --i) {
            if (a.digit[i] != b.digit[i])
                return a.digit[i] < b.digit[i];
        }
        return false;
    }
    friend constexpr bool operator>(const Big& a, const Big& b) { return b < a; }
    friend constexpr bool operator<=(const Big& a, const Big& b) { return !(b < a); }
    friend constexpr bool operator>=(const Big& a, const Big& b) { return !(a < b); }

    constexpr Big absolute() const { return negative() ? -*this : *this; }

    // For printing measured errors; never decides a test.
    long double approximate() const {
        const Big a = absolute();
        long double r = 0;
        for (int i = N - 1; i >= 0; --i)
            r = r * 4294967296.0L + a.digit[i];
        return negative() ? -r : r;
    }
};

// a / 2^n to the nearest, half up.
template <int N>
constexpr Big<N> shift_right_half_up(const Big<N>& a, int n) {
    return n == 0 ? a : (a + Big<N>::power_of_two(n - 1)) >> n;
}

} // namespace lks::test
