// Contacts are looked for once a tick. Where a tick is long, what gravity adds in it is looked ahead for,
// too.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

// How far a ball that is let go so high above something sinks into it in two seconds, metres.
template <typename AddGround>
double deepest(std::uint32_t rate, double height, const AddGround& add_ground) {
    lks_world_def def = lks_default_world_def();
    def.tick_rate_hz = rate;
    World world(def);
    add_ground(world);
    const lks_body_id ball = add_body(world, ball_shape(0.05), fixed(0, 0.05 + height, 0));
    double least = 0;
    for (std::uint32_t tick = 0; tick < 2 * rate; ++tick) {
        world.step();
        least = std::min(least, state_of(world, ball).position.y - 0.05);
    }
    CHECK(state_of(world, ball).position.y == doctest::Approx(0.05).epsilon(0.02));
    return -least;
}

} // namespace

TEST_CASE("what falls from rest does not sink into the ground, however few ticks a second has") {
    const auto add_plane = [](World& world) {
        lks_collider_def plane = lks_default_collider_def();
        plane.shape = LKS_SHAPE_PLANE;
        world.add(plane);
    };
    const auto add_floor = [](World& world) {
        lks_collider_def floor = lks_default_collider_def();
        floor.shape = LKS_SHAPE_BOX;
        floor.half_extents = fixed(1, 0.5, 1);
        floor.transform.position = fixed(0, -0.5, 0);
        world.add(floor);
    };
    const auto add_body_below = [](World& world) {
        lks_body_def def = lks_default_body_def();
        def.kind = LKS_BODY_KINEMATIC;
        add_body(world, box_shape(1, 0.5, 1), fixed(0, -0.5, 0), def);
    };
    for (const std::uint32_t rate : {10u, 15u, 20u, 60u}) {
        for (const double height : {0.01, 0.025, 0.04, 0.06, 0.08, 0.095}) {
            INFO(rate << " Hz from " << height << " m");
            CHECK(deepest(rate, height, add_plane) < 1e-3);
            CHECK(deepest(rate, height, add_floor) < 1e-3);
            CHECK(deepest(rate, height, add_body_below) < 1e-3);
        }
    }
}
