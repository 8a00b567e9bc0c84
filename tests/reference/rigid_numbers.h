// Vectors, matrices and quaternions of the rigid reference solver, in any number type.
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/rigid_model.h"
#include "reference/symmetric_system.h"
#include "reference/xpbd.h"

namespace reference {

template <typename Scalar>
Vector3<Scalar> cross(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename Scalar>
Vector3<Scalar> products(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

// The greatest component.
template <typename Scalar>
Scalar greatest(const Vector3<Scalar>& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// By an axis's number.
template <typename Scalar>
Scalar component(const Vector3<Scalar>& v, int i) {
    return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

template <typename Scalar>
Vector3<Scalar> along_axis(int i, Scalar length) {
    return {i == 0 ? length : 0, i == 1 ? length : 0, i == 2 ? length : 0};
}

template <typename Scalar>
Vector3<Scalar> some_across(const Vector3<Scalar>& v) {
    const Vector3<Scalar> some =
        std::abs(v.x) < std::abs(v.y) ? Vector3<Scalar>{0, -v.z, v.y} : Vector3<Scalar>{-v.z, 0, v.x};
    return some * (1 / some.length());
}

template <typename Scalar>
struct Matrix {
    using Vec = Vector3<Scalar>;

    Vec rows[3];

    Vec operator*(const Vec& v) const { return {rows[0].dot(v), rows[1].dot(v), rows[2].dot(v)}; }
    Vec column(int i) const { return {component(rows[0], i), component(rows[1], i), component(rows[2], i)}; }
    // By the transposed.
    Vec back(const Vec& v) const { return rows[0] * v.x + rows[1] * v.y + rows[2] * v.z; }
    Matrix operator*(const Matrix& m) const { return {{m.back(rows[0]), m.back(rows[1]), m.back(rows[2])}}; }
    // R·M·Rᵀ of a symmetric M.
    Matrix around(const Matrix& m) const {
        return {{*this * (m * rows[0]), *this * (m * rows[1]), *this * (m * rows[2])}};
    }
};

template <typename Scalar>
Matrix<Scalar> diagonal(const Vector3<Scalar>& v) {
    return {{{v.x, 0, 0}, {0, v.y, 0}, {0, 0, v.z}}};
}

template <typename Scalar>
Matrix<Scalar> matrix_of(const RigidInertia& m) {
    const auto row = [](double x, double y, double z) { return Vector3<Scalar>(support::Vector{x, y, z}); };
    return {{row(m.xx, m.xy, m.xz), row(m.xy, m.yy, m.yz), row(m.xz, m.yz, m.zz)}};
}

// Of a symmetric positive one.
template <typename Scalar>
Matrix<Scalar> inverse_of(const Matrix<Scalar>& m) {
    SymmetricSystem<Scalar> system;
    system.factor(3, {m.rows[0].x, m.rows[0].y, m.rows[0].z, m.rows[1].x, m.rows[1].y, m.rows[1].z,
                      m.rows[2].x, m.rows[2].y, m.rows[2].z});
    Matrix<Scalar> out;
    for (int i = 0; i < 3; ++i) {
        std::vector<Scalar> column(3);
        column[static_cast<std::size_t>(i)] = 1;
        system.solve(column);
        out.rows[i] = {column[0], column[1], column[2]};
    }
    return out;
}

template <typename Scalar>
struct Quaternion {
    using Vec = Vector3<Scalar>;

    Scalar x = 0, y = 0, z = 0, w = 1;

    bool operator==(const Quaternion&) const = default;
    Vec vector() const { return {x, y, z}; }
    Quaternion conjugate() const { return {-x, -y, -z, w}; }
    Quaternion operator*(const Quaternion& b) const {
        const Vec v = b.vector() * w + vector() * b.w + cross(vector(), b.vector());
        return {v.x, v.y, v.z, w * b.w - vector().dot(b.vector())};
    }
    Quaternion normalised() const {
        const Scalar f = 1 / std::sqrt(x * x + y * y + z * z + w * w);
        return {x * f, y * f, z * f, w * f};
    }
    // A share of the shorter way: the components in between, normalised.
    Quaternion towards(const Quaternion& b, Scalar share) const {
        const Scalar dot = x * b.x + y * b.y + z * b.z + w * b.w;
        const Scalar to = dot < 0 ? -share : share;
        const Scalar from = 1 - share;
        return Quaternion{x * from + b.x * to, y * from + b.y * to, z * from + b.z * to, w * from + b.w * to}
            .normalised();
    }
    // q + τ⊗q, not normalised.
    Quaternion moved(const Vec& half_turn) const {
        const Quaternion d = Quaternion{half_turn.x, half_turn.y, half_turn.z, 0} * *this;
        return {x + d.x, y + d.y, z + d.z, w + d.w};
    }
    // Of a unit quaternion; else the matrix of these components.
    Matrix<Scalar> matrix() const {
        return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (z * x + w * y)},
                 {2 * (x * y + w * z), 1 - 2 * (z * z + x * x), 2 * (y * z - w * x)},
                 {2 * (z * x - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
    }
};

template <typename Scalar>
Quaternion<Scalar> quaternion_of(const Rotation& q) {
    return {static_cast<Scalar>(q.x), static_cast<Scalar>(q.y), static_cast<Scalar>(q.z),
            static_cast<Scalar>(q.w)};
}

// Of the shorter way: what makes of a unit quaternion's vector the axis times the angle.
template <typename Scalar>
Scalar angle_by_vector(const Quaternion<Scalar>& q) {
    const Scalar sine = q.vector().length();
    return sine == 0 ? 0 : 2 * std::atan2(q.w < 0 ? -sine : sine, std::abs(q.w)) / sine;
}

// axis·tan(angle/2) from one to the other: the inverse of Cayley's map.
template <typename Scalar>
Vector3<Scalar> half_turn_between(const Quaternion<Scalar>& from, const Quaternion<Scalar>& to) {
    const Quaternion<Scalar> d = to * from.conjugate();
    return d.vector() * (1 / d.w);
}

} // namespace reference
