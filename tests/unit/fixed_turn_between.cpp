// The rotation between two rotations, against exact fractions.
#include <doctest/doctest.h>

#include <algorithm>

#include "big_integer.h"
#include "fixed/turn_between.h"
#include "fixed_samples.h"

using namespace lks::fixed;
using lks::test::Big;
using lks::test::Random;

namespace {

using Wide = Big<12>;

constexpr std::int32_t one = 1 << 30;

Wide wide(std::int64_t a) {
    return Wide::from_i64(a);
}

// to ⊗ from*, and its squared length.
struct Exact {
    Wide x, y, z, w, square;
};

Exact exact_turn(Rotation from, Rotation to) {
    const Wide ax = wide(to.x), ay = wide(to.y), az = wide(to.z), aw = wide(to.w);
    const Wide bx = wide(-from.x), by = wide(-from.y), bz = wide(-from.z), bw = wide(from.w);
    Exact q{aw * bx + ax * bw + ay * bz - az * by, aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx, aw * bw - ax * bx - ay * by - az * bz, Wide()};
    q.square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    return q;
}

// v + 2 w (u × v) + 2 u × (u × v), times the squared length.
void turn_exactly(const Exact& q, const Wide (&v)[3], Wide (&out)[3]) {
    const Wide u[3] = {q.x, q.y, q.z};
    const auto cross = [](const Wide(&a)[3], const Wide(&b)[3], int i) {
        return a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    };
    const Wide t[3] = {cross(u, v, 0), cross(u, v, 1), cross(u, v, 2)};
    for (int i = 0; i < 3; ++i)
        out[i] = v[i] * q.square + ((q.w * t[i] + cross(u, t, i)) << 1);
}

// |value - exact / square| in units of 1/1024, rounded up; no more than a thousand units.
std::int64_t error_of(std::int64_t value, const Wide& exact, const Wide& square) {
    const Wide apart = (wide(value) * square - exact).absolute() << 10;
    std::int64_t low = 0, high = 1024 * 1024;
    while (low < high) {
        const std::int64_t middle = (low + high) / 2;
        if (wide(middle) * square >= apart)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

// Of a length within 1e-4 of one.
Rotation any_rotation(Random& random) {
    const std::int64_t v[4] = {random.any_signed(31), random.any_signed(31), random.any_signed(31),
                               random.any_signed(31) | 1};
    UnitVector4 unit{};
    REQUIRE(normalise_wide(v, unit));
    const auto length = one + static_cast<std::int64_t>(random.below(200000)) - 100000;
    const auto part = [&](int i) {
        return static_cast<std::int32_t>(multiply_shift(unit.component[i], length, 62));
    };
    return {part(0), part(1), part(2), part(3)};
}

} // namespace

TEST_CASE("what turns one rotation into another is rounded once an entry, for all that counts as unit") {
    Random random(1);
    std::int64_t worst = 0;
    for (std::uint64_t i = 0; i < lks::test::slow_sample_count() / 20; ++i) {
        const Rotation from = any_rotation(random), to = any_rotation(random);
        REQUIRE(is_nearly_unit(from));
        const TurnBetween turn = turn_between(from, to);
        const Exact q = exact_turn(from, to);
        for (int column = 0; column < 3; ++column) {
            Wide axis[3], exact[3];
            axis[column] = Wide::power_of_two(turn_matrix_bits);
            turn_exactly(q, axis, exact);
            for (int row = 0; row < 3; ++row)
                worst = std::max(worst, error_of(turn.matrix.m[row][column], exact[row], q.square));
        }
    }
    MESSAGE("worst error of an entry: " << static_cast<double>(worst) / 1024 << " units of 2^-62");
    CHECK(worst <= 778); // 0.76
}

TEST_CASE("what is turned is within a half and 2^-4 a metre of a unit of 2^-56 m") {
    Random random(2);
    for (const int bits : {40, 53, 56, 60, 62}) {
        const auto greatest =
            1024 * (0.5 + 3 * 0.76 / 64 * static_cast<double>(std::int64_t{1} << bits) / 0x1p56);
        std::int64_t worst = 0;
        for (std::uint64_t i = 0; i < lks::test::slow_sample_count() / 100; ++i) {
            const Rotation from = any_rotation(random), to = any_rotation(random);
            const Vec3 v{random.any_signed(bits), random.any_signed(bits), random.any_signed(bits)};
            const TurnBetween turn = turn_between(from, to);
            const Exact q = exact_turn(from, to);
            const Wide wide_v[3] = {wide(v.x), wide(v.y), wide(v.z)};
            Wide exact[3];
            turn_exactly(q, wide_v, exact);
            for (int row = 0; row < 3; ++row) {
                const std::int64_t turned = round_turned(turn_row(turn.matrix, row, v));
                worst = std::max(worst, error_of(turned, exact[row], q.square));
            }
        }
        MESSAGE("below 2^" << bits << " units: " << static_cast<double>(worst) / 1024);
        CHECK(static_cast<double>(worst) <= greatest + 1);
    }
}

TEST_CASE("quarter and half turns about the axes are exact, and equal rotations turn nothing") {
    constexpr std::int32_t root_half = 759250125;
    constexpr std::int64_t whole = std::int64_t{1} << turn_matrix_bits;
    const Rotation none{0, 0, 0, one};
    const Rotation turns[] = {{root_half, 0, 0, root_half},
                              {0, root_half, 0, -root_half},
                              {0, 0, root_half, root_half},
                              {one, 0, 0, 0},
                              {0, one, 0, 0},
                              {0, 0, one, 0},
                              {one / 2, one / 2, one / 2, one / 2}};
    for (const Rotation& q : turns) {
        for (const bool back : {false, true}) {
            const TurnBetween turn = back ? turn_between(q, none) : turn_between(none, q);
            CHECK(turn.turns);
            int ones = 0;
            for (const auto& row : turn.matrix.m) {
                for (const std::int64_t entry : row) {
                    CHECK((entry == 0 || entry == whole || entry == -whole));
                    ones += entry == 0 ? 0 : 1;
                }
            }
            CHECK(ones == 3);
        }
    }
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const Rotation q = any_rotation(random);
        CHECK_FALSE(turn_between(q, q).turns);
        CHECK_FALSE(turn_between(q, Rotation{-q.x, -q.y, -q.z, -q.w}).turns);
    }
}
