// Contact points of shapes against distances that are sampled in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "collide/manifold.h"
#include "support/numbers.h"

using namespace support;

namespace {

double unit(Random& random) {
    return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

lks::fixed::Matrix3 random_axes(Random& random) {
    lks::fixed::Rotation q{};
    do {
        const auto part = [&] { return static_cast<std::int32_t>(random.next() >> 34) - (1 << 29); };
        q = {part(), part(), part(), part()};
    } while (q.x == 0 && q.y == 0);
    return lks::fixed::to_matrix(lks::fixed::normalise(q));
}

lks::Piece random_piece(Random& random, std::uint32_t kind, double spread) {
    lks::Piece piece{};
    piece.kind = kind;
    if (kind == LKS_SHAPE_BOX) {
        piece.half_extents = {fixed(0.05 + 0.5 * unit(random)), fixed(0.05 + 0.5 * unit(random)),
                              fixed(0.05 + 0.5 * unit(random))};
    } else {
        piece.radius = fixed(0.02 + 0.2 * unit(random));
        piece.half_length = kind == LKS_SHAPE_CAPSULE ? fixed(0.6 * unit(random)) : 0;
    }
    piece.centre = {fixed(spread * (unit(random) - 0.5)), fixed(spread * (unit(random) - 0.5)),
                    fixed(spread * (unit(random) - 0.5))};
    piece.axes = random_axes(random);
    return piece;
}

Vector axis(const lks::Piece& piece, int i) {
    return Vector{double(piece.axes.m[0][i]), double(piece.axes.m[1][i]), double(piece.axes.m[2][i])} *
           0x1p-30;
}

Vector centre(const lks::Piece& piece) {
    return {metres(piece.centre.x), metres(piece.centre.y), metres(piece.centre.z)};
}

// The nearest point of a piece's core to p.
Vector nearest(const lks::Piece& piece, const Vector& p) {
    const Vector d = p - centre(piece);
    if (piece.kind != LKS_SHAPE_BOX) {
        const double h = metres(piece.half_length);
        return centre(piece) + axis(piece, 1) * std::clamp(d.dot(axis(piece, 1)), -h, h);
    }
    const double e[3] = {metres(piece.half_extents.x), metres(piece.half_extents.y),
                         metres(piece.half_extents.z)};
    Vector out = centre(piece);
    for (int i = 0; i < 3; ++i) {
        out = out + axis(piece, i) * std::clamp(d.dot(axis(piece, i)), -e[i], e[i]);
    }
    return out;
}

// The distance of two cores: projecting in turn onto either converges, as both are convex.
double core_distance(const lks::Piece& a, const lks::Piece& b) {
    Vector p = centre(a);
    for (int i = 0; i < 4000; ++i) {
        p = nearest(a, nearest(b, p));
    }
    return (nearest(b, p) - p).length();
}

double least_separation(const lks::Manifold& manifold) {
    double least = 1e9;
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        least = std::min(least, metres(manifold.points[i].separation));
    }
    return least;
}

struct Tally {
    double worst = 0;
    int compared = 0;
};

// Only pairs whose cores are apart: there the distance says everything.
Tally compare(std::uint32_t kind_a, std::uint32_t kind_b, int rounds) {
    Random random(11 + kind_a * 7 + kind_b);
    Tally tally;
    for (int i = 0; i < rounds; ++i) {
        const lks::Piece a = random_piece(random, kind_a, 1.5);
        const lks::Piece b = random_piece(random, kind_b, 1.5);
        const double distance = core_distance(a, b);
        if (distance < 0.01) {
            continue;
        }
        lks::Manifold manifold{};
        lks::collide(a, b, LKS_FIXED(5), lks::no_side, manifold);
        REQUIRE(manifold.count >= 1);
        const double expected = distance - metres(a.radius) - metres(b.radius);
        tally.worst = std::max(tally.worst, std::abs(least_separation(manifold) - expected));
        ++tally.compared;
    }
    return tally;
}

} // namespace

TEST_CASE("spheres and capsules meet at their distance") {
    for (const std::uint32_t a : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE}) {
        for (const std::uint32_t b : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE}) {
            const Tally tally = compare(a, b, 300);
            INFO(a << " and " << b << ": " << tally.worst << " of " << tally.compared);
            CHECK(tally.compared > 200);
            CHECK(tally.worst < 2e-6);
        }
    }
}

TEST_CASE("spheres and capsules meet boxes at their distance, whichever comes first") {
    for (const std::uint32_t a : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE}) {
        const Tally tally = compare(a, LKS_SHAPE_BOX, 300);
        INFO(a << ": " << tally.worst << " of " << tally.compared);
        CHECK(tally.compared > 150);
        CHECK(tally.worst < 2e-6);
        const Tally turned = compare(LKS_SHAPE_BOX, a, 300);
        CHECK(turned.worst < 2e-6);
    }
}

TEST_CASE("boxes never seem to overlap where they are apart") {
    Random random(3);
    int apart = 0;
    for (int i = 0; i < 400; ++i) {
        const lks::Piece a = random_piece(random, LKS_SHAPE_BOX, 1.8);
        const lks::Piece b = random_piece(random, LKS_SHAPE_BOX, 1.8);
        const double distance = core_distance(a, b);
        lks::Manifold manifold{};
        lks::collide(a, b, LKS_FIXED(5), lks::no_side, manifold);
        if (manifold.count == 0) {
            // Beside each other: nothing of either face is over the other.
            CHECK(distance > 0.01);
            continue;
        }
        if (distance > 0.01) {
            ++apart;
            // Along the axis of least overlap. What is over a face may be further than two edges are that are
            // not, so it is near boxes that count.
            if (distance < 0.05) {
                CHECK(least_separation(manifold) < 1.5 * distance);
            }
            CHECK(least_separation(manifold) > -1e-6);
        } else {
            CHECK(least_separation(manifold) < 0.011);
        }
    }
    CHECK(apart > 100);
}

TEST_CASE("a box that lies on a box touches it in four points, on a plane too") {
    Random random(9);
    lks::Piece low = random_piece(random, LKS_SHAPE_BOX, 0);
    low.axes = lks::fixed::to_matrix(lks::fixed::identity_rotation());
    low.half_extents = {fixed(1.0), fixed(0.5), fixed(1.0)};
    low.centre = {0, 0, 0};
    lks::Piece high = low;
    high.half_extents = {fixed(0.25), fixed(0.25), fixed(0.25)};
    high.centre = {fixed(0.1), fixed(0.751), fixed(-0.2)};
    lks::Manifold manifold{};
    lks::collide(low, high, fixed(0.01), lks::no_side, manifold);
    REQUIRE(manifold.count == 4);
    CHECK(manifold.normal.y == 1 << 30);
    for (const lks::ManifoldPoint& point : manifold.points) {
        CHECK(std::abs(metres(point.separation) - 0.001) < 1e-8);
        CHECK(std::abs(std::abs(metres(point.core_b.x) - 0.1) - 0.25) < 1e-8);
    }
    lks::Piece plane{};
    plane.kind = LKS_SHAPE_PLANE;
    plane.axes = low.axes;
    plane.centre = {0, fixed(0.5), 0};
    lks::collide(high, plane, fixed(0.01), lks::no_side, manifold);
    REQUIRE(manifold.count == 4);
    CHECK(manifold.normal.y == -(1 << 30));
}

TEST_CASE("equal boxes upon each other touch at their corners, a hair aside and tilted by one too") {
    Random random(12);
    lks::Piece low{};
    low.kind = LKS_SHAPE_BOX;
    low.half_extents = {fixed(0.5), fixed(0.5), fixed(0.5)};
    low.axes = lks::fixed::to_matrix(lks::fixed::identity_rotation());
    for (int round = 0; round < 2000; ++round) {
        const double hair = std::ldexp(1.0, -14 - round % 24);
        const auto some = [&](double size) { return size * (2 * unit(random) - 1); };
        const auto turn = [&] { return static_cast<std::int32_t>(some(0x1p30 * hair)); };
        lks::Piece high = low;
        high.centre = {fixed(some(hair)), fixed(1 - 0.001 * unit(random)), fixed(some(hair))};
        high.axes = lks::fixed::to_matrix(
            lks::fixed::normalise(lks::fixed::Rotation{turn(), turn(), turn(), 1 << 30}));
        lks::Manifold manifold{};
        lks::collide(low, high, fixed(0.01), lks::no_side, manifold);
        REQUIRE(manifold.count == 4);
        double sum_x = 0;
        double sum_z = 0;
        for (const lks::ManifoldPoint& point : manifold.points) {
            const double x = metres(point.core_a.x);
            const double z = metres(point.core_a.z);
            CHECK(std::abs(std::abs(x) - 0.5) < 3e-4);
            CHECK(std::abs(std::abs(z) - 0.5) < 3e-4);
            sum_x += x;
            sum_z += z;
        }
        CHECK(std::abs(sum_x) < 1e-3);
        CHECK(std::abs(sum_z) < 1e-3);
    }
}

std::int32_t units(double part) {
    return static_cast<std::int32_t>(std::lround(part * 0x1p30));
}

// A capsule over a box of one metre, its axis in the plane of x and y, turned down by so many degrees towards
// +x.
struct OverEdge {
    lks::Piece capsule{};
    lks::Piece box{};
    lks::Manifold manifold{};

    OverEdge(double x, double height, double degrees) {
        box.kind = LKS_SHAPE_BOX;
        box.half_extents = {fixed(0.5), fixed(0.5), fixed(0.5)};
        box.axes = lks::fixed::to_matrix(lks::fixed::identity_rotation());
        capsule.kind = LKS_SHAPE_CAPSULE;
        capsule.radius = fixed(0.05);
        capsule.half_length = fixed(0.3);
        capsule.centre = {fixed(x), fixed(height), 0};
        const double half = (-90 - degrees) * M_PI / 360;
        capsule.axes = lks::fixed::to_matrix({0, 0, units(std::sin(half)), units(std::cos(half))});
    }

    // Of the point with that feature; infinite where there is none.
    double separation(std::uint32_t feature) {
        manifold = {};
        lks::collide(capsule, box, fixed(0.2), lks::no_side, manifold);
        for (std::uint32_t i = 0; i < manifold.count; ++i) {
            if (manifold.points[i].feature == feature) {
                return metres(manifold.points[i].separation);
            }
        }
        return HUGE_VAL;
    }
};

TEST_CASE("a capsule that hangs over a box's edge is held at its other end, too") {
    for (const double degrees : {0.5, 2.0, 5.0, 10.0}) {
        const double sine = std::sin(degrees * M_PI / 180);
        const double cosine = std::cos(degrees * M_PI / 180);
        // The axis passes the edge at 5.2 cm, so that its nearest point is beside the box.
        OverEdge over(0.5, 0.5 + 0.052 / cosine, degrees);
        const double at_edge = over.separation(0);
        CHECK(std::abs(at_edge - 0.002) < 1e-6);
        const double height = 0.052 / cosine + 0.3 * sine; // of the other end over the face
        CHECK(std::abs(over.separation(1) - (cosine * height - 0.05)) < 1e-6);
        CHECK(over.manifold.count == 2);
        CHECK(std::abs(over.manifold.normal.y * 0x1p-30 + cosine) < 1e-6);
    }
    // What leans by more than 26 degrees is a touch at the edge alone.
    OverEdge steep(0.5, 0.56, 40);
    CHECK(steep.separation(0) < 0.01);
    CHECK(steep.manifold.count == 1);
}

TEST_CASE("a capsule along a box's edge touches it at both ends of what they share") {
    OverEdge along(0.52, 0.55, 0);
    const std::int32_t half = units(std::sqrt(0.5)); // a quarter turn about x
    along.capsule.axes = lks::fixed::to_matrix({half, 0, 0, half});
    along.capsule.centre.z = fixed(0.3); // from 0 to 0.6, and the box ends at 0.5
    const double distance = std::hypot(0.02, 0.05) - 0.05;
    CHECK(std::abs(along.separation(1) - distance) < 1e-6);
    CHECK(std::abs(along.separation(2) - distance) < 1e-6);
    REQUIRE(along.manifold.count == 3); // and in the middle
    CHECK(std::abs(metres(along.manifold.points[1].core_a.z - along.manifold.points[0].core_a.z)) > 0.499);
}

TEST_CASE("shapes in exactly the same place have a normal and an overlap") {
    Random random(21);
    for (const std::uint32_t kind : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
        for (const std::uint32_t other : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
            lks::Piece a = random_piece(random, kind, 0);
            lks::Piece b = random_piece(random, other, 0);
            b.centre = a.centre;
            b.axes = a.axes;
            lks::Manifold manifold{};
            lks::collide(a, b, 0, lks::no_side, manifold);
            REQUIRE(manifold.count >= 1);
            CHECK(least_separation(manifold) < 0);
            const double length =
                std::hypot(double(manifold.normal.x), double(manifold.normal.y), double(manifold.normal.z)) *
                0x1p-30;
            CHECK(std::abs(length - 1) < 1e-8);
        }
    }
}

TEST_CASE("what was pressed past a box's middle, or through it, is kept on the side that it came from") {
    Random random(22);
    for (const std::uint32_t kind : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
        for (int round = 0; round < 400; ++round) {
            lks::Piece wall = random_piece(random, LKS_SHAPE_BOX, 0);
            wall.half_extents = {fixed(0.025), fixed(5), fixed(5)};
            lks::Piece limb = random_piece(random, kind, 0);
            const auto place = [&](double height) {
                const Vector p = centre(wall) + axis(wall, 0) * height;
                limb.centre = {fixed(p.x), fixed(p.y), fixed(p.z)};
            };
            const auto height_along = [&](const lks::fixed::Direction& normal) { // on the wall's axis
                return axis(wall, 0).dot(Vector{double(normal.x), double(normal.y), double(normal.z)}) *
                       0x1p-30;
            };
            lks::Manifold before{};
            place(0.9);
            const bool wall_first = round % 2 == 1;
            const lks::Piece& a = wall_first ? wall : limb;
            const lks::Piece& b = wall_first ? limb : wall;
            lks::collide(a, b, LKS_FIXED(1), lks::no_side, before);
            REQUIRE(std::abs(height_along(before.normal) - (wall_first ? 1 : -1)) < 1e-6);
            const double least_before = least_separation(before);
            for (const double height : {-0.01, -0.1, -0.9}) {
                place(height);
                lks::Manifold alone{};
                lks::collide(a, b, LKS_FIXED(1), lks::no_side, alone);
                CHECK(height_along(alone.normal) * height_along(before.normal) < 0);
                lks::Manifold now{};
                lks::collide(a, b, LKS_FIXED(1), before.normal, now);
                REQUIRE(now.count >= 1);
                CHECK(height_along(now.normal) * height_along(before.normal) > 0.99);
                // As much deeper as it went.
                CHECK(std::abs(least_separation(now) - least_before - (height - 0.9)) < 1e-3);
            }
        }
    }
}
