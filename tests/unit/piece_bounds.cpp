// How large shapes are along the axes of the world, and which of them pass each other by, against their
// corners and against places on their way in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "rigid/piece_bounds.h"
#include "rigid_samples.h"
#include "support/numbers.h"

using namespace lks;
using fixed::Vec3;
using lks::test::any_orientation;

namespace {

Piece any_piece(test::Random& random, std::uint32_t kind) {
    Piece piece{};
    piece.kind = kind;
    const auto length = [&] { return 1 + std::abs(random.any_signed(world_fraction_bits)); };
    if (kind == LKS_SHAPE_BOX) {
        piece.half_extents = {length(), length(), length()};
    } else {
        piece.radius = length();
        piece.half_length = kind == LKS_SHAPE_CAPSULE ? length() : 0;
    }
    piece.axes = fixed::to_matrix(narrow(any_orientation(random)));
    return piece;
}

// Half its size along an axis of the world, by its corners or by the ends of its segment.
double farthest(const Piece& piece, int axis) {
    const double e[3] = {support::metres(piece.half_extents.x),
                         support::metres(piece.half_extents.y) + support::metres(piece.half_length),
                         support::metres(piece.half_extents.z)};
    double most = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double place = 0;
        for (int i = 0; i < 3; ++i) {
            place += ((corner >> i & 1) != 0 ? 1 : -1) * e[i] * double(piece.axes.m[axis][i]) * 0x1p-30;
        }
        most = std::max(most, place);
    }
    return most + support::metres(piece.radius);
}

} // namespace

TEST_CASE("extents hold a shape, and hardly more") {
    test::Random random(31);
    for (int i = 0; i < 30000; ++i) {
        const std::uint32_t kinds[] = {LKS_SHAPE_BOX, LKS_SHAPE_CAPSULE, LKS_SHAPE_SPHERE};
        const Piece piece = any_piece(random, kinds[i % 3]);
        const Vec3 size = extent(piece);
        const std::int64_t sizes[3] = {size.x, size.y, size.z};
        for (int axis = 0; axis < 3; ++axis) {
            const double more = support::metres(sizes[axis]) - farthest(piece, axis);
            CHECK(more > -1e-12);
            CHECK(more < 1e-8);
        }
    }
}

TEST_CASE("what passes by is never within the room on its way, and all that moves apart along an axis does") {
    test::Random random(32);
    int passed = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3 between = test::any_vector(random, 50);
        const Vec3 way = test::any_vector(random, 50);
        const auto half = [&] { return std::abs(random.any_signed(49)); };
        const Vec3 room{half(), half(), half()};
        const double d[3] = {double(between.x), double(between.y), double(between.z)};
        const double w[3] = {double(way.x), double(way.y), double(way.z)};
        const double r[3] = {double(room.x), double(room.y), double(room.z)};
        bool within = false; // at some of the places
        bool apart = false;  // on all of the way, along one axis
        for (int axis = 0; axis < 3; ++axis) {
            apart = apart || std::min(d[axis], d[axis] + w[axis]) > r[axis] ||
                    std::max(d[axis], d[axis] + w[axis]) < -r[axis];
        }
        for (int step = 0; step <= 64; ++step) {
            const auto inside = [&](int axis) { return std::abs(d[axis] + w[axis] * step / 64) < r[axis]; };
            within = within || (inside(0) && inside(1) && inside(2));
        }
        const bool passes = passes_by(between, way, room);
        CHECK_FALSE((passes && within));
        CHECK(passes == apart);
        passed += passes ? 1 : 0;
    }
    CHECK(passed > 10000);
    CHECK(passed < 90000);
}

TEST_CASE("ways beyond the range stop at its end") {
    const Vec3 none{0, 0, 0};
    const Vec3 room{1000, 1000, 1000};
    CHECK(passes_by({INT64_MAX, 0, 0}, {INT64_MAX, 0, 0}, room));
    CHECK(passes_by({INT64_MIN, 0, 0}, {INT64_MIN, 0, 0}, room));
    CHECK_FALSE(passes_by({INT64_MAX, 0, 0}, {INT64_MIN, 0, 0}, room));
    CHECK_FALSE(passes_by({1000, -1000, 0}, none, room));
    CHECK(passes_by({1001, 0, 0}, none, room));
    CHECK_FALSE(passes_by({1001, 0, 0}, {-1, 0, 0}, room));
}
