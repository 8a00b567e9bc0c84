// Directions in which the joints of a held figure do not let their bodies turn, and which of those that are
// limits push (sdk/src/rigid/held_tree.h).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "reference/rigid_numbers.h"
#include "reference/symmetric_system.h"

namespace reference {

// b against a about the axis. `error`: how far it is turned; limits: less than zero beyond them.
template <typename Scalar>
struct HeldRow {
    Vector3<Scalar> axis;
    Scalar error;
    Scalar push;  // of limits: what they have pushed by now, not less than zero
    Scalar* kept; // where that is kept; null: no limit
    Scalar sign;  // of what is kept
    std::size_t joint = 0;

    bool is_limit() const { return kept != nullptr; }
};

// What is to be pushed more: row by row of a dense system of `points` rows and those of turns behind them,
// whose matrix is symmetric. A limit that would pull has nothing left of what it has pushed. `softness`: what
// rows are softened by, of which what that leaves is solved for again, four times.
template <typename Scalar>
std::vector<Scalar> solve_held(const std::vector<Scalar>& matrix, const std::vector<Scalar>& errors,
                               std::size_t points, const std::vector<HeldRow<Scalar>>& rows,
                               const std::vector<Scalar>& softness = {}) {
    const std::size_t size = errors.size();
    std::vector<bool> pushes(size, true);
    for (std::size_t i = points; i < size; ++i) {
        const HeldRow<Scalar>& row = rows[i - points];
        pushes[i] = !row.is_limit() || row.error < 0 || row.push > 0;
    }
    std::vector<Scalar> found(size);
    std::size_t least = size + 1;
    int patience = 3;
    for (int pass = 0; pass < 24; ++pass) {
        std::vector<std::size_t> active;
        for (std::size_t i = 0; i < size; ++i) {
            found[i] = pushes[i] ? Scalar(0) : -rows[i - points].push;
            if (pushes[i]) {
                active.push_back(i);
            }
        }
        const auto moved = [&](std::size_t i) {
            Scalar sum = errors[i];
            for (std::size_t j = 0; j < size; ++j) {
                sum += matrix[i * size + j] * found[j];
            }
            return sum;
        };
        std::vector<Scalar> part;
        for (const std::size_t i : active) {
            for (const std::size_t j : active) {
                part.push_back(matrix[i * size + j] +
                               (i == j && !softness.empty() ? softness[i] : Scalar(0)));
            }
        }
        SymmetricSystem<Scalar> system;
        system.factor(active.size(), std::move(part));
        for (int round = 0; round < (softness.empty() ? 1 : 5); ++round) {
            std::vector<Scalar> wanted;
            for (const std::size_t i : active) {
                wanted.push_back(-moved(i));
            }
            system.solve(wanted);
            for (std::size_t k = 0; k < active.size(); ++k) {
                found[active[k]] += wanted[k];
            }
        }
        std::vector<std::size_t> wrong;
        for (std::size_t i = size; i-- > points;) {
            const HeldRow<Scalar>& row = rows[i - points];
            if (row.is_limit() && (pushes[i] ? row.push + found[i] < 0 : moved(i) < Scalar(-1e-6))) {
                wrong.push_back(i);
            }
        }
        if (wrong.empty()) {
            break;
        }
        patience = wrong.size() < least ? 3 : patience - 1;
        least = std::min(least, wrong.size());
        wrong.resize(patience >= 0 ? wrong.size() : 1);
        for (const std::size_t i : wrong) {
            pushes[i] = !pushes[i];
        }
    }
    return found;
}

} // namespace reference
