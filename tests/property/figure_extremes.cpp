// What no figure should have to bear: a bone pulled at 1,000 m/s, and figures in exactly the same place.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"

using namespace support;

namespace {

constexpr std::uint32_t joint_count = LKS_HUMANOID_BONES - 1;

struct Figure {
    explicit Figure(World& in, double height) : world(in) {
        Humanoid human;
        human.def.transform.position = fixed(0, height, 0);
        REQUIRE(human.add(world, bodies, joints) == LKS_OK);
    }

    double worst_joint() const {
        double worst = 0;
        for (const lks_joint_id joint : joints) {
            worst = std::max(worst, error_of(world, joint));
        }
        return worst;
    }

    Vector momentum() const {
        Vector sum;
        for (const lks_body_id body : bodies) {
            sum = sum + state_of(world, body).velocity * mass_of(world, body);
        }
        return sum;
    }

    double fastest() const {
        double speed = 0;
        for (const lks_body_id body : bodies) {
            speed = std::max(speed, state_of(world, body).velocity.length());
        }
        return speed;
    }

    World& world;
    lks_body_id bodies[LKS_HUMANOID_BONES];
    lks_joint_id joints[joint_count];
};

} // namespace

TEST_CASE(
    "a humanoid whose bone is thrown off at 1,000 m/s keeps together, its momentum, and gains no energy") {
    for (std::uint32_t bone = 0; bone < LKS_HUMANOID_BONES; ++bone) {
        World world(world_def(60, 8));
        REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
        Figure figure(world, 0);
        REQUIRE(lks_body_set_velocity(world, figure.bodies[bone], fixed(600, 640, 480), {}) == LKS_OK);
        const double energy = energy_of(world);
        const Vector start = figure.momentum();
        double greatest = 0;
        double worst = 0;
        for (int tick = 0; tick < 120; ++tick) {
            world.step();
            greatest = std::max(greatest, energy_of(world));
            worst = std::max(worst, figure.worst_joint());
        }
        INFO("bone " << bone << ": joints " << 1e3 * worst << " mm at the worst, energy "
                     << greatest / energy);
        CHECK(greatest <= energy);
        CHECK(worst < 0.01);
        CHECK(figure.worst_joint() < 1e-3); // it whirls on
        CHECK((figure.momentum() - start).length() < 1e-6 * start.length());
    }
}

TEST_CASE("a humanoid that is dragged by a hand at 1,000 m/s follows, and comes together again") {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    Figure figure(world, 0);
    const lks_body_id hand = figure.bodies[LKS_HUMANOID_BONES - 1];
    REQUIRE(lks_body_set_kind(world, hand, LKS_BODY_KINEMATIC) == LKS_OK);
    lks_transform place{};
    REQUIRE(lks_body_transform(world, hand, &place) == LKS_OK);
    double worst = 0;
    double fastest = 0;
    for (int tick = 0; tick < 60; ++tick) {
        place.position.x += fixed(1000 / 60.0);
        REQUIRE(lks_body_move_to(world, hand, place) == LKS_OK);
        world.step();
        worst = std::max(worst, figure.worst_joint());
        fastest = std::max(fastest, figure.fastest());
    }
    // From nothing to 1,000 m/s in a substep, and nobody may be faster than that for long: 39 cm apart.
    CHECK(worst < 0.5);
    CHECK(fastest < 1100);
    CHECK(figure.worst_joint() < 0.03);
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
    }
    CHECK(figure.worst_joint() < 1e-4);
    CHECK(figure.fastest() < 2);
}

TEST_CASE("figures in exactly the same place part, and fall asleep") {
    for (const int count : {2, 5}) {
        World world(world_def(60, 8));
        add_ground(world);
        std::vector<Figure> figures;
        for (int i = 0; i < count; ++i) {
            figures.emplace_back(world, 1.2);
        }
        double worst = 0;
        double fastest = 0;
        int tick = 0;
        for (; tick < 1800 && (tick == 0 || lks_world_awake_body_count(world) > 0); ++tick) {
            world.step();
            for (const Figure& figure : figures) {
                worst = std::max(worst, figure.worst_joint());
                fastest = std::max(fastest, figure.fastest());
            }
        }
        INFO(count << " figures: joints " << 1e3 * worst << " mm at the worst, fastest " << fastest
                   << " m/s, asleep after " << tick / 60.0 << " s");
        CHECK(worst < 1e-3);
        CHECK(fastest < 12); // they fall at 5
        CHECK(lks_world_awake_body_count(world) == 0);
    }
}
