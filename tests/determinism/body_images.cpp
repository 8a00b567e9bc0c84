// What a world already has of an image's bodies and joints is not made again: whatever it had before, it is
// the image's afterwards and has its future.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr std::uint32_t links = 6;

// A chain that falls onto a stack; a body of several shapes on its end.
struct Chained {
    World world{world_def(60, 6)};
    std::vector<lks_body_id> bodies;
    std::vector<lks_joint_id> joints;

    Chained() {
        add_ground(world);
        for (int i = 0; i < 3; ++i) {
            add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0.5, 0.2 + 0.4 * i, 0));
        }
        for (std::uint32_t i = 0; i < links; ++i) {
            bodies.push_back(add_link(i, 1000));
        }
        for (std::uint32_t i = 0; i + 1 < links; ++i) {
            joints.push_back(join(i, 20));
        }
        const lks_motor motor{fixed(2), fixed(0.1), {0, 0, 1 << 29, 929887697}};
        REQUIRE(lks_joint_set_motor(world, joints[2], &motor) == LKS_OK);
    }

    lks_body_id add_link(std::uint32_t i, double density, lks_fixed friction = LKS_FIXED_RATIO(1, 2)) {
        const bool last = i == links - 1;
        lks_body_shape shapes[3] = {capsule_shape(0.05, 0.1, density), box_shape(0.1, 0.05, 0.07, density),
                                    ball_shape(0.08, density)};
        for (int s = 0; s < 3; ++s) {
            shapes[s].transform.position = fixed(0, 0.1 * s, 0.02 * s);
        }
        lks_body_def def = lks_default_body_def();
        def.shapes = shapes;
        def.shape_count = last ? 3 : 1;
        def.transform.position = fixed(0.1 * i, 1.8 + 0.31 * i, 0.01 * i);
        def.static_friction = friction;
        lks_body_id id{};
        REQUIRE(lks_world_add_body(world, &def, &id) == LKS_OK);
        return id;
    }

    lks_joint_id join(std::uint32_t i, double limit, double soft = 0.02) {
        lks_joint_def def = lks_default_joint_def();
        def.kind = i == 1 ? LKS_JOINT_HINGE : LKS_JOINT_BALL;
        def.swing_limit = fixed(limit);
        def.friction = fixed(0.05);
        def.limit_compliance = fixed(i == 3 ? soft : 0);
        def.limit_damping = fixed(i == 3 ? 0.01 : 0);
        def.frame_a.position = fixed(0, 0.15, 0);
        def.frame_b.position = fixed(0, -0.15, 0);
        return add_joint(world, def, bodies[i], bodies[i + 1]);
    }

    // With its joints.
    void replace(std::uint32_t i, double density, lks_fixed friction = LKS_FIXED_RATIO(1, 2)) {
        REQUIRE(lks_world_remove_body(world, bodies[i]) == LKS_OK);
        const std::uint32_t index = bodies[i].index;
        bodies[i] = add_link(i, density, friction);
        REQUIRE(bodies[i].index == index);
        for (const std::uint32_t joint : {i - 1, i}) {
            joints[joint] = join(joint, 20);
        }
    }

    void set_swing(double degrees) {
        lks_limits limits{};
        REQUIRE(lks_joint_limits(world, joints[1], &limits) == LKS_OK);
        limits.swing_limit = fixed(degrees);
        REQUIRE(lks_joint_set_limits(world, joints[1], &limits) == LKS_OK);
    }

    void set_motor(double torque, const lks_rotation& target) {
        const lks_motor motor{fixed(torque), fixed(0.1), target};
        REQUIRE(lks_joint_set_motor(world, joints[2], &motor) == LKS_OK);
    }
};

const std::function<void(Chained&)> changes[] = {
    [](Chained&) {},
    [](Chained& c) { c.replace(2, 1000); },                            // the same once more
    [](Chained& c) { c.replace(2, 3000); },                            // joints of the same, other masses
    [](Chained& c) { c.replace(2, 1000, LKS_FIXED_RATIO(1, 2) + 1); }, // the least there is
    [](Chained& c) { c.replace(links - 2, 1000, LKS_FIXED_RATIO(1, 2) - 1); },
    [](Chained& c) { REQUIRE(lks_body_set_kind(c.world, c.bodies[3], LKS_BODY_KINEMATIC) == LKS_OK); },
    [](Chained& c) { c.set_motor(2, about(1, 0, 0, 30)); },
    [](Chained& c) {
        c.set_motor(5, {0, 0, 1 << 29, 929887697});
    },
    [](Chained& c) {
        c.set_motor(0, {0, 0, 0, LKS_ROTATION_ONE});
    },
    [](Chained& c) {
        REQUIRE(lks_world_remove_joint(c.world, c.joints[1]) == LKS_OK);
        c.joints[1] = c.join(1, 50);
    },
    [](Chained& c) {
        // Softer limits only.
        REQUIRE(lks_world_remove_joint(c.world, c.joints[3]) == LKS_OK);
        c.joints[3] = c.join(3, 20, 0.03);
    },
    [](Chained& c) { c.set_swing(15); },
    [](Chained& c) { c.set_swing(180); },
    [](Chained& c) { REQUIRE(lks_world_remove_joint(c.world, c.joints[1]) == LKS_OK); },
    [](Chained& c) { REQUIRE(lks_world_remove_joint(c.world, c.joints.back()) == LKS_OK); },
    [](Chained& c) { REQUIRE(lks_world_remove_body(c.world, c.bodies[4]) == LKS_OK); },
    [](Chained& c) {
        // More of both than the image has, one pair that it lets collide.
        for (int i = 0; i < 20; ++i) {
            add_body(c.world, ball_shape(0.1), fixed(3, 0.1 + 0.2 * i, 0));
        }
        lks_joint_def def = lks_default_joint_def();
        def.kind = LKS_JOINT_DISTANCE;
        def.distance_max = fixed(5);
        add_joint(c.world, def, c.bodies[0], c.bodies[5]);
    },
    [](Chained& c) {
        // Other bodies where the chain was.
        for (const lks_body_id body : c.bodies) {
            REQUIRE(lks_world_remove_body(c.world, body) == LKS_OK);
        }
        for (std::uint32_t i = 0; i < links; ++i) {
            add_body(c.world, box_shape(0.1, 0.2, 0.3), fixed(0, 1 + i, 0));
        }
    },
};

void check_same_future(const Image& image, World& dirty) {
    World fresh(world_def(60, 6));
    REQUIRE(lks_world_load(fresh, image.data(), image.size()) == LKS_OK);
    REQUIRE(lks_world_load(dirty, image.data(), image.size()) == LKS_OK);
    CHECK(fresh.save() == image);
    CHECK(dirty.save() == image);
    for (int tick = 0; tick < 90; ++tick) {
        REQUIRE(fresh.hash() == dirty.hash());
        fresh.step();
        dirty.step();
    }
    CHECK(fresh.save() == dirty.save());
    CHECK(energy_of(fresh) == energy_of(dirty));
}

} // namespace

TEST_CASE("an image has the same future in a world whose bodies and joints are others in any way") {
    Chained original;
    original.world.step(25);
    const Image image = original.world.save();
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        INFO("change " << i);
        for (const int ticks : {0, 12, 40}) {
            if (support::sanitised && ticks != 12) {
                continue;
            }
            Chained dirty;
            changes[i](dirty);
            dirty.world.step(ticks);
            check_same_future(image, dirty.world);
            // And the other way round.
            Chained changed;
            changed.world.step(ticks);
            changes[i](changed);
            changed.world.step(7);
            const Image other = changed.world.save();
            check_same_future(other, original.world);
        }
    }
}

TEST_CASE("what is read out follows from the state: a loaded world says the same at once") {
    Chained original;
    for (int tick = 0; tick < 60; ++tick) {
        original.world.step();
        const Image image = original.world.save();
        World loaded(world_def(60, 6));
        REQUIRE(lks_world_load(loaded, image.data(), image.size()) == LKS_OK);
        for (const lks_joint_id joint : original.joints) {
            lks_fixed expected[3];
            lks_fixed got[3];
            REQUIRE(lks_joint_error(original.world, joint, &expected[0]) == LKS_OK);
            REQUIRE(lks_joint_angles(original.world, joint, &expected[1], &expected[2]) == LKS_OK);
            REQUIRE(lks_joint_error(loaded, joint, &got[0]) == LKS_OK);
            REQUIRE(lks_joint_angles(loaded, joint, &got[1], &got[2]) == LKS_OK);
            CHECK(std::equal(got, got + 3, expected));
        }
        CHECK(energy_of(loaded) == energy_of(original.world));
    }
}
