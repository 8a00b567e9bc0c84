// 1/sqrt and 1/x of mantissas: worst relative errors. LOCKSTITCH_LONG=1 takes every mantissa there is.
#include <doctest/doctest.h>

#include "big_integer.h"
#include "fixed/projection_reciprocal_sqrt.h"
#include "fixed/reciprocal_sqrt.h"
#include "fixed_samples.h"

using namespace lks::fixed;
using lks::test::Big;
using lks::test::Random;
using lks::test::Tally;

namespace {

// y = (1 + d) / sqrt(m) gives y^2 * m = 1 + 2d + d^2. In units of 2^-92: |y^2 * m - 2^92| <= 2^93 * 2^-30.99
// covers |d| <= 2^-30.99, for d^2 only matters beyond 2^-61.
constexpr std::uint64_t sqrt_error_bound = 4643683640440590000u; // 2^62.01
// y = (1 + d) / m gives y * m = 1 + d, in units of 2^-62.
constexpr std::uint64_t reciprocal_error_bound = 2162373000u; // 2^31.01

void check_sqrt(std::uint32_t m, Tally& tally) {
    const std::uint64_t y = reciprocal_sqrt_mantissa(m);
    const Big<4> error =
        (Big<4>::from_u64(y * y) * Big<4>::from_u64(m) - Big<4>::power_of_two(92)).absolute();
    const bool in_range = y >= (std::uint64_t{1} << 30) && y <= (std::uint64_t{1} << 31);
    tally.expect(in_range && error <= Big<4>::from_u64(sqrt_error_bound), m, y);
    tally.measure(static_cast<long double>(error.low64()) * 0x1p-93L);
}

void check_reciprocal(std::uint32_t m, Tally& tally) {
    const std::uint64_t y = reciprocal_mantissa(m);
    const std::uint64_t one = std::uint64_t{1} << 62, product = y * m;
    const std::uint64_t error = product > one ? product - one : one - product;
    const bool in_range = y >= (std::uint64_t{1} << 30) && y <= (std::uint64_t{1} << 31);
    tally.expect(in_range && error <= reciprocal_error_bound, m, y);
    tally.measure(static_cast<long double>(error) * 0x1p-62L);
}

// Every mantissa from `first` on, with a line of progress every 2^28.
template <typename Check>
void sweep(const char* name, std::uint64_t first, std::uint64_t step, Tally& tally, Check check) {
    for (std::uint64_t m = first; m < (std::uint64_t{1} << 32); m += step) {
        check(static_cast<std::uint32_t>(m), tally);
        if (step == 1 && (m & 0x0fffffff) == 0x0fffffff) {
            std::fprintf(stderr, "%s: %u %% of all mantissas\n", name,
                         static_cast<unsigned>((m - first) * 100 / ((std::uint64_t{1} << 32) - first)));
        }
    }
}

// The edges of every segment, and of the 16 bits that the seed looks at.
template <typename Check>
void check_edges(std::uint64_t first, Tally& tally, Check check) {
    for (std::uint64_t m = first; m < (std::uint64_t{1} << 32); m += 1 << 12) {
        check(static_cast<std::uint32_t>(m), tally);
        check(static_cast<std::uint32_t>(m + (1 << 12) - 1), tally);
    }
}

// An odd step that spreads the samples evenly over all residues.
std::uint64_t sweep_step(std::uint64_t mantissas) {
    return lks::test::long_run() ? 1 : (mantissas / lks::test::sample_count()) | 1;
}

} // namespace

TEST_CASE("fixed: 1/sqrt of a mantissa is within 2^-30.99") {
    Tally tally;
    const std::uint64_t first = std::uint64_t{1} << 30;
    check_edges(first, tally, check_sqrt);
    sweep("1/sqrt", first, sweep_step(3 * first), tally, check_sqrt);
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst relative error 2^", static_cast<double>(std::log2(tally.worst)));
    CHECK(reciprocal_sqrt_mantissa(1u << 30) == 1u << 31);
    CHECK(reciprocal_sqrt_mantissa(UINT32_MAX) == 1u << 30);
}

TEST_CASE("fixed: 1/sqrt for projections is within 2^-29.42, and below one") {
    Tally tally;
    const auto check = [](std::uint32_t m, Tally& t) {
        const std::uint64_t y = projection_reciprocal_sqrt(m);
        const Big<4> error =
            (Big<4>::from_u64(y * y) * Big<4>::from_u64(m) - Big<4>::power_of_two(92)).absolute();
        const bool in_range = y >= (std::uint64_t{1} << 30) && y < (std::uint64_t{1} << 31);
        t.expect(in_range && error <= Big<4>::from_u64(13813000000000000000u), m, y); // 2^93 * 2^-29.42
        t.measure(static_cast<long double>(error.low64()) * 0x1p-93L);
    };
    const std::uint64_t first = std::uint64_t{1} << 30;
    check_edges(first, tally, check);
    sweep("1/sqrt for projections", first, sweep_step(3 * first), tally, check);
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst relative error 2^", static_cast<double>(std::log2(tally.worst)));
}

TEST_CASE("fixed: the reciprocal of a mantissa is within 2^-30.99") {
    Tally tally;
    const std::uint64_t first = std::uint64_t{1} << 31;
    check_edges(first, tally, check_reciprocal);
    sweep("reciprocal", first, sweep_step(first), tally, check_reciprocal);
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst relative error 2^", static_cast<double>(std::log2(tally.worst)));
    CHECK(reciprocal_mantissa(1u << 31) == 1u << 31);
    CHECK(reciprocal_mantissa(UINT32_MAX) == 1u << 30);
}

TEST_CASE("fixed: both seeds are close enough for one third-order step, and below one") {
    // Relative to 2^-16 units: s^2 * m within 2^-11.9 of one, s * m within 2^-13.8.
    Tally root, reciprocal;
    for (std::uint64_t m = std::uint64_t{1} << 30; m < (std::uint64_t{1} << 32); m += 1 << 12) {
        for (std::uint64_t offset = 0; offset < (1 << 12); offset += (1 << 12) - 1) {
            const std::uint32_t mantissa = static_cast<std::uint32_t>(m + offset);
            const std::uint64_t s = seed(reciprocal_sqrt_seeds, mantissa);
            const std::int64_t error = static_cast<std::int64_t>(s * s * mantissa - (std::uint64_t{1} << 62));
            root.expect(s < 65536 && error <= 1206700000000000 && error >= -1206700000000000, mantissa, s);
            root.measure(static_cast<long double>(error) * 0x1p-63L);
            if (mantissa < (1u << 31))
                continue;
            const std::uint64_t t = seed(reciprocal_seeds, mantissa);
            const std::int64_t rest = static_cast<std::int64_t>(t * mantissa - (std::uint64_t{1} << 47));
            reciprocal.expect(t < 65536 && rest <= 9867000000 && rest >= -9867000000, mantissa, t);
            reciprocal.measure(static_cast<long double>(rest) * 0x1p-47L);
        }
    }
    LKS_CHECK_TALLY(root);
    LKS_CHECK_TALLY(reciprocal);
    MESSAGE("worst seeds 2^", static_cast<double>(std::log2(root.worst)), " and 2^",
            static_cast<double>(std::log2(reciprocal.worst)));
}

TEST_CASE("fixed: reciprocal lengths of every magnitude are within 2^-30.4") {
    Tally tally;
    // mantissa^2 * (u << 2 * shift) against 2^124; the bound is 2^125 * 2^-30.4 = 2^94.6.
    const Big<5> bound = Big<5>::from_u64(6509953000u) << 62;
    const auto check = [&](std::uint64_t u) {
        if (u == 0)
            return;
        const ReciprocalLength r = reciprocal_length(u);
        const std::uint64_t y = r.mantissa;
        const std::uint64_t normalised = u << (2 * r.shift);
        const bool placed =
            r.shift >= 0 && r.shift <= 31 && (normalised >> (2 * r.shift)) == u && (normalised >> 62) != 0;
        const Big<5> error =
            (Big<5>::from_u64(y * y) * Big<5>::from_u64(normalised) - Big<5>::power_of_two(124)).absolute();
        tally.expect(placed && error <= bound, u, y);
        tally.measure(error.approximate() * 0x1p-125L);
    };
    for (const std::uint64_t u : lks::test::edges_u64)
        check(u);
    for (int bit = 0; bit < 64; ++bit) {
        for (std::uint64_t d = 0; d < 1000; ++d) {
            check((std::uint64_t{1} << bit) + d);
            check((std::uint64_t{1} << bit) - d);
        }
    }
    Random random(11);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        check(random.any_magnitude());
        // Just above a power of four plus almost one unit of what is cut off: the worst place.
        check((std::uint64_t{1} << 62) + (random.below(1 << 16) << 32) + 0xffffffffu);
    }
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst relative error 2^", static_cast<double>(std::log2(tally.worst)));
}
