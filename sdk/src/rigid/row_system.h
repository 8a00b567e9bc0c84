// A symmetric positive system of up to six rows, by L·D·Lᵀ: in the tree's fraction bits, unknowns in any
// format. A row that the others leave nothing of lets nothing be pushed.
#pragma once

#include "rigid/fine_algebra.h"

namespace lks {

// The arithmetic of a tree's rows: of 32 fraction bits, or of 40.
struct CoarseRows {
    static constexpr int fraction_bits = tree_detail::tree_fraction_bits;
    using Pivot = Inverse;
    static std::int64_t multiply(std::int64_t a, std::int64_t b) { return multiply_32(a, b); }
    static Pivot invert(std::int64_t pivot) { return tree_detail::invert_pivot(pivot); }
    static std::int64_t divide(std::int64_t value, const Pivot& pivot) { return lks::divide(value, pivot); }
};
struct FineRows {
    static constexpr int fraction_bits = tree_detail::fine_fraction_bits;
    using Pivot = FineInverse;
    static std::int64_t multiply(std::int64_t a, std::int64_t b) { return tree_detail::multiply_40(a, b); }
    static Pivot invert(std::int64_t pivot) { return tree_detail::invert_fine(pivot); }
    static std::int64_t divide(std::int64_t value, const Pivot& pivot) {
        return tree_detail::divide(value, pivot);
    }
};

inline constexpr int most_rows = 6;

template <typename Rows>
struct RowSystem {
    int count;
    std::int64_t lower[most_rows][most_rows]; // below the diagonal
    typename Rows::Pivot pivots[most_rows];
};

// Only the lower half of `matrix` is read.
template <typename Rows>
void factor(const std::int64_t (&matrix)[most_rows][most_rows], RowSystem<Rows>& system) {
    using tree_detail::minus;
    for (int i = 0; i < system.count; ++i) {
        // L times D
        std::int64_t scaled[most_rows];
        for (int j = 0; j <= i; ++j) {
            fixed::ProductSum others;
            for (int k = 0; k < j; ++k) {
                others.add(scaled[k], system.lower[j][k]);
            }
            const std::int64_t rest = minus(matrix[i][j], others.shifted(Rows::fraction_bits));
            if (j == i) {
                system.pivots[i] = Rows::invert(rest);
            } else {
                scaled[j] = rest;
                system.lower[i][j] = Rows::divide(rest, system.pivots[j]);
            }
        }
    }
}

// L·x = rows
template <typename Rows>
void solve_lower(const RowSystem<Rows>& system, std::int64_t (&rows)[most_rows]) {
    for (int i = 0; i < system.count; ++i) {
        fixed::ProductSum others;
        for (int k = 0; k < i; ++k) {
            others.add(system.lower[i][k], rows[k]);
        }
        rows[i] = tree_detail::minus(rows[i], others.shifted(Rows::fraction_bits));
    }
}

// Lᵀ·x = rows
template <typename Rows>
void solve_upper(const RowSystem<Rows>& system, std::int64_t (&rows)[most_rows]) {
    for (int i = system.count; i-- > 0;) {
        fixed::ProductSum others;
        for (int k = i + 1; k < system.count; ++k) {
            others.add(system.lower[k][i], rows[k]);
        }
        rows[i] = tree_detail::minus(rows[i], others.shifted(Rows::fraction_bits));
    }
}

} // namespace lks
