// A symmetric positive system of up to six rows, by L·D·Lᵀ: 32 fraction bits, unknowns in any format. A row
// that the others leave nothing of lets nothing be pushed.
#pragma once

#include "rigid/articulation_algebra.h"

namespace lks {

inline constexpr int most_rows = 6;

struct RowSystem {
    int count;
    std::int64_t lower[most_rows][most_rows]; // below the diagonal
    Inverse pivots[most_rows];
};

// Only the lower half of `matrix` is read.
inline void factor(const std::int64_t (&matrix)[most_rows][most_rows], RowSystem& system) {
    using tree_detail::minus;
    for (int i = 0; i < system.count; ++i) {
        // L times D
        std::int64_t scaled[most_rows];
        for (int j = 0; j <= i; ++j) {
            std::int64_t rest = matrix[i][j];
            for (int k = 0; k < j; ++k) {
                rest = minus(rest, multiply_32(scaled[k], j == i ? system.lower[i][k] : system.lower[j][k]));
            }
            if (j == i) {
                system.pivots[i] = tree_detail::invert_pivot(rest);
            } else {
                scaled[j] = rest;
                system.lower[i][j] = divide(rest, system.pivots[j]);
            }
        }
    }
}

inline void solve(const RowSystem& system, std::int64_t (&rows)[most_rows]) {
    for (int i = 0; i < system.count; ++i) {
        for (int k = 0; k < i; ++k) {
            rows[i] = tree_detail::minus(rows[i], multiply_32(system.lower[i][k], rows[k]));
        }
    }
    for (int i = system.count; i-- > 0;) {
        rows[i] = divide(rows[i], system.pivots[i]);
        for (int k = i + 1; k < system.count; ++k) {
            rows[i] = tree_detail::minus(rows[i], multiply_32(system.lower[k][i], rows[k]));
        }
    }
}

} // namespace lks
