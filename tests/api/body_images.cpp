// Whatever a game may give, and whatever comes of it: a world's image is taken by another one, and both go on
// alike.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/events.h"

using namespace support;

namespace {

constexpr double edge = 8388000; // metres: the end of positions

// Into a fresh world of the same settings; whether both have the same bits for so many ticks.
void check_loads(World& world, const lks_world_def& def, int ticks) {
    World fresh(def);
    const Image image = world.save();
    const lks_result loaded = lks_world_load(fresh, image.data(), image.size());
    INFO(fresh.message());
    REQUIRE(loaded == LKS_OK);
    REQUIRE(fresh.hash() == world.hash());
    for (int tick = 1; tick <= ticks; ++tick) {
        world.step(1);
        fresh.step(1);
        INFO(tick << " ticks later");
        REQUIRE(fresh.hash() == world.hash());
    }
}

} // namespace

TEST_CASE("a loaded world goes on alike where jointed bodies are deep in each other") {
    const lks_world_def def = world_def(60, 20);
    // Contacts that change their side by it are rare: these were searched for.
    for (const std::uint64_t seed : {1235u, 1512u}) {
        std::uint64_t bits = seed;
        const auto any = [&bits] {
            bits = bits * 6364136223846793005u + 1442695040888963407u;
            return static_cast<double>(bits >> 33) / 0x1p31 - 0.5;
        };
        any();
        World world(def);
        for (int pair = 0; pair < 3; ++pair) {
            lks_body_id ids[2];
            for (int i = 0; i < 2; ++i) {
                const double x = any();
                const double y = any();
                const double z = any();
                const double turn = any();
                const double axis[3] = {any(), any(), any()};
                lks_body_def body = lks_default_body_def();
                REQUIRE(lks_rotation_from_axis_angle_fixed(fixed(axis[0], axis[1], axis[2]),
                                                           fixed(360 * turn),
                                                           &body.transform.rotation) == LKS_OK);
                ids[i] = add_body(world, box_shape(0.3, 0.3, 0.3), fixed(0.4 * x, 0.4 * y + 0.7 * i, 0.4 * z),
                                  body);
            }
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_a.position.y = fixed(0.35);
            joint.frame_b.position.y = fixed(-0.35);
            add_joint(world, joint, ids[0], ids[1]);
        }
        for (int tick = 0; tick < 10; ++tick) {
            check_loads(world, def, 1);
        }
    }
}

TEST_CASE("sticks that are thrown back faster than they may turn have images that load") {
    const lks_world_def def = world_def(30, 2);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    lks_fixed fastest = 0;
    for (int sample = 0; sample < 400; ++sample) {
        World world(def);
        add_ground(world);
        lks_body_def body = lks_default_body_def();
        body.restitution = fixed(1);
        body.velocity.y = fixed(-40);
        body.transform.rotation = about(any(random), any(random), any(random), 180 * any(random));
        const lks_body_id id = add_body(world, box_shape(0.05, 0.5, 0.05), fixed(0, 1.5, 0), body);
        for (int tick = 0; tick < 4; ++tick) {
            check_loads(world, def, 1);
            lks_vec3 velocity{};
            lks_vec3 spin{};
            REQUIRE(lks_body_velocity(world, id, &velocity, &spin) == LKS_OK);
            for (const lks_fixed axis : {spin.x, spin.y, spin.z}) {
                fastest = std::max(fastest, axis < 0 ? -axis : axis);
            }
            // Where nothing touches it, it goes its own way within 7/4 of the limit.
            REQUIRE(fastest <= lks_world_spin_limit(world) * 7 / 4);
        }
    }
    CHECK(fastest >= LKS_FIXED(60)); // the limit was reached
}

TEST_CASE("rotations that a game has computed in float are the same in an image") {
    const lks_world_def def = world_def(60, 4);
    std::mt19937 random(2);
    std::normal_distribution<float> any(0, 1);
    for (int sample = 0; sample < 300; ++sample) {
        World world(def);
        float q[4];
        float squared = 0;
        for (float& c : q) {
            c = any(random);
            squared += c * c;
        }
        const auto part = [&](float c) {
            return static_cast<std::int32_t>(static_cast<double>(c / std::sqrt(squared)) * LKS_ROTATION_ONE);
        };
        const lks_rotation rotation{part(q[0]), part(q[1]), part(q[2]), part(q[3])};
        lks_body_shape shape = box_shape(0.1, 0.2, 0.3);
        shape.transform.rotation = rotation;
        const lks_body_id a = add_body(world, shape, fixed(0, 0, 0));
        const lks_body_id b = add_body(world, shape, fixed(1, 0, 0));
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position.x = fixed(1);
        const lks_joint_id id = add_joint(world, joint, a, b);
        lks_motor motor{};
        motor.max_torque = fixed(5);
        motor.response = fixed(0.1);
        motor.target = rotation;
        REQUIRE(lks_joint_set_motor(world, id, &motor) == LKS_OK);
        check_loads(world, def, 2);
    }
}

TEST_CASE("bodies at the end of all positions, and pressed against it, have images that load") {
    const lks_world_def def = world_def(60, 4);
    for (const std::uint32_t kind : {LKS_BODY_DYNAMIC, LKS_BODY_KINEMATIC}) {
        World world(def);
        lks_body_shape shape = ball_shape(0.5);
        shape.transform.position.x = fixed(1); // its frame lies a metre within
        lks_body_def body = lks_default_body_def();
        body.kind = kind;
        const lks_body_id id = add_body(world, shape, fixed(edge - 1, -edge, edge), body);
        check_loads(world, def, 3);
        REQUIRE(lks_body_set_transform(world, id, at(edge - 1, edge, -edge)) == LKS_OK);
        check_loads(world, def, 3);
        if (kind == LKS_BODY_KINEMATIC) {
            REQUIRE(lks_body_move_to(world, id, at(edge - 1, edge - 2, -edge)) == LKS_OK);
            check_loads(world, def, 3);
        }
    }
    World world(def);
    Humanoid humanoid;
    humanoid.def.transform.position = fixed(edge - 10, 0, 0);
    humanoid.def.velocity = fixed(20, 0, 0);
    REQUIRE(humanoid.add(world) == LKS_OK);
    for (int tick = 0; tick < 120; ++tick) {
        check_loads(world, def, 1);
    }
}

TEST_CASE("a contact's normal has length one, also behind what undoes overlaps, and its image loads") {
    Random random(5);
    const auto between = [&random](double low, double high) {
        return low + (high - low) * static_cast<double>(random.between(0, 1 << 20)) * 0x1p-20;
    };
    double worst = 0;
    int contacts = 0;
    for (int trial = 0; trial < 400; ++trial) {
        World world(weightless(2u << (trial % 3)));
        record(world, LKS_EVENT_BIT(LKS_EVENT_CONTACT_BEGIN) | LKS_EVENT_BIT(LKS_EVENT_CONTACT_END));
        lks_body_def def = lks_default_body_def();
        // A little askew from a quarter turn.
        def.transform.rotation = about(between(-0.03, 0.03), between(-0.03, 0.03), 1, between(89, 91));
        add_body(world, box_shape(0.1, 0.5, 0.5), {}, def);
        lks_body_def ball = lks_default_body_def();
        ball.kind = LKS_BODY_KINEMATIC;
        add_body(world, ball_shape(0.1),
                 fixed(between(-0.45, 0.45), 0.2 - between(0, 0.06), between(-0.45, 0.45)), ball);
        for (int tick = 0; tick < 6; ++tick) {
            world.step();
            for (const lks_event& event : events_of(world)) {
                if (metres(event.normal).length() > 0) {
                    worst = std::max(worst, std::abs(metres(event.normal).length() - 1));
                    ++contacts;
                }
            }
            const Image image = world.save();
            REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
        }
    }
    CHECK(contacts > 300);
    CHECK(worst < 1e-8);
}
