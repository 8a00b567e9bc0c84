#include "reference/implicit.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace reference {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr int most_newton_steps = 100;
// Added to α̃ in the matrix, not in the equations, so that pivots don't vanish where nothing is soft: a step
// then leaves this share of the error.
constexpr double softening = 1e-9;
// Metres in all of one particle's error (g / m, h), relative to coordinates of about a metre.
constexpr double converged_at = 1e-13;

double component(const Vector3<double>& v, std::size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// g = M(x - x̃) - ∇Cᵀλ of every particle, and h = C + α̃λ of every row.
struct Equations {
    Points g;
    Multipliers h;
};

Equations equations_of(const Model& model, double step, const Points& x, const Points& predicted,
                       const Multipliers& multipliers) {
    Equations result;
    for (std::size_t p = 0; p < x.size(); ++p) {
        result.g.push_back((x[p] - predicted[p]) * model.masses[p]);
    }
    Block<double> block;
    for (std::size_t i = 0; i < multipliers.size(); ++i) {
        evaluate(model, i, x, block);
        std::array<double, 3> h{};
        for (std::size_t row = 0; row < block.rows; ++row) {
            h[row] = block.value[row];
            for (std::size_t column = 0; column < block.rows; ++column) {
                h[row] += block.compliance[row][column] / (step * step) * multipliers[i][column];
            }
            for (std::size_t k = 0; k < block.particles.size(); ++k) {
                Vector3<double>& g = result.g[block.particles[k]];
                g = g - block.slope(row, k) * multipliers[i][row];
            }
        }
        result.h.push_back(h);
    }
    for (const std::uint32_t pin : model.pins) {
        result.g[pin] = {};
    }
    return result;
}

// Calls add(a, b, H) for each pair of a block's particles, H = Σ λ ∂²C/∂x_a∂x_b.
template <typename Add>
void add_curvature(const Edge& edge, const Points& x, const std::array<double, 3>& multiplier,
                   const Add& add) {
    const Vector3<double> difference = x[edge.a] - x[edge.b];
    const double length = difference.length();
    if (!(length > 0)) {
        return;
    }
    const Vector3<double> n = difference * (1 / length);
    Matrix3 same{};
    Matrix3 other{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            same[i][j] = multiplier[0] * ((i == j ? 1 : 0) - component(n, i) * component(n, j)) / length;
            other[i][j] = -same[i][j];
        }
    }
    add(edge.a, edge.a, same);
    add(edge.b, edge.b, same);
    add(edge.a, edge.b, other);
    add(edge.b, edge.a, other);
}

template <typename Add>
void add_curvature(const Triangle& triangle, const Points&, const std::array<double, 3>& multiplier,
                   const Add& add) {
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            const auto& s = triangle.slopes[a];
            const auto& t = triangle.slopes[b];
            const double value = multiplier[0] * s[0] * t[0] + multiplier[1] * s[1] * t[1] +
                                 multiplier[2] * (s[0] * t[1] + s[1] * t[0]);
            add(triangle.corners[a], triangle.corners[b],
                Matrix3{{{value, 0, 0}, {0, value, 0}, {0, 0, value}}});
        }
    }
}

template <typename Add>
void add_curvature(const Volume& volume, const Points& x, const std::array<double, 3>& multiplier,
                   const Add& add) {
    for (const std::array<std::uint32_t, 3>& corners : volume.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = volume.particles[corners[k]];
            const std::uint32_t b = volume.particles[corners[(k + 1) % 3]];
            const std::uint32_t c = volume.particles[corners[(k + 2) % 3]];
            // ∂(b × c)/∂b = -[c]ₓ, and its transpose for the pair the other way round.
            const Vector3<double> v = x[c] * (multiplier[0] / 6);
            add(a, b, Matrix3{{{0, v.z, -v.y}, {-v.z, 0, v.x}, {v.y, -v.x, 0}}});
            add(b, a, Matrix3{{{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}}});
        }
    }
}

template <typename Add>
void add_curvature(const Model& model, std::size_t index, const Points& x,
                   const std::array<double, 3>& multiplier, const Add& add) {
    if (index < model.edges.size()) {
        add_curvature(model.edges[index], x, multiplier, add);
    } else if (index - model.edges.size() < model.triangles.size()) {
        add_curvature(model.triangles[index - model.edges.size()], x, multiplier, add);
    } else {
        add_curvature(model.volumes[index - model.edges.size() - model.triangles.size()], x, multiplier, add);
    }
}

Eigen::VectorXd solve(int size, const Triplets& triplets, const Eigen::VectorXd& right) {
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    return factors.solve(right);
}

} // namespace

Residual residual_of(const Model& model, double h, const Points& x, const Points& predicted,
                     const Multipliers& multipliers) {
    const Equations equations = equations_of(model, h, x, predicted, multipliers);
    Residual residual;
    for (const Vector3<double>& g : equations.g) {
        residual.momentum += g.dot(g);
    }
    for (const std::array<double, 3>& row : equations.h) {
        residual.constraints += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
    }
    return {std::sqrt(residual.momentum), std::sqrt(residual.constraints)};
}

ImplicitEuler::ImplicitEuler(const Model& model, const Settings& settings, Linearisation linearisation)
    : model_(model), settings_(settings), linearisation_(linearisation),
      h_(1 / (settings.tick_rate_hz * settings.substeps)), unknowns_(model.positions.size(), 0) {
    for (const support::Vector& position : model.positions) {
        positions_.emplace_back(position);
    }
    for (const std::uint32_t pin : model.pins) {
        unknowns_[pin] = -1;
    }
    for (int& unknown : unknowns_) {
        if (unknown == 0) {
            unknown = free_count_;
            free_count_ += 3;
        }
    }
    velocities_.resize(positions_.size());
    multipliers_.resize(constraint_count(model));
    for (const double mass : model.masses) {
        largest_inverse_mass_ = std::max(largest_inverse_mass_, 1 / mass);
    }
}

void ImplicitEuler::tick(int count) {
    for (int i = 0; i < count * settings_.substeps; ++i) {
        substep();
    }
}

void ImplicitEuler::substep() {
    const Points previous = positions_;
    const Vector3<double> gravity = Vector3<double>(settings_.gravity) * (h_ * h_);
    const double kept = 1 - settings_.linear_damping * h_;
    for (std::size_t p = 0; p < positions_.size(); ++p) {
        if (unknowns_[p] >= 0) {
            positions_[p] = positions_[p] + velocities_[p] * (h_ * kept) + gravity;
        }
    }
    predicted_ = positions_;
    multipliers_.assign(multipliers_.size(), {});
    residuals_ = {residual_of(model_, h_, positions_, predicted_, multipliers_)};
    if (linearisation_ == Linearisation::full) {
        solve_full();
    } else {
        for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
            solve_constraints();
            residuals_.push_back(residual_of(model_, h_, positions_, predicted_, multipliers_));
        }
    }
    for (std::size_t p = 0; p < positions_.size(); ++p) {
        velocities_[p] = (positions_[p] - previous[p]) * (1 / h_);
    }
}

// ½|M^-½ g|² + ½|h|² with h as long as a constraint would have to move its particles.
double ImplicitEuler::merit(const Points& x, const Multipliers& multipliers) const {
    const Equations equations = equations_of(model_, h_, x, predicted_, multipliers);
    double sum = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
        sum += equations.g[p].dot(equations.g[p]) / (model_.masses[p] * model_.masses[p]);
    }
    for (const std::array<double, 3>& row : equations.h) {
        sum += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
    }
    return sum / 2;
}

bool ImplicitEuler::small(const Points& x, const Multipliers& multipliers) const {
    return std::sqrt(2 * merit(x, multipliers)) <
           converged_at * std::sqrt(static_cast<double>(x.size() + multipliers.size()));
}

// [K  -∇Cᵀ; -∇C  -α̃] (Δx, Δλ) = (-g, h): eq. 12, made symmetric.
void ImplicitEuler::solve_full() {
    Block<double> block;
    for (int step = 0; step < most_newton_steps; ++step) {
        if (small(positions_, multipliers_)) {
            return;
        }
        const Equations equations = equations_of(model_, h_, positions_, predicted_, multipliers_);
        Triplets triplets;
        std::vector<int> rows;
        int size = free_count_;
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            for (int axis = 0; unknowns_[p] >= 0 && axis < 3; ++axis) {
                triplets.emplace_back(unknowns_[p] + axis, unknowns_[p] + axis, model_.masses[p]);
            }
        }
        for (std::size_t i = 0; i < multipliers_.size(); ++i) {
            add_curvature(model_, i, positions_, multipliers_[i],
                          [&](std::uint32_t a, std::uint32_t b, const Matrix3& curvature) {
                              for (std::size_t k = 0; k < 3 && unknowns_[a] >= 0 && unknowns_[b] >= 0; ++k) {
                                  for (std::size_t l = 0; l < 3; ++l) {
                                      triplets.emplace_back(unknowns_[a] + static_cast<int>(k),
                                                            unknowns_[b] + static_cast<int>(l),
                                                            -curvature[k][l]);
                                  }
                              }
                          });
            evaluate(model_, i, positions_, block);
            for (std::size_t row = 0; row < block.rows; ++row) {
                const int unknown = size + static_cast<int>(row);
                for (std::size_t k = 0; k < block.particles.size(); ++k) {
                    const int x = unknowns_[block.particles[k]];
                    for (std::size_t axis = 0; x >= 0 && axis < 3; ++axis) {
                        const double slope = -component(block.slope(row, k), axis);
                        triplets.emplace_back(x + static_cast<int>(axis), unknown, slope);
                        triplets.emplace_back(unknown, x + static_cast<int>(axis), slope);
                    }
                }
                for (std::size_t column = 0; column < block.rows; ++column) {
                    const double kept = row == column ? softening * largest_inverse_mass_ : 0;
                    triplets.emplace_back(unknown, size + static_cast<int>(column),
                                          -block.compliance[row][column] / (h_ * h_) - kept);
                }
            }
            rows.push_back(size);
            size += static_cast<int>(block.rows);
        }
        Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
        for (std::size_t p = 0; p < positions_.size(); ++p) {
            for (std::size_t axis = 0; unknowns_[p] >= 0 && axis < 3; ++axis) {
                right[unknowns_[p] + static_cast<int>(axis)] = -component(equations.g[p], axis);
            }
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const int end = i + 1 < rows.size() ? rows[i + 1] : size;
            for (int row = rows[i]; row < end; ++row) {
                right[row] = equations.h[i][static_cast<std::size_t>(row - rows[i])];
            }
        }
        const Eigen::VectorXd change = solve(size, triplets, right);

        const double before = merit(positions_, multipliers_);
        Points x;
        Multipliers multipliers;
        // Halved until it is better; the shortest is taken as it is.
        for (double length = 1; length > 1e-6; length /= 2) {
            x = positions_;
            multipliers = multipliers_;
            for (std::size_t p = 0; p < x.size(); ++p) {
                if (const int at = unknowns_[p]; at >= 0) {
                    x[p] = x[p] + Vector3<double>(change[at], change[at + 1], change[at + 2]) * length;
                }
            }
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const int end = i + 1 < rows.size() ? rows[i + 1] : size;
                for (int row = rows[i]; row < end; ++row) {
                    multipliers[i][static_cast<std::size_t>(row - rows[i])] += length * change[row];
                }
            }
            if (merit(x, multipliers) < before) {
                break;
            }
        }
        if (!(merit(x, multipliers) < before)) {
            break; // rounding alone is left
        }
        positions_ = x;
        multipliers_ = multipliers;
        residuals_.push_back(residual_of(model_, h_, positions_, predicted_, multipliers_));
    }
    // What rounding of multipliers leaves: a share of 1e-16 of the forces.
    constexpr double enough = 1e-9;
    converged_ = converged_ && merit(positions_, multipliers_) < enough * enough / 2;
}

// [∇C M⁻¹ ∇Cᵀ + α̃] Δλ = -C - α̃λ, Δx = M⁻¹∇CᵀΔλ: eq. 16 and 17.
void ImplicitEuler::solve_constraints() {
    std::vector<Block<double>> blocks(multipliers_.size());
    std::vector<int> starts;
    int size = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        evaluate(model_, i, positions_, blocks[i]);
        starts.push_back(size);
        size += static_cast<int>(blocks[i].rows);
    }
    Triplets slopes;
    Triplets inverse_masses;
    Triplets compliances;
    Eigen::VectorXd right(size);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Block<double>& block = blocks[i];
        for (std::size_t row = 0; row < block.rows; ++row) {
            const int equation = starts[i] + static_cast<int>(row);
            right[equation] = -block.value[row];
            for (std::size_t column = 0; column < block.rows; ++column) {
                const double compliance = block.compliance[row][column] / (h_ * h_);
                compliances.emplace_back(equation, starts[i] + static_cast<int>(column), compliance);
                right[equation] -= compliance * multipliers_[i][column];
            }
            for (std::size_t k = 0; k < block.particles.size(); ++k) {
                const int x = unknowns_[block.particles[k]];
                for (std::size_t axis = 0; x >= 0 && axis < 3; ++axis) {
                    slopes.emplace_back(equation, x + static_cast<int>(axis),
                                        component(block.slope(row, k), axis));
                }
            }
        }
    }
    for (std::size_t p = 0; p < positions_.size(); ++p) {
        for (int axis = 0; unknowns_[p] >= 0 && axis < 3; ++axis) {
            inverse_masses.emplace_back(unknowns_[p] + axis, unknowns_[p] + axis, 1 / model_.masses[p]);
        }
    }
    Eigen::SparseMatrix<double> jacobian(size, free_count_);
    Eigen::SparseMatrix<double> inverse_mass(free_count_, free_count_);
    Eigen::SparseMatrix<double> compliance(size, size);
    jacobian.setFromTriplets(slopes.begin(), slopes.end());
    inverse_mass.setFromTriplets(inverse_masses.begin(), inverse_masses.end());
    compliance.setFromTriplets(compliances.begin(), compliances.end());
    const Eigen::SparseMatrix<double> transposed = inverse_mass * jacobian.transpose();
    const Eigen::SparseMatrix<double> matrix = jacobian * transposed + compliance;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::VectorXd change = factors.solve(right);
    const Eigen::VectorXd moved = transposed * change;
    for (std::size_t p = 0; p < positions_.size(); ++p) {
        if (const int at = unknowns_[p]; at >= 0) {
            positions_[p] = positions_[p] + Vector3<double>(moved[at], moved[at + 1], moved[at + 2]);
        }
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        for (std::size_t row = 0; row < blocks[i].rows; ++row) {
            multipliers_[i][row] += change[starts[i] + static_cast<int>(row)];
        }
    }
}

void must_have_converged(const ImplicitEuler& solver) {
    if (!solver.converged()) {
        throw std::runtime_error("Newton's method did not converge.");
    }
}

} // namespace reference
