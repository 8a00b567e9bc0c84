// Nothing at up to 100 m/s goes through a 5 cm plate or a 10 cm ball, at any number of substeps.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

constexpr double radius = 0.01;
constexpr double speed = 100;
constexpr std::uint32_t substep_counts[] = {1, 3, 20};

lks_collider_def plate_at(const lks_transform& transform) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = fixed(20, 0.025, 20);
    def.transform = transform;
    return def;
}

lks_collider_def ball_at(const lks_transform& transform) {
    lks_collider_def def = lks_default_collider_def();
    def.radius = fixed(0.05);
    def.transform = transform;
    return def;
}

// Many particles at once, each at another phase of its way when it meets the plate.
Asset shower() {
    std::vector<Vector> points;
    std::vector<double> masses;
    for (int i = 0; i < 200; ++i) {
        points.push_back({0.05 * (i % 20), 0.0173 * i, 0.05 * (i / 20)});
        masses.push_back(0.01);
    }
    return loose_points(points, masses, radius);
}

double lowest(const World& world, lks_object_id object) {
    double result = 1e9;
    for (const Vector& p : world.positions_from(object, {})) {
        result = std::min(result, p.y);
    }
    return result;
}

} // namespace

TEST_CASE("particles at 100 m/s stop at a plate of 5 cm from any angle") {
    for (const std::uint32_t substeps : substep_counts) {
        for (const double slant : {0.0, 30.0, 60.0}) {
            World world(weightless(substeps));
            world.add(plate_at(at(0, 0, 0)));
            const Asset asset = shower();
            lks_object_def def = object_def(asset, at(-8, 1, 0));
            const double angle = slant * 3.14159265358979323846 / 180;
            def.velocity = fixed(speed * std::sin(angle), -speed * std::cos(angle), 0);
            const lks_object_id object = world.add(def);
            INFO(substeps << " substeps, " << slant << " degrees");
            bool above = true;
            for (int tick = 0; tick < 12; ++tick) {
                world.step();
                above = above && lowest(world, object) >= 0.025 + radius - 1e-4;
            }
            CHECK(above);
        }
    }
}

TEST_CASE("particles at 100 m/s do not go through a ball of 10 cm") {
    for (const std::uint32_t substeps : substep_counts) {
        for (int phase = 0; phase < 40; ++phase) {
            for (const double offset : {0.0, 0.01, 0.025}) {
                World world(weightless(substeps));
                world.add(ball_at(at(0, 0, 0)));
                const Asset asset = loose_points({{0, 0, 0}, {0, 0, 30}}, {1, 1}, radius);
                lks_object_def def = object_def(asset, at(-3 - 0.0417 * phase, offset, 0));
                def.velocity = fixed(speed, 0, 0);
                const lks_object_id object = world.add(def);
                INFO(substeps << " substeps, phase " << phase << ", " << offset << " m beside the centre");
                for (int tick = 0; tick < 5; ++tick) {
                    world.step();
                    const Vector p = world.positions_from(object, {})[0];
                    CHECK(p.length() >= 0.05 + radius - 1e-4);
                }
                if (offset == 0) {
                    CHECK(world.positions_from(object, {})[0].x <= -0.05 - radius + 1e-4);
                }
                // What is left is the tangential part of its speed at most, along its direction: v sin². (In
                // substeps that are much longer than the ball it has slid off along the tangent before its
                // speed is gone.)
                if (substeps == 20) {
                    const double sine = offset / (0.05 + radius);
                    CHECK(metres(world.velocities(object)[0]).x <= speed * sine * sine * 1.3 + 0.5);
                }
            }
        }
    }
}

TEST_CASE("a plate or a ball at 100 m/s takes resting particles along") {
    for (const std::uint32_t substeps : substep_counts) {
        INFO(substeps << " substeps");
        World world(weightless(substeps));
        const lks_collider_id plate = world.add(plate_at(at(0, -3, 0)));
        const Asset asset = shower();
        const lks_object_id object = world.add(asset, at(0, 0, 0));
        for (int tick = 1; tick <= 6; ++tick) {
            const lks_vec3 place = fixed(0, -3, 0) + lks_vec3{0, LKS_FIXED(100) * tick / 60, 0};
            REQUIRE(lks_collider_move_to(world, plate, at(place)) == LKS_OK);
            world.step();
            CHECK(lowest(world, object) >= metres(place.y) + 0.025 + radius - 1e-4);
        }

        World second(weightless(substeps));
        const lks_collider_id ball = second.add(ball_at(at(-2, 0, 0)));
        const Asset single = loose_points({{0, 0, 0}, {0, 0, 30}}, {1, 1}, radius);
        const lks_object_id hit = second.add(single, at(0, 0, 0));
        for (int tick = 1; tick <= 6; ++tick) {
            const lks_vec3 place = fixed(-2, 0, 0) + lks_vec3{LKS_FIXED(100) * tick / 60, 0, 0};
            REQUIRE(lks_collider_move_to(second, ball, at(place)) == LKS_OK);
            second.step();
            CHECK(second.positions_from(hit, {})[0].x >=
                  (tick == 1 ? -1.0 : metres(place.x) + 0.05 + radius - 1e-4));
        }
    }
}

TEST_CASE("a cloth and a rope at 100 m/s stop at a plate of 5 cm") {
    for (const std::uint32_t substeps : substep_counts) {
        World world(weightless(substeps));
        world.add(plate_at(at(0, 0, 0)));
        Net net;
        net.side = 16;
        net.width = 1;
        net.radius = radius;
        const Asset cloth = net.build();
        lks_object_def def = object_def(cloth, turned(at(0, 2, 0), 1, 0, 1, 60));
        def.velocity = fixed(0, -speed, 0);
        const lks_object_id falling_cloth = world.add(def);
        lks_rope_def rope_def = lks_default_rope_def();
        rope_def.length = 1;
        rope_def.segments = 30;
        rope_def.particle_radius = radius;
        const Asset rope(rope_def);
        def = object_def(rope, turned(at(3, 2, 0), 0, 0, 1, 70));
        def.velocity = fixed(0, -speed, 0);
        const lks_object_id falling_rope = world.add(def);
        INFO(substeps << " substeps");
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            CHECK(lowest(world, falling_cloth) >= 0.025 + radius - 1e-4);
            CHECK(lowest(world, falling_rope) >= 0.025 + radius - 1e-4);
        }
    }
}

TEST_CASE("a cloth thrown at 100 m/s at a ball of 10 cm lets no particle through it") {
    for (const std::uint32_t substeps : substep_counts) {
        World world(weightless(substeps));
        world.add(ball_at(at(0, 0, 0)));
        Net net;
        net.side = 32;
        net.width = 0.6;
        net.radius = radius;
        const Asset cloth = net.build();
        lks_object_def def = object_def(cloth, at(0.003, 0.002, -2));
        def.velocity = fixed(0, 0, speed);
        const lks_object_id object = world.add(def);
        INFO(substeps << " substeps");
        for (int tick = 0; tick < 10; ++tick) {
            world.step();
            double nearest = 1e9;
            for (const Vector& p : world.positions_from(object, {})) {
                nearest = std::min(nearest, p.length());
            }
            CHECK(nearest >= 0.05 + radius - 1e-4);
        }
    }
}
