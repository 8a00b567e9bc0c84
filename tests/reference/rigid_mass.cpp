#include "reference/rigid_mass.h"

#include <cmath>
#include <vector>

#include "reference/rigid_numbers.h"

namespace reference {
namespace {

using support::Vector;

double volume_of(const lks_body_shape& shape) {
    const double pi = std::acos(-1.0);
    if (shape.shape == LKS_SHAPE_BOX) {
        const Vector e = support::metres(shape.half_extents);
        return 8 * e.x * e.y * e.z;
    }
    const double r = support::metres(shape.radius);
    const double h = shape.shape == LKS_SHAPE_CAPSULE ? support::metres(shape.half_length) : 0;
    return pi * r * r * (4 * r / 3 + 2 * h);
}

// Of one kilogram, about the shape's own axes.
Vector own_inertia(const lks_body_shape& shape) {
    const double r = support::metres(shape.radius);
    const double ball = 2 * r * r / 5;
    if (shape.shape == LKS_SHAPE_SPHERE) {
        return {ball, ball, ball};
    }
    if (shape.shape == LKS_SHAPE_CAPSULE) {
        const double h = support::metres(shape.half_length);
        const double cylinder = 3 * h / (3 * h + 2 * r); // its share of the mass
        const double ends = 1 - cylinder;
        const double across = cylinder * (r * r / 4 + h * h / 3) + ends * (ball + h * h + 3 * h * r / 4);
        return {across, cylinder * r * r / 2 + ends * ball, across};
    }
    const Vector e = support::metres(shape.half_extents);
    return {(e.y * e.y + e.z * e.z) / 3, (e.z * e.z + e.x * e.x) / 3, (e.x * e.x + e.y * e.y) / 3};
}

// R·diag·Rᵀ + |d|²·1 − d·dᵀ
RigidInertia inertia_about(const lks_body_shape& shape, const Vector& d) {
    const Matrix<double> turned = quaternion_of<double>(rotation_of(shape.transform.rotation))
                                      .matrix()
                                      .around(diagonal(Vector3<double>(own_inertia(shape))));
    const Vector3<double>(&rows)[3] = turned.rows;
    const double square = d.dot(d);
    return {rows[0].x + square - d.x * d.x, rows[0].y - d.x * d.y, rows[0].z - d.x * d.z,
            rows[1].y + square - d.y * d.y, rows[1].z - d.y * d.z, rows[2].z + square - d.z * d.z};
}

// A rod thinner than this would only spin numbers.
void thicken(RigidInertia& m) {
    const double trace = m.xx + m.yy + m.zz;
    const double least = trace / 4096;
    const double determinant = m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.xz * m.yz) +
                               m.xz * (m.xy * m.yz - m.xz * m.yy);
    if (determinant < trace * trace * least / 4) {
        m = m + RigidInertia{least, 0, 0, least, 0, least};
    }
}

} // namespace

RigidMass rigid_mass(const lks_body_shape* shapes, std::uint32_t count) {
    std::vector<double> masses;
    double whole = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        masses.push_back(volume_of(shapes[i]) * support::metres(shapes[i].density));
        whole += masses.back();
    }
    RigidMass out;
    for (std::uint32_t i = 0; i < count; ++i) {
        out.centre = out.centre + support::metres(shapes[i].transform.position) * (masses[i] / whole);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector from_centre = support::metres(shapes[i].transform.position) - out.centre;
        out.inertia = out.inertia + inertia_about(shapes[i], from_centre) * (masses[i] / whole);
    }
    thicken(out.inertia);
    return out;
}

} // namespace reference
