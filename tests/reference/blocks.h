// Constraints of every kind as the papers write them: value, gradient and compliance of one block of rows.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/model.h"
#include "reference/rigid_numbers.h"

namespace reference {

// Up to three rows that share a compliance matrix (XPBD eq. 27).
template <typename Scalar>
struct Block {
    std::size_t rows = 0;
    std::vector<std::uint32_t> particles;
    std::array<Scalar, 3> value{};
    std::array<std::array<Scalar, 3>, 3> compliance{}; // α
    std::vector<Vector3<Scalar>> gradient;             // row by row, each by particle

    Vector3<Scalar>& slope(std::size_t row, std::size_t particle) {
        return gradient[row * particles.size() + particle];
    }
    const Vector3<Scalar>& slope(std::size_t row, std::size_t particle) const {
        return gradient[row * particles.size() + particle];
    }
};

// C = |x_a - x_b| - L.
template <typename Scalar>
void evaluate(const Edge& edge, const std::vector<Vector3<Scalar>>& x, Block<Scalar>& block) {
    const Vector3<Scalar> difference = x[edge.a] - x[edge.b];
    const Scalar length = difference.length();
    const Vector3<Scalar> direction = length > 0 ? difference * (1 / length) : Vector3<Scalar>();
    block.rows = 1;
    block.particles = {edge.a, edge.b};
    block.value[0] = length - static_cast<Scalar>(edge.rest);
    block.compliance[0][0] = static_cast<Scalar>(edge.compliance);
    block.gradient = {direction, direction * Scalar(-1)};
}

// C = (εxx, εyy, 2εxy), ε = (FᵀF - 1) / 2.
template <typename Scalar>
void evaluate(const Triangle& triangle, const std::vector<Vector3<Scalar>>& x, Block<Scalar>& block) {
    constexpr std::size_t axes[3][2] = {{0, 0}, {1, 1}, {0, 1}};
    const auto slope_of = [&](std::size_t corner, std::size_t axis) {
        return static_cast<Scalar>(triangle.slopes[corner][axis]);
    };
    Vector3<Scalar> columns[2];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            columns[axis] = columns[axis] + x[triangle.corners[corner]] * slope_of(corner, axis);
        }
    }
    block.rows = 3;
    block.particles.assign(triangle.corners.begin(), triangle.corners.end());
    block.gradient.resize(9);
    for (std::size_t row = 0; row < 3; ++row) {
        const auto [k, l] = axes[row];
        const Scalar factor = k == l ? Scalar(0.5) : Scalar(1);
        block.value[row] = factor * (columns[k].dot(columns[l]) - (k == l ? Scalar(1) : Scalar(0)));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            block.slope(row, corner) =
                (columns[l] * slope_of(corner, k) + columns[k] * slope_of(corner, l)) * factor;
        }
        for (std::size_t column = 0; column < 3; ++column) {
            block.compliance[row][column] = static_cast<Scalar>(triangle.compliance[row][column]);
        }
    }
}

// C = enclosed volume - rest volume.
template <typename Scalar>
void evaluate(const Volume& volume, const std::vector<Vector3<Scalar>>& x, Block<Scalar>& block) {
    block.rows = 1;
    block.particles = volume.particles;
    block.compliance[0][0] = static_cast<Scalar>(volume.compliance);
    block.gradient.assign(volume.particles.size(), {});
    Scalar sum = 0;
    for (const std::array<std::uint32_t, 3>& corners : volume.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3<Scalar>& next = x[volume.particles[corners[(k + 1) % 3]]];
            const Vector3<Scalar>& last = x[volume.particles[corners[(k + 2) % 3]]];
            const Vector3<Scalar> area = cross(next, last) * (Scalar(1) / 6);
            block.slope(0, corners[k]) = block.slope(0, corners[k]) + area;
            sum += k == 0 ? x[volume.particles[corners[0]]].dot(area) : Scalar(0);
        }
    }
    block.value[0] = sum - static_cast<Scalar>(volume.rest);
}

// All constraints of a model by one index: edges, then triangles, then volumes.
inline std::size_t constraint_count(const Model& model) {
    return model.edges.size() + model.triangles.size() + model.volumes.size();
}

template <typename Scalar>
void evaluate(const Model& model, std::size_t index, const std::vector<Vector3<Scalar>>& x,
              Block<Scalar>& block) {
    if (index < model.edges.size()) {
        evaluate(model.edges[index], x, block);
    } else if (index - model.edges.size() < model.triangles.size()) {
        evaluate(model.triangles[index - model.edges.size()], x, block);
    } else {
        evaluate(model.volumes[index - model.edges.size() - model.triangles.size()], x, block);
    }
}

} // namespace reference
