// Scaled: every operation is the exact result rounded to the nearest, half up: relative error at most 2^-64.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <initializer_list>

#include "big_integer.h"
#include "fixed/scaled.h"
#include "fixed_samples.h"

using namespace lks::fixed;
using lks::test::Random;
using lks::test::Tally;
using Exact = lks::test::Big<14>;

namespace {

Exact exact(std::uint64_t a) {
    return Exact::from_u64(a);
}

bool is_normal(Scaled a) {
    return a.mantissa == 0 ? a.exponent == 0 : (a.mantissa >> 63) == 1;
}

// Whether r is whole * 2^exponent rounded half up to 64 bits; whole > 0. Measures the error relative to the
// result.
bool is_rounded(Scaled r, const Exact& whole, std::int64_t exponent, Tally& tally) {
    if (!is_normal(r) || r.is_zero())
        return false;
    const std::int64_t cut = r.exponent - exponent;
    if (cut <= 0)
        return (whole << static_cast<int>(-cut)) == exact(r.mantissa);
    const int shift = static_cast<int>(cut);
    const Exact error = (exact(r.mantissa) << shift) - whole;
    tally.measure(error.approximate() / std::ldexp(static_cast<long double>(r.mantissa), shift));
    const Exact half = Exact::power_of_two(shift - 1);
    // Below a power of two the numbers lie twice as close.
    const bool power = r.mantissa == std::uint64_t{1} << 63;
    return (power ? error + error : error) <= half && -error < half;
}

// Exponents near each other, where roundings happen, and sometimes far.
Scaled any_scaled(Random& random, bool zeros = true) {
    const std::uint64_t top = std::uint64_t{1} << 63;
    const std::uint64_t kind = random.below(zeros ? 33 : 32);
    if (kind == 32)
        return {};
    std::uint64_t mantissa = top | random.bits();
    if (kind < 4)
        mantissa = top + random.below(3);
    if (kind >= 4 && kind < 8)
        mantissa = UINT64_MAX - random.below(3);
    if (kind >= 8 && kind < 12)
        mantissa = top | (random.bits() << random.below(64));
    const std::int32_t exponent = static_cast<std::int32_t>(random.below(kind < 24 ? 9 : 280));
    return {mantissa, exponent - 140};
}

// Samples, and all pairs of edges at every distance: where a bit that a shift has cut off decides a rounding.
template <typename Check>
void for_pairs(std::uint64_t seed, Check check) {
    const std::uint64_t edges[] = {0x8000000000000000u, 0x8000000000000001u, 0x8000000000000002u,
                                   0xc000000000000000u, 0xc000000000000001u, 0xfffffffffffffffeu,
                                   0xffffffffffffffffu};
    for (const std::uint64_t a : edges) {
        for (const std::uint64_t b : edges) {
            for (std::int32_t distance = -140; distance <= 140; ++distance)
                check(Scaled{a, 0}, Scaled{b, distance});
        }
    }
    Random random(seed);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const Scaled a = any_scaled(random);
        Scaled b = any_scaled(random);
        // Neighbours, so that differences cancel.
        if ((i & 7) == 0) {
            const std::uint64_t top = std::uint64_t{1} << 63;
            b = {top | (a.mantissa + random.below(5)),
                 a.exponent + static_cast<std::int32_t>(random.below(3)) - 1};
        }
        check(a, b);
    }
}

void report(const Tally& tally) {
    CHECK(tally.worst <= 0x1p-64L);
    MESSAGE("worst relative error 2^", static_cast<double>(std::log2(tally.worst)));
}

} // namespace

TEST_CASE("fixed: Scaled products are rounded correctly") {
    Tally tally;
    for_pairs(21, [&](Scaled a, Scaled b) {
        const Scaled r = a * b;
        const bool good = a.is_zero() || b.is_zero() ? r == Scaled{}
                                                     : is_rounded(r, exact(a.mantissa) * exact(b.mantissa),
                                                                  a.exponent + b.exponent, tally);
        tally.expect(good, a.mantissa, b.mantissa);
    });
    LKS_CHECK_TALLY(tally);
    report(tally);
}

TEST_CASE("fixed: Scaled sums and differences are rounded correctly at every distance") {
    Tally tally;
    for_pairs(22, [&](Scaled a, Scaled b) {
        const std::int32_t low = a.exponent < b.exponent ? a.exponent : b.exponent;
        const Exact wide_a = exact(a.mantissa) << (a.exponent - low);
        const Exact wide_b = exact(b.mantissa) << (b.exponent - low);
        const std::uint64_t exponents = static_cast<std::uint64_t>(a.exponent - b.exponent);
        const Scaled sum = a + b;
        const bool sum_good =
            a.is_zero() && b.is_zero() ? sum == Scaled{} : is_rounded(sum, wide_a + wide_b, low, tally);
        tally.expect(sum_good && sum == b + a, a.mantissa, b.mantissa, exponents, 0);
        const Scaled rest = subtract_or_zero(a, b);
        const bool rest_good =
            wide_a <= wide_b ? rest == Scaled{} : is_rounded(rest, wide_a - wide_b, low, tally);
        tally.expect(rest_good, a.mantissa, b.mantissa, exponents, 1);
        const int order = wide_a < wide_b ? -1 : wide_a > wide_b ? 1 : 0;
        tally.expect(compare(a, b) == order && (a < b) == (order < 0) && (a >= b) == (order >= 0), a.mantissa,
                     b.mantissa, exponents, 2);
    });
    LKS_CHECK_TALLY(tally);
    report(tally);
    // So far apart that nothing of the smaller one is left but the direction in which a tie would fall.
    const Scaled one = Scaled::from_u64(1), tiny = one.times_power_of_two(-100000);
    CHECK(one + tiny == one);
    CHECK(subtract_or_zero(one, tiny) == one);
}

TEST_CASE("fixed: Scaled quotients are rounded correctly") {
    Tally tally;
    for_pairs(23, [&](Scaled a, Scaled b) {
        const Scaled r = a / b;
        if (a.is_zero() || b.is_zero()) {
            tally.expect(r == (a.is_zero() ? Scaled{} : Scaled::largest()), a.mantissa, b.mantissa);
            return;
        }
        // r * b against a, in units of b's last place times r's.
        const std::int64_t shift = std::int64_t{a.exponent} - b.exponent - r.exponent;
        bool good = is_normal(r) && (shift == 63 || shift == 64);
        if (good) {
            const Exact twice_error =
                (exact(r.mantissa) * exact(b.mantissa) - (exact(a.mantissa) << static_cast<int>(shift))) << 1;
            good = twice_error <= exact(b.mantissa) && -twice_error < exact(b.mantissa);
            tally.measure(twice_error.approximate() / 2 / static_cast<long double>(r.mantissa) /
                          static_cast<long double>(b.mantissa));
        }
        tally.expect(good, a.mantissa, b.mantissa);
    });
    LKS_CHECK_TALLY(tally);
    report(tally);
    CHECK(Scaled::ratio(1, 3) == Scaled{0xaaaaaaaaaaaaaaabu, -65});
    CHECK(Scaled::ratio(0, 0) == Scaled{});
    CHECK(Scaled::ratio(5, 0) == Scaled::largest());
}

TEST_CASE("fixed: Scaled square roots are rounded correctly") {
    Tally tally;
    Random random(24);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const Scaled a = any_scaled(random, false);
        const Scaled r = square_root(a);
        // (r - 1/2)^2 <= a < (r + 1/2)^2 in units of r's last place; there are no ties.
        const std::int64_t shift = std::int64_t{a.exponent} - 2 * std::int64_t{r.exponent};
        bool good = is_normal(r) && (shift == 63 || shift == 64);
        if (good) {
            const Exact m = exact(r.mantissa), square = m * m;
            const Exact target = exact(a.mantissa) << static_cast<int>(shift);
            good = square - m < target && target <= square + m;
            tally.measure((square - target).approximate() / 2 / m.approximate() / m.approximate());
        }
        tally.expect(good, a.mantissa, static_cast<std::uint64_t>(a.exponent));
    }
    LKS_CHECK_TALLY(tally);
    report(tally);
    CHECK(square_root(Scaled{}) == Scaled{});
    CHECK(square_root(Scaled::from_u64(144)) == Scaled::from_u64(12));
}

TEST_CASE("fixed: Scaled from integers, fixed-point and 128 bits") {
    Tally tally;
    Random random(25);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const std::uint64_t a = random.any_magnitude(), b = random.bits();
        const int fraction = static_cast<int>(random.below(128)) - 32;
        const Scaled from_u64 = Scaled::from_u64(a);
        tally.expect(a == 0 ? from_u64 == Scaled{} : is_rounded(from_u64, exact(a), 0, tally), a);
        const Scaled from_fixed = Scaled::from_fixed(a, fraction);
        tally.expect(a == 0 ? from_fixed == Scaled{} : is_rounded(from_fixed, exact(a), -fraction, tally), a);
        const Exact wide = (exact(a) << 64) + exact(b);
        const Scaled from_u128 = Scaled::from_u128({a, b}, fraction);
        tally.expect(wide.is_zero() ? from_u128 == Scaled{} : is_rounded(from_u128, wide, -fraction, tally),
                     a, b);
        tally.expect(a == 0 || from_u64.log2_floor() == 63 - std::countl_zero(a), a);
    }
    LKS_CHECK_TALLY(tally);
    CHECK(Scaled{}.log2_floor() == INT32_MIN);
    CHECK(Scaled::from_u128({UINT64_MAX, UINT64_MAX}, 0) == Scaled{std::uint64_t{1} << 63, 65});
}

TEST_CASE("fixed: Scaled from the bits of doubles is exact") {
    Tally tally;
    Random random(26);
    const auto check = [&tally](std::uint64_t bits) {
        if ((bits >> 52) == 0x7ff)
            return;
        const Scaled s = Scaled::from_double_bits(bits);
        // Scaling by a power of two is exact where the result is a double, and this one is.
        const double back = std::ldexp(static_cast<double>(s.mantissa >> 11), s.exponent + 11);
        tally.expect(is_normal(s) && (s.mantissa & 0x7ff) == 0 && std::bit_cast<std::uint64_t>(back) == bits,
                     bits);
    };
    const std::uint64_t positive = ~(std::uint64_t{1} << 63);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const std::uint64_t bits = random.bits() & positive;
        check(bits);
        check(bits & ((std::uint64_t{1} << 52) - 1));  // subnormal
        check(random.any_magnitude(52));               // small subnormal
        check(bits & ~((std::uint64_t{1} << 52) - 1)); // power of two
        check(std::uint64_t{random.below(2047)} << 52 | 1);
    }
    for (const double value :
         {0.0, 1.0, 0.1, 9.81, 4.9e-324, 2.2250738585072014e-308, 1.7976931348623157e308}) {
        check(std::bit_cast<std::uint64_t>(value));
    }
    LKS_CHECK_TALLY(tally);
    CHECK(Scaled::from_double_bits(std::bit_cast<std::uint64_t>(4.9e-324)) ==
          Scaled{std::uint64_t{1} << 63, -1074 - 63});
}

TEST_CASE("fixed: Scaled to fixed-point rounds half up and saturates") {
    Tally tally;
    for_pairs(27, [&](Scaled a, Scaled b) {
        const int fraction = b.exponent / 2;
        const int shift = a.exponent + fraction;
        const Exact whole = shift >= 0 ? exact(a.mantissa) << shift
                                       : lks::test::shift_right_half_up(exact(a.mantissa), -shift);
        const std::uint64_t bounded = whole > exact(UINT64_MAX) ? UINT64_MAX : whole.low64();
        const std::uint64_t exponent = static_cast<std::uint64_t>(shift);
        tally.expect(a.to_fixed(fraction) == bounded, a.mantissa, exponent);
        const std::uint64_t limit = static_cast<std::uint64_t>(INT64_MAX);
        const std::uint64_t size = bounded > limit ? limit : bounded;
        tally.expect(a.to_i64_fixed(fraction) == static_cast<std::int64_t>(size), a.mantissa, exponent);
    });
    LKS_CHECK_TALLY(tally);
    CHECK(Scaled::ratio(1, 2).to_fixed(0) == 1);
    CHECK(Scaled::ratio(1, 2).times_power_of_two(-1).to_fixed(0) == 0);
    CHECK(subtract_or_zero(Scaled::ratio(1, 2), Scaled::ratio(1, std::uint64_t{1} << 63)).to_fixed(0) == 0);
    CHECK(Scaled::largest().to_fixed(0) == UINT64_MAX);
    CHECK(Scaled::largest().to_i64_fixed(-1000) == INT64_MAX);
}

TEST_CASE("fixed: Scaled exponents saturate at the largest number and at zero") {
    Scaled large = Scaled::from_u64(3), small = Scaled::ratio(1, 3);
    for (int i = 0; i < 40; ++i) {
        large = large * large;
        small = small * small;
    }
    CHECK(large == Scaled::largest());
    CHECK(small == Scaled{});
    CHECK(Scaled::largest() + Scaled::largest() == Scaled::largest());
    CHECK(Scaled::largest() / Scaled::from_u64(1).times_power_of_two(-5) == Scaled::largest());
    CHECK(Scaled::from_u64(1).times_power_of_two(-INT32_MAX) == Scaled{});
}
