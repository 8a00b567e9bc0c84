// Where the particles of an object are on their way, while some of them are moved.
#include <doctest/doctest.h>

#include <algorithm>

#include "rigid/swept_particles.h"
#include "solver/world.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr std::int64_t metre = lks::coordinate_one;

bool holds(const lks::Bounds& bounds, const lks::Coordinates& p) {
    return bounds.low.x <= p.x && p.x <= bounds.high.x && bounds.low.y <= p.y && p.y <= bounds.high.y &&
           bounds.low.z <= p.z && p.z <= bounds.high.z;
}

// A rope of 100 particles in its place.
struct Placed {
    Asset asset{straight_rope(99, 2)};
    World world{world_def(60, 8)};
    lks_world& inner = *static_cast<lks_world*>(world);
    lks::Object& object = *inner.find_object(world.add(asset, lks_transform_identity()));
    lks::SweptParticles swept{object, *inner.kernels};

    void move(std::uint32_t particle, std::int64_t way) {
        swept.moved(particle); // told beforehand, as bodies do
        object.axis(1)[particle] += way;
    }

    bool holds_all() {
        const lks::Bounds bounds = swept.bounds();
        const std::int64_t growth = swept.greatest_growth();
        bool all = true;
        for (std::uint32_t i = 0; i < object.count(); ++i) {
            all = all && holds(bounds, object.position(i)) && holds(bounds, object.start(i)) &&
                  growth >= object.growth_of(i);
        }
        return all;
    }
};

} // namespace

TEST_CASE("bounds and growth hold what has been moved since, be it few or many") {
    for (const std::uint32_t many : {1u, 2u, 31u, 32u, 33u, 100u}) {
        CAPTURE(many);
        Placed rope;
        REQUIRE(rope.holds_all());
        const std::int64_t before = rope.swept.greatest_growth();
        for (std::uint32_t i = 0; i < many; ++i) {
            rope.move((i * 37) % 100, (i % 2 == 0 ? 1 : -1) * (metre + i * metre / 64));
        }
        CHECK(rope.holds_all());
        CHECK(rope.swept.greatest_growth() >= before + metre / 2);
        // Asked in between, and told of again.
        rope.move(5, 7 * metre);
        CHECK(rope.holds_all());
    }
}

TEST_CASE("what has been moved back is looked at anew when many are moved") {
    Placed rope;
    rope.move(3, 5 * metre);
    const lks::Bounds wide = rope.swept.bounds();
    for (std::uint32_t i = 0; i < 100; ++i) {
        rope.move(i, i == 3 ? -5 * metre : 0);
    }
    const lks::Bounds narrow = rope.swept.bounds();
    CHECK(wide.high.y >= narrow.high.y + 4 * metre);
    CHECK(rope.holds_all());
}
