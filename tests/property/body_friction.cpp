// Coulomb's friction of bodies: what lies on slopes, what slides, and what rubs as it bounces.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"

using namespace support;

namespace {

constexpr double g = 9.81;
constexpr double pi = 3.14159265358979323846;

struct Friction {
    double still, sliding;
};

lks_body_def rubbing(const Friction& friction) {
    lks_body_def def = lks_default_body_def();
    def.static_friction = fixed(friction.still);
    def.dynamic_friction = fixed(friction.sliding);
    return def;
}

// A plane that is turned about z by so many degrees.
void add_slope(World& world, const Friction& friction, double degrees) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_PLANE;
    def.static_friction = fixed(friction.still);
    def.dynamic_friction = fixed(friction.sliding);
    def.transform.rotation = about(0, 0, 1, degrees);
    world.add(def);
}

// How fast a ball goes along the ground and spins, before it bounces or behind.
struct Bounce {
    double along, spin;
};

constexpr double ball_radius = 0.2;

Bounce bounce(double restitution, double along, double spin, std::uint32_t substeps, bool on_body) {
    World world(world_def(60, substeps));
    if (on_body) {
        lks_body_def def = rubbing({0.5, 0.4});
        def.kind = LKS_BODY_KINEMATIC;
        add_body(world, box_shape(8, 0.5, 8), fixed(0, -0.5, 0), def);
    } else {
        add_slope(world, {0.5, 0.4}, 0);
    }
    lks_body_def def = rubbing({0.5, 0.4});
    def.restitution = fixed(restitution);
    def.velocity = fixed(along, 0, 0);
    def.angular_velocity = fixed(0, 0, spin);
    const lks_body_id ball = add_body(world, ball_shape(ball_radius), fixed(0, 1 + ball_radius, 0), def);
    world.step(33); // it comes down in the 28th, and not yet for the second time
    const BodyState state = state_of(world, ball);
    return {state.velocity.x, state.spin.z};
}

} // namespace

TEST_CASE("a box slides as far as friction lets it") {
    for (const double friction : {0.2, 0.5}) {
        World world(world_def(60, 8));
        add_ground(world, friction);
        lks_body_def def = lks_default_body_def();
        def.static_friction = def.dynamic_friction = fixed(friction);
        def.velocity = fixed(4, 0, 0);
        const lks_body_id box = add_body(world, box_shape(0.5, 0.25, 0.5), fixed(0, 0.25, 0), def);
        world.step(300);
        const BodyState state = state_of(world, box);
        const double expected = 16 / (2 * g * friction);
        INFO("friction " << friction << ": " << state.position.x << " of " << expected);
        CHECK(std::abs(state.position.x - expected) < 0.01 * expected);
        CHECK(state.velocity.length() < 1e-5);
    }
}

TEST_CASE(
    "a box stays on a slope up to the angle of static friction, and slides above it by its dynamic one") {
    for (const Friction& friction :
         {Friction{0.5, 0.5}, Friction{0.5, 0.4}, Friction{0.5, 0.1}, Friction{1, 0.2}}) {
        for (const std::uint32_t substeps : {4u, 8u, 20u}) {
            const double limit = std::atan(friction.still) * 180 / pi;
            for (const double degrees : {limit - 1, limit - 0.1, limit + 0.3, limit + 3}) {
                World world(world_def(60, substeps));
                add_slope(world, friction, degrees);
                const double angle = degrees * pi / 180;
                lks_body_def def = rubbing(friction);
                def.never_sleeps = 1; // what slides off so slowly would
                def.transform.rotation = about(0, 0, 1, degrees);
                const lks_vec3 place = fixed(-0.1 * std::sin(angle), 0.1 * std::cos(angle), 0);
                const lks_body_id box = add_body(world, box_shape(0.5, 0.1, 0.5), place, def);
                const auto moved = [&] { return (state_of(world, box).position - metres(place)).length(); };
                INFO("friction " << friction.still << " and " << friction.sliding << ", " << substeps
                                 << " substeps, " << degrees << " degrees");
                if (degrees < limit) {
                    world.step(300);
                    CHECK(moved() < 2e-4);
                    continue;
                }
                // It comes off slowly, by what static friction does not bear.
                world.step(240);
                const double before = state_of(world, box).velocity.length();
                world.step(60);
                const double gained = state_of(world, box).velocity.length() - before;
                const double expected = (std::sin(angle) - friction.sliding * std::cos(angle)) * g;
                CHECK(std::abs(gained / expected - 1) < 0.01);
            }
        }
    }
}

TEST_CASE("a ball that bounces is rubbed by what it is thrown back with, as Coulomb says") {
    const double down = std::sqrt(2 * g);
    for (const double restitution : {0.2, 0.5, 0.8, 1.0}) {
        for (const std::uint32_t substeps : {1u, 8u, 20u}) {
            for (const bool on_body : {false, true}) {
                // Thrown along, it grips and rolls; thrown fast or spinning fast it slides all the time.
                for (const Bounce& thrown : {Bounce{3, 0}, Bounce{0, -20}, Bounce{12, 0}, Bounce{0, 50}}) {
                    const double along = thrown.along;
                    const double spin = thrown.spin;
                    const double slip = along + spin * ball_radius;
                    const double greatest = 0.4 * (1 + restitution) * down;
                    const double grips = std::abs(slip) * 2 / 7; // what stops the slip of a ball
                    const double taken = std::copysign(std::min(grips, greatest), slip);
                    const Bounce found = bounce(restitution, along, spin, substeps, on_body);
                    INFO("restitution " << restitution << ", " << substeps << " substeps, along " << along
                                        << " m/s, spin " << spin << ": " << found.along << ", "
                                        << found.spin);
                    // A substep sees the impact: the speed of the fall is off by what gravity gives in one.
                    const double off = 0.01 + 0.4 * 2 * g / (60 * substeps);
                    CHECK(std::abs(found.along - (along - taken)) < off);
                    CHECK(std::abs(found.spin - (spin - taken * 2.5 / ball_radius)) <
                          2.5 / ball_radius * off);
                }
            }
        }
    }
}

TEST_CASE("a plate that bounces flat is rubbed by what throws it back, too") {
    const double down = std::sqrt(2 * g);
    for (const double restitution : {0.0, 0.5, 0.8}) {
        for (const std::uint32_t substeps : {8u, 20u}) {
            World world(world_def(60, substeps));
            add_slope(world, {0.2, 0.2}, 0);
            lks_body_def def = rubbing({0.2, 0.2});
            def.restitution = fixed(restitution);
            def.velocity = fixed(20, 0, 0);
            const lks_body_id plate = add_body(world, box_shape(0.5, 0.01, 0.5), fixed(0, 1.01, 0), def);
            world.step(28); // in the last of these it comes down
            const double taken = 20 - state_of(world, plate).velocity.x;
            const double expected = 0.2 * (1 + restitution) * down;
            INFO("restitution " << restitution << ", " << substeps << " substeps: " << taken << " m/s of "
                                << expected);
            CHECK(std::abs(taken / expected - 1) < 0.05);
        }
    }
}

TEST_CASE("balls that strike each other off centre part where they meet, and keep what they turn by") {
    constexpr double radius = 0.2;
    for (const double off : {0.05, 0.2, 0.3}) {
        for (const double friction : {0.0, 0.4}) {
            for (const double restitution : {0.0, 0.9}) {
                World world(world_def(60, 8));
                REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
                lks_body_def def = rubbing({friction, friction});
                def.restitution = fixed(restitution);
                def.velocity = fixed(5, 0, 0);
                const lks_body_id a = add_body(world, ball_shape(radius), fixed(-1, off, 0), def);
                def.velocity = {};
                const lks_body_id b = add_body(world, ball_shape(radius), fixed(0, 0, 0), def);
                const double energy = energy_of(world);
                world.step(60);
                const BodyState first = state_of(world, a);
                const BodyState second = state_of(world, b);
                INFO(off << " m off, friction " << friction << ", restitution " << restitution);
                CHECK((first.velocity + second.velocity - Vector{5, 0, 0}).length() < 1e-9);
                CHECK(energy_of(world) < energy);
                // About the middle of both, for a mass of one.
                const Vector between = second.position - first.position;
                const Vector parting = second.velocity - first.velocity;
                const double orbit = (between.x * parting.y - between.y * parting.x) / 2;
                const double spins = 0.4 * radius * radius * (first.spin.z + second.spin.z);
                CHECK(std::abs((orbit + spins) / (-5 * off / 2) - 1) < 0.01);
                CHECK(first.spin.z == doctest::Approx(second.spin.z).epsilon(1e-6));
                if (friction > 0) {
                    CHECK(first.spin.z < -1);
                } else {
                    // Along the line between them as they meet.
                    const double angle = std::atan2(-second.velocity.y, second.velocity.x);
                    CHECK(std::abs(angle - std::asin(off / (2 * radius))) < 0.015);
                }
            }
        }
    }
}
