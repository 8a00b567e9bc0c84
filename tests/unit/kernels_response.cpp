// Every instruction set moves particles out of colliders as plain integers do.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "collide/contact.h"
#include "collide/shape.h"
#include "fixed/formats.h"
#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "rigid_samples.h"
#include "wide_kernels.h"

using namespace lks;
using test::any_vector;

namespace {

std::int64_t up_to(test::Random& random, std::int64_t limit) {
    return static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(limit)));
}

fixed::Rotation rotation(test::Random& random) {
    const auto any = [&] { return static_cast<std::int32_t>(random.bits() >> 32); };
    return fixed::normalise(fixed::Rotation{any(), any(), any(), any()});
}

// Within millimetres to 60 m, about as often in each octave.
std::int64_t length(test::Random& random) {
    const std::int64_t octave = coordinate_one << random.below(6);
    return (octave >> random.below(13)) + up_to(random, coordinate_one >> 9);
}

ContactFrame make_frame(test::Random& random, lks_shape_kind kind) {
    ContactFrame frame{};
    const std::int64_t most = coordinate_one * 30;
    frame.shape = {static_cast<std::uint32_t>(kind), 0, 0, {0, 0, 0}};
    if (kind == LKS_SHAPE_SPHERE || kind == LKS_SHAPE_CAPSULE) {
        frame.shape.radius = std::min(length(random), most);
    }
    if (kind == LKS_SHAPE_CAPSULE) {
        frame.shape.half_length = random.below(8) == 0 ? 0 : std::min(length(random), most);
    }
    if (kind == LKS_SHAPE_BOX) {
        frame.shape.half_extents = {std::min(length(random), most), std::min(length(random), most),
                                    std::min(length(random), most)};
    }
    frame.margin = random.below(2) == 0 ? 0 : up_to(random, coordinate_one >> random.below(9));
    const fixed::Rotation start = random.below(3) == 0 ? fixed::identity_rotation() : rotation(random);
    fixed::Rotation end = start;
    if (random.below(2) == 0) {
        const std::int32_t by = static_cast<std::int32_t>(random.any_signed(26));
        end = fixed::normalise(
            fixed::Rotation{start.x / 2 + by, start.y / 2 - by, start.z / 2, start.w / 2 + by});
    }
    frame.start_rotation = fixed::to_matrix(start);
    frame.end_rotation = fixed::to_matrix(end);
    frame.start_centre = any_vector(random, 59 + static_cast<int>(random.below(4)));
    frame.end_centre = random.below(2) == 0
                           ? frame.start_centre
                           : frame.start_centre + any_vector(random, 40 + static_cast<int>(random.below(20)));
    const auto friction = [&] {
        return static_cast<std::uint32_t>(random.any_magnitude(random.below(4) == 0 ? 32 : 19));
    };
    frame.static_friction = random.below(4) == 0 ? 0 : friction();
    frame.dynamic_friction = std::min(frame.static_friction, friction());
    frame.greatest_recovery =
        random.below(2) == 0 ? INT64_MAX : static_cast<std::int64_t>(random.any_magnitude(56));
    frame.reachable = true;
    frame.box_low = {INT64_MIN, INT64_MIN, INT64_MIN};
    frame.box_high = {INT64_MAX, INT64_MAX, INT64_MAX};
    return frame;
}

struct Particles {
    std::vector<std::int64_t> values[6]; // x, y, z, and where they were

    ParticleArrays arrays() {
        return {values[0].data(), values[1].data(), values[2].data(),
                values[3].data(), values[4].data(), values[5].data()};
    }
    void add(const fixed::Vec3& position, const fixed::Vec3& start) {
        const std::int64_t all[6] = {position.x, position.y, position.z, start.x, start.y, start.z};
        for (int i = 0; i < 6; ++i) {
            values[i].push_back(i < 3 ? std::clamp(all[i], -coordinate_limit, coordinate_limit) : all[i]);
        }
    }
    friend bool operator==(const Particles& a, const Particles& b) {
        return std::equal(std::begin(a.values), std::end(a.values), std::begin(b.values));
    }
};

// At any height above or below the surface, all sizes of it alike, in the shape's own frame.
fixed::Vec3 near_surface(test::Random& random, const ContactFrame& frame) {
    fixed::Vec3 p{};
    if (frame.shape.kind == LKS_SHAPE_PLANE) {
        p = any_vector(random, 60);
        p.y = frame.margin + random.any_signed(random.below(4) == 0 ? 60 : 48);
        return p;
    }
    const Shape& s = frame.shape;
    const std::int64_t reach = s.radius + frame.margin + 2;
    const auto component = [&](std::int64_t half) {
        return up_to(random, 2 * (half + reach)) - half - reach;
    };
    p = {component(s.half_extents.x), component(s.half_extents.y + s.half_length),
         component(s.half_extents.z)};
    const SurfacePoint nearest = nearest_surface(s, p, frame.margin);
    const std::int64_t height = random.any_signed(random.below(4) == 0 ? 60 : 48);
    return p + fixed::scale(nearest.normal, height - nearest.distance);
}

void add_particle(test::Random& random, const ContactFrame& frame, Particles& particles) {
    if (random.below(40) == 0) { // anywhere
        particles.add(any_vector(random, 62), any_vector(random, 62));
        return;
    }
    const fixed::Vec3 start = near_surface(random, frame);
    fixed::Vec3 end = near_surface(random, frame);
    if (random.below(8) != 0) { // hardly moved
        end = start + any_vector(random, 36 + static_cast<int>(random.below(22)));
    }
    particles.add(frame.end_centre + fixed::rotate(frame.end_rotation, end),
                  frame.start_centre + fixed::rotate(frame.start_rotation, start));
}

} // namespace

TEST_CASE("kernels: every instruction set moves particles out of colliders as plain integers do") {
    // Of 32 particles on the average: 2·10^7, and in long runs 10^7 of each shape, which has a kernel of its
    // own.
    const std::uint64_t problems = test::sample_count() / (test::long_run() ? 32 : 64);
    for (const lks_shape_kind kind : {LKS_SHAPE_PLANE, LKS_SHAPE_SPHERE, LKS_SHAPE_CAPSULE, LKS_SHAPE_BOX}) {
        test::Random random(17 + kind);
        std::uint64_t different = 0, moved = 0;
        for (std::uint64_t p = 0; p < problems; ++p) {
            const ContactFrame frame = make_frame(random, kind);
            const auto first = static_cast<std::uint32_t>(random.below(9));
            const auto count = static_cast<std::uint32_t>(1 + random.below(64));
            Particles before;
            for (std::uint32_t i = 0; i < first + count + 3; ++i) {
                add_particle(random, frame, before);
            }
            Particles expected = before;
            resolve_contacts(frame, expected.arrays(), first, count, kernels_scalar);
            moved += expected == before ? 0 : 1;
            for (const Kernels* kernels : test::wide_kernels()) {
                Particles found = before;
                resolve_contacts(frame, found.arrays(), first, count, *kernels);
                different += found == expected ? 0 : 1;
            }
        }
        INFO("shape ", static_cast<int>(kind));
        CHECK(different == 0);
        CHECK(moved > problems / 2);
    }
}
