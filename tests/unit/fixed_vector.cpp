// Vectors and directions: lengths, unit vectors, products.
#include <doctest/doctest.h>

#include "big_integer.h"
#include "fixed/vector.h"
#include "fixed_samples.h"
#include "fixed_unit_vectors.h"

using namespace lks::fixed;
using lks::test::Big;
using lks::test::Random;
using lks::test::Tally;

namespace {

using Wide = Big<8>;

Wide wide(std::int64_t a) {
    return Wide::from_i64(a);
}
Big<4> exact(std::int64_t a) {
    return Big<4>::from_i64(a);
}
Wide square(std::int64_t a) {
    return wide(a) * wide(a);
}
std::uint64_t bits(std::int64_t a) {
    return static_cast<std::uint64_t>(a);
}

// Components of one magnitude, or of three; edges; axes; and every combination of their signs.
template <typename Check>
void for_vectors(std::uint64_t seed, int width, Check check) {
    const std::int64_t top = static_cast<std::int64_t>((std::uint64_t{1} << width) - 1);
    const std::int64_t values[] = {0,
                                   1,
                                   -1,
                                   2,
                                   3,
                                   (std::int64_t{1} << 30) - 1,
                                   std::int64_t{1} << 31,
                                   (std::int64_t{1} << 32) + 1,
                                   top,
                                   -top,
                                   top / 2 + 1,
                                   -top / 3};
    for (const std::int64_t x : values) {
        for (const std::int64_t y : values) {
            for (const std::int64_t z : values)
                check(Vec3{x, y, z});
        }
    }
    Random random(seed);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        Vec3 v{random.any_signed(width), random.any_signed(width), random.any_signed(width)};
        if ((i & 1) != 0) {
            const int shift = static_cast<int>(random.below(static_cast<std::uint64_t>(width)));
            const int keep = 63 - width + shift;
            v = {static_cast<std::int64_t>(random.bits()) >> keep,
                 static_cast<std::int64_t>(random.bits()) >> keep,
                 static_cast<std::int64_t>(random.bits()) >> keep};
            if (v.x < -top || v.y < -top || v.z < -top)
                continue;
        }
        check(v);
    }
}

Direction any_direction(Random& random) {
    NormalisedVector n{};
    while (!normalise({random.any_signed(), random.any_signed(), random.any_signed()}, n)) {}
    return n.direction;
}

} // namespace

TEST_CASE("fixed: length() is rounded to the nearest unit") {
    Tally tally;
    const auto check = [&tally](Vec3 v) {
        const std::uint64_t r = length(v);
        const Wide squared = square(v.x) + square(v.y) + square(v.z);
        const Wide root = Wide::from_u64(r);
        // (r - 1/2)^2 < squared < (r + 1/2)^2; no ties.
        tally.expect((r == 0 && squared.is_zero()) ||
                         (root * root - root < squared && squared <= root * root + root),
                     bits(v.x), bits(v.y), bits(v.z));
        const UInt128 s = length_squared(v);
        tally.expect(Wide::from_halves(s.hi, s.lo) == squared, bits(v.x), bits(v.y), bits(v.z));
    };
    for_vectors(31, 63, check);
    check({INT64_MIN, INT64_MIN, INT64_MIN});
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: normalise() gives directions within 1.5 units and lengths within 2^-29.4") {
    Tally tally, direction_tally, length_tally;
    const auto check = [&](Vec3 v) {
        NormalisedVector n{{7, 7, 7}, 7}, mirrored{};
        const bool found = normalise(v, n);
        if (v == Vec3{0, 0, 0}) {
            tally.expect(!found && n.length == 7 && n.direction == Direction{7, 7, 7});
            return;
        }
        const Wide squared = square(v.x) + square(v.y) + square(v.z);
        const std::int64_t component[3] = {v.x, v.y, v.z};
        const std::int32_t unit[3] = {n.direction.x, n.direction.y, n.direction.z};
        for (int i = 0; i < 3; ++i) {
            const bool good =
                lks::test::is_unit_component(unit[i], Wide::from_i64(component[i]), squared, 384);
            direction_tally.expect(good, bits(v.x), bits(v.y), bits(v.z), static_cast<std::uint64_t>(i));
            const long double reference =
                static_cast<long double>(component[i]) / std::sqrt(squared.approximate()) * 0x1p30L;
            direction_tally.measure(unit[i] - reference);
        }
        // |length - |v|| <= |v| * 2^-29.4 + 1/2, by squares: with the tolerance t in 2^-44 of the length,
        // (2 length -+ 1)^2 * 2^88 against 4 |v|^2 (2^44 +- t)^2.
        constexpr std::int64_t tolerance = 24833; // 2^14.6
        const Wide below = wide((std::int64_t{1} << 44) - tolerance),
                   above = wide((std::int64_t{1} << 44) + tolerance);
        const Wide twice = wide(n.length) << 1, one = wide(1);
        const bool low = squared * below * below * wide(4) <= (((twice + one) * (twice + one)) << 88);
        const bool high = (((twice - one) * (twice - one)) << 88) <= squared * above * above * wide(4);
        const bool beyond = squared > square(INT64_MAX);
        length_tally.expect((low && high) || (beyond && high && n.length == INT64_MAX), bits(v.x), bits(v.y),
                            bits(v.z), bits(n.length));
        if (n.length > (std::int64_t{1} << 32) && n.length < INT64_MAX) {
            length_tally.measure(static_cast<long double>(n.length) / std::sqrt(squared.approximate()) - 1);
        }
        if (v.x == INT64_MIN)
            return;
        tally.expect(normalise(-v, mirrored) && mirrored.direction == -n.direction &&
                         mirrored.length == n.length,
                     bits(v.x), bits(v.y), bits(v.z));
    };
    for_vectors(32, 63, check);
    check({INT64_MIN, INT64_MIN, INT64_MIN});
    check({INT64_MIN, 0, 1});
    LKS_CHECK_TALLY(tally);
    LKS_CHECK_TALLY(direction_tally);
    LKS_CHECK_TALLY(length_tally);
    MESSAGE("worst direction error ", static_cast<double>(direction_tally.worst),
            " units; worst length error 2^", static_cast<double>(std::log2(length_tally.worst)));
}

TEST_CASE("fixed: axes normalise exactly") {
    for (int bit = 0; bit < 63; ++bit) {
        const std::int64_t size = std::int64_t{1} << bit;
        NormalisedVector n{};
        CHECK(normalise({0, -size, 0}, n));
        CHECK(n.direction == Direction{0, -(1 << 30), 0});
        CHECK(n.length == size);
    }
}

TEST_CASE("fixed: dot() and scale() are exact but for one rounding half up") {
    Tally tally;
    Random random(33);
    std::uint64_t i = 0;
    Direction d{1 << 30, 0, 0};
    for_vectors(34, 62, [&](Vec3 v) {
        if ((i++ & 15) == 0)
            d = any_direction(random);
        if ((i & 0xff) == 0)
            d = {0, 0, -(1 << 30)};
        const Big<4> sum = exact(d.x) * exact(v.x) + exact(d.y) * exact(v.y) + exact(d.z) * exact(v.z);
        tally.expect(exact(dot(d, v)) == shift_right_half_up(sum, 30), bits(v.x), bits(v.y), bits(v.z));
        const Vec3 along = scale(d, v.x);
        tally.expect(exact(along.x) == shift_right_half_up(exact(d.x) * exact(v.x), 30) &&
                         exact(along.y) == shift_right_half_up(exact(d.y) * exact(v.x), 30) &&
                         exact(along.z) == shift_right_half_up(exact(d.z) * exact(v.x), 30),
                     bits(v.x), bits(d.x), bits(d.y), bits(d.z));
        const Direction other = any_direction(random);
        const Big<4> small =
            exact(d.x) * exact(other.x) + exact(d.y) * exact(other.y) + exact(d.z) * exact(other.z);
        tally.expect(exact(dot(d, other)) == shift_right_half_up(small, 30), bits(d.x), bits(other.x));
    });
    LKS_CHECK_TALLY(tally);
    const std::int32_t one = 1 << 30;
    CHECK(scale({one, -one, 0}, INT64_MAX) == Vec3{INT64_MAX, -INT64_MAX, 0});
    CHECK(scale({one, 0, 0}, INT64_MIN).x == INT64_MIN);
    CHECK(scale({1, -1, 0}, std::int64_t{1} << 29) == Vec3{1, 0, 0});
}

TEST_CASE("fixed: vector sums wrap instead of overflowing") {
    const Vec3 top{INT64_MAX, INT64_MIN, 5}, one{1, -1, -7};
    CHECK(top + one == Vec3{INT64_MIN, INT64_MAX, -2});
    CHECK(top - one == Vec3{INT64_MAX - 1, INT64_MIN + 1, 12});
    CHECK(-top == Vec3{-INT64_MAX, INT64_MIN, -5});
}
