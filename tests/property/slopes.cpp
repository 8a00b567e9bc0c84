// What moves slowly on a slope moves as if it might not sleep: up, round, and down again.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr double degree = std::numbers::pi / 180;

// A plane, or boxes of 30 cm side by side, that falls along x.
struct Slope {
    Slope(double degrees, std::uint32_t substeps, double friction = 0.5, int tiles = 0)
        : world(world_def(60, substeps)), rotation(about(0, 0, 1, -degrees)),
          sine(std::sin(degrees * degree)), cosine(std::cos(degrees * degree)) {
        if (tiles == 0) {
            add_ground(world, friction, &rotation);
        }
        for (int i = -tiles; i < tiles; ++i) {
            lks_collider_def def = lks_default_collider_def();
            def.shape = LKS_SHAPE_BOX;
            def.half_extents = fixed(0.15, 0.2, 1);
            def.transform = {above(0.3 * i, -0.2), rotation};
            world.add(def);
        }
    }

    lks_vec3 above(double down, double height, double aside = 0) const {
        return fixed(down * cosine + height * sine, height * cosine - down * sine, aside);
    }

    // Rolls up from the origin, without slipping.
    lks_body_id roll(double radius, double speed, double aside, bool sleeps) {
        lks_body_def def = lks_default_body_def();
        def.never_sleeps = sleeps ? 0 : 1;
        def.velocity = above(-speed, 0);
        def.angular_velocity = fixed(0, 0, speed / radius);
        return add_body(world, ball_shape(radius), above(0, radius, aside), def);
    }

    double way(lks_body_id body) const {
        const Vector p = state_of(world, body).position;
        return p.x * cosine - p.y * sine;
    }

    World world;
    lks_rotation rotation;
    double sine, cosine;
};

struct Throw {
    double radius, speed;
};
constexpr Throw throws[] = {{0.05, 0}, {0.05, 0.2}, {0.05, 1},  {0.2, 0},   {0.2, 0.2}, {0.2, 0.5},
                            {0.2, 1},  {0.5, 0},    {0.5, 0.2}, {0.5, 0.5}, {0.5, 1}};

// All throws on one slope, abreast.
std::vector<lks_body_id> throw_all(Slope& slope, bool sleeps) {
    std::vector<lks_body_id> balls;
    for (const Throw& t : throws) {
        balls.push_back(slope.roll(t.radius, t.speed, 2.0 * static_cast<double>(balls.size()), sleeps));
    }
    return balls;
}

// A ball that is heavy below, tipped on level ground: seconds until it sleeps, or -1.
double rocks_for(double spin) {
    World world(world_def(60, 8));
    add_ground(world);
    lks_body_shape shapes[] = {ball_shape(0.3, 100), ball_shape(0.1, 8000)};
    shapes[1].transform.position = fixed(0, -0.18, 0);
    lks_body_def def = lks_default_body_def();
    def.shapes = shapes;
    def.shape_count = 2;
    def.transform.position = fixed(0, 0.3, 0);
    def.angular_velocity = fixed(0, 0, spin);
    lks_body_id body{};
    REQUIRE(lks_world_add_body(world, &def, &body) == LKS_OK);
    for (int tick = 1; tick <= 600; ++tick) {
        world.step();
        if (lks_body_is_awake(world, body) == 0) {
            return tick / 60.0;
        }
    }
    return -1;
}

} // namespace

// Slower than 10 cm/s for half a second they slept where they turned, on up to 4 degrees, and gave up a
// quarter of their speed a tick on 4 to 6, as what trembles does.
TEST_CASE("balls that are rolled up a slope roll down again as if they might not sleep") {
    for (const std::uint32_t substeps : {4u, 8u, 20u}) {
        for (const double degrees : {0.5, 1., 2., 3., 4., 5., 6., 8.}) {
            Slope slope(degrees, substeps);
            Slope restless(degrees, substeps);
            const std::vector<lks_body_id> balls = throw_all(slope, true);
            const std::vector<lks_body_id> others = throw_all(restless, false);
            slope.world.step(480);
            restless.world.step(480);
            for (std::size_t i = 0; i < balls.size(); ++i) {
                INFO(substeps << " substeps, " << degrees << " degrees, a ball of " << throws[i].radius
                              << " m at " << throws[i].speed << " m/s");
                const double fall = 5. / 14 * 9.81 * slope.sine * 64;
                CHECK(lks_body_is_awake(slope.world, balls[i]) == 1);
                CHECK(slope.way(balls[i]) == restless.way(others[i]));
                CHECK(std::abs(slope.way(balls[i]) - (fall - 8 * throws[i].speed)) < 0.015 * fall);
            }
        }
    }
}

TEST_CASE("balls roll up and down over seams as if they might not sleep") {
    for (const double degrees : {1., 2., 4., 6.}) {
        for (const double speed : {0.1, 0.2, 0.3, 0.5}) {
            Slope slope(degrees, 8, 0.5, 14);
            Slope restless(degrees, 8, 0.5, 14);
            const lks_body_id ball = slope.roll(0.2, speed, 0, true);
            const lks_body_id other = restless.roll(0.2, speed, 0, false);
            slope.world.step(180);
            restless.world.step(180);
            INFO(degrees << " degrees, " << speed << " m/s");
            CHECK(slope.way(ball) == restless.way(other));
        }
    }
}

TEST_CASE("a box slides off from a third of a degree above its angle of friction on") {
    for (const double beyond : {0.3, 0.5, 0.75, 1.}) {
        const double degrees = std::atan(0.5) / degree + beyond;
        double ways[2];
        for (const bool sleeps : {false, true}) {
            Slope slope(degrees, 8);
            lks_body_def def = lks_default_body_def();
            def.static_friction = def.dynamic_friction = fixed(0.5);
            def.never_sleeps = sleeps ? 0 : 1;
            def.transform.rotation = slope.rotation;
            const lks_body_id box = add_body(slope.world, box_shape(0.2, 0.1, 0.2), slope.above(0, 0.1), def);
            slope.world.step(480);
            ways[sleeps ? 1 : 0] = slope.way(box);
        }
        INFO(beyond << " degrees beyond");
        CHECK(ways[0] > 5 * beyond);
        CHECK(ways[1] == ways[0]);
    }
}

// Saved where it turns, with what it has done until then.
TEST_CASE("a world that is saved while a ball turns on a slope goes on as it would have") {
    Slope slope(2, 8);
    const lks_body_id ball = slope.roll(0.2, 0.2, 0, true);
    slope.world.step(45);
    const Image image = slope.world.save();
    slope.world.step(120);
    const std::uint64_t hash = slope.world.hash();
    const double way = slope.way(ball);
    Slope other(2, 8);
    other.roll(0.2, 0, 0, true);
    REQUIRE(lks_world_load(other.world, image.data(), image.size()) == LKS_OK);
    other.world.step(120);
    CHECK(other.world.hash() == hash);
    CHECK(way > 0);
}

TEST_CASE("what rocks slowly has turned round, and rests") {
    for (const double spin : {0.02, 0.05, 0.1, 0.2, 0.5}) {
        const double seconds = rocks_for(spin);
        INFO(spin << " rad/s: asleep after " << seconds << " s");
        CHECK(seconds > 0);
        CHECK(seconds < 3);
    }
}
