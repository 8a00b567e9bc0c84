// Two segments with radii: spheres and capsules (Ericson, Real-Time Collision Detection, 5.1.9, over unit
// directions).
#include <algorithm>

#include "collide/manifold.h"
#include "fixed/formats.h"

namespace lks::manifold_detail {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Sine squared of the angle below which segments count as parallel: 7°.
constexpr std::int64_t parallel = (std::int64_t{1} << 30) >> 6;
// And below which the nearest points say nothing: 0.06°.
constexpr std::int64_t nearly_parallel = (std::int64_t{1} << 30) >> 20;

} // namespace

void collide_segments(const Piece& a, const Piece& b, std::int64_t margin, Manifold& out) {
    const Direction u = axis(a.axes, 1);
    const Direction v = axis(b.axes, 1);
    const std::int64_t half_a = a.half_length;
    const std::int64_t half_b = b.half_length;
    const Vec3 r = a.centre - b.centre;
    const std::int64_t along_a = fixed::dot(u, r);
    const std::int64_t along_b = fixed::dot(v, r);
    const std::int32_t cosine = fixed::dot(u, v);
    const std::int64_t sine_squared =
        direction_one - static_cast<std::int64_t>((std::int64_t{cosine} * cosine) >> 30);
    const auto nearest_a = [&](std::int64_t t) {
        return std::clamp(fixed::scale_component(cosine, t) - along_a, -half_a, half_a);
    };
    const auto nearest_b = [&](std::int64_t s) {
        return std::clamp(fixed::scale_component(cosine, s) + along_b, -half_b, half_b);
    };
    const bool side_by_side = half_a != 0 && half_b != 0 && sine_squared < parallel;
    std::int64_t s = 0;
    if (half_a != 0 && half_b != 0 && sine_squared > nearly_parallel) {
        s = std::clamp(fixed::multiply_divide(fixed::scale_component(cosine, along_b) - along_a,
                                              direction_one, sine_squared),
                       -half_a, half_a);
    } else if (side_by_side) {
        // The middle of where they lie beside each other.
        const std::int64_t first = nearest_a(-half_b);
        const std::int64_t last = nearest_a(half_b);
        s = (first + last) / 2;
    }
    std::int64_t t = nearest_b(s);
    s = nearest_a(t);
    t = nearest_b(s);

    const auto on_a = [&](std::int64_t at) { return a.centre + fixed::scale(u, at); };
    const auto on_b = [&](std::int64_t at) { return b.centre + fixed::scale(v, at); };
    fixed::NormalisedVector way{};
    // Across both where the cores meet; anything across where they are one.
    static_cast<void>(fixed::normalise(on_b(t) - on_a(s), way) || fixed::normalise(fixed::cross(u, v), way) ||
                      fixed::normalise(fixed::some_across(u), way));
    out.normal = way.direction;
    const std::int64_t radii = a.radius + b.radius;
    if (side_by_side) {
        const std::int64_t first = nearest_a(-half_b);
        const std::int64_t last = nearest_a(half_b);
        if (first != last) {
            add_point(out, on_a(first), on_b(nearest_b(first)), radii, margin, 1);
            add_point(out, on_a(last), on_b(nearest_b(last)), radii, margin, 2);
            if (s == first || s == last) {
                return;
            }
        }
    }
    add_point(out, on_a(s), on_b(t), radii, margin, 0);
}

} // namespace lks::manifold_detail
