// What the tests of collide/ share: metres, an exact reference for distances, and one particle's substeps.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "collide/broad_phase.h"
#include "collide/contact.h"
#include "fixed/formats.h"
#include "solver/object.h"
#include "support/handles.h"
#include "support/numbers.h"
#include "support/sanitised.h"

namespace collide_test {

// All of them in long runs.
inline int samples(int all) {
    return support::sanitised ? all / 10 : support::long_runs() ? all : all / 2;
}

using Real = long double;

struct Point {
    Real x = 0, y = 0, z = 0;

    Point operator+(const Point& b) const { return {x + b.x, y + b.y, z + b.z}; }
    Point operator-(const Point& b) const { return {x - b.x, y - b.y, z - b.z}; }
    Point operator*(Real f) const { return {x * f, y * f, z * f}; }
    Real dot(const Point& b) const { return x * b.x + y * b.y + z * b.z; }
    Real length() const { return std::sqrt(dot(*this)); }
    Point cross(const Point& b) const { return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x}; }
};

inline std::int64_t coordinate(Real metres) {
    return static_cast<std::int64_t>(std::llround(std::ldexp(metres, 56)));
}
inline std::int64_t world(Real metres) {
    return static_cast<std::int64_t>(std::llround(std::ldexp(metres, 40)));
}
inline Real from_coordinate(std::int64_t raw) {
    return std::ldexp(static_cast<Real>(raw), -56);
}
inline lks::fixed::Vec3 coordinates(const Point& p) {
    return {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
}
inline lks::fixed::Vec3 worlds(const Point& p) {
    return {world(p.x), world(p.y), world(p.z)};
}
inline Point to_point(const lks::fixed::Vec3& v) {
    return {from_coordinate(v.x), from_coordinate(v.y), from_coordinate(v.z)};
}
inline Point to_point(const lks::fixed::Direction& d) {
    return {std::ldexp(Real(d.x), -30), std::ldexp(Real(d.y), -30), std::ldexp(Real(d.z), -30)};
}
// Rows of the matrix times p, or columns.
inline Point rotated(const lks::fixed::Matrix3& a, const Point& p) {
    const auto row = [&](int i) {
        return std::ldexp(a.m[i][0] * p.x + a.m[i][1] * p.y + a.m[i][2] * p.z, -30);
    };
    return {row(0), row(1), row(2)};
}
inline Point rotated_back(const lks::fixed::Matrix3& a, const Point& p) {
    const auto column = [&](int i) {
        return std::ldexp(a.m[0][i] * p.x + a.m[1][i] * p.y + a.m[2][i] * p.z, -30);
    };
    return {column(0), column(1), column(2)};
}

// Random numbers of a fixed sequence.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    Real between(Real low, Real high) {
        return low + (high - low) * std::ldexp(static_cast<Real>(random_.next() >> 1), -63);
    }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_.next() % n); }
    std::int64_t any() { return static_cast<std::int64_t>(random_.next()); }
    Point in_cube(Real half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Point direction() {
        for (;;) {
            const Point p = in_cube(1);
            const Real length = p.length();
            if (length > 0.01L && length <= 1) {
                return p * (1 / length);
            }
        }
    }
    lks::fixed::Rotation rotation(Real greatest_degrees) {
        const Point axis = direction();
        const Real half = between(0, greatest_degrees) * std::acos(Real(-1)) / 360;
        return turn(axis, half);
    }
    static lks::fixed::Rotation turn(const Point& axis, Real half_angle) {
        const auto raw = [](Real v) { return static_cast<std::int32_t>(std::llround(std::ldexp(v, 30))); };
        return lks::fixed::normalise(
            lks::fixed::Rotation{raw(axis.x * std::sin(half_angle)), raw(axis.y * std::sin(half_angle)),
                                 raw(axis.z * std::sin(half_angle)), raw(std::cos(half_angle))});
    }

private:
    support::Random random_;
};

inline lks::fixed::Rotation degrees_about(const Point& axis, Real degrees) {
    return Dice::turn(axis, degrees * std::acos(Real(-1)) / 360);
}

inline lks::Shape plane() {
    return {LKS_SHAPE_PLANE, 0, 0, {0, 0, 0}};
}
inline lks::Shape sphere(Real radius) {
    return {LKS_SHAPE_SPHERE, coordinate(radius), 0, {0, 0, 0}};
}
inline lks::Shape capsule(Real radius, Real half_length) {
    return {LKS_SHAPE_CAPSULE, coordinate(radius), coordinate(half_length), {0, 0, 0}};
}
inline lks::Shape box(Real x, Real y, Real z) {
    return {LKS_SHAPE_BOX, 0, 0, coordinates({x, y, z})};
}

// The signed distance written the plain way, in long double.
inline Real reference_distance(const lks::Shape& shape, const Point& p, Real margin) {
    const Real radius = from_coordinate(shape.radius) + margin;
    switch (shape.kind) {
    case LKS_SHAPE_PLANE:
        return p.y - margin;
    case LKS_SHAPE_SPHERE:
        return p.length() - radius;
    case LKS_SHAPE_CAPSULE: {
        const Real h = from_coordinate(shape.half_length);
        return Point{p.x, p.y - std::fmax(-h, std::fmin(h, p.y)), p.z}.length() - radius;
    }
    default: {
        const Point h = to_point(shape.half_extents);
        const Point q = {std::fabs(p.x) - h.x, std::fabs(p.y) - h.y, std::fabs(p.z) - h.z};
        const Point outside = {std::fmax(q.x, Real(0)), std::fmax(q.y, Real(0)), std::fmax(q.z, Real(0))};
        return outside.length() + std::fmin(std::fmax(q.x, std::fmax(q.y, q.z)), Real(0)) - radius;
    }
    }
}

// The least distance on the straight way from a to b; the distance to a convex shape is convex along it.
inline Real least_distance(const lks::Shape& shape, const Point& a, const Point& b, Real margin) {
    const auto at = [&](Real t) { return reference_distance(shape, a + (b - a) * t, margin); };
    Real low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const Real left = low + (high - low) / 3, right = high - (high - low) / 3;
        if (at(left) < at(right)) {
            high = right;
        } else {
            low = left;
        }
    }
    return std::fmin(std::fmin(at(0), at(1)), at((low + high) / 2));
}

inline lks::ColliderState resting(const lks::Shape& shape, const Point& position = {},
                                  lks::fixed::Rotation rotation = lks::fixed::identity_rotation()) {
    lks::ColliderState collider{};
    collider.shape = shape;
    collider.filter = lks::default_filter;
    collider.position = worlds(position);
    collider.target_position = collider.position;
    collider.rotation = rotation;
    collider.target_rotation = rotation;
    return collider;
}

// One particle, its object's origin, and the solver's substep around the contact.
struct Particle {
    lks::fixed::Vec3 position{};
    lks::fixed::Vec3 start{};
    lks::fixed::Vec3 origin{};
    std::int64_t margin = 0;
    std::int64_t friction_factor = std::int64_t{1} << 40;

    static Particle at(const Point& p, const Point& motion_per_substep) {
        Particle particle;
        particle.position = coordinates(p);
        particle.start = particle.position - coordinates(motion_per_substep);
        return particle;
    }
    lks::fixed::Vec3 motion() const { return position - start; }

    void predict(const Point& acceleration_motion) {
        const lks::fixed::Vec3 moved = motion() + coordinates(acceleration_motion);
        start = position;
        position = position + moved;
    }
    lks::Bounds bounds() const {
        return {
            {std::min(position.x, start.x), std::min(position.y, start.y), std::min(position.z, start.z)},
            {std::max(position.x, start.x), std::max(position.y, start.y), std::max(position.z, start.z)}};
    }
    lks::ContactFrame frame(const lks::ColliderState& collider, std::uint32_t substep,
                            std::uint32_t substeps) const {
        return lks::make_contact_frame(collider, substep, substeps, origin, bounds(), margin,
                                       friction_factor);
    }
    void resolve(const lks::ContactFrame& frame) {
        lks::resolve_contacts(frame, {&position.x, &position.y, &position.z, &start.x, &start.y, &start.z}, 0,
                              1, *lks::find_kernels(LKS_SIMD_SCALAR));
    }
};

inline Point local_start(const lks::ContactFrame& frame, const lks::fixed::Vec3& start) {
    return rotated_back(frame.start_rotation, to_point(start) - to_point(frame.start_centre));
}
inline Point local_end(const lks::ContactFrame& frame, const lks::fixed::Vec3& position) {
    return rotated_back(frame.end_rotation, to_point(position) - to_point(frame.end_centre));
}

// For the end of a tick: what the collider moved to is where it is.
inline void finish_motion(lks::ColliderState& collider) {
    collider.position = collider.target_position;
    collider.rotation = collider.target_rotation;
}

} // namespace collide_test
