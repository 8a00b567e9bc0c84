// Contact points of shapes against those of the floating-point reference solver, at random.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "collide/manifold.h"
#include "reference/rigid_meeting.h"
#include "rigid/meeting.h"
#include "support/numbers.h"

using namespace support;

namespace {

double unit(Random& random) {
    return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

lks::fixed::Vec3 random_vector(Random& random, double from, double to) {
    const auto part = [&] { return fixed(from + (to - from) * unit(random)); };
    return {part(), part(), part()};
}

lks::fixed::Rotation random_rotation(Random& random) {
    const auto part = [&] { return static_cast<std::int32_t>(random.next() >> 34) - (1 << 29); };
    return lks::fixed::normalise(lks::fixed::Rotation{part(), part(), part(), part() | 1});
}

lks::Piece random_piece(Random& random, std::uint32_t kind) {
    lks::Piece piece{};
    piece.kind = kind;
    if (kind == LKS_SHAPE_BOX) {
        piece.half_extents = random_vector(random, 0.05, 0.5);
    } else if (kind != LKS_SHAPE_PLANE) {
        piece.radius = fixed(0.02 + 0.2 * unit(random));
        piece.half_length = kind == LKS_SHAPE_CAPSULE ? fixed(0.05 + 0.5 * unit(random)) : 0;
    }
    piece.centre = random_vector(random, -0.4, 0.4);
    piece.axes = lks::fixed::to_matrix(random_rotation(random));
    return piece;
}

// Turned by a degree.
lks::fixed::Matrix3 nearly(Random& random, const lks::fixed::Matrix3& axes) {
    const auto part = [&] { return (static_cast<std::int32_t>(random.next() >> 34) - (1 << 29)) >> 6; };
    const lks::fixed::Matrix3 turn =
        lks::fixed::to_matrix(lks::fixed::normalise(lks::fixed::Rotation{part(), part(), part(), 1 << 29}));
    lks::fixed::Matrix3 turned{};
    for (int i = 0; i < 3; ++i) {
        const lks::fixed::Direction axis = lks::fixed::rotate(turn, lks::manifold_detail::axis(axes, i));
        turned.m[0][i] = axis.x;
        turned.m[1][i] = axis.y;
        turned.m[2][i] = axis.z;
    }
    return turned;
}

Vector metres_of(const lks::fixed::Vec3& v) {
    return {metres(v.x), metres(v.y), metres(v.z)};
}

Vector units_of(const lks::fixed::Direction& d) {
    return Vector{double(d.x), double(d.y), double(d.z)} * 0x1p-30;
}

template <typename Scalar>
reference::Piece<Scalar> same_piece(const lks::Piece& from) {
    using Vec = reference::Vector3<Scalar>;
    reference::Piece<Scalar> piece{from.kind,
                                   static_cast<Scalar>(metres(from.radius)),
                                   static_cast<Scalar>(metres(from.half_length)),
                                   Vec(metres_of(from.half_extents)),
                                   Vec(metres_of(from.centre)),
                                   {}};
    for (int i = 0; i < 3; ++i) {
        const auto& row = from.axes.m[i];
        piece.axes.rows[i] = Vec(Vector{double(row[0]), double(row[1]), double(row[2])} * 0x1p-30);
    }
    return piece;
}

// Of the normals and the points from the reference's; infinite where the points are others.
template <typename Scalar>
double distance_of(const lks::Manifold& fixed_point, const reference::Manifold<Scalar>& expected) {
    double off = expected.points.size() == fixed_point.count ? 0 : INFINITY;
    if (fixed_point.count != 0) {
        off = std::max(off, (units_of(fixed_point.normal) - expected.normal.widened()).length());
    }
    for (std::size_t i = 0; i < fixed_point.count && off < INFINITY; ++i) {
        const lks::ManifoldPoint& p = fixed_point.points[i];
        const reference::ManifoldPoint<Scalar>& q = expected.points[i];
        off = std::max({off, (metres_of(p.core_a) - q.core_a.widened()).length(),
                        (metres_of(p.core_b) - q.core_b.widened()).length(),
                        std::abs(metres(p.separation) - static_cast<double>(q.separation)),
                        p.feature == q.feature ? 0.0 : double{INFINITY}});
    }
    return off;
}

template <typename Scalar>
double distance_of(const lks::Manifold& fixed_point, const lks::Piece& a, const lks::Piece& b,
                   std::int64_t margin, const lks::fixed::Direction& side) {
    return distance_of(fixed_point, reference::touch(same_piece<Scalar>(a), same_piece<Scalar>(b),
                                                     static_cast<Scalar>(metres(margin)),
                                                     reference::Vector3<Scalar>(units_of(side))));
}

// After so many of 512 parts of its way.
lks::Piece after_part(lks::Piece piece, const lks::fixed::Vec3& way, std::int64_t part) {
    piece.centre =
        piece.centre + lks::fixed::Vec3{way.x * part / 512, way.y * part / 512, way.z * part / 512};
    return piece;
}

// The least gap on the way, and how far along it is.
struct Closest {
    std::int64_t gap = INT64_MAX;
    std::int64_t first_deep = -1; // of 512 parts of the way, the first with less than `depth`
};
Closest closest_on_way(const lks::Piece& a, const lks::Piece& b, const lks::fixed::Vec3& way,
                       std::int64_t margin, std::int64_t depth) {
    Closest closest;
    for (std::int64_t part = 0; part <= 512; ++part) {
        const lks::Piece moved = after_part(b, way, part);
        lks::Manifold found{};
        lks::collide(a, moved, margin, lks::no_side, found);
        closest.gap = std::min(closest.gap, found.gap);
        if (closest.first_deep < 0 && found.gap < -depth) {
            closest.first_deep = part;
        }
    }
    return closest;
}

} // namespace

TEST_CASE("contact points of any two shapes are those of the reference within 2e-5 m, mostly 1e-9") {
    Random random(17);
    const char* const names[] = {"plane", "sphere", "capsule", "box"};
    for (const std::uint32_t kind_a : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
        for (const std::uint32_t kind_b :
             {LKS_SHAPE_PLANE, LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
            constexpr int pairs = 20000;
            int points = 0;
            double worst = 0, sum = 0, single_sum = 0;
            for (int i = 0; i < pairs; ++i) {
                const lks::Piece a = random_piece(random, kind_a);
                lks::Piece b = random_piece(random, kind_b);
                if (i % 4 == 0) {
                    b.axes = nearly(random, a.axes);
                }
                const std::int64_t margin = fixed(0.1 * unit(random));
                lks::Manifold other{};
                lks::collide(random_piece(random, kind_a), b, margin, lks::no_side, other);
                const lks::fixed::Direction side = i % 2 == 0 ? lks::no_side : other.normal;
                lks::Manifold found{};
                lks::collide(a, b, margin, side, found);
                const double off = distance_of<double>(found, a, b, margin, side);
                const double single_off = distance_of<float>(found, a, b, margin, side);
                points += static_cast<int>(found.count);
                worst = std::max(worst, off);
                if (single_off < 0.001) { // the same points
                    sum += off;
                    single_sum += single_off;
                }
            }
            std::printf(
                "%-7s and %-7s %5d points, %.1e m off at worst, %.1e on the average; float32 %.0f times "
                "as far\n",
                names[kind_a], names[kind_b], points, worst, sum / pairs, single_sum / sum);
            INFO("shapes " << kind_a << " and " << kind_b);
            // Where two segments are nearest is the less certain the less they cross.
            const bool segments = kind_a == LKS_SHAPE_CAPSULE && kind_b == LKS_SHAPE_CAPSULE;
            CHECK(points > 2000);
            CHECK(worst <= (segments ? 2e-5 : 1e-6));
            CHECK(sum / pairs <= 5e-9);
            CHECK(single_sum >= 25 * sum);
        }
    }
}

TEST_CASE("contact points of shapes that move are those of the reference but in 1 of 1000 pairs") {
    Random random(18);
    for (const std::uint32_t kind_a : {LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
        constexpr int pairs = 20000;
        int moved = 0, others = 0;
        double worst = 0;
        for (int i = 0; i < pairs; ++i) {
            lks::Piece a = random_piece(random, kind_a);
            lks::Piece b = random_piece(random, LKS_SHAPE_BOX);
            if (i % 4 == 0) {
                b.axes = nearly(random, a.axes);
            }
            b.centre = random_vector(random, -1, 1);
            if (i % 2 == 1) {
                std::swap(a, b);
            }
            const lks::fixed::Vec3 way = random_vector(random, -0.5, 0.5);
            const std::int64_t margin = fixed(1.6);
            lks::Manifold here{}, found{};
            lks::collide(a, b, margin, lks::no_side, here);
            lks::collide_on_way(a, b, way, margin, lks::no_side, found);
            moved += here.normal.x != found.normal.x ? 1 : 0;
            const reference::Piece<double> same_a = same_piece<double>(a);
            const reference::Piece<double> same_b = same_piece<double>(b);
            const reference::Meeting<double> meeting(
                same_a, same_b, reference::Vector3<double>(metres_of(way)), metres(margin), {});
            const double off = distance_of(found, meeting.found());
            // Between two of the places that are looked at roundings may choose.
            others += off > 1e-4 ? 1 : 0;
            worst = std::max(worst, off > 1e-4 ? 0 : off);
        }
        INFO("shape " << kind_a << ": " << others << " others, " << worst << " m off, " << moved << " moved");
        CHECK(moved > pairs / 20);
        CHECK(others <= pairs / 1000);
        CHECK(worst < 1e-5);
    }
}

TEST_CASE("what moves touches with the normal that it meets with, and what passes is not pushed") {
    Random random(19);
    const std::int64_t depth = fixed(0.001);
    int passing = 0, meeting = 0, others = 0;
    for (int i = 0; i < 6000; ++i) {
        lks::Piece a = random_piece(random, i % 3 == 0 ? LKS_SHAPE_BOX : LKS_SHAPE_CAPSULE);
        const lks::Piece b = random_piece(random, LKS_SHAPE_BOX);
        a.centre = random_vector(random, -1, 1);
        const lks::fixed::Vec3 way = random_vector(random, -0.5, 0.5);
        const std::int64_t margin = fixed(1.6);
        lks::Manifold here{}, found{};
        lks::collide(a, b, margin, lks::no_side, here);
        if (here.gap < 0) {
            continue;
        }
        lks::collide_on_way(a, b, way, margin, lks::no_side, found);
        const std::int64_t closing = -lks::fixed::dot(found.normal, way);
        const Closest closest = closest_on_way(a, b, way, margin, depth);
        if (closest.gap >= 0) {
            ++passing;
            for (std::uint32_t point = 0; point < found.count; ++point) {
                CHECK(found.points[point].separation - closing > -depth);
            }
        } else if (closest.gap < -2 * depth) {
            ++meeting;
            // Where it has just gone in that far.
            const lks::Piece moved = after_part(b, way, closest.first_deep);
            lks::Manifold there{};
            lks::collide(a, moved, margin, lks::no_side, there);
            CHECK(closing > 0);
            others += (units_of(there.normal) - units_of(found.normal)).length() > 0.2 ? 1 : 0;
        }
    }
    CHECK(passing > 300);
    CHECK(meeting > 300);
    // Two sides that they go into at once.
    CHECK(others <= meeting / 200);
}
