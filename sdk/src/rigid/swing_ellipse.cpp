#include "rigid/swing_ellipse.h"

#include <algorithm>

namespace lks {

using fixed::Direction;
using fixed::Vec3;

namespace {

// The first two components of a vector in a plane.
std::int64_t length_of(std::int64_t x, std::int64_t z) {
    return static_cast<std::int64_t>(fixed::length(Vec3{x, z, 0}));
}

std::int64_t cubed(std::int64_t c) {
    return (c * c >> 30) * c >> 30;
}

// The parameter (cosine, sine) of the point of an ellipse that is next to p, both in the first quadrant: the
// centre of curvature of each guess takes the place of the ellipse's (A. Chlumský, Simple Method for Distance
// to Ellipse). However thin it is four rounds leave 2e-4 of the longer half axis next to the edge, and 4e-4
// at 1.3 times as far (the worst of 6,000 at random with half axes of 0.05 to 180 degrees).
Direction nearest(std::int64_t half_x, std::int64_t half_z, std::int64_t p_x, std::int64_t p_z) {
    constexpr int rounds = 4;
    constexpr std::int32_t root_of_half = 759250125;
    const std::int64_t spread_x = fixed::multiply_divide(half_x - half_z, half_x + half_z, half_x);
    const std::int64_t spread_z = fixed::multiply_divide(half_z - half_x, half_x + half_z, half_z);
    Direction t{root_of_half, root_of_half, 0};
    for (int i = 0; i < rounds; ++i) {
        const std::int64_t centre_x = fixed::multiply_shift(spread_x, cubed(t.x), 30);
        const std::int64_t centre_z = fixed::multiply_shift(spread_z, cubed(t.y), 30);
        const std::int64_t radius = length_of(fixed::scale_component(t.x, half_x) - centre_x,
                                              fixed::scale_component(t.y, half_z) - centre_z);
        const std::int64_t away = length_of(p_x - centre_x, p_z - centre_z);
        if (away == 0) {
            break;
        }
        const auto next = [radius, away](std::int64_t p, std::int64_t centre, std::int64_t half) {
            const std::int64_t on_circle = fixed::multiply_divide(p - centre, radius, away) + centre;
            return fixed::multiply_divide(std::clamp<std::int64_t>(on_circle, 0, half), world_one, half);
        };
        fixed::NormalisedVector way{};
        if (!fixed::normalise(Vec3{next(p_x, centre_x, half_x), next(p_z, centre_z, half_z), 0}, way)) {
            break;
        }
        t = way.direction;
    }
    return t;
}

// In the first quadrant, with how far p and it are along the normal there.
struct EllipsePoint {
    std::int64_t x, z;
    Direction normal; // in x and y
    std::int64_t out;
    std::int64_t edge;
};

EllipsePoint nearest_point(const JointConstants& c, std::int64_t p_x, std::int64_t p_z) {
    const Direction t = nearest(c.swing_limit, c.swing_limit_z, p_x, p_z);
    fixed::NormalisedVector normal{};
    fixed::normalise(
        Vec3{fixed::scale_component(t.x, c.swing_limit_z), fixed::scale_component(t.y, c.swing_limit), 0},
        normal);
    const Direction n = normal.direction;
    const std::int64_t x = fixed::scale_component(t.x, c.swing_limit);
    const std::int64_t z = fixed::scale_component(t.y, c.swing_limit_z);
    return {x, z, n, fixed::scale_component(n.x, p_x) + fixed::scale_component(n.y, p_z),
            fixed::scale_component(n.x, x) + fixed::scale_component(n.y, z)};
}

template <typename Size, typename Sign>
Size with_sign_of(Size size, Sign sign) {
    return sign < 0 ? -size : size;
}

// v × t, World; t = cos φ·z − sin φ·x, square to the swing.
Vec3 about_azimuth(const Direction& v, const Direction& phi, const Direction& x, const Direction& z) {
    const auto mixed = [&phi](std::int32_t along_x, std::int32_t along_z) {
        return fixed::shift_right_rounded(std::int64_t{phi.x} * along_z - std::int64_t{phi.y} * along_x, 30);
    };
    const Vec3 t{mixed(x.x, z.x), mixed(x.y, z.y), mixed(x.z, z.z)};
    const auto part = [](std::int64_t c) { return c >> (60 - world_fraction_bits); };
    return {part(v.y * t.z - v.z * t.y), part(v.z * t.x - v.x * t.z), part(v.x * t.y - v.y * t.x)};
}

// θ/sin θ, World; not more than near 165 degrees, and one at nought.
std::int64_t over_sine(std::int64_t angle, std::int64_t sine) {
    constexpr std::int64_t least = direction_one / 4;
    const bool beyond_right = angle > 2 * world_one;
    return angle < world_one / 1024
               ? world_one
               : fixed::multiply_divide(angle, direction_one, beyond_right ? std::max(sine, least) : sine);
}

} // namespace

Swing square_to_edge(const JointConstants& c, const Body& a, const Direction& v, const Direction& k,
                     std::int64_t angle, std::int64_t sine) {
    const Direction across_x = fixed::rotate(a.rotation, c.across_a[0]);
    const Direction across_z = fixed::rotate(a.rotation, c.across_a[1]);
    fixed::NormalisedVector phi{};
    if (!fixed::normalise(Vec3{fixed::dot(across_x, v), fixed::dot(across_z, v), 0}, phi)) {
        phi.direction = {c.swing_limit < c.swing_limit_z ? direction_one : 0,
                         c.swing_limit < c.swing_limit_z ? 0 : direction_one, 0};
    }
    const auto size = [angle](std::int32_t share) {
        return fixed::scale_component(share < 0 ? -share : share, angle);
    };
    const std::int64_t p_x = size(phi.direction.x);
    const std::int64_t p_z = size(phi.direction.y);
    const EllipsePoint next = nearest_point(c, p_x, p_z);
    const Direction n = next.normal;
    const std::int64_t n_x = with_sign_of(n.x, phi.direction.x);
    const std::int64_t n_z = with_sign_of(n.y, phi.direction.y);
    const std::int64_t radial = (n_x * phi.direction.x + n_z * phi.direction.y) >> (60 - world_fraction_bits);
    const std::int64_t along = (n_z * phi.direction.x - n_x * phi.direction.y) >> (60 - world_fraction_bits);
    const std::int64_t azimuthal = fixed::multiply_shift(along, over_sine(angle, sine), world_fraction_bits);
    const Vec3 m = about_azimuth(v, phi.direction, across_x, across_z);
    const auto part = [=](std::int32_t about_k, std::int64_t about_m) {
        return fixed::scale_component(about_k, radial) +
               fixed::multiply_shift(about_m, azimuthal, world_fraction_bits);
    };
    fixed::NormalisedVector way{};
    if (!fixed::normalise(Vec3{part(k.x, m.x), part(k.y, m.y), part(k.z, m.z)}, way)) {
        return {k, next.out, next.edge};
    }
    const auto as_turn = [&way](std::int64_t value) {
        return fixed::multiply_divide(value, world_one, way.length);
    };
    return {way.direction, as_turn(next.out), as_turn(next.edge)};
}

SwingEdge nearest_edge(const JointConstants& c, std::int64_t x, std::int64_t z) {
    if (c.swing_round) {
        const std::int64_t angle = length_of(x, z);
        const auto part = [&](std::int64_t p) {
            return angle == 0 ? 0 : fixed::multiply_divide(p, c.swing_limit, angle);
        };
        return {part(x), part(z), angle - c.swing_limit};
    }
    const EllipsePoint next = nearest_point(c, x < 0 ? -x : x, z < 0 ? -z : z);
    return {with_sign_of(next.x, x), with_sign_of(next.z, z), next.out - next.edge};
}

} // namespace lks
