// Who is struck strikes the next one in the same tick: in a row of balls each hands on what it got, however
// far they are from each other, asleep or awake, and nobody passes anybody.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

constexpr double radius = 0.02857; // of pool

lks_body_def frictionless(double restitution) {
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(restitution);
    def.static_friction = def.dynamic_friction = 0;
    return def;
}

struct Strike {
    double gap; // metres
    double speed;
    bool asleep;
    double restitution;
    std::uint32_t substeps;
};

// Five in a row, and one that comes along it.
class Row {
public:
    explicit Row(const Strike& strike) : world_(weightless(strike.substeps)), strike_(strike) {
        lks_body_def def = frictionless(strike.restitution);
        def.never_sleeps = strike.asleep ? 0 : 1;
        for (int i = 0; i < 5; ++i) {
            balls_.push_back(
                add_body(world_, ball_shape(radius), fixed(i * (2 * radius + strike.gap), 0, 0), def));
        }
        for (int tick = 0; strike.asleep && tick < 600 && lks_world_awake_body_count(world_) != 0; ++tick) {
            world_.step();
        }
        REQUIRE(lks_world_awake_body_count(world_) == (strike.asleep ? 0 : 5));
        def.velocity = fixed(strike.speed, 0, 0);
        balls_.insert(balls_.begin(), add_body(world_, ball_shape(radius), fixed(-0.5, 0, 0), def));
    }

    void run() {
        const double way = 0.5 + 5 * (2 * radius + strike_.gap) + 0.5;
        for (int tick = 0; tick < static_cast<int>(60 * way / strike_.speed) + 20; ++tick) {
            world_.step();
            for (std::size_t i = 1; i < balls_.size(); ++i) {
                CHECK(state_of(world_, balls_[i]).position.x > state_of(world_, balls_[i - 1]).position.x);
            }
        }
    }

    // In what the first one had.
    double momentum() const {
        double sum = 0;
        for (const lks_body_id ball : balls_) {
            sum += speed(ball);
        }
        return sum / strike_.speed;
    }

    double last_speed() const { return speed(balls_.back()) / strike_.speed; }

private:
    double speed(lks_body_id ball) const { return state_of(world_, ball).velocity.x; }

    World world_;
    Strike strike_;
    std::vector<lks_body_id> balls_;
};

} // namespace

TEST_CASE("a row of balls hands a strike on in the tick in which it comes, asleep or awake") {
    for (const bool asleep : {false, true}) {
        for (const double gap : {0.0005, 0.005, 0.02, 0.05, 0.1, 0.3}) {
            for (const double speed : {1., 3., 10., 20.}) {
                INFO("gaps of " << gap << " m, " << speed << " m/s, asleep: " << asleep);
                Row bouncing({gap, speed, asleep, 1, 8});
                bouncing.run();
                CHECK(std::abs(bouncing.last_speed() - 1) < 1e-3);
                CHECK(std::abs(bouncing.momentum() - 1) < 1e-6);
                Row dull({gap, speed, asleep, 0, 8});
                dull.run();
                CHECK(std::abs(dull.momentum() - 1) < 1e-6);
            }
        }
    }
}

TEST_CASE("with few substeps a row hands on what comes by twice its thickness in one of them") {
    for (const bool asleep : {false, true}) {
        for (const double gap : {0.005, 0.02, 0.05, 0.1}) {
            for (const std::uint32_t substeps : {1u, 2u, 4u, 20u}) {
                const double speed = std::min(40., 2 * 2 * radius * 60 * substeps * 0.9);
                INFO("gaps of " << gap << " m, " << substeps << " substeps, asleep: " << asleep);
                Row bouncing({gap, speed, asleep, 1, substeps});
                bouncing.run();
                CHECK(std::abs(bouncing.momentum() - 1) < 1e-6);
            }
        }
    }
}

TEST_CASE("a rack of balls that is broken at ten metres a second scatters, and no two go into each other") {
    for (const double gap : {0.0005, 0.01, 0.03}) {
        World world(weightless(8));
        std::vector<lks_body_id> balls;
        const double pitch = 2 * radius + gap;
        for (int row = 0; row < 5; ++row) {
            for (int i = 0; i <= row; ++i) {
                balls.push_back(add_body(world, ball_shape(radius),
                                         fixed(row * pitch * std::sqrt(0.75), 0, (i - row / 2.) * pitch),
                                         frictionless(0.95)));
            }
        }
        for (int tick = 0; tick < 600 && lks_world_awake_body_count(world) != 0; ++tick) {
            world.step();
        }
        REQUIRE(lks_world_awake_body_count(world) == 0);
        lks_body_def def = frictionless(0.95);
        def.velocity = fixed(10, 0, 0);
        balls.push_back(add_body(world, ball_shape(radius), fixed(-0.4, 0, 0.003), def));
        double nearest = 1;
        for (int tick = 0; tick < 60; ++tick) {
            world.step();
            for (std::size_t i = 0; i < balls.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    nearest = std::min(
                        nearest,
                        (state_of(world, balls[i]).position - state_of(world, balls[j]).position).length());
                }
            }
        }
        Vector momentum{};
        double energy = 0;
        for (const lks_body_id ball : balls) {
            const Vector velocity = state_of(world, ball).velocity;
            momentum = momentum + velocity;
            energy += velocity.dot(velocity) / 2;
        }
        INFO("gaps of " << gap << " m");
        CHECK(nearest > 2 * radius - 0.004);
        CHECK((momentum - Vector{10, 0, 0}).length() < 1e-5);
        CHECK(energy < 50);
        CHECK(energy > 30);
    }
}

// They fall with the same speed, so that neither comes towards the other until the ground has sent the lower
// one back.
TEST_CASE("a ball that falls behind another is struck by it in the tick in which that bounces") {
    for (const std::uint32_t substeps : {8u, 20u}) {
        for (const double speed : {3., 5., 8., 12., 18.}) {
            for (const double gap : {0.001, 0.01, 0.03, 0.06}) {
                for (int start = 0; start < 8; ++start) {
                    World world(world_def(60, substeps));
                    add_ground(world);
                    const double height = speed / 60 * (1 + start / 8.);
                    lks_body_def def = frictionless(0.9);
                    def.velocity = fixed(0, -speed, 0);
                    const lks_body_id lower =
                        add_body(world, ball_shape(0.12, 83), fixed(0, 0.12 + height, 0), def);
                    const lks_body_id upper =
                        add_body(world, ball_shape(0.033, 370), fixed(0, 0.273 + height + gap, 0), def);
                    double fastest = 0;
                    for (int tick = 0; tick < 12; ++tick) {
                        world.step();
                        const double above =
                            state_of(world, upper).position.y - state_of(world, lower).position.y;
                        INFO(substeps << " substeps, " << speed << " m/s, " << gap << " m apart, from "
                                      << height << " m");
                        CHECK(above > 0.11);
                        fastest = std::max(fastest, state_of(world, upper).velocity.y);
                    }
                    CHECK(fastest > 0.9 * speed);
                }
            }
        }
    }
}

// Each is lighter than the one before and would be faster, without end: no body is faster than the limit, nor
// carried further.
TEST_CASE("a row from a thousand tonnes to a milligram hands on no more than the greatest speed") {
    const int count = 24;
    for (const bool asleep : {false, true}) {
        for (const std::uint32_t substeps : {1u, 8u, 100u}) {
            INFO(substeps << " substeps, asleep: " << asleep);
            World world(weightless(substeps));
            lks_body_def def = frictionless(1);
            def.never_sleeps = asleep ? 0 : 1;
            std::vector<lks_body_id> balls;
            for (int i = 0; i < count; ++i) {
                def.mass =
                    std::max(fixed(std::pow(10, 6 - 12. * i / (count - 1))), LKS_FIXED_RATIO(1, 1000000));
                balls.push_back(add_body(world, ball_shape(0.05), fixed(0.12 * i, 0, 0), def));
            }
            for (int tick = 0; asleep && tick < 600 && lks_world_awake_body_count(world) != 0; ++tick) {
                world.step();
            }
            const double limit = std::min(1000., 16. * 60 * substeps);
            REQUIRE(lks_body_set_velocity(world, balls[0], fixed(0.9 * limit, 0, 0), {}) == LKS_OK);
            world.step(20);
            CHECK(state_of(world, balls[0]).velocity.x > 0);
            CHECK(std::abs(state_of(world, balls.back()).velocity.x / limit - 1) < 1e-6);
        }
    }
}
