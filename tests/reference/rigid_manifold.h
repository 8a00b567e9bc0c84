// Where two shapes of the rigid reference solver touch, or are about to: what sdk/src/collide/manifold.h
// defines, in floating point. Spheres and capsules have a core and a radius; points are those of cores.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "reference/rigid_numbers.h"

namespace reference {

// A shape in its place.
template <typename Scalar>
struct Piece {
    std::uint32_t kind; // lks_shape_kind
    Scalar radius, half_length;
    Vector3<Scalar> half_extents;
    Vector3<Scalar> centre;
    Matrix<Scalar> axes; // local to world

    Vector3<Scalar> at(const Vector3<Scalar>& local) const { return centre + axes * local; }
};

template <typename Scalar>
struct ManifoldPoint {
    Vector3<Scalar> core_a, core_b;
    Scalar separation; // of the surfaces along the normal
    std::uint32_t feature;
};

template <typename Scalar>
class Manifold {
public:
    using Vec = Vector3<Scalar>;

    // For points of at most this separation.
    Manifold(Scalar margin, Scalar radii) : margin_(margin), radii_(radii) {}

    Vec normal; // from a to b
    std::vector<ManifoldPoint<Scalar>> points;
    Scalar gap = std::numeric_limits<Scalar>::max(); // of the shapes along the normal, also without points

    Scalar margin() const { return margin_; }
    void add(const Vec& core_a, const Vec& core_b, std::uint32_t feature) {
        const Scalar separation = normal.dot(core_b - core_a) - radii_;
        gap = std::min(gap, separation);
        if (separation <= margin_ && points.size() < 4) {
            points.push_back({core_a, core_b, separation, feature});
        }
    }
    // Found as that of b and a.
    void turn_round() {
        normal = normal * Scalar(-1);
        for (ManifoldPoint<Scalar>& point : points) {
            std::swap(point.core_a, point.core_b);
        }
    }

private:
    Scalar margin_, radii_;
};

// The face of a box that looks most along a direction in its frame.
template <typename Scalar>
class BoxFace {
public:
    using Vec = Vector3<Scalar>;

    BoxFace(const Vec& half_extents, const Vec& towards) : half_extents_(half_extents) {
        for (int i = 1; i < 3; ++i) {
            if (std::abs(component(towards, i)) > std::abs(component(towards, axis_))) {
                axis_ = i;
            }
        }
        positive_ = component(towards, axis_) > 0;
    }

    int axis() const { return axis_; }

    struct Corner {
        Vec local;
        std::uint32_t feature;
    };
    // `first`, `second`: on the positive side of the next axis, and of the one after that.
    Corner corner(bool first, bool second) const {
        Corner corner{{}, 0};
        const bool positive[3] = {positive_, first, second};
        for (int k = 0; k < 3; ++k) {
            const int i = (axis_ + k) % 3;
            const Scalar extent = component(half_extents_, i);
            corner.local = corner.local + along_axis(i, positive[k] ? extent : -extent);
            corner.feature |= positive[k] ? 1u << i : 0u;
        }
        return corner;
    }

private:
    Vec half_extents_;
    int axis_ = 0;
    bool positive_ = false;
};

// Whether a normal is clearly against the one that shapes have touched with before; zero: with none.
template <typename Scalar>
bool is_against(const Vector3<Scalar>& normal, const Vector3<Scalar>& side) {
    return normal.dot(side) < Scalar(-0.5);
}

// A sphere is a segment without length.
template <typename Scalar>
void touch_plane(const Piece<Scalar>& a, const Piece<Scalar>& plane, Manifold<Scalar>& out) {
    using Vec = Vector3<Scalar>;
    const Vec up = plane.axes.column(1);
    out.normal = up * Scalar(-1);
    const auto add = [&](const Vec& local, std::uint32_t feature) {
        const Vec point = a.at(local);
        out.add(point, point - up * up.dot(point - plane.centre), feature);
    };
    if (a.kind != LKS_SHAPE_BOX) {
        add({0, a.half_length, 0}, 0);
        if (a.half_length != 0) {
            add({0, -a.half_length, 0}, 1);
        }
        return;
    }
    // The corners of the face that looks most against the plane's normal.
    const BoxFace<Scalar> face(a.half_extents, a.axes.back(up) * Scalar(-1));
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const auto [local, feature] = face.corner((corner & 1u) != 0, (corner & 2u) != 0);
        add(local, feature);
    }
}

// Two cores that are segments, or points.
template <typename Scalar>
void touch_segments(const Piece<Scalar>& a, const Piece<Scalar>& b, Manifold<Scalar>& out) {
    using Vec = Vector3<Scalar>;
    const Vec u = a.axes.column(1);
    const Vec v = b.axes.column(1);
    const Vec across = cross(u, v);
    const Vec between = a.centre - b.centre;
    const Scalar sine_squared = across.dot(across);
    const bool segments = a.half_length != 0 && b.half_length != 0;
    const bool side_by_side = segments && sine_squared < Scalar(1) / 64;
    const auto on_a = [&](Scalar s) { return a.centre + u * s; };
    const auto on_b = [&](Scalar t) { return b.centre + v * t; };
    const auto nearest_a = [&](Scalar t) {
        return std::clamp(u.dot(on_b(t) - a.centre), -a.half_length, a.half_length);
    };
    const auto nearest_b = [&](Scalar s) {
        return std::clamp(v.dot(on_a(s) - b.centre), -b.half_length, b.half_length);
    };
    // Of a's part that is beside b.
    const Scalar first = nearest_a(-b.half_length);
    const Scalar last = nearest_a(b.half_length);
    Scalar s = 0;
    if (segments && sine_squared > Scalar(0x1p-20)) {
        s = std::clamp((u.dot(v) * v.dot(between) - u.dot(between)) / sine_squared, -a.half_length,
                       a.half_length);
    } else if (side_by_side) {
        s = (first + last) / 2;
    }
    s = nearest_a(nearest_b(s));
    const Scalar t = nearest_b(s);
    const Vec way = on_b(t) - on_a(s);
    const Scalar distance = way.length();
    // Across both where the cores meet; anything across where they are one.
    out.normal = distance > 0       ? way * (1 / distance)
                 : sine_squared > 0 ? across * (1 / across.length())
                                    : some_across(u);
    if (side_by_side && first != last) {
        out.add(on_a(first), on_b(nearest_b(first)), 1);
        out.add(on_a(last), on_b(nearest_b(last)), 2);
        if (s == first || s == last) {
            return;
        }
    }
    out.add(on_a(s), on_b(t), 0);
}

} // namespace reference
