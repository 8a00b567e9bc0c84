// The exact implicit step: what XPBD's iterations approach. Sparse factorisations, double precision.
#pragma once

#include <vector>

#include "reference/model.h"
#include "reference/position_based.h"

namespace reference {

// Of eq. 8 and 9 of XPBD, both zero in the exact step.
struct Residual {
    double momentum = 0;    // |M(x - x̃) - ∇Cᵀλ|, kg·m
    double constraints = 0; // |C + α̃λ|, in the constraints' units
};

using Points = std::vector<Vector3<double>>;
using Multipliers = std::vector<std::array<double, 3>>;

// `h` is the length of a substep in seconds. Pinned particles don't count.
Residual residual_of(const Model& model, double h, const Points& x, const Points& predicted,
                     const Multipliers& multipliers);

enum class Linearisation {
    full,        // Newton on eq. 8, 9 with K = M - Σ λ∇²C (eq. 12), and a line search
    constraints, // eq. 16: K ≈ M, g ≈ 0; solved directly, `iterations` times
};

// Damping of constraints is left out, and so is the ball.
class ImplicitEuler {
public:
    ImplicitEuler(const Model& model, const Settings& settings, Linearisation linearisation);

    void tick(int count = 1);

    const Points& positions() const { return positions_; }
    const Points& velocities() const { return velocities_; }
    double force(std::size_t edge) const { return -multipliers_[edge][0] / (h_ * h_); }
    // Of the last substep: the start, after each iteration. Positions too, for convergence by iteration.
    const std::vector<Residual>& residuals() const { return residuals_; }
    // Whether every full step so far came down to rounding.
    bool converged() const { return converged_; }

private:
    void substep();
    void solve_full();
    void solve_constraints();
    bool small(const Points& x, const Multipliers& multipliers) const;
    double merit(const Points& x, const Multipliers& multipliers) const;

    Model model_;
    Settings settings_;
    Linearisation linearisation_;
    double h_;
    std::vector<int> unknowns_; // of a particle's x in the system; -1: pinned
    int free_count_ = 0;        // times three
    double largest_inverse_mass_ = 0;
    Points positions_, predicted_, velocities_;
    Multipliers multipliers_;
    std::vector<Residual> residuals_;
    bool converged_ = true;
};

// Throws std::runtime_error where a reference is none.
void must_have_converged(const ImplicitEuler& solver);

} // namespace reference
