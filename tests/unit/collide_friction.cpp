// Coulomb's law, and what contacts do to velocities: resting, sliding, sticking, carried along, pushed out.
#include "collide_support.h"

#include <doctest/doctest.h>

using namespace collide_test;
using lks::ColliderState;
using lks::ContactFrame;
using lks::Shape;
using lks::fixed::Vec3;

namespace {

constexpr Real gravity = 9.81L;

struct Slope {
    Shape shape;
    Real top; // height of the surface in the shape's frame
};

const Slope slopes[] = {{plane(), 0}, {box(20, 0.5L, 20), 0.5L}};

ColliderState slope_collider(const Slope& slope, Real degrees, Real static_friction, Real dynamic_friction) {
    ColliderState collider = resting(slope.shape, {0.3L, -0.2L, 0.1L}, degrees_about({0, 0, 1}, degrees));
    collider.static_friction = world(static_friction);
    collider.dynamic_friction = world(dynamic_friction);
    return collider;
}

// Where a local point of the collider is.
Point placed(const ColliderState& collider, const Point& local) {
    return to_point(collider.position) * 65536.0L + rotated(lks::fixed::to_matrix(collider.rotation), local);
}

void run(Particle& particle, ColliderState& collider, int ticks, std::uint32_t substeps) {
    const Real h = 1.0L / 60 / substeps;
    for (int tick = 0; tick < ticks; ++tick) {
        for (std::uint32_t substep = 1; substep <= substeps; ++substep) {
            particle.predict({0, -gravity * h * h, 0});
            particle.resolve(particle.frame(collider, substep, substeps));
        }
        finish_motion(collider);
    }
}

Real degrees_of(Real tangent) {
    return std::atan(tangent) * 180 / std::acos(Real(-1));
}

} // namespace

TEST_CASE("collide: a resting particle sticks to a slope just below tan(angle) = static friction, and slides "
          "just above") {
    for (const Slope& slope : slopes) {
        for (const Real mu : {0.1L, 0.5L, 1.0L, 2.0L}) {
            for (const std::uint32_t substeps : {1u, 5u, 20u}) {
                const Real h = 1.0L / 60 / substeps;
                ColliderState steep = slope_collider(slope, degrees_of(mu * 1.01L), mu, mu * 0.8L);
                Particle slider = Particle::at(placed(steep, {0, slope.top, 0}), {0, 0, 0});
                const Point slider_start = to_point(slider.position);
                run(slider, steep, 60, substeps);
                CHECK((to_point(slider.position) - slider_start).length() > 0.1L);

                ColliderState flat = slope_collider(slope, degrees_of(mu * 0.99L), mu, mu * 0.8L);
                Particle sticker = Particle::at(placed(flat, {0, slope.top, 0}), {0, 0, 0});
                const Point sticker_start = to_point(sticker.position);
                run(sticker, flat, 60, substeps);
                CHECK((to_point(sticker.position) - sticker_start).length() < 1e-9L);
                CHECK(to_point(sticker.motion()).length() / h < 1e-9L);
            }
        }
    }
}

TEST_CASE("collide: a sliding particle accelerates by g (sin - dynamic friction cos) to 1 %") {
    for (const Slope& slope : slopes) {
        for (const std::uint32_t substeps : {1u, 5u, 20u}) {
            for (const Real mu : {0.0L, 0.2L, 0.5L}) {
                const Real degrees = 40;
                const Real h = 1.0L / 60 / substeps;
                ColliderState collider = slope_collider(slope, degrees, mu * 1.5L, mu);
                Particle particle = Particle::at(placed(collider, {5, slope.top, 0}), {0, 0, 0});
                run(particle, collider, 60, substeps);
                const Real radians = degrees * std::acos(Real(-1)) / 180;
                const Real expected = gravity * (std::sin(radians) - mu * std::cos(radians));
                CHECK(std::fabs(to_point(particle.motion()).length() / h - expected) < 0.01L * expected);
            }
        }
    }
}

TEST_CASE(
    "collide: a particle on level ground is slowed by g times the dynamic friction, then stops for good") {
    for (const Slope& slope : slopes) {
        const std::uint32_t substeps = 20;
        const Real h = 1.0L / 60 / substeps;
        ColliderState collider = slope_collider(slope, 0, 0.5L, 0.3L);
        const Real speed = 5;
        Particle particle = Particle::at(placed(collider, {-8, slope.top, 0}), {speed * h, 0, 0});
        const Real begin = to_point(particle.position).x;
        run(particle, collider, 60, substeps);
        CHECK(std::fabs(to_point(particle.motion()).x / h - (speed - 0.3L * gravity)) <
              0.01L * 0.3L * gravity);
        run(particle, collider, 60, substeps);
        CHECK(particle.motion().x == 0);
        const Real way = speed * speed / (2 * 0.3L * gravity);
        CHECK(std::fabs(to_point(particle.position).x - begin - way) < 0.01L * way);
    }
}

TEST_CASE("collide: the total friction of an impact is Coulomb's") {
    // Falling obliquely: the tangential velocity lost is the dynamic friction times the normal velocity lost.
    Dice dice(5);
    for (int sample = 0; sample < 500; ++sample) {
        const std::uint32_t substeps = 1 + dice.below(20);
        const Real h = 1.0L / 60 / substeps;
        ColliderState collider = slope_collider(slopes[sample % 2], 0, 0.3L, 0.2L);
        const Real down = dice.between(1, 20), along = dice.between(10, 30);
        const Real top = slopes[sample % 2].top;
        Particle particle = Particle::at(placed(collider, {-3, top + dice.between(0.01L, 0.4L), 0}),
                                         {along * h, -down * h, 0});
        for (int tick = 0; tick < 26; ++tick) {
            for (std::uint32_t substep = 1; substep <= substeps; ++substep) {
                particle.predict({0, 0, 0});
                particle.resolve(particle.frame(collider, substep, substeps));
            }
        }
        CHECK(std::fabs(to_point(particle.motion()).y / h) < 1e-6L);
        CHECK(std::fabs(to_point(particle.motion()).x / h - (along - 0.2L * down)) <
              0.01L * 0.2L * down + 1e-6L);
    }
}

TEST_CASE("collide: the asset's factor multiplies both coefficients, and what is too large is clamped") {
    ColliderState collider = slope_collider(slopes[0], 0, 0.5L, 0.25L);
    Particle particle;
    particle.friction_factor = world(2);
    ContactFrame frame = particle.frame(collider, 1, 1);
    CHECK(frame.static_friction == 1u << 18);
    CHECK(frame.dynamic_friction == 1u << 17);
    collider.static_friction = world(100);
    particle.friction_factor = world(100);
    frame = particle.frame(collider, 1, 1);
    CHECK(frame.static_friction == 10000u << 18);
    collider.static_friction = world(1000);
    CHECK(particle.frame(collider, 1, 1).static_friction == UINT32_MAX);
}

TEST_CASE("collide: a lift carries a particle at its own speed, and a belt drags it along") {
    const std::uint32_t substeps = 20;
    const Real h = 1.0L / 60 / substeps;
    for (const Slope& slope : slopes) {
        ColliderState collider = slope_collider(slope, 0, 0.8L, 0.6L);
        Particle particle = Particle::at(placed(collider, {0, slope.top, 0}), {0, 0, 0});
        for (int tick = 0; tick < 60; ++tick) {
            collider.target_position = collider.position + worlds({0, 2.0L / 60, 0});
            run(particle, collider, 1, substeps);
        }
        CHECK(std::fabs(to_point(particle.motion()).y / h - 2) < 1e-6L);
        CHECK(std::fabs((to_point(particle.position) - placed(collider, {0, slope.top, 0})).length()) <
              1e-9L);

        collider = slope_collider(slope, 0, 0.8L, 0.6L);
        particle = Particle::at(placed(collider, {0, slope.top, 0}), {0, 0, 0});
        const Real before = to_point(particle.position).x;
        for (int tick = 0; tick < 60; ++tick) {
            collider.target_position = collider.position + worlds({2.0L / 60, 0, 0});
            run(particle, collider, 1, substeps);
        }
        CHECK(std::fabs(to_point(particle.motion()).x / h - 2) < 1e-4L);
        // It starts slipping: until it has the belt's speed it falls back by v²/(2 µ g).
        const Real slip = 4 / (2 * 0.6L * gravity);
        CHECK(std::fabs(2 - slip - (to_point(particle.position).x - before)) < 0.01L);
    }
}

TEST_CASE(
    "collide: a turntable carries a particle where friction can hold it, and loses it where it cannot") {
    const std::uint32_t substeps = 20;
    const Real rate = 90; // degrees a second
    const Real omega = rate * std::acos(Real(-1)) / 180;
    for (const Slope& slope : slopes) {
        for (const bool holds : {true, false}) {
            // The limit is omega² r = µ g.
            const Real mu = 0.5L;
            const Real radius = mu * gravity / (omega * omega) * (holds ? 0.9L : 1.1L);
            ColliderState collider = slope_collider(slope, 0, mu, mu);
            Particle particle = Particle::at(placed(collider, {radius, slope.top, 0}),
                                             {0, 0, -omega * radius / 60 / substeps});
            Real degrees = 0;
            for (int tick = 0; tick < 60; ++tick) {
                degrees += rate / 60;
                collider.target_rotation = degrees_about({0, 1, 0}, degrees);
                run(particle, collider, 1, substeps);
            }
            const Real away =
                (to_point(particle.position) - placed(collider, {radius, slope.top, 0})).length();
            if (holds) {
                CHECK(away < 2e-3L);
            } else {
                CHECK(away > 0.02L);
            }
        }
    }
}

TEST_CASE("collide: what was inside at the start is put outside without gaining speed") {
    Dice dice(9);
    const Shape shapes[] = {plane(), sphere(0.5L), capsule(0.3L, 0.6L), box(0.5L, 0.7L, 0.4L)};
    for (const Shape& shape : shapes) {
        int inside = 0;
        while (inside < 2000) {
            ColliderState collider = resting(shape, {0.1L, 0.2L, -0.1L}, dice.rotation(360));
            collider.static_friction = world(0.5L);
            collider.dynamic_friction = world(0.5L);
            Particle particle = Particle::at(placed(collider, dice.in_cube(0.7L)), dice.in_cube(0.001L));
            particle.margin = coordinate(0.01L);
            const ContactFrame frame = particle.frame(collider, 1, 1);
            if (!frame.reachable) {
                continue;
            }
            const Real before = reference_distance(shape, local_start(frame, particle.start), 0.01L);
            const Real after = reference_distance(shape, local_end(frame, particle.position), 0.01L);
            if (before >= 0 || after >= 0) {
                continue;
            }
            ++inside;
            const Real speed = to_point(particle.motion()).length();
            particle.resolve(frame);
            REQUIRE(reference_distance(shape, local_end(frame, particle.position), 0.01L) >= -1e-7L);
            REQUIRE(to_point(particle.motion()).length() <= speed + 1e-9L);
        }
    }
}

TEST_CASE("collide: recovering from an old overlap presses on nothing, so that it causes no friction") {
    for (const Slope& slope : slopes) {
        ColliderState collider = slope_collider(slope, 0, 0.8L, 0.8L);
        Particle particle = Particle::at(placed(collider, {0, slope.top - 0.1L, 0}), {0, 0, 0});
        particle.position = particle.position + coordinates({0.01L, 0, 0.02L});
        const Vec3 motion = particle.motion();
        particle.resolve(particle.frame(collider, 1, 1));
        CHECK(particle.motion() == motion);
        CHECK(std::fabs(to_point(particle.position).y - placed(collider, {0, slope.top, 0}).y) < 1e-12L);
    }
}

TEST_CASE("collide: a thing at rest stays at rest, to a few units, for a minute") {
    for (const Shape& shape : {plane(), sphere(3), capsule(0.5L, 2), box(1, 1, 1)}) {
        ColliderState collider = resting(shape, {0.1L, 0.2L, 0.3L});
        collider.static_friction = world(0.5L);
        collider.dynamic_friction = world(0.4L);
        const Real top = shape.kind == LKS_SHAPE_PLANE    ? 0
                         : shape.kind == LKS_SHAPE_BOX    ? 1
                         : shape.kind == LKS_SHAPE_SPHERE ? 3
                                                          : 2.5L;
        Particle particle = Particle::at(placed(collider, {0, top, 0}), {0, 0, 0});
        const lks::fixed::Vec3 begin = particle.position;
        run(particle, collider, 3600, 20);
        const lks::fixed::Vec3 drift = particle.position - begin;
        CHECK(to_point(drift).length() < 1e-12L);
    }
}
