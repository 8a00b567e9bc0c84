// The exact distance of the shapes against long double: the figures that collide/shape.h states.
#include "collide_support.h"

#include <doctest/doctest.h>

using namespace collide_test;
using lks::Shape;
using lks::SurfacePoint;

namespace {

constexpr std::int64_t one = lks::coordinate_one;
constexpr std::int32_t unit = lks::direction_one;

Shape random_shape(Dice& dice, std::uint32_t kind) {
    const auto size = [&dice] { return std::pow(Real(10), dice.between(-3, 0.9L)); };
    switch (kind) {
    case LKS_SHAPE_PLANE:
        return plane();
    case LKS_SHAPE_SPHERE:
        return sphere(size());
    case LKS_SHAPE_CAPSULE:
        return capsule(size(), size());
    default:
        return box(size(), size(), size());
    }
}

// The gradient of the distance: where the reference has a unique nearest point, its own direction to it.
Point reference_normal(const Shape& shape, const Point& p) {
    if (shape.kind == LKS_SHAPE_PLANE) {
        return {0, 1, 0};
    }
    Point offset = p;
    if (shape.kind == LKS_SHAPE_CAPSULE) {
        const Real h = from_coordinate(shape.half_length);
        offset.y -= std::fmax(-h, std::fmin(h, p.y));
    } else if (shape.kind == LKS_SHAPE_BOX) {
        const Point h = to_point(shape.half_extents);
        const auto beyond = [](Real a, Real extent) { return a - std::fmax(-extent, std::fmin(extent, a)); };
        offset = {beyond(p.x, h.x), beyond(p.y, h.y), beyond(p.z, h.z)};
        if (offset.length() == 0) {
            const Real q[3] = {std::fabs(p.x) - h.x, std::fabs(p.y) - h.y, std::fabs(p.z) - h.z};
            const auto sign = [](Real a) { return a < 0 ? Real(-1) : Real(1); };
            if (q[0] >= q[1] && q[0] >= q[2]) {
                return {sign(p.x), 0, 0};
            }
            return q[1] >= q[2] ? Point{0, sign(p.y), 0} : Point{0, 0, sign(p.z)};
        }
    }
    return offset * (1 / offset.length());
}

void check_kind(std::uint32_t kind) {
    Dice dice(7 + kind);
    Real worst_distance = 0, worst_normal = 0, worst_length = 0;
    for (int sample = 0; sample < 1000000; ++sample) {
        const Shape shape = random_shape(dice, kind);
        const Real margin = sample % 2 == 0 ? 0 : dice.between(0, 0.5L);
        const lks::fixed::Vec3 raw = coordinates(dice.in_cube(std::pow(Real(10), dice.between(-3, 1))));
        const std::int64_t raw_margin = coordinate(margin);
        const SurfacePoint found = lks::nearest_surface(shape, raw, raw_margin);
        const Point p = to_point(raw);
        const Real expected = reference_distance(shape, p, from_coordinate(raw_margin));
        worst_distance = std::fmax(worst_distance, std::fabs(from_coordinate(found.distance) - expected));
        const Point normal = to_point(found.normal);
        const Point difference = normal - reference_normal(shape, p);
        worst_normal = std::fmax(worst_normal, difference.length());
        worst_length = std::fmax(worst_length, std::fabs(normal.length() - 1));
        if (lks::distance_only(shape, raw, raw_margin) != found.distance) {
            FAIL("distance_only differs from nearest_surface");
        }
    }
    MESSAGE("shape " << kind << ": distance " << double(worst_distance) << " m, normal "
                     << double(worst_normal));
    CHECK(worst_distance <= 1e-15L);
    CHECK(worst_normal <= 3e-9L);
    CHECK(worst_length <= 3e-9L);
}

template <lks_shape_kind kind>
void check_beyond(std::uint64_t seed) {
    Dice dice(seed);
    int missed = 0, far = 0;
    for (int sample = 0; sample < 200000; ++sample) {
        const Shape shape = random_shape(dice, kind);
        const lks::fixed::Vec3 raw = coordinates(dice.in_cube(10));
        const std::int64_t margin = coordinate(dice.between(0, 0.1L));
        const std::int64_t reach = coordinate(dice.between(0, 4));
        const std::int64_t distance = lks::distance_only(shape, raw, margin);
        const bool beyond = lks::is_beyond<kind>(shape, raw, margin, reach);
        if (beyond && distance < reach) {
            FAIL("is_beyond rejects what is within reach");
        }
        if (distance >= reach + one / 1000000) {
            ++far;
            missed += beyond ? 0 : 1;
        }
    }
    CHECK(far > 10000);
    CHECK(missed == 0);
}

} // namespace

TEST_CASE("collide: the distance to every shape is exact to 1e-15 m and the normal to 3e-9") {
    check_kind(LKS_SHAPE_PLANE);
    check_kind(LKS_SHAPE_SPHERE);
    check_kind(LKS_SHAPE_CAPSULE);
    check_kind(LKS_SHAPE_BOX);
}

TEST_CASE("collide: the quick test never rejects what is within reach, and misses less than a micrometre") {
    check_beyond<LKS_SHAPE_PLANE>(1);
    check_beyond<LKS_SHAPE_SPHERE>(2);
    check_beyond<LKS_SHAPE_CAPSULE>(3);
    check_beyond<LKS_SHAPE_BOX>(4);
}

TEST_CASE("collide: where the nearest point is not unique, the documented direction is taken") {
    const auto check = [](const Shape& shape, const lks::fixed::Vec3& p, std::int64_t distance,
                          std::int32_t x, std::int32_t y, std::int32_t z) {
        const SurfacePoint found = lks::nearest_surface(shape, p, one / 16);
        CHECK(found.distance == distance - one / 16);
        CHECK(found.normal == lks::fixed::Direction{x, y, z});
    };
    check(sphere(0.5L), {0, 0, 0}, -one / 2, 0, unit, 0);
    check(capsule(0.25L, 1), {0, 0, 0}, -one / 4, unit, 0, 0);
    check(capsule(0.25L, 1), {0, one, 0}, -one / 4, unit, 0, 0);
    check(capsule(0.25L, 1), {0, one + 8, 0}, 8 - one / 4, 0, unit, 0);
    check(box(1, 1, 1), {0, 0, 0}, -one, unit, 0, 0);
    check(box(2, 1, 1), {0, 0, 0}, -one, 0, unit, 0);
    check(box(2, 2, 1), {0, 0, 0}, -one, 0, 0, unit);
    check(box(1, 1, 1), {-one / 2, one / 2, one / 2}, -one / 2, -unit, 0, 0);
    check(box(1, 1, 1), {0, -one / 2, -one / 2}, -one / 2, 0, -unit, 0);
    check(box(1, 1, 1), {one, one, one}, 0, unit, 0, 0);
    check(box(1, 1, 1), {0, one, 0}, 0, 0, unit, 0);
}

TEST_CASE("collide: distances are defined for all 64-bit points and never too large") {
    Dice dice(11);
    const Shape shapes[] = {plane(), sphere(30), capsule(30, 30), box(30, 30, 30), sphere(0.001L)};
    const std::int64_t edges[] = {
        INT64_MIN, INT64_MAX, INT64_MIN + 1, 0, lks::coordinate_limit, -lks::coordinate_limit};
    for (const Shape& shape : shapes) {
        for (int sample = 0; sample < 20000; ++sample) {
            const auto any = [&] { return dice.below(2) == 0 ? edges[dice.below(6)] : dice.any(); };
            const lks::fixed::Vec3 p = {any(), any(), any()};
            const SurfacePoint found = lks::nearest_surface(shape, p, one);
            const Real exact = reference_distance(shape, to_point(p), 1);
            // A plane's distance saturates below -128 m.
            REQUIRE(from_coordinate(found.distance) <= std::fmax(exact + 1e-12L, Real(-128)));
            const bool far = exact > 64;
            REQUIRE((!far || found.distance > 0));
        }
    }
}

TEST_CASE("collide: the bounding radius contains the shape and is no larger") {
    CHECK(lks::bounding_radius(sphere(2), one) == 3 * one);
    CHECK(lks::bounding_radius(capsule(2, 5), one) == 8 * one);
    const std::int64_t radius = lks::bounding_radius(box(3, 4, 12), one);
    CHECK(radius >= 14 * one);
    CHECK(radius <= 14 * one + 2);
    CHECK(lks::bounding_radius(plane(), one) == INT64_MAX);
}
