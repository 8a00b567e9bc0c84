// What a kinematic body is turned at it keeps when it becomes dynamic.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

// That of its last substep was 36 % less at 90 degrees with one substep, and 9 % with 20.
TEST_CASE("what was turned evenly and is let go turns on as fast") {
    for (const std::uint32_t substeps : {1u, 4u, 8u, 20u}) {
        for (const double degrees : {1., 10., 45., 90.}) {
            World world(world_def(60, substeps));
            REQUIRE(lks_world_set_gravity(world, {}) == LKS_OK);
            lks_body_def def = lks_default_body_def();
            def.kind = LKS_BODY_KINEMATIC;
            def.angular_damping = 0;
            def.never_sleeps = 1;
            const lks_body_id body = add_body(world, ball_shape(0.2), {}, def);
            lks_transform to = lks_transform_identity();
            for (int tick = 1; tick <= 5; ++tick) {
                to.rotation = about(0, 1, 0, std::fmod(degrees * tick, 360));
                REQUIRE(lks_body_move_to(world, body, to) == LKS_OK);
                world.step(1);
            }
            // A body turns by twice the arc tangent of half its spin in a substep.
            const double radians = degrees * std::numbers::pi / 180;
            const double turned = 120. * substeps * std::tan(radians / (2 * substeps));
            const double expected = std::min(turned, lks_fixed_to_double(lks_world_spin_limit(world)));
            CAPTURE(substeps);
            CAPTURE(degrees);
            CHECK(std::abs(state_of(world, body).spin.y / expected - 1) < 0.001);
            REQUIRE(lks_body_set_kind(world, body, LKS_BODY_DYNAMIC) == LKS_OK);
            world.step(10);
            CHECK(std::abs(state_of(world, body).spin.y / expected - 1) < 0.001);
        }
    }
}
