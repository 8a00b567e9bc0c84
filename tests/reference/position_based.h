// PBD and XPBD to the letter of the paper, for every kind of constraint, in any number type. Where xpbd.h has
// the SDK's own form (coefficients in [0, 1], Λ = D·λ, a clamp), this one has the paper's λ.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/blocks.h"
#include "reference/symmetric_system.h"

namespace reference {

enum class Method {
    pbd,        // eq. 1, 2: k·s in every iteration
    pbd_scaled, // the same with k' = 1 - (1 - k)^(1/iterations)
    xpbd,       // eq. 17, 18, 26, one constraint after the other, in the order of the model
    xpbd_jacobi // all from the same positions, each Δλ divided by the most constraints that share a particle
};

template <typename Scalar>
class PositionBased {
public:
    using Vec = Vector3<Scalar>;
    using Multiplier = std::array<Scalar, 3>;

    PositionBased(const Model& model, const Settings& settings, Method method, double stiffness = 1)
        : model_(model), settings_(settings), method_(method),
          h_(static_cast<Scalar>(1 / (settings.tick_rate_hz * settings.substeps))),
          stiffness_(static_cast<Scalar>(method == Method::pbd_scaled
                                             ? 1 - std::pow(1 - stiffness, 1.0 / settings.iterations)
                                             : stiffness)) {
        for (std::size_t i = 0; i < model.positions.size(); ++i) {
            positions_.push_back(Vec(model.positions[i]));
            inverse_masses_.push_back(static_cast<Scalar>(1 / model.masses[i]));
        }
        for (const std::uint32_t pin : model.pins) {
            inverse_masses_[pin] = 0;
        }
        velocities_.resize(positions_.size());
        previous_ = positions_;
        multipliers_.resize(constraint_count(model_));
        if (method_ == Method::xpbd_jacobi) {
            count_neighbours();
        }
    }

    void tick(int count = 1) {
        for (int substep = 0; substep < count * settings_.substeps; ++substep) {
            begin_substep();
            for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
                iterate();
            }
            end_substep();
        }
    }

    // x̃, and λ₀ = 0.
    void begin_substep() {
        previous_ = positions_;
        const Vec gravity = Vec(settings_.gravity) * (h_ * h_);
        const Scalar kept = 1 - static_cast<Scalar>(settings_.linear_damping) * h_;
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            if (inverse_masses_[p] != 0) {
                positions_[p] = positions_[p] + velocities_[p] * (h_ * kept) + gravity;
            }
        }
        predicted_ = positions_;
        std::fill(multipliers_.begin(), multipliers_.end(), Multiplier{});
    }
    void iterate() {
        for (std::size_t index = 0; index < multipliers_.size(); ++index) {
            project(index);
        }
        if (method_ == Method::xpbd_jacobi) {
            for (std::size_t p = 0; p < positions_.size(); ++p) {
                positions_[p] = positions_[p] + moves_[p];
                moves_[p] = {};
            }
        }
        leave_ball(Vec(model_.ball.centre), static_cast<Scalar>(model_.ball.radius), inverse_masses_,
                   positions_);
    }
    void end_substep() {
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            velocities_[p] = (positions_[p] - previous_[p]) * (1 / h_);
        }
    }

    const std::vector<Vec>& positions() const { return positions_; }
    const std::vector<Vec>& velocities() const { return velocities_; }
    const std::vector<Vec>& predicted() const { return predicted_; }
    const std::vector<Multiplier>& multipliers() const { return multipliers_; }
    // Newtons, tension positive. PBD has none.
    double force(std::size_t edge) const { return -static_cast<double>(multipliers_[edge][0] / (h_ * h_)); }

private:
    bool is_pbd() const { return method_ == Method::pbd || method_ == Method::pbd_scaled; }

    void count_neighbours() {
        std::vector<Scalar> valence(positions_.size());
        for (std::size_t i = 0; i < multipliers_.size(); ++i) {
            evaluate(model_, i, positions_, block_);
            for (const std::uint32_t p : block_.particles) {
                valence[p] += 1;
            }
        }
        for (std::size_t i = 0; i < multipliers_.size(); ++i) {
            evaluate(model_, i, positions_, block_);
            Scalar most = 1;
            for (const std::uint32_t p : block_.particles) {
                most = std::max(most, valence[p]);
            }
            shares_.push_back(1 / most);
        }
        moves_.resize(positions_.size());
    }

    // What project() comes to where there is one row and two particles, many times as fast.
    void project_edge(std::size_t index) {
        const Edge& edge = model_.edges[index];
        const Scalar w_a = inverse_masses_[edge.a];
        const Scalar w_b = inverse_masses_[edge.b];
        const Vec difference = positions_[edge.a] - positions_[edge.b];
        const Scalar length = difference.length();
        if (!(length > 0) || !(w_a + w_b > 0)) {
            return;
        }
        const Vec direction = difference * (1 / length);
        Scalar numerator = static_cast<Scalar>(edge.rest) - length;
        Scalar denominator = w_a + w_b;
        Scalar factor = stiffness_;
        if (!is_pbd()) {
            const Scalar compliance = static_cast<Scalar>(edge.compliance) / (h_ * h_);
            const Scalar gamma = static_cast<Scalar>(edge.compliance * edge.damping) / h_;
            numerator -= compliance * multipliers_[index][0];
            if (gamma > 0) {
                numerator -= gamma * direction.dot(difference - previous_[edge.a] + previous_[edge.b]);
            }
            denominator = (1 + gamma) * denominator + compliance;
            factor = method_ == Method::xpbd_jacobi ? shares_[index] : Scalar(1);
        }
        const Scalar change = factor * numerator / denominator;
        multipliers_[index][0] += change;
        std::vector<Vec>& moved = method_ == Method::xpbd_jacobi ? moves_ : positions_;
        moved[edge.a] = moved[edge.a] + direction * (w_a * change);
        moved[edge.b] = moved[edge.b] - direction * (w_b * change);
    }

    void project(std::size_t index) {
        if (index < model_.edges.size()) {
            project_edge(index);
            return;
        }
        evaluate(model_, index, positions_, block_);
        const std::size_t rows = block_.rows;
        matrix_.assign(rows * rows, 0);
        right_.assign(rows, 0);
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                for (std::size_t k = 0; k < block_.particles.size(); ++k) {
                    matrix_[row * rows + column] += inverse_masses_[block_.particles[k]] *
                                                    block_.slope(row, k).dot(block_.slope(column, k));
                }
            }
            right_[row] = -block_.value[row];
        }
        if (!is_pbd()) {
            add_compliance(index);
        }
        for (std::size_t row = 0; row < rows; ++row) {
            if (!(matrix_[row * rows + row] > 0)) {
                return;
            }
        }
        system_.factor(rows, matrix_);
        system_.solve(right_);
        const Scalar factor = is_pbd()                         ? stiffness_
                              : method_ == Method::xpbd_jacobi ? shares_[index]
                                                               : Scalar(1);
        std::vector<Vec>& moved = method_ == Method::xpbd_jacobi ? moves_ : positions_;
        for (std::size_t row = 0; row < rows; ++row) {
            const Scalar change = factor * right_[row];
            multipliers_[index][row] += change;
            for (std::size_t k = 0; k < block_.particles.size(); ++k) {
                const std::uint32_t p = block_.particles[k];
                moved[p] = moved[p] + block_.slope(row, k) * (inverse_masses_[p] * change);
            }
        }
    }

    // α̃ on both sides. Blocks have no damping.
    void add_compliance(std::size_t index) {
        const std::size_t rows = block_.rows;
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < rows; ++column) {
                const Scalar compliance = block_.compliance[row][column] / (h_ * h_);
                matrix_[row * rows + column] += compliance;
                right_[row] -= compliance * multipliers_[index][column];
            }
        }
    }

    Model model_;
    Settings settings_;
    Method method_;
    Scalar h_;
    Scalar stiffness_;
    std::vector<Scalar> inverse_masses_;
    std::vector<Vec> positions_, previous_, predicted_, velocities_;
    std::vector<Multiplier> multipliers_;
    std::vector<Vec> moves_;     // of one Jacobi iteration
    std::vector<Scalar> shares_; // of a constraint in a Jacobi iteration
    Block<Scalar> block_;
    std::vector<Scalar> matrix_, right_;
    SymmetricSystem<Scalar> system_;
};

} // namespace reference
