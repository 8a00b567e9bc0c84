// A body's own gravity and damping, against what mechanics says.
#include <doctest/doctest.h>

#include <cmath>

#include "support/bodies.h"

using namespace support;

TEST_CASE("gravity acts on a body by its factor") {
    World world(world_def(60, 8));
    const double factors[] = {0, 0.5, 1, -2};
    lks_body_id balls[4];
    for (int i = 0; i < 4; ++i) {
        lks_body_def def = lks_default_body_def();
        def.gravity_factor = fixed(factors[i]);
        balls[i] = add_body(world, ball_shape(0.1), fixed(2 * i, 100, 0), def);
    }
    world.step(60);
    for (int i = 0; i < 4; ++i) {
        INFO("factor " << factors[i]);
        CHECK(std::abs(state_of(world, balls[i]).velocity.y + 9.81 * factors[i]) < 1e-6);
    }
}

TEST_CASE("damping takes speed and spin away as an exponential, in steps of the substep") {
    for (const double damping : {0.0, 0.5, 2.0, 30.0}) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        lks_body_def def = lks_default_body_def();
        def.velocity = fixed(5, -1, 0);
        def.angular_velocity = fixed(0, 3, 0);
        def.linear_damping = fixed(damping);
        const lks_body_id slowed = add_body(world, ball_shape(0.1), {}, def);
        def.linear_damping = 0;
        def.angular_damping = fixed(damping);
        const lks_body_id calmed = add_body(world, ball_shape(0.1), fixed(0, 10, 0), def);
        world.step(30);
        const double left = std::pow(1 - damping / 480, 240);
        INFO("damping " << damping << "/s, " << left << " left");
        const BodyState a = state_of(world, slowed);
        CHECK(std::abs(a.velocity.x - 5 * left) < 5e-6);
        CHECK(std::abs(a.velocity.y + left) < 1e-6);
        CHECK(std::abs(a.spin.y - 3) < 1e-6);
        const BodyState b = state_of(world, calmed);
        CHECK(std::abs(b.velocity.x - 5) < 1e-6);
        CHECK(std::abs(b.spin.y - 3 * left) < 3e-6);
        // e^(-damping · t), but for the steps.
        CHECK(std::abs(left - std::exp(-damping / 2)) < damping * damping / 480 / 4 + 1e-9);
    }
}
