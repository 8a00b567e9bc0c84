// Masses and inertias of bodies against the formulas in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "rigid/inertia.h"
#include "support/numbers.h"

using namespace support;

namespace {

lks::BodyShape shape_of(std::uint32_t kind, double a, double b, double c) {
    lks::BodyShape shape{};
    shape.kind = kind;
    if (kind == LKS_SHAPE_BOX) {
        shape.half_extents = {fixed(a), fixed(b), fixed(c)};
    } else {
        shape.radius = fixed(a);
        shape.half_length = kind == LKS_SHAPE_CAPSULE ? fixed(b) : 0;
    }
    shape.rotation = lks::fixed::identity_rotation();
    shape.density = fixed(700.0);
    return shape;
}

double to_double(const lks::fixed::Scaled& value) {
    return std::ldexp(static_cast<double>(value.mantissa), value.exponent);
}

// A squared radius of gyration in m².
double gyration(const lks::MassProperties& p, std::int32_t entry) {
    return std::ldexp(static_cast<double>(entry), -30 + 2 * p.scale);
}

double inverse_gyration(const lks::MassProperties& p, std::int32_t entry) {
    return std::ldexp(static_cast<double>(entry), -30 + p.inverse_shift - 2 * p.scale);
}

void check_close(double a, double b, double relative) {
    INFO(a << " against " << b);
    CHECK(std::abs(a - b) <= relative * std::abs(b));
}

} // namespace

TEST_CASE("a sphere, a capsule and a box have the masses and inertias of the textbook") {
    const double pi = std::acos(-1.0);
    for (const double size : {0.002, 0.05, 0.5, 7.0, 29.0}) {
        const lks::BodyShape ball = shape_of(LKS_SHAPE_SPHERE, size, 0, 0);
        lks::MassProperties p = lks::mass_properties(&ball, 1);
        check_close(to_double(p.mass), 700 * 4 / 3.0 * pi * size * size * size, 1e-9);
        check_close(gyration(p, p.inertia.xx), 0.4 * size * size, 1e-7);
        check_close(inverse_gyration(p, p.inverse_inertia.yy), 1 / (0.4 * size * size), 1e-7);
        CHECK(p.round);

        const double h = 0.7 * size;
        const lks::BodyShape capsule = shape_of(LKS_SHAPE_CAPSULE, size, h, 0);
        p = lks::mass_properties(&capsule, 1);
        const double tube = pi * size * size * 2 * h;
        const double caps = 4 / 3.0 * pi * size * size * size;
        check_close(to_double(p.mass), 700 * (tube + caps), 1e-9);
        const double along = (tube * size * size / 2 + caps * 0.4 * size * size) / (tube + caps);
        const double across =
            (tube * (size * size / 4 + h * h / 3) + caps * (0.4 * size * size + h * h + 0.75 * h * size)) /
            (tube + caps);
        check_close(gyration(p, p.inertia.yy), along, 1e-7);
        check_close(gyration(p, p.inertia.zz), across, 1e-7);
        check_close(inverse_gyration(p, p.inverse_inertia.yy), 1 / along, 1e-6);
        CHECK_FALSE(p.round);

        const lks::BodyShape box = shape_of(LKS_SHAPE_BOX, size, size / 2, size / 3);
        p = lks::mass_properties(&box, 1);
        check_close(to_double(p.mass), 700 * 8 * size * size / 2 * size / 3, 1e-9);
        check_close(gyration(p, p.inertia.xx), (size * size / 4 + size * size / 9) / 3, 1e-7);
        check_close(inverse_gyration(p, p.inverse_inertia.zz), 3 / (size * size + size * size / 4), 1e-6);
    }
}

TEST_CASE("two balls on a line turn about their common centre, with the inertia of a dumb-bell") {
    lks::BodyShape shapes[2] = {shape_of(LKS_SHAPE_SPHERE, 0.1, 0, 0), shape_of(LKS_SHAPE_SPHERE, 0.1, 0, 0)};
    shapes[0].position = {fixed(-0.3), fixed(0.2), 0};
    shapes[1].position = {fixed(0.6), fixed(0.2), 0};
    shapes[1].density = fixed(1400.0);
    const lks::MassProperties p = lks::mass_properties(shapes, 2);
    check_close(metres(p.centre.x), 0.3, 1e-9);
    check_close(metres(p.centre.y), 0.2, 1e-9);
    const double spread = (0.6 * 0.6 + 2 * 0.3 * 0.3) / 3;
    check_close(gyration(p, p.inertia.xx), 0.004, 1e-6);
    check_close(gyration(p, p.inertia.yy), 0.004 + spread, 1e-6);
    CHECK(p.inertia.xy == 0);
}

TEST_CASE("a heavy ball with a light one far away is a point, which turns as one of some size") {
    Random random(11);
    int points = 0;
    for (int i = 0; i < 20000; ++i) {
        lks::BodyShape shapes[2];
        for (lks::BodyShape& shape : shapes) {
            shape =
                shape_of(LKS_SHAPE_SPHERE, std::exp(random.between(std::log(0.001), std::log(5.0))), 0, 0);
            shape.density = fixed(std::exp(random.between(std::log(0.001), std::log(100000.0))));
        }
        shapes[1].position = {fixed(random.between(-25, 25)), fixed(random.between(-15, 15)), 0};
        const lks::MassProperties p = lks::mass_properties(shapes, 2);
        REQUIRE(p.inverse_shift >= 0);
        REQUIRE(p.inverse_shift < 32);
        // Of a 256th of the unit at least, and no inverse of less than what is the same about all axes.
        const std::int32_t least = std::min({p.inertia.xx, p.inertia.yy, p.inertia.zz});
        REQUIRE(least > 0);
        REQUIRE(std::min({p.inverse_inertia.xx, p.inverse_inertia.yy, p.inverse_inertia.zz}) > 0);
        const double trace = std::ldexp(double(p.inertia.xx) + p.inertia.yy + p.inertia.zz, -30);
        REQUIRE(trace >= std::ldexp(2.9, -16));
        points += trace < std::ldexp(4, -16) ? 1 : 0;
    }
    CHECK(points > 1000);
}

TEST_CASE("the inverse of a tilted body's inertia undoes it") {
    lks::BodyShape shapes[3] = {shape_of(LKS_SHAPE_BOX, 0.4, 0.1, 0.2),
                                shape_of(LKS_SHAPE_CAPSULE, 0.1, 0.3, 0),
                                shape_of(LKS_SHAPE_SPHERE, 0.15, 0, 0)};
    shapes[1].position = {fixed(0.3), fixed(0.25), fixed(-0.1)};
    shapes[1].rotation = lks::fixed::normalise(lks::fixed::Rotation{1 << 28, 3 << 27, -(1 << 28), 1 << 30});
    shapes[2].position = {fixed(-0.35), fixed(-0.05), fixed(0.3)};
    const lks::MassProperties p = lks::mass_properties(shapes, 3);
    const lks::SymmetricMatrix& a = p.inertia;
    const lks::SymmetricMatrix& b = p.inverse_inertia;
    const double m[3][3] = {{double(a.xx), double(a.xy), double(a.xz)},
                            {double(a.xy), double(a.yy), double(a.yz)},
                            {double(a.xz), double(a.yz), double(a.zz)}};
    const double n[3][3] = {{double(b.xx), double(b.xy), double(b.xz)},
                            {double(b.xy), double(b.yy), double(b.yz)},
                            {double(b.xz), double(b.yz), double(b.zz)}};
    CHECK(a.xy != 0);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) {
                sum += std::ldexp(m[i][k] * n[k][j], -60 + p.inverse_shift);
            }
            CHECK(std::abs(sum - (i == j ? 1 : 0)) < 1e-6);
        }
    }
}
