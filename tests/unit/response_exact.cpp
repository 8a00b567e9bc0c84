// Particles against one collider at the ends of all ranges: every kernel, plain integers too, moves them as
// collide/contact.cpp says, in integers that have no limit. Only nearest points, unit vectors and the shares
// of a way are the SDK's own, which shape_exact.cpp, fixed_vector.cpp and the tests of collide/ look at.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "collide/contact.h"
#include "collide/shape.h"
#include "collide/trace.h"
#include "exact_kernels.h"
#include "fixed/formats.h"
#include "rigid_samples.h"
#include "wide_kernels.h"

using namespace lks;
using namespace lks::test::exact;
using fixed::Vec3;

namespace {

using Vector = std::array<B, 3>;

Vector vector_of(const Vec3& v) {
    return {big(v.x), big(v.y), big(v.z)};
}
template <typename Change>
Vector each(const Change& change) {
    return {change(0), change(1), change(2)};
}
Vector operator+(const Vector& a, const Vector& b) {
    return each([&](int i) { return a[i] + b[i]; });
}
Vector operator-(const Vector& a, const Vector& b) {
    return each([&](int i) { return a[i] - b[i]; });
}
B limited(const B& value, std::int64_t limit) {
    return between(value, big(-limit), big(limit));
}
B saturated(const B& value) {
    return between(value, big(INT64_MIN), big(INT64_MAX));
}
Vector saturated(const Vector& v) {
    return each([&](int i) { return saturated(v[i]); });
}
Vec3 narrow(const Vector& v) {
    return {low(v[0]), low(v[1]), low(v[2])};
}

B dot(const Vector& direction, const Vector& v) {
    return rounded(direction[0] * v[0] + direction[1] * v[1] + direction[2] * v[2], direction_fraction_bits);
}
Vector scale(const Vector& direction, const B& by) {
    return each([&](int i) { return rounded(direction[i] * by, direction_fraction_bits); });
}
Vector vector_of(const fixed::Direction& d) {
    return {big(d.x), big(d.y), big(d.z)};
}
Vector rotate(const fixed::Matrix3& m, const Vector& v) {
    return each([&](int i) { return dot({big(m.m[i][0]), big(m.m[i][1]), big(m.m[i][2])}, v); });
}
Vector rotate_back(const fixed::Matrix3& m, const Vector& v) {
    return each([&](int i) { return dot({big(m.m[0][i]), big(m.m[1][i]), big(m.m[2][i])}, v); });
}

struct Way {
    Vector start, end;
};
struct Contact {
    Vector normal;
    B depth, start_depth;
};

// Within 63 m of the centre, by the upper 32 bits.
bool is_followed(const Vector& v) {
    B sum{};
    for (const B& component : v) {
        const B coarse = component.absolute() >> 32;
        sum = sum + coarse * coarse;
    }
    const B radius = big(coordinate_one * 63) >> 32;
    return sum < radius * radius;
}

// Where a way from far out comes within that, to 16 halvings.
Vector cut_start(const Vec3& start, const Vec3& centre, const Vector& end) {
    Vector outer = each([&](int i) { return (vector_of(start)[i] >> 1) - (vector_of(centre)[i] >> 1); });
    Vector inner = each([&](int i) { return end[i] >> 1; });
    for (int halving = 0; halving < 16; ++halving) {
        const Vector middle = each([&](int i) { return (outer[i] >> 1) + (inner[i] >> 1); });
        (is_followed(saturated(middle + middle)) ? inner : outer) = middle;
    }
    return inner + inner;
}

// False: too far away to touch.
bool find_way(const ContactFrame& frame, const Vec3& position, const Vec3& start, Way& way) {
    const Vector end = saturated(vector_of(position) - vector_of(frame.end_centre));
    if (!is_followed(end)) {
        return false;
    }
    Vector from = saturated(vector_of(start) - vector_of(frame.start_centre));
    if (!is_followed(from)) {
        from = cut_start(start, frame.start_centre, end);
    }
    way = {rotate_back(frame.start_rotation, from), rotate_back(frame.end_rotation, end)};
    return true;
}

// Halved, and clamped as particles are.
Vector plane_local(const fixed::Matrix3& rotation, const Vec3& position, const Vec3& centre) {
    const Vector halved = each([&](int i) {
        return limited((vector_of(position)[i] >> 1) - (vector_of(centre)[i] >> 1), coordinate_limit);
    });
    const Vector local = rotate_back(rotation, halved);
    return saturated(local + local);
}

bool find_plane_contact(const ContactFrame& frame, const Way& way, Contact& contact) {
    const auto depth = [&](const B& height) { return saturated(-saturated(height - big(frame.margin))); };
    contact = {{B{}, big(direction_one), B{}}, depth(way.end[1]), depth(way.start[1])};
    return contact.depth > B{};
}

bool find_contact(const ContactFrame& frame, const Way& way, Contact& contact) {
    SurfacePoint nearest = nearest_surface(frame.shape, narrow(way.start), frame.margin);
    contact.start_depth = -big(nearest.distance);
    Vector rest = way.end - way.start;
    for (int step = 0; step < greatest_trace_steps; ++step) {
        contact.normal = vector_of(nearest.normal);
        const B closing = -dot(contact.normal, rest);
        contact.depth = closing - big(nearest.distance);
        if (contact.depth <= B{}) {
            return false;
        }
        if (nearest.distance <= contact_tolerance) {
            return true;
        }
        const std::int32_t share = way_share(static_cast<std::uint64_t>(nearest.distance), closing.low64());
        rest = rest - scale(rest, big(share));
        nearest = nearest_surface(frame.shape, narrow(way.end - rest), frame.margin);
    }
    return false; // not in so many steps: never seen
}

// By how much it slides less.
Vector friction(const ContactFrame& frame, const Way& way, const Vector& normal, const B& new_depth) {
    const Vector motion = saturated(way.end - way.start) + scale(normal, new_depth);
    const Vector sliding = motion - scale(normal, dot(normal, motion));
    const auto allowed = [&](std::uint32_t coefficient) {
        return saturated(rounded(B::from_u64(coefficient) * new_depth, friction_fraction_bits));
    };
    fixed::NormalisedVector slide{};
    if (frame.static_friction == 0 || new_depth.is_zero() || !fixed::normalise(narrow(sliding), slide)) {
        return {};
    }
    if (big(slide.length) <= allowed(frame.static_friction)) {
        return sliding;
    }
    return scale(vector_of(slide.direction), std::min(allowed(frame.dynamic_friction), big(slide.length)));
}

// False: nothing happens to the particle.
bool respond_exactly(const ContactFrame& frame, Vec3& position, Vec3& start) {
    Way way{};
    Contact contact{};
    if (frame.shape.kind == LKS_SHAPE_PLANE) {
        way = {plane_local(frame.start_rotation, start, frame.start_centre),
               plane_local(frame.end_rotation, position, frame.end_centre)};
        if (!find_plane_contact(frame, way, contact)) {
            return false;
        }
    } else if (!find_way(frame, position, start, way) || !find_contact(frame, way, contact)) {
        return false;
    }
    const B old_depth = std::min(contact.depth, std::max(contact.start_depth, B{}));
    const B recovered = std::min(old_depth, big(frame.greatest_recovery));
    const B depth = contact.depth - (old_depth - recovered);
    const Vector push =
        scale(contact.normal, depth) - friction(frame, way, contact.normal, depth - recovered);
    const Vector moved = vector_of(position) + rotate(frame.end_rotation, push);
    position = narrow(each([&](int i) { return limited(moved[i], coordinate_limit); }));
    start =
        narrow(saturated(vector_of(start) + rotate(frame.end_rotation, scale(contact.normal, recovered))));
    return true;
}

// A micrometre to twenty metres.
std::int64_t any_size(test::Random& random) {
    const std::int64_t least = coordinate_one >> 20, greatest = coordinate_one * 20;
    return random.below(4) == 0 ? greatest : std::clamp(random.any_signed(61), least, greatest);
}

// None, half and quarter turns, or any.
fixed::Rotation any_rotation(test::Random& random) {
    if (random.below(3) == 0) {
        return fixed::identity_rotation();
    }
    const bool any = random.below(2) == 0;
    const auto part = [&] {
        return any ? static_cast<std::int32_t>(random.any_signed(30))
                   : (static_cast<std::int32_t>(random.below(3)) - 1) * (direction_one / 2);
    };
    return fixed::normalise(fixed::Rotation{part(), part(), part(), part() | 1});
}

// About as fast as particles can be and kernels take, hardly at all, or anything.
Vec3 any_motion(test::Random& random) {
    const std::int64_t fast = substep_motion_limit;
    const std::int64_t places[] = {
        0, 0, 0, 1, 2, fast / 2 - 1, fast / 2, fast - 1, fast, random.any_signed(58)};
    const auto one = [&] {
        const std::int64_t size = one_of(random, places);
        return random.below(2) == 0 ? size : -size;
    };
    return {one(), one(), one()};
}

std::uint32_t any_friction(test::Random& random) {
    const std::int64_t places[] = {
        0, 1, (1 << friction_fraction_bits) - 1, 1 << friction_fraction_bits, INT32_MAX, UINT32_MAX};
    return static_cast<std::uint32_t>(one_of(random, places));
}

// Next to the surface, in the shape's frame.
Vec3 any_place(test::Random& random, const ContactFrame& frame) {
    const Shape& s = frame.shape;
    const auto component = [&](std::int64_t half) {
        const std::int64_t places[] = {0, 0, half, -half, random.any_signed(60)};
        return one_of(random, places) + static_cast<std::int64_t>(random.below(3)) - 1;
    };
    const std::int64_t heights[] = {0,
                                    1,
                                    -1,
                                    -2,
                                    contact_tolerance,
                                    contact_tolerance + 1,
                                    -random.any_signed(48),
                                    -random.any_signed(60)};
    const std::int64_t height = one_of(random, heights);
    if (s.kind == LKS_SHAPE_PLANE) {
        return {component(coordinate_one), frame.margin + height, component(coordinate_one)};
    }
    const Vec3 p{component(s.half_extents.x + s.radius), component(s.half_extents.y + s.half_length),
                 component(s.half_extents.z)};
    if (random.below(8) == 0) {
        return p; // also on the core itself, where there is no way outwards
    }
    const SurfacePoint nearest = nearest_surface(s, p, frame.margin);
    return p + fixed::scale(nearest.normal, height - nearest.distance);
}

ContactFrame any_frame(test::Random& random, lks_shape_kind kind) {
    ContactFrame frame{};
    frame.shape.kind = static_cast<std::uint32_t>(kind);
    frame.shape.radius = kind == LKS_SHAPE_SPHERE || kind == LKS_SHAPE_CAPSULE ? any_size(random) : 0;
    frame.shape.half_length = kind == LKS_SHAPE_CAPSULE ? any_size(random) : 0;
    if (kind == LKS_SHAPE_BOX) {
        frame.shape.half_extents = {any_size(random), any_size(random), any_size(random)};
    }
    const std::int64_t margins[] = {0, 1, coordinate_one / 50, coordinate_one};
    frame.margin = one_of(random, margins);
    const fixed::Rotation end = any_rotation(random);
    frame.end_rotation = fixed::to_matrix(end);
    frame.start_rotation = fixed::to_matrix(random.below(2) == 0 ? end : any_rotation(random));
    frame.static_friction = any_friction(random);
    frame.dynamic_friction = std::min(frame.static_friction, any_friction(random));
    const std::int64_t recoveries[] = {0, 1, coordinate_one / 1000, INT64_MAX, INT64_MAX};
    frame.greatest_recovery = one_of(random, recoveries);
    frame.reachable = true;
    frame.box_low = {INT64_MIN, INT64_MIN, INT64_MIN};
    frame.box_high = {INT64_MAX, INT64_MAX, INT64_MAX};
    // So that its surface is in the middle of the range, or in a corner.
    const auto corner = [&] {
        const std::int64_t places[] = {0, coordinate_limit, -coordinate_limit, random.any_signed(62)};
        return one_of(random, places);
    };
    const Vec3 at = random.below(2) == 0 ? test::any_vector(random, 58) : Vec3{corner(), corner(), corner()};
    frame.end_centre = at - fixed::rotate(frame.end_rotation, any_place(random, frame));
    frame.start_centre = random.below(2) == 0 ? frame.end_centre : frame.end_centre - any_motion(random);
    return frame;
}

Vec3 in_range(const Vec3& v) {
    const auto limited = [](std::int64_t x) { return std::clamp(x, -coordinate_limit, coordinate_limit); };
    return {limited(v.x), limited(v.y), limited(v.z)};
}

struct Particles {
    std::vector<std::int64_t> values[6]; // x, y, z, and where they were

    void add(const Vec3& position, const Vec3& start) {
        const std::int64_t all[6] = {position.x, position.y, position.z, start.x, start.y, start.z};
        for (int i = 0; i < 6; ++i) {
            values[i].push_back(all[i]);
        }
    }
    Vec3 position(std::uint32_t i) const { return {values[0][i], values[1][i], values[2][i]}; }
    Vec3 start(std::uint32_t i) const { return {values[3][i], values[4][i], values[5][i]}; }
    friend bool operator==(const Particles& a, const Particles& b) {
        return std::equal(std::begin(a.values), std::end(a.values), std::begin(b.values));
    }
};

constexpr std::uint32_t together = 24;

Particles resolved(const ContactFrame& frame, Particles particles, const Kernels& kernels) {
    auto& v = particles.values;
    resolve_contacts(frame, {v[0].data(), v[1].data(), v[2].data(), v[3].data(), v[4].data(), v[5].data()}, 0,
                     together, kernels);
    return particles;
}

Particles any_particles(test::Random& random, const ContactFrame& frame) {
    Particles particles;
    for (std::uint32_t i = 0; i < together; ++i) {
        const Vec3 end =
            in_range(frame.end_centre + fixed::rotate(frame.end_rotation, any_place(random, frame)));
        // Not as seen from the collider, or not at all.
        const Vec3 carried = random.below(2) == 0 ? frame.end_centre - frame.start_centre : Vec3{0, 0, 0};
        particles.add(end, in_range(end - carried - any_motion(random)));
    }
    return particles;
}

constexpr lks_shape_kind kinds[] = {LKS_SHAPE_PLANE, LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX};

} // namespace

TEST_CASE("kernels: contacts at the ends of every range are what integers without limits give") {
    const std::uint64_t frames = test::sample_count() / together / (test::long_run() ? 10 : 100);
    const std::vector<const Kernels*> all = test::all_kernels();
    for (const lks_shape_kind kind : kinds) {
        INFO("shape ", static_cast<int>(kind));
        test::Random random(90 + kind);
        std::uint64_t different = 0, touched = 0, recovered = 0;
        for (std::uint64_t i = 0; i < frames; ++i) {
            const ContactFrame frame = any_frame(random, kind);
            const Particles before = any_particles(random, frame);
            Particles expected;
            for (std::uint32_t p = 0; p < together; ++p) {
                Vec3 position = before.position(p), start = before.start(p);
                touched += respond_exactly(frame, position, start) ? 1 : 0;
                recovered += start == before.start(p) ? 0 : 1;
                expected.add(position, start);
            }
            for (const Kernels* kernels : all) {
                different += resolved(frame, before, *kernels) == expected ? 0 : 1;
            }
        }
        CHECK(different == 0);
        CHECK(touched > frames * together / 8);
        CHECK(touched < frames * together);
        CHECK(recovered > frames * together / 32);
    }
}

TEST_CASE("kernels: every instruction set does the same with particles that are anywhere") {
    const std::int64_t places[] = {INT64_MIN, INT64_MIN + 1,    -coordinate_limit, -1,       0,
                                   1,         coordinate_limit, INT64_MAX - 1,     INT64_MAX};
    const auto anywhere = [&](test::Random& random) {
        return Vec3{one_of(random, places), one_of(random, places), one_of(random, places)};
    };
    const std::uint64_t frames = test::sample_count() / 1000;
    for (const lks_shape_kind kind : kinds) {
        INFO("shape ", static_cast<int>(kind));
        test::Random random(95 + kind);
        std::uint64_t different = 0, moved = 0;
        for (std::uint64_t i = 0; i < frames; ++i) {
            ContactFrame frame = any_frame(random, kind);
            if (random.below(4) == 0) {
                frame.start_centre = anywhere(random);
            }
            Particles before = any_particles(random, frame);
            for (std::vector<std::int64_t>& axis : before.values) {
                for (std::int64_t& x : axis) {
                    x = random.below(4) == 0 ? one_of(random, places) : x;
                }
            }
            const Particles expected = resolved(frame, before, kernels_scalar);
            moved += expected == before ? 0 : 1;
            for (const Kernels* kernels : test::wide_kernels()) {
                different += resolved(frame, before, *kernels) == expected ? 0 : 1;
            }
        }
        CHECK(different == 0);
        CHECK(moved > frames / 4);
    }
}
