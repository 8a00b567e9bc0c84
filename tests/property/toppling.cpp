// Sleep does not hold what begins to topple, and does not stand in the way of what topples onto it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double degree = std::numbers::pi / 180;

// Thirty in a row, the first of which is pushed: the ticks until each leans by 18 degrees.
std::vector<int> topple_row(double push, std::uint32_t substeps, bool sleeps) {
    World world(world_def(60, substeps));
    add_ground(world, 0.6);
    lks_body_def def = lks_default_body_def();
    def.static_friction = def.dynamic_friction = fixed(0.4);
    def.never_sleeps = sleeps ? 0 : 1;
    std::vector<lks_body_id> bodies;
    for (int i = 0; i < 30; ++i) {
        bodies.push_back(add_body(world, box_shape(0.02, 0.2, 0.1), fixed(0.15 * i, 0.2, 0), def));
    }
    REQUIRE(lks_body_set_velocity(world, bodies[0], fixed(0.2 * push, 0, 0), fixed(0, 0, -push)) == LKS_OK);
    std::vector<int> ticks(bodies.size(), -1);
    for (int tick = 1; tick <= 400; ++tick) {
        world.step();
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const Vector up = rotate(state_of(world, bodies[i]).rotation, {0, 1, 0});
            if (up.y < 0.95 && ticks[i] < 0) {
                ticks[i] = tick;
            }
        }
    }
    return ticks;
}

// -1: it is not, within five seconds.
int ticks_until_below(World& world, lks_body_id body, double height) {
    for (int tick = 1; tick <= 300; ++tick) {
        world.step();
        if (state_of(world, body).position.y < height) {
            return tick;
        }
    }
    return -1;
}

// When a slab that is let go beyond its balance lies, or -1.
int fall_of_slab(double half_height, double degrees_beyond, bool sleeps) {
    World world(world_def(60, 8));
    add_ground(world, 0.9);
    const double half_width = half_height / 10;
    const double lean = std::atan(0.1) + degrees_beyond * degree;
    lks_body_def def = lks_default_body_def();
    def.static_friction = def.dynamic_friction = fixed(0.9);
    def.never_sleeps = sleeps ? 0 : 1;
    def.transform.rotation = about(0, 0, 1, -lean / degree);
    const double height = half_height * std::cos(lean) + half_width * std::sin(lean);
    const lks_body_id slab =
        add_body(world, box_shape(half_width, half_height, half_height / 2), fixed(0, height, 0), def);
    return ticks_until_below(world, slab, 0.3 * half_height);
}

// When a ball that lies beside the top of another has fallen off it, or -1.
int fall_of_ball(double beside, bool sleeps) {
    World world(world_def(60, 8));
    add_ground(world);
    lks_collider_def below = lks_default_collider_def();
    below.radius = fixed(0.2);
    below.transform.position = fixed(0, 0.2, 0);
    world.add(below);
    lks_body_def def = lks_default_body_def();
    def.never_sleeps = sleeps ? 0 : 1;
    const double height = 0.2 + std::sqrt(0.4 * 0.4 - beside * beside);
    const lks_body_id ball = add_body(world, ball_shape(0.2), fixed(beside, height, 0), def);
    return ticks_until_below(world, ball, 0.25);
}

} // namespace

// The top of what topples comes twice as fast as its middle. Sleepers that were woken a tick too late stood
// like walls: the row took 1.5 to 2 times as long.
TEST_CASE("a row of dominoes that are asleep falls as fast as one that is awake") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        if (sanitised && substeps != 8) {
            continue;
        }
        for (const double push : {1., 2.}) {
            const std::vector<int> awake = topple_row(push, substeps, false);
            const std::vector<int> asleep = topple_row(push, substeps, true);
            INFO(push << " rad/s, " << substeps << " substeps: the last leans after " << asleep.back()
                      << " ticks, awake after " << awake.back());
            CHECK(awake.back() > 60);
            CHECK(asleep.back() >= awake.back() - 6);
            CHECK(asleep.back() <= awake.back() + 6);
            CHECK(std::is_sorted(asleep.begin(), asleep.end()));
        }
    }
}

TEST_CASE("what begins to topple falls as if it might not sleep") {
    for (const double half_height : {0.2, 1., 2.}) {
        for (const double degrees_beyond : {0.25, 0.5, 1., 2., 4.}) {
            INFO("a slab of " << 2 * half_height << " m, " << degrees_beyond
                              << " degrees beyond its balance");
            const int ticks = fall_of_slab(half_height, degrees_beyond, false);
            CHECK(ticks > 0);
            CHECK(fall_of_slab(half_height, degrees_beyond, true) == ticks);
        }
    }
    for (const double beside : {0.001, 0.002, 0.005, 0.01, 0.02}) {
        INFO("a ball " << beside << " m beside the top");
        const int ticks = fall_of_ball(beside, false);
        CHECK(ticks > 0);
        CHECK(fall_of_ball(beside, true) == ticks);
    }
}
