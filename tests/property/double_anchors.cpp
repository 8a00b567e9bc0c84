// What two joints hold to what does not move, whether they fit each other or not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

lks_body_def kinematic() {
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    def.filter.mask = 0;
    return def;
}

} // namespace

TEST_CASE("a door on two hinges hangs still, however far these are from fitting each other") {
    for (const std::uint32_t kind : {LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double off : {0., 1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
                for (const std::uint32_t substeps : {4u, 8u, 20u}) {
                    if (sanitised && (substeps != 8 || axis != 0)) {
                        continue;
                    }
                    World world(world_def(60, substeps));
                    const lks_body_id post =
                        add_body(world, box_shape(0.05, 1, 0.05), fixed(0, 1, 0), kinematic());
                    lks_body_def def = lks_default_body_def();
                    def.mass = fixed(25);
                    def.filter.mask = 0;
                    const lks_body_id door = add_body(world, box_shape(0.45, 1, 0.02), fixed(0.5, 1, 0), def);
                    lks_joint_def joint = lks_default_joint_def();
                    joint.kind = kind;
                    std::vector<lks_joint_id> joints;
                    for (const double height : {-0.8, 0.8}) {
                        const double error = height > 0 ? off : 0;
                        joint.frame_a.position = fixed(0.05, height, 0);
                        joint.frame_b.position =
                            fixed(-0.45 + (axis == 0 ? error : 0), height + (axis == 1 ? error : 0),
                                  axis == 2 ? error : 0);
                        joints.push_back(add_joint(world, joint, post, door));
                    }
                    double most = 0, apart = 0;
                    for (int tick = 0; tick < 600; ++tick) {
                        world.step();
                        most = std::max(most, energy_of(world));
                        for (const lks_joint_id id : joints) {
                            apart = std::max(apart, error_of(world, id));
                        }
                    }
                    INFO((kind == LKS_JOINT_HINGE ? "hinges " : "balls ")
                         << off << " m off along " << axis << ", " << substeps << " substeps");
                    CHECK(most < 30); // it may swing, a little
                    CHECK(apart < 2 * off + 1e-3);
                    CHECK(energy_of(world) < 30);
                }
            }
        }
    }
}

TEST_CASE("the one bone that an animation leaves to itself stays where it belongs, though the others are "
          "moved inexactly") {
    for (const std::uint32_t free :
         {LKS_HUMANOID_UPPER_ARM_LEFT, LKS_HUMANOID_UPPER_LEG_LEFT, LKS_HUMANOID_CHEST}) {
        for (const double noise : {0., 1e-4, 1e-3, 5e-3}) {
            for (const std::uint32_t substeps : {4u, 8u, 20u}) {
                if (sanitised && substeps != 8) {
                    continue;
                }
                World world(world_def(60, substeps));
                Humanoid humanoid;
                humanoid.def.transform.position = fixed(0, 1, 0);
                lks_body_id bodies[LKS_HUMANOID_BONES];
                REQUIRE(humanoid.add(world, bodies) == LKS_OK);
                lks_transform rest[LKS_HUMANOID_BONES];
                for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
                    REQUIRE(lks_body_transform(world, bodies[i], &rest[i]) == LKS_OK);
                    if (i != free) {
                        REQUIRE(lks_body_set_kind(world, bodies[i], LKS_BODY_KINEMATIC) == LKS_OK);
                    }
                }
                Random random(3);
                const auto off = [&] {
                    return noise * static_cast<double>(random.between(-1000, 1000)) / 1000;
                };
                double most = 0, away = 0;
                for (int tick = 0; tick < 300; ++tick) {
                    const double along = 0.3 * std::sin(0.05 * tick);
                    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
                        if (i != free) {
                            lks_transform place = rest[i];
                            place.position = place.position + fixed(along + off(), off(), off());
                            REQUIRE(lks_body_move_to(world, bodies[i], place) == LKS_OK);
                        }
                    }
                    world.step();
                    most = std::max(most, energy_of(world));
                    away = std::max(away, (state_of(world, bodies[free]).position -
                                           metres(rest[free].position) - Vector{along, 0, 0})
                                              .length());
                }
                INFO("bone " << free << ", " << noise << " m, " << substeps << " substeps");
                CHECK(most < 100);
                CHECK(away < 0.05);
            }
        }
    }
}

TEST_CASE("a humanoid that is held by both hands stays whole, within its reach and beyond") {
    for (const double span : {1.0, 1.5, 1.7}) {
        for (const std::uint32_t substeps : {8u, 20u}) {
            if (sanitised && substeps != 8) {
                continue;
            }
            World world(world_def(60, substeps));
            Humanoid humanoid;
            humanoid.def.transform.position = fixed(0, 1, 0);
            lks_body_id bodies[LKS_HUMANOID_BONES];
            lks_joint_id joints[LKS_HUMANOID_BONES - 1];
            REQUIRE(humanoid.add(world, bodies, joints) == LKS_OK);
            std::vector<lks_joint_id> all(joints, joints + LKS_HUMANOID_BONES - 1);
            lks_body_id holders[2];
            double start = 0;
            for (int side = 0; side < 2; ++side) {
                const lks_body_id hand = bodies[side == 0 ? LKS_HUMANOID_HAND_LEFT : LKS_HUMANOID_HAND_RIGHT];
                lks_transform place{};
                REQUIRE(lks_body_transform(world, hand, &place) == LKS_OK);
                holders[side] = add_body(world, ball_shape(0.05), place.position, kinematic());
                all.push_back(add_joint(world, lks_default_joint_def(), holders[side], hand));
                start = std::abs(metres(place.position.x));
            }
            double apart = 0, most = 0, now = 2 * start, lift = 0;
            for (int tick = 0; tick < 600; ++tick) {
                const double wider = tick >= 60 && now < span ? 1.0 / 60 : 0; // 0.5 m/s each
                const double higher = tick < 60 ? 0.9 / 60 : 0;
                now += wider;
                lift += higher;
                for (int side = 0; side < 2; ++side) {
                    lks_transform place{};
                    REQUIRE(lks_body_transform(world, holders[side], &place) == LKS_OK);
                    const double out = place.position.x > 0 ? 1 : -1;
                    place.position = place.position + fixed(out * wider / 2, higher, 0);
                    REQUIRE(lks_body_move_to(world, holders[side], place) == LKS_OK);
                }
                world.step();
                most = std::max(most, energy_of(world));
                for (const lks_joint_id id : all) {
                    apart = std::max(apart, error_of(world, id));
                }
            }
            INFO(span << " m, " << substeps << " substeps");
            MESSAGE(span << " m, " << substeps << " substeps: " << most << " J, " << apart << " m apart");
            CHECK(most < (span < 1.55 ? 1500 : 8000)); // beyond its reach it is torn, and snaps
            CHECK(apart < (span < 1.55 ? 0.01 : 1.5));
        }
    }
}

TEST_CASE("what a distance joint bore can be read after its limits were changed") {
    World world(world_def(60, 20));
    const lks_body_id anchor = add_anchor(world, fixed(0, 3, 0));
    lks_body_def def = lks_default_body_def();
    def.mass = fixed(80);
    const lks_body_id weight = add_body(world, ball_shape(0.2), fixed(0, 1, 0), def);
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = LKS_JOINT_DISTANCE;
    joint.distance_max = fixed(2);
    const lks_joint_id id = add_joint(world, joint, anchor, weight);
    world.step(600);
    lks_vec3 before{}, after{};
    REQUIRE(lks_joint_load(world, id, &before, nullptr) == LKS_OK);
    CHECK(std::abs(metres(before).length() - 80 * 9.81) < 1);
    lks_limits limits{};
    REQUIRE(lks_joint_limits(world, id, &limits) == LKS_OK);
    limits.distance_max -= fixed(0.01);
    REQUIRE(lks_joint_set_limits(world, id, &limits) == LKS_OK);
    REQUIRE(lks_joint_load(world, id, &after, nullptr) == LKS_OK);
    CHECK(same(before, after));
}
