// Quaternions and matrices in Q2.30.
#include <doctest/doctest.h>

#include "big_integer.h"
#include "fixed/rotation.h"
#include "fixed_samples.h"
#include "fixed_unit_vectors.h"

using namespace lks::fixed;
using lks::test::Big;
using lks::test::Random;
using lks::test::Tally;

namespace {

using Wide = Big<9>;

Wide wide(std::int64_t a) {
    return Wide::from_i64(a);
}

// Sums of three or four products of 64 by 32 bits.
using Sum = Big<4>;

Sum exact(std::int64_t a) {
    return Sum::from_i64(a);
}

std::uint64_t bits(std::int64_t a) {
    return static_cast<std::uint64_t>(a);
}

Matrix3 transpose(const Matrix3& a) {
    return {{{a.m[0][0], a.m[1][0], a.m[2][0]},
             {a.m[0][1], a.m[1][1], a.m[2][1]},
             {a.m[0][2], a.m[1][2], a.m[2][2]}}};
}

std::int32_t any_component(Random& random) {
    return static_cast<std::int32_t>(random.any_signed(31));
}

// Evenly from a cube, or with components of any magnitude; normalised.
Rotation any_rotation(Random& random) {
    const std::uint64_t kind = random.below(8);
    if (kind == 0) {
        return normalise(Rotation{any_component(random), any_component(random), any_component(random),
                                  any_component(random)});
    }
    const std::uint64_t a = random.bits(), b = random.bits();
    return normalise(Rotation{static_cast<std::int32_t>(a), static_cast<std::int32_t>(a >> 32),
                              static_cast<std::int32_t>(b), static_cast<std::int32_t>(b >> 32)});
}

// `count` of them, and the axes and diagonals.
template <typename Check>
void for_rotations(std::uint64_t seed, std::uint64_t count, Check check) {
    const std::int32_t one = 1 << 30, half = 1 << 29, root_half = 759250125;
    const Rotation edges[] = {{0, 0, 0, one},
                              {0, 0, 0, -one},
                              {one, 0, 0, 0},
                              {0, -one, 0, 0},
                              {0, 0, one, 0},
                              {half, half, half, half},
                              {-half, half, -half, half},
                              {root_half, 0, 0, root_half},
                              {0, root_half, -root_half, 0},
                              {1, -1, 0, one},
                              {one, 1, 0, 0}};
    for (const Rotation& q : edges)
        check(q);
    Random random(seed);
    for (std::uint64_t i = 0; i < count; ++i)
        check(any_rotation(random));
}

Wide squared_length(const std::int64_t (&v)[4]) {
    Wide sum;
    for (const std::int64_t c : v)
        sum = sum + wide(c) * wide(c);
    return sum;
}

// Each component of q within 0.5 + 1/256 units of v / |v|.
bool is_normalised(Rotation q, const std::int64_t (&v)[4], Tally& tally) {
    const Wide squared = squared_length(v);
    const std::int32_t unit[4] = {q.x, q.y, q.z, q.w};
    bool good = true;
    for (int i = 0; i < 4; ++i) {
        good = good && lks::test::is_unit_component(unit[i], wide(v[i]), squared, 129);
        tally.measure(unit[i] - static_cast<long double>(v[i]) / std::sqrt(squared.approximate()) * 0x1p30L);
    }
    return good;
}

std::int64_t dot(Rotation a, Rotation b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z +
           std::int64_t{a.w} * b.w;
}

} // namespace

TEST_CASE("fixed: quaternions of any length are normalised to half a unit") {
    Tally tally;
    const auto check = [&tally](Rotation q) {
        if (q == Rotation{0, 0, 0, 0})
            return;
        const std::int64_t v[4] = {q.x, q.y, q.z, q.w};
        tally.expect(is_normalised(normalise(q), v, tally), bits(q.x), bits(q.y), bits(q.z), bits(q.w));
    };
    const std::int32_t values[] = {0, 1, -1, 3, 1 << 15, -(1 << 30), (1 << 30) - 1, INT32_MAX, INT32_MIN};
    for (const std::int32_t x : values) {
        for (const std::int32_t y : values) {
            for (const std::int32_t z : values) {
                for (const std::int32_t w : values)
                    check({x, y, z, w});
            }
        }
    }
    Random random(41);
    for (std::uint64_t i = 0; i < lks::test::slow_sample_count(); ++i) {
        check({any_component(random), any_component(random), any_component(random), any_component(random)});
    }
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst error ", static_cast<double>(tally.worst), " units");
    CHECK(normalise(Rotation{0, 0, 0, 0}) == identity_rotation());
}

TEST_CASE("fixed: wide normalisation is within two units of 2^-62, also at the largest components") {
    Tally tally;
    Random random(48);
    const auto check = [&tally](const std::int64_t(&v)[4]) {
        UnitVector4 u{};
        if (!normalise_wide(v, u)) {
            tally.expect(v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0);
            return;
        }
        const Wide squared = squared_length(v);
        for (int i = 0; i < 4; ++i) {
            // (|u| - 0)^2 |v|^2 <= (2^62 v)^2 up to the root's own rounding, and (|u| + 2)^2 beyond it.
            const Wide size = wide(u.component[i]).absolute();
            const Wide target = (wide(v[i]) * wide(v[i])) << 124;
            const Wide above = size + wide(2), below = size - wide(2);
            const bool low = below.negative() || below * below * squared <= target;
            tally.expect(low && above * above * squared >= target, bits(v[0]), bits(v[1]), bits(v[2]),
                         bits(v[3]));
            tally.expect(u.component[i] == 0 || (u.component[i] < 0) == (v[i] < 0), bits(v[0]), bits(v[1]));
        }
    };
    const std::int64_t values[] = {0, 1, -2, INT64_MAX, -INT64_MAX, std::int64_t{1} << 62};
    for (const std::int64_t x : values) {
        for (const std::int64_t y : values) {
            for (const std::int64_t z : values) {
                for (const std::int64_t w : values)
                    check({x, y, z, w});
            }
        }
    }
    for (std::uint64_t i = 0; i < lks::test::slow_sample_count(); ++i) {
        check({random.any_signed(), random.any_signed(), random.any_signed(), random.any_signed()});
    }
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: nearly unit means a length within 1e-4 of one") {
    const auto along_w = [](std::int64_t w) { return Rotation{0, 0, 0, static_cast<std::int32_t>(w)}; };
    const std::int64_t one = std::int64_t{1} << 30;
    // 2^30 * 0.9999 = 1073634449.8; 2^30 * 1.0001 = 1073849198.2.
    CHECK(is_nearly_unit(along_w(one)));
    CHECK(is_nearly_unit(along_w(-one)));
    CHECK(is_nearly_unit(along_w(1073634450)));
    CHECK_FALSE(is_nearly_unit(along_w(1073634449)));
    CHECK(is_nearly_unit(along_w(-1073849198)));
    CHECK_FALSE(is_nearly_unit(along_w(1073849199)));
    CHECK_FALSE(is_nearly_unit({INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN}));
    CHECK_FALSE(is_nearly_unit({0, 0, 0, 0}));
    // Right at both bounds: squares that add up to a number next to the bound, against the exact fraction.
    Tally tally;
    Random random(51);
    for (std::uint64_t i = 0; i < lks::test::sample_count() / 100; ++i) {
        const bool upper = (i & 1) != 0;
        const std::uint64_t parts = upper ? 10001 : 9999;
        const Wide bound = Wide::from_u64(parts * parts) << 60; // times 10^8
        std::uint64_t rest = divide(UInt128{parts * parts, 0} >> 4, std::uint64_t{100'000'000}).quotient.lo;
        std::int32_t component[4];
        for (int j = 0; j < 4; ++j) {
            const std::uint64_t root = square_root(rest);
            const std::uint64_t part = j == 0 ? root - random.below(1000) : root + random.below(2) * (j == 3);
            component[j] = static_cast<std::int32_t>(part);
            rest -= part * part;
        }
        const Rotation q{component[0], component[1], component[2], component[3]};
        const std::int64_t v[4] = {q.x, q.y, q.z, q.w};
        const Wide squared = squared_length(v) * wide(100'000'000);
        const bool inside = upper ? squared <= bound : squared >= bound;
        tally.expect(is_nearly_unit(q) == inside, bits(q.x), bits(q.y), bits(q.z), bits(q.w));
    }
    for_rotations(42, lks::test::sample_count() / 10, [&](Rotation q) { tally.expect(is_nearly_unit(q)); });
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: a rotation's matrix is rounded once per entry and orthonormal within 5 units") {
    Tally tally, rows;
    for_rotations(43, lks::test::sample_count(), [&](Rotation q) {
        const Matrix3 a = to_matrix(q);
        const std::int64_t x = q.x, y = q.y, z = q.z, w = q.w, one = std::int64_t{1} << 60;
        const std::int64_t twice[3][3] = {
            {one - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), one - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), one - 2 * (x * x + y * y)}};
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                tally.expect(exact(a.m[i][j]) == shift_right_half_up(exact(twice[i][j]), 30), bits(q.x),
                             bits(q.y), bits(q.z), bits(q.w));
            }
            // Rows of length one, and at right angles: errors in units of 2^-30, times 2^30.
            const int k = (i + 1) % 3;
            std::int64_t length = -one, angle = 0;
            for (int j = 0; j < 3; ++j) {
                length += std::int64_t{a.m[i][j]} * a.m[i][j];
                angle += std::int64_t{a.m[i][j]} * a.m[k][j];
            }
            const std::int64_t limit = std::int64_t{5} << 30;
            rows.expect(magnitude(length / 2) <= magnitude(limit) && magnitude(angle) <= magnitude(limit),
                        bits(q.x), bits(q.y), bits(q.z), bits(q.w));
            rows.measure(static_cast<long double>(length) * 0x1p-31L);
            rows.measure(static_cast<long double>(angle) * 0x1p-30L);
        }
        tally.expect(to_matrix(conjugate(q)) == transpose(a), bits(q.x), bits(q.y), bits(q.z), bits(q.w));
    });
    LKS_CHECK_TALLY(tally);
    LKS_CHECK_TALLY(rows);
    MESSAGE("worst deviation from orthonormal ", static_cast<double>(rows.worst), " units");
}

TEST_CASE("fixed: rotating 64-bit vectors is exact but for one rounding, and turns back") {
    Tally tally, back;
    Random random(44);
    Matrix3 a = to_matrix(identity_rotation());
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        if ((i & 15) == 0)
            a = to_matrix(any_rotation(random));
        const std::int64_t limit = std::int64_t{1} << 62;
        Vec3 v{random.any_signed(62), random.any_signed(62), random.any_signed(62)};
        if ((i & 63) == 1)
            v = {limit, (i & 64) != 0 ? limit : -limit, (i & 128) != 0 ? limit : -limit};
        const Vec3 r = rotate(a, v), t = rotate_transposed(a, v);
        const std::int64_t forward[3] = {r.x, r.y, r.z}, backward[3] = {t.x, t.y, t.z};
        for (int j = 0; j < 3; ++j) {
            const Sum row =
                exact(a.m[j][0]) * exact(v.x) + exact(a.m[j][1]) * exact(v.y) + exact(a.m[j][2]) * exact(v.z);
            const Sum column =
                exact(a.m[0][j]) * exact(v.x) + exact(a.m[1][j]) * exact(v.y) + exact(a.m[2][j]) * exact(v.z);
            tally.expect(exact(forward[j]) == shift_right_half_up(row, 30), bits(v.x), bits(v.y), bits(v.z));
            tally.expect(exact(backward[j]) == shift_right_half_up(column, 30), bits(v.x), bits(v.y),
                         bits(v.z));
        }
        // There and back: within 2^-27 of the length and two units.
        const std::int64_t quarter = std::int64_t{1} << 60;
        const Vec3 w{v.x % quarter, v.y % quarter, v.z % quarter};
        const Vec3 lost = rotate_transposed(a, rotate(a, w)) - w;
        const std::int64_t tolerance = static_cast<std::int64_t>(length(w) >> 27) + 2;
        back.expect(length(lost) <= static_cast<std::uint64_t>(tolerance), bits(w.x), bits(w.y), bits(w.z));
        if (length(w) > (1u << 31)) {
            back.measure(static_cast<long double>(length(lost)) / static_cast<long double>(length(w)) *
                         0x1p30L);
        }
    }
    LKS_CHECK_TALLY(tally);
    LKS_CHECK_TALLY(back);
    MESSAGE("there and back loses at most ", static_cast<double>(back.worst), " * 2^-30 of the length");
}

TEST_CASE("fixed: directions are turned with one rounding") {
    Tally tally;
    Random random(49);
    for (std::uint64_t i = 0; i < lks::test::sample_count(); ++i) {
        const Matrix3 a = to_matrix(any_rotation(random));
        NormalisedVector n{};
        if (!normalise({random.any_signed(), random.any_signed(), random.any_signed()}, n))
            continue;
        const Direction& d = n.direction;
        const Direction r = rotate(a, d), t = rotate_transposed(a, d);
        const std::int32_t turned[3] = {r.x, r.y, r.z}, back[3] = {t.x, t.y, t.z};
        for (int j = 0; j < 3; ++j) {
            const std::int64_t row =
                std::int64_t{a.m[j][0]} * d.x + std::int64_t{a.m[j][1]} * d.y + std::int64_t{a.m[j][2]} * d.z;
            const std::int64_t column =
                std::int64_t{a.m[0][j]} * d.x + std::int64_t{a.m[1][j]} * d.y + std::int64_t{a.m[2][j]} * d.z;
            tally.expect(exact(turned[j]) == shift_right_half_up(exact(row), 30) &&
                             exact(back[j]) == shift_right_half_up(exact(column), 30),
                         bits(d.x), bits(d.y), bits(d.z));
        }
    }
    LKS_CHECK_TALLY(tally);
}

TEST_CASE("fixed: quaternion products are rounded once, and mean one rotation after the other") {
    Tally tally, meaning;
    Random random(45);
    for_rotations(46, lks::test::sample_count(), [&](Rotation a) {
        const Rotation b = any_rotation(random), r = multiply(a, b);
        const Sum x = exact(a.w) * exact(b.x) + exact(a.x) * exact(b.w) + exact(a.y) * exact(b.z) -
                      exact(a.z) * exact(b.y);
        const Sum y = exact(a.w) * exact(b.y) - exact(a.x) * exact(b.z) + exact(a.y) * exact(b.w) +
                      exact(a.z) * exact(b.x);
        const Sum z = exact(a.w) * exact(b.z) + exact(a.x) * exact(b.y) - exact(a.y) * exact(b.x) +
                      exact(a.z) * exact(b.w);
        const Sum w = exact(a.w) * exact(b.w) - exact(a.x) * exact(b.x) - exact(a.y) * exact(b.y) -
                      exact(a.z) * exact(b.z);
        tally.expect(exact(r.x) == shift_right_half_up(x, 30) && exact(r.y) == shift_right_half_up(y, 30) &&
                         exact(r.z) == shift_right_half_up(z, 30) && exact(r.w) == shift_right_half_up(w, 30),
                     bits(a.x), bits(a.y), bits(b.x), bits(b.y));
        // By the matrices, which know nothing of quaternion products: within 16 units.
        const Vec3 v{1 << 30, -(1 << 29), 1 << 28};
        const Vec3 error = rotate(to_matrix(r), v) - rotate(to_matrix(a), rotate(to_matrix(b), v));
        meaning.expect(length(error) <= 16, bits(a.x), bits(a.y), bits(b.x), bits(b.y));
        const Rotation none = multiply(a, conjugate(a));
        meaning.expect(none.x == 0 && none.y == 0 && none.z == 0 && magnitude(none.w - (1 << 30)) <= 2,
                       bits(a.x));
    });
    LKS_CHECK_TALLY(tally);
    LKS_CHECK_TALLY(meaning);
}

TEST_CASE("fixed: interpolation is the normalised line on the shorter way, within half a unit") {
    Tally tally;
    Random random(47);
    for_rotations(50, lks::test::slow_sample_count(), [&](Rotation a) {
        const Rotation b = any_rotation(random);
        const std::uint32_t denominator = static_cast<std::uint32_t>(random.any_magnitude(32));
        if (denominator < 2)
            return;
        const std::uint32_t numerator = 1 + static_cast<std::uint32_t>(random.below(denominator - 1));
        const Rotation r = interpolate(a, b, numerator, denominator);
        const std::int64_t sign = dot(a, b) < 0 ? -1 : 1;
        const std::int64_t p = std::int64_t{denominator} - numerator, q = sign * numerator;
        const std::int64_t v[4] = {a.x * p + b.x * q, a.y * p + b.y * q, a.z * p + b.z * q,
                                   a.w * p + b.w * q};
        tally.expect(is_normalised(r, v, tally), bits(a.x), bits(b.x), numerator, denominator);
        tally.expect(dot(r, a) >= 0 && sign * dot(r, b) >= 0, bits(a.x), bits(b.x), numerator, denominator);
    });
    LKS_CHECK_TALLY(tally);
    MESSAGE("worst error ", static_cast<double>(tally.worst), " units");

    const std::int32_t one = 1 << 30, root_half = 759250125;
    const Rotation none{0, 0, 0, one}, half_turn{0, one, 0, 0}, opposite{0, -one, 0, 0};
    const Rotation sum{0, root_half, 0, root_half}, difference{0, -root_half, 0, root_half};
    CHECK(interpolate(none, half_turn, 1, 2) == sum); // a dot product of zero keeps b's sign
    CHECK(interpolate(none, opposite, 1, 2) == difference);
    CHECK(interpolate(none, Rotation{0, 0, 0, -one}, 1, 3) == none);
    CHECK(interpolate(none, half_turn, 0, 7) == none);
    CHECK(interpolate(none, half_turn, 7, 7) == half_turn);
    CHECK(interpolate(none, half_turn, 8, 7) == half_turn);
    const Rotation long_turn{0, one + 9, 0, 0}; // the ends are not even normalised
    CHECK(interpolate(long_turn, none, 0, 7) == long_turn);
    CHECK(interpolate(none, long_turn, 7, 7) == long_turn);
    CHECK(interpolate(none, long_turn, 0, 0) == none);
    CHECK(interpolate(none, half_turn, UINT32_MAX - 1, UINT32_MAX) == half_turn);
}
