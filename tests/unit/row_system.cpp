// The system of a held joint's rows (rigid/row_system.h).
#include "rigid/row_system.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/numbers.h"

using namespace lks;
using support::Random;

namespace {

constexpr double one = 0x1p32;

double chance(Random& random) {
    return static_cast<double>(random.between(-1000000, 1000000)) * 1e-6;
}

// Its eigenvalues are at least a hundredth.
struct Matrix {
    std::int64_t entries[most_rows][most_rows] = {};

    Matrix(Random& random, int count) {
        double factor[most_rows][most_rows];
        for (auto& row : factor) {
            for (double& value : row) {
                value = chance(random);
            }
        }
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < count; ++j) {
                double sum = i == j ? 0.01 : 0;
                for (int k = 0; k < count; ++k) {
                    sum += factor[i][k] * factor[j][k];
                }
                entries[i][j] = std::llround(sum * one);
            }
        }
    }

    double row_times(int i, const std::int64_t (&x)[most_rows], int count) const {
        double sum = 0;
        for (int j = 0; j < count; ++j) {
            sum += static_cast<double>(entries[i][j]) / one * static_cast<double>(x[j]);
        }
        return sum;
    }
};

void solve(const RowSystem<CoarseRows>& system, std::int64_t (&x)[most_rows]) {
    solve_lower(system, x);
    for (int i = 0; i < system.count; ++i) {
        x[i] = CoarseRows::divide(x[i], system.pivots[i]);
    }
    solve_upper(system, x);
}

} // namespace

TEST_CASE("what a system of rows gives solves it") {
    Random random(3);
    double worst = 0;
    for (int round = 0; round < 20000; ++round) {
        RowSystem<CoarseRows> system{};
        system.count = 1 + round % most_rows;
        const Matrix matrix(random, system.count);
        factor(matrix.entries, system);
        std::int64_t wanted[most_rows] = {};
        for (std::int64_t& value : wanted) {
            value = random.between(-(std::int64_t{1} << 38), std::int64_t{1} << 38);
        }
        std::int64_t x[most_rows];
        std::copy_n(wanted, most_rows, x);
        solve(system, x);
        double largest = 0x1p38;
        for (int i = 0; i < system.count; ++i) {
            largest = std::max(largest, std::abs(static_cast<double>(x[i])));
        }
        for (int i = 0; i < system.count; ++i) {
            const double off =
                std::abs(matrix.row_times(i, x, system.count) - static_cast<double>(wanted[i]));
            worst = std::max(worst, off / largest);
        }
    }
    MESSAGE("off by " << worst << " of the largest unknown");
    CHECK(worst < 1e-7);
}

TEST_CASE("a row that asks for the same as another pushes nothing, and the other one all of it") {
    const std::int64_t half = std::int64_t{1} << 31;
    std::int64_t matrix[most_rows][most_rows] = {};
    for (int i = 0; i < 2; ++i) {
        matrix[i][0] = matrix[i][1] = half;
    }
    RowSystem<CoarseRows> system{};
    system.count = 2;
    factor(matrix, system);
    std::int64_t x[most_rows] = {1000, 1000};
    solve(system, x);
    CHECK(x[0] == 2000);
    CHECK(x[1] == 0);
}
