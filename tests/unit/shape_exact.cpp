// The nearest points of solid shapes, which every contact of particles begins with, against squares in
// integers that have no limit: at the ends of all ranges, and next to every place where a formula changes.
#include "collide/shape.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>

#include "big_integer.h"
#include "fixed_samples.h"

using namespace lks;
using fixed::Vec3;

namespace {

using B = test::Big<8>;

B big(std::int64_t value) {
    return B::from_i64(value);
}

constexpr std::int64_t far_edge = shape_detail::far_edge;
// A shape reaches 61 m at most.
constexpr std::int64_t greatest_size = coordinate_one * 20;

// A micrometre to twenty metres, all lengths alike.
std::int64_t any_size(test::Random& random) {
    const auto least = std::int64_t{1} << (coordinate_fraction_bits - 20);
    return std::clamp(static_cast<std::int64_t>(random.any_magnitude(61)), least, greatest_size);
}

Shape any_shape(test::Random& random, std::uint32_t kind) {
    Shape shape{};
    shape.kind = kind;
    shape.radius = kind == LKS_SHAPE_BOX ? 0 : any_size(random);
    shape.half_length = kind == LKS_SHAPE_CAPSULE ? any_size(random) : 0;
    if (kind == LKS_SHAPE_BOX) {
        shape.half_extents = {any_size(random), any_size(random), any_size(random)};
    }
    return shape;
}

// Next to a face, the middle, the edge of what is looked at and the ends of the range, or anywhere.
std::int64_t any_place(test::Random& random, std::int64_t face) {
    const std::int64_t places[] = {0, face, far_edge, coordinate_limit, INT64_MAX - (std::int64_t{1} << 40)};
    const std::int64_t size = random.below(2) == 0
                                  ? places[random.below(5)] + random.any_signed(random.below(2) == 0 ? 2 : 40)
                                  : random.any_signed(62);
    return random.below(2) == 0 ? size : -size;
}

Vec3 any_point(test::Random& random, const Shape& shape) {
    const Vec3& h = shape.half_extents;
    const bool capsule = shape.kind == LKS_SHAPE_CAPSULE;
    Vec3 p{any_place(random, h.x), any_place(random, capsule ? shape.half_length : h.y),
           any_place(random, h.z)};
    if (random.below(3) == 0) {
        p.x = random.any_signed(30);
    }
    if (random.below(3) == 0) {
        p.z = random.any_signed(30);
    }
    if (random.below(16) == 0) {
        p.x = p.z = 0; // on a capsule's axis
        p.y = random.below(2) == 0 ? 0 : p.y;
    }
    return p;
}

B beyond(std::int64_t value, std::int64_t extent) {
    return value > extent ? big(value) - big(extent) : value < -extent ? big(value) + big(extent) : B{};
}

// From the nearest point of the core.
struct Offset {
    B x, y, z;

    B squared() const { return x * x + y * y + z * z; }
    bool is_none() const { return x.is_zero() && y.is_zero() && z.is_zero(); }
};

Offset offset_from_core(const Shape& shape, const Vec3& p) {
    const Vec3& h = shape.half_extents;
    return {beyond(p.x, h.x), beyond(p.y, shape.kind == LKS_SHAPE_CAPSULE ? shape.half_length : h.y),
            beyond(p.z, h.z)};
}

// a·√s ≤ b.
bool is_at_most(const B& a, const B& s, const B& b) {
    if (a.negative() != b.negative()) {
        return a.negative();
    }
    const B left = a * a * s;
    const B right = b * b;
    return a.negative() ? left >= right : left <= right;
}

// Whether a component of the normal is within 1.3 units of 2^-30 of offset over √squared.
bool is_near(std::int32_t component, const B& offset, const B& squared) {
    const B ten_exact = offset * B::power_of_two(direction_fraction_bits) * big(10);
    const B ten_found = big(std::int64_t{10} * component);
    return is_at_most(ten_found - big(13), squared, ten_exact) &&
           is_at_most(-(ten_found + big(13)), squared, -ten_exact);
}

// What collide/shape.h states: 1e-15 m and a unit.
constexpr std::int64_t greatest_error = 72 + 1;

bool is_exact_outside(const Offset& offset, std::int64_t radius, const SurfacePoint& found) {
    const B squared = offset.squared();
    const B length = big(found.distance) + big(radius);
    const B least = length - big(greatest_error);
    const B most = length + big(greatest_error);
    return (least.negative() || least * least <= squared) && most * most >= squared &&
           is_near(found.normal.x, offset.x, squared) && is_near(found.normal.y, offset.y, squared) &&
           is_near(found.normal.z, offset.z, squared);
}

// On the core: of a box, the nearest of its faces; else the radius.
bool is_exact_inside(const Shape& shape, const Vec3& p, std::int64_t radius, const SurfacePoint& found) {
    if (shape.kind != LKS_SHAPE_BOX) {
        return big(found.distance) == big(-radius);
    }
    const Vec3& h = shape.half_extents;
    const B x = big(p.x).absolute() - big(h.x);
    const B y = big(p.y).absolute() - big(h.y);
    const B z = big(p.z).absolute() - big(h.z);
    const B nearest = std::max({x, y, z});
    const auto stands = [&](std::int32_t n, std::int64_t c, const B& depth) {
        return n == 0 || (depth == nearest && (n == direction_one) == (c >= 0) &&
                          (n == direction_one || n == -direction_one));
    };
    const int faces =
        (found.normal.x != 0 ? 1 : 0) + (found.normal.y != 0 ? 1 : 0) + (found.normal.z != 0 ? 1 : 0);
    return big(found.distance) + big(radius) == nearest && faces == 1 && stands(found.normal.x, p.x, x) &&
           stands(found.normal.y, p.y, y) && stands(found.normal.z, p.z, z);
}

bool is_within_edge(const Vec3& p) {
    return fixed::magnitude(p.x) <= far_edge && fixed::magnitude(p.y) <= far_edge &&
           fixed::magnitude(p.z) <= far_edge;
}

// Further out than is looked at it only comes out too small, and positive still.
bool is_bounded(const Offset& offset, std::int64_t radius, const SurfacePoint& found) {
    const B least = big(found.distance) + big(radius) - big(greatest_error);
    return found.distance > 0 && least * least <= offset.squared();
}

template <lks_shape_kind kind>
bool is_beyond_rightly(const Shape& shape, const Vec3& p, std::int64_t margin, std::int64_t reach,
                       const Offset& offset, std::uint64_t& beyond_count) {
    if (!is_beyond<kind>(shape, p, margin, reach)) {
        return true;
    }
    ++beyond_count;
    const B far = big(shape.radius) + big(margin) + big(reach);
    return far * far <= offset.squared();
}

// What the sample has in it.
struct Seen {
    std::uint64_t outside = 0, inside = 0, far_out = 0, beyond = 0;
};

template <lks_shape_kind kind>
void check_kind() {
    test::Random random(23 + kind);
    test::Tally nearest;
    test::Tally beyond;
    Seen seen;
    const std::uint64_t samples = test::sample_count() / (test::long_run() ? 1 : 4);
    for (std::uint64_t i = 0; i < samples; ++i) {
        const Shape shape = any_shape(random, kind);
        const std::int64_t margin =
            random.below(2) == 0 ? 0 : static_cast<std::int64_t>(random.below(coordinate_one + 1));
        const std::int64_t radius = shape.radius + margin;
        const Vec3 p = any_point(random, shape);
        const Offset offset = offset_from_core(shape, p);
        const SurfacePoint found = nearest_surface<kind>(shape, p, margin);
        bool right = false;
        if (offset.is_none()) {
            ++seen.inside;
            right = is_exact_inside(shape, p, radius, found);
        } else if (is_within_edge(p)) {
            ++seen.outside;
            right = is_exact_outside(offset, radius, found);
        } else {
            ++seen.far_out;
            right = is_bounded(offset, radius, found);
        }
        nearest.expect(right, i, static_cast<std::uint64_t>(p.x), static_cast<std::uint64_t>(p.y),
                       static_cast<std::uint64_t>(p.z));
        const auto reach = static_cast<std::int64_t>(random.any_magnitude(61));
        beyond.expect(is_beyond_rightly<kind>(shape, p, margin, reach, offset, seen.beyond), i,
                      static_cast<std::uint64_t>(p.x), static_cast<std::uint64_t>(p.y),
                      static_cast<std::uint64_t>(p.z));
    }
    LKS_CHECK_TALLY(nearest);
    LKS_CHECK_TALLY(beyond);
    CHECK(seen.outside > samples / 10);
    CHECK(seen.inside > samples / 1000);
    CHECK(seen.far_out > samples / 10);
    CHECK(seen.beyond > samples / 10);
}

} // namespace

TEST_CASE("nearest points of spheres are what integers without limits give") {
    check_kind<LKS_SHAPE_SPHERE>();
}

TEST_CASE("nearest points of capsules are what integers without limits give") {
    check_kind<LKS_SHAPE_CAPSULE>();
}

TEST_CASE("nearest points of boxes are what integers without limits give") {
    check_kind<LKS_SHAPE_BOX>();
}
