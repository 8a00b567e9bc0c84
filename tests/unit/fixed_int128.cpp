// 128-bit integers against integers of other widths.
#include <doctest/doctest.h>

#include <cstdint>
#include <initializer_list>

#include "big_integer.h"
#include "fixed/int128.h"
#include "fixed/product_sum.h"
#include "fixed_samples.h"

using namespace lks::fixed;
using lks::test::Big;
using lks::test::Random;
using lks::test::Tally;

namespace {

Big<6> big(UInt128 a) {
    return Big<6>::from_halves(a.hi, a.lo);
}
Big<6> big(Int128 a) {
    Big<6> r = Big<6>::from_halves(static_cast<std::uint64_t>(a.hi), a.lo);
    if (a.hi < 0)
        r = r - Big<6>::power_of_two(128);
    return r;
}
Big<6> big(std::int64_t a) {
    return Big<6>::from_i64(a);
}
Big<6> big(std::uint64_t a) {
    return Big<6>::from_u64(a);
}

// What 128 bits keep of a.
UInt128 wrapped(const Big<6>& a) {
    return {(a >> 64).low64(), a.low64()};
}

UInt128 any_u128(Random& random) {
    const UInt128 wide{random.any_magnitude(), random.bits()};
    return random.below(4) == 0 ? UInt128{0, random.any_magnitude()}
                                : wide >> static_cast<int>(random.below(64));
}

// Calls check(a, b) for all pairs of edges and for the samples.
template <typename Check>
void for_pairs(std::uint64_t seed, Check check) {
    for (const std::uint64_t a : lks::test::edges_u64) {
        for (const std::uint64_t b : lks::test::edges_u64)
            check(a, b);
    }
    Random random(seed);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const std::uint64_t a = random.any_magnitude();
        const std::uint64_t b = random.any_magnitude();
        check((i & 1) != 0 ? a : 0 - a, (i & 2) != 0 ? b : 0 - b);
    }
}

// The same for pairs of 128 bits.
template <typename Check>
void for_wide_pairs(std::uint64_t seed, Check check) {
    for (const std::uint64_t a : lks::test::edges_u64) {
        for (const std::uint64_t b : lks::test::edges_u64) {
            for (const std::uint64_t c : lks::test::edges_u64) {
                for (const std::uint64_t d : lks::test::edges_u64)
                    check(UInt128{a, b}, UInt128{c, d});
            }
        }
    }
    Random random(seed);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i)
        check(any_u128(random), any_u128(random));
}

} // namespace

TEST_CASE("fixed: 64 x 64 -> 128 bit products are exact") {
    Tally tally;
    for_pairs(1, [&](std::uint64_t a, std::uint64_t b) {
        const std::int64_t sa = static_cast<std::int64_t>(a), sb = static_cast<std::int64_t>(b);
        tally.expect(big(multiply(a, b)) == big(a) * big(b), a, b);
        tally.expect(multiply_halves(a, b) == multiply(a, b), a, b);
        tally.expect(multiply_signed_halves(sa, sb) == multiply(sa, sb), a, b);
        tally.expect(big(multiply(sa, sb)) == big(sa) * big(sb), a, b);
    });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: products over 2^32 are rounded down, and the same by halves") {
    Tally tally;
    for_pairs(8, [&](std::uint64_t a, std::uint64_t b) {
        const std::int64_t sa = static_cast<std::int64_t>(a), sb = static_cast<std::int64_t>(b);
        const auto exact = static_cast<std::int64_t>((multiply(sa, sb) >> 32).lo);
        tally.expect(multiply_shift_32(sa, sb) == exact, a, b);
        tally.expect(multiply_shift_32_halves(sa, sb) == exact, a, b);
    });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: shifted products are to the nearest, saturate, and are the same by halves") {
    Tally tally;
    for_pairs(9, [&](std::uint64_t a, std::uint64_t b) {
        const std::int64_t sa = static_cast<std::int64_t>(a), sb = static_cast<std::int64_t>(b);
        for (const int n : {0, 1, 40, 64, 127, static_cast<int>((a ^ b) & 127)}) {
            const std::int64_t found = multiply_shift(sa, sb, n);
            tally.expect(found == multiply_shift_halves(sa, sb, n), a, b);
            const Big<6> exact = shift_right_half_up(big(sa) * big(sb), n);
            const Big<6> least = big(INT64_MIN), most = big(INT64_MAX);
            tally.expect(big(found) == (exact < least ? least : exact > most ? most : exact), a, b);
        }
    });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: sums of products are exact before they are shifted, and the same by halves") {
    Tally tally;
    for_pairs(10, [&](std::uint64_t a, std::uint64_t b) {
        const std::int64_t sa = static_cast<std::int64_t>(a), sb = static_cast<std::int64_t>(b);
        ProductSum sum;
        HalvesProductSum by_halves;
        for (const std::int64_t factor : {sb, sa ^ sb, std::int64_t{-1}, sb >> 7}) {
            sum.add(sa, factor);
            by_halves.add(sa, factor);
        }
        const Big<6> factors = big(sb) + big(sa ^ sb) + big(std::int64_t{-1}) + big(sb >> 7);
        const Int128 whole = as_signed(wrapped(big(sa) * factors));
        for (const int n : {0, 40, 64}) {
            tally.expect(sum.shifted(n) == by_halves.shifted(n), a, b);
            tally.expect(sum.shifted(n) == static_cast<std::int64_t>((whole >> n).lo), a, b);
        }
    });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: short dot products are the same by halves and by the machine's 128 bits") {
    Tally tally;
    for_pairs(7, [&](std::uint64_t a, std::uint64_t b) {
        const std::int64_t sa = static_cast<std::int64_t>(a), sb = static_cast<std::int64_t>(b);
        // Magnitudes that sum to less than 2^31.
        const auto p = static_cast<std::int32_t>(sb >> 33), q = static_cast<std::int32_t>(sa >> 34);
        const auto r = static_cast<std::int32_t>((sa ^ sb) >> 34);
        tally.expect(dot_shift_30(p, 0, 0, sa, 0, 0) == dot_shift_30_halves(p, 0, 0, sa, 0, 0), a, b);
        tally.expect(dot_shift_30(p, q, r, sa, sb, sa ^ sb) == dot_shift_30_halves(p, q, r, sa, sb, sa ^ sb),
                     a, b);
    });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: 128-bit sums, differences, negation and order") {
    Tally tally;
    for_wide_pairs(2, [&](UInt128 a, UInt128 b) {
        const Int128 sa = as_signed(a), sb = as_signed(b);
        tally.expect(a + b == wrapped(big(a) + big(b)), a.hi, a.lo, b.hi, b.lo);
        tally.expect(a - b == wrapped(big(a) - big(b)), a.hi, a.lo, b.hi, b.lo);
        tally.expect(as_unsigned(sa + sb) == wrapped(big(sa) + big(sb)), a.hi, a.lo, b.hi, b.lo);
        tally.expect(as_unsigned(sa - sb) == wrapped(big(sa) - big(sb)), a.hi, a.lo, b.hi, b.lo);
        tally.expect(as_unsigned(negate(sa)) == wrapped(-big(sa)), a.hi, a.lo);
        tally.expect(big(abs(sa)) == big(sa).absolute(), a.hi, a.lo);
        tally.expect((a < b) == (big(a) < big(b)) && (a <= b) == (big(a) <= big(b)), a.hi, a.lo, b.hi, b.lo);
        tally.expect((sa < sb) == (big(sa) < big(sb)) && (sa > sb) == (big(sa) > big(sb)), a.hi, a.lo, b.hi,
                     b.lo);
        tally.expect((a == b) == (big(a) == big(b)), a.hi, a.lo, b.hi, b.lo);
        const Big<6> bounded = big(sa) < big(INT64_MIN)   ? big(INT64_MIN)
                               : big(sa) > big(INT64_MAX) ? big(INT64_MAX)
                                                          : big(sa);
        tally.expect(big(saturate_to_int64(sa)) == bounded, a.hi, a.lo);
    });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: 128-bit shifts, rounded shifts and leading zeros") {
    Tally tally;
    const auto check = [&tally](UInt128 a, int n) {
        const Int128 sa = as_signed(a);
        const std::uint64_t shift = static_cast<std::uint64_t>(n);
        tally.expect((a << n) == wrapped(big(a) << n), a.hi, a.lo, shift);
        tally.expect((a >> n) == wrapped(big(a) >> n), a.hi, a.lo, shift);
        tally.expect(as_unsigned(sa << n) == wrapped(big(a) << n), a.hi, a.lo, shift);
        tally.expect(big(sa >> n) == big(sa) >> n, a.hi, a.lo, shift);
        tally.expect(big(shift_right_rounded(sa, n)) == shift_right_half_up(big(sa), n), a.hi, a.lo, shift);
        tally.expect(big(shift_right_rounded(a, n)) == shift_right_half_up(big(a), n), a.hi, a.lo, shift);
        const std::int64_t half = static_cast<std::int64_t>(a.hi);
        const int small = n & 63;
        tally.expect(big(shift_right_rounded(half, small)) == shift_right_half_up(big(half), small), a.hi,
                     shift);
        tally.expect(big(shift_right_rounded(a.hi, small)) == shift_right_half_up(big(a.hi), small), a.hi,
                     shift);
        int zeros = 0;
        while (zeros < 128 && !big(a).bit(127 - zeros))
            ++zeros;
        tally.expect(leading_zeros(a) == zeros, a.hi, a.lo);
    };
    for (const std::uint64_t hi : lks::test::edges_u64) {
        for (const std::uint64_t lo : lks::test::edges_u64) {
            for (int n = 0; n < 128; ++n)
                check({hi, lo}, n);
        }
    }
    Random random(3);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        check({random.any_magnitude(), random.bits()}, static_cast<int>(random.below(128)));
    }
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: 128-bit quotients are the floor, for divisors of 64 and of 128 bits") {
    Tally tally;
    for_wide_pairs(4, [&](UInt128 a, UInt128 b) {
        if (b.lo != 0) {
            if (a.hi < b.lo) {
                const Quotient64 narrow = divide_narrow(a.hi, a.lo, b.lo);
                const Quotient64 digits = divide_by_digits(a.hi, a.lo, b.lo);
                tally.expect(narrow.quotient == digits.quotient && narrow.remainder == digits.remainder, a.hi,
                             a.lo, b.lo);
            }
            const Quotient128 q = divide(a, b.lo);
            tally.expect(big(q.quotient) * big(b.lo) + big(q.remainder) == big(a) && q.remainder < b.lo, a.hi,
                         a.lo, b.lo);
        }
        if (b != UInt128{0, 0}) {
            const UInt128 q = divide(a, b);
            const Big<6> rest = big(a) - big(q) * big(b);
            tally.expect(!rest.negative() && rest < big(b), a.hi, a.lo, b.hi, b.lo);
        }
    });
    LKS_CHECK_TALLY(tally);
    const UInt128 all{UINT64_MAX, UINT64_MAX};
    CHECK(divide(UInt128{1, 2}, std::uint64_t{0}).quotient == all);
    CHECK(divide(UInt128{1, 2}, UInt128{0, 0}) == all);
}

TEST_CASE("fixed: square roots of 32, 64 and 128 bits are the floor") {
    Tally tally;
    const auto check = [&tally](UInt128 a) {
        const std::uint64_t root = square_root(a);
        const Big<6> r = big(root), next = big(root) + big(std::uint64_t{1});
        tally.expect(r * r <= big(a) && next * next > big(a), a.hi, a.lo);
        const std::uint64_t root64 = square_root(a.lo);
        const Big<6> s = big(root64), s_next = big(root64) + big(std::uint64_t{1});
        tally.expect(s * s <= big(a.lo) && s_next * s_next > big(a.lo), a.lo);
        const std::uint32_t low = static_cast<std::uint32_t>(a.lo);
        const std::uint64_t root32 = square_root(low);
        tally.expect(root32 * root32 <= low && (root32 + 1) * (root32 + 1) > low, low);
    };
    for (const std::uint64_t hi : lks::test::edges_u64) {
        for (const std::uint64_t lo : lks::test::edges_u64)
            check({hi, lo});
    }
    Random random(5);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        check(any_u128(random));
        // Squares and their neighbours, where an estimate one too large shows.
        const std::uint64_t root = random.any_magnitude();
        const UInt128 square = multiply(root, root);
        check(square);
        check(square - UInt128{0, 1});
    }
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: multiply_divide rounds to the nearest, ties away from zero, and saturates") {
    Tally tally;
    const auto check = [&tally](std::int64_t a, std::int64_t b, std::int64_t d) {
        if (d == 0)
            return;
        const std::int64_t q = multiply_divide(a, b, d);
        const Big<6> two = big(std::uint64_t{2});
        const Big<6> product = big(a) * big(b);
        const Big<6> size = product.absolute(), divisor = big(d).absolute();
        // The nearest quotient, ties away: floor((2 * size + divisor) / (2 * divisor)), found by checking q.
        const Big<6> found = big(q).absolute();
        const bool negative = product.negative() != (d < 0);
        const Big<6> limit = negative ? big(INT64_MIN).absolute() : big(INT64_MAX);
        const Big<6> doubled = size * two + divisor;
        const bool below = found * two * divisor <= doubled;
        const bool above = (found + big(std::uint64_t{1})) * two * divisor > doubled;
        const bool sign_good = q == 0 || (q < 0) == negative;
        const bool saturated = found == limit && below;
        tally.expect(sign_good && ((below && above) || saturated), static_cast<std::uint64_t>(a),
                     static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(d));
    };
    for (const std::uint64_t a : lks::test::edges_u64) {
        for (const std::uint64_t b : lks::test::edges_u64) {
            for (const std::uint64_t d : lks::test::edges_u64) {
                check(static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
                      static_cast<std::int64_t>(d));
            }
        }
    }
    Random random(6);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        check(random.any_signed(), random.any_signed(), random.any_signed());
    }
    LKS_CHECK_TALLY(tally);
    CHECK(multiply_divide(7, 1, 2) == 4);
    CHECK(multiply_divide(-7, 1, 2) == -4);
    CHECK(multiply_divide(5, 3, -2) == -8);
    CHECK(multiply_divide(INT64_MIN, INT64_MIN, -1) == INT64_MIN);
    CHECK(multiply_divide(INT64_MIN, 1, 1) == INT64_MIN);
    CHECK(multiply_divide(INT64_MIN, -1, 1) == INT64_MAX);
    CHECK(multiply_divide(1, 1, 0) == INT64_MAX);
    CHECK(multiply_divide(-1, 1, 0) == INT64_MIN);
    CHECK(multiply_divide(0, 1, 0) == 0);
}

TEST_CASE("fixed: 64-bit helpers wrap and saturate as documented") {
    Tally tally;
    for_pairs(7, [&](std::uint64_t ua, std::uint64_t ub) {
        const std::int64_t a = static_cast<std::int64_t>(ua), b = static_cast<std::int64_t>(ub);
        const Big<6> sum = big(a) + big(b);
        const Big<6> bounded = sum < big(INT64_MIN)   ? big(INT64_MIN)
                               : sum > big(INT64_MAX) ? big(INT64_MAX)
                                                      : sum;
        tally.expect(big(saturating_add(a, b)) == bounded, ua, ub);
        tally.expect(static_cast<std::uint64_t>(wrapping_add(a, b)) == sum.low64(), ua, ub);
        tally.expect(static_cast<std::uint64_t>(wrapping_subtract(a, b)) == (big(a) - big(b)).low64(), ua,
                     ub);
        tally.expect(static_cast<std::uint64_t>(wrapping_multiply(a, b)) == (big(a) * big(b)).low64(), ua,
                     ub);
        tally.expect(big(magnitude(a)) == big(a).absolute(), ua);
    });
    LKS_CHECK_TALLY(tally);
    CHECK(with_sign(std::uint64_t{1} << 63, true) == INT64_MIN);
    CHECK(with_sign(UINT64_MAX, true) == INT64_MIN);
    CHECK(with_sign(std::uint64_t{1} << 63, false) == INT64_MAX);
    CHECK(with_sign(5, true) == -5);
    CHECK(wrapping_negate(INT64_MIN) == INT64_MIN);
}
