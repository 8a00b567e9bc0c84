// Poses in and out, from animation to ragdoll and back, and powered ragdolls.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bodies.h"
#include "support/refusals.h"

using namespace support;

namespace {

const double pi = std::acos(-1.0);

struct Puppet {
    explicit Puppet(World& world, std::uint32_t root_kind = LKS_BODY_DYNAMIC) : world_(world) {
        human.bones[LKS_HUMANOID_PELVIS].body.kind = root_kind;
        REQUIRE(human.add(world, bodies, joints) == LKS_OK);
    }

    std::vector<lks_transform> pose() const {
        std::vector<lks_transform> out(LKS_HUMANOID_BONES);
        REQUIRE(lks_ragdoll_pose(world_, bodies, LKS_HUMANOID_BONES, out.data()) == LKS_OK);
        return out;
    }

    Humanoid human;
    lks_body_id bodies[LKS_HUMANOID_BONES];
    lks_joint_id joints[LKS_HUMANOID_BONES - 1];

private:
    World& world_;
};

// Degrees between two rotations.
double between(const lks_rotation& a, const lks_rotation& b) {
    const double dot =
        (1.0 * a.x * b.x + 1.0 * a.y * b.y + 1.0 * a.z * b.z + 1.0 * a.w * b.w) / std::pow(2.0, 60);
    return 2 * std::acos(std::min(1.0, std::abs(dot))) * 180 / pi;
}

} // namespace

TEST_CASE("a pose that was read is the one that was set, and velocities follow from two of them") {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {0, 0, 0}) == LKS_OK);
    Puppet puppet(world);
    const std::vector<lks_transform> before = puppet.pose();
    std::vector<lks_transform> now = before;
    for (lks_transform& bone : now) {
        bone.position = bone.position + fixed(0.1, -0.02, 0);
    }
    REQUIRE(lks_ragdoll_set_pose(world, puppet.bodies, LKS_HUMANOID_BONES, now.data(), before.data()) ==
            LKS_OK);
    for (int i = 0; i < static_cast<int>(LKS_HUMANOID_BONES); ++i) {
        const BodyState state = state_of(world, puppet.bodies[i]);
        CHECK((state.velocity - Vector{6, -1.2, 0}).length() < 1e-6);
        CHECK(state.spin.length() < 1e-6);
        CHECK(puppet.pose()[static_cast<std::size_t>(i)].position.x ==
              now[static_cast<std::size_t>(i)].position.x);
    }
    // It flies on as one.
    world.step(30);
    CHECK(std::abs(state_of(world, puppet.bodies[LKS_HUMANOID_HEAD]).velocity.x - 6) < 1e-3);
    // A bone that turns by three degrees a tick.
    std::vector<lks_transform> turned = puppet.pose();
    turned[0].rotation = product(about(0, 1, 0, 3), turned[0].rotation);
    const std::vector<lks_transform> as_it_is = puppet.pose();
    REQUIRE(lks_ragdoll_set_pose(world, puppet.bodies, 1, turned.data(), as_it_is.data()) == LKS_OK);
    CHECK(std::abs(state_of(world, puppet.bodies[0]).spin.y - pi) < 1e-3);
}

TEST_CASE("what turns from one pose to the next turns on by the same angle a tick") {
    for (const std::uint32_t substeps : {1u, 2u, 8u, 20u}) {
        for (const double degrees : {1e-4, 1.0, 10.0, 30.0, 60.0, 90.0, 120.0}) {
            CAPTURE(substeps);
            CAPTURE(degrees);
            if (std::tan(degrees / 2 / substeps * pi / 180) > 0.5) {
                continue; // faster than bodies may spin
            }
            World world(weightless(substeps));
            lks_body_def def = lks_default_body_def();
            def.angular_damping = 0;
            const lks_body_id ball = add_body(world, ball_shape(0.2), {}, def);
            lks_transform before = at(0, 0, 0);
            lks_transform now = before;
            now.rotation = about(0.6, 0, 0.8, degrees);
            REQUIRE(lks_ragdoll_set_pose(world, &ball, 1, &now, &before) == LKS_OK);
            world.step();
            const lks_rotation back = conjugate(now.rotation);
            const lks_rotation turned = product(state_of(world, ball).rotation, back);
            const double sine = std::hypot(turned.x, turned.y, turned.z);
            const double angle = 2 * std::atan2(sine, turned.w) * 180 / pi;
            CHECK(std::abs(angle - degrees) < 1e-5 * degrees + 1e-6);
        }
    }
}

TEST_CASE("an animated figure becomes a ragdoll at the speed that it had, and can be animated again") {
    World world(world_def(60, 8));
    Puppet puppet(world);
    REQUIRE(lks_ragdoll_set_kind(world, puppet.bodies, LKS_HUMANOID_BONES, LKS_BODY_KINEMATIC) == LKS_OK);
    CHECK(lks_body_get_kind(world, puppet.bodies[3]) == LKS_BODY_KINEMATIC);
    std::vector<lks_transform> pose = puppet.pose();
    const auto walk = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick) {
            for (lks_transform& bone : pose) {
                bone.position.x += fixed(0.05);
            }
            REQUIRE(lks_ragdoll_move_to(world, puppet.bodies, LKS_HUMANOID_BONES, pose.data()) == LKS_OK);
            world.step();
        }
    };
    walk(30);
    CHECK(puppet.pose()[2].position.x == pose[2].position.x);
    REQUIRE(lks_ragdoll_set_kind(world, puppet.bodies, LKS_HUMANOID_BONES, LKS_BODY_DYNAMIC) == LKS_OK);
    CHECK(std::abs(state_of(world, puppet.bodies[LKS_HUMANOID_CHEST]).velocity.x - 3) < 1e-6);
    world.step(12);
    // It falls, and goes on at 3 m/s.
    const BodyState chest = state_of(world, puppet.bodies[LKS_HUMANOID_CHEST]);
    CHECK(std::abs(chest.velocity.x - 3) < 0.3);
    CHECK(chest.velocity.y < -1);
    REQUIRE(lks_ragdoll_set_kind(world, puppet.bodies, LKS_HUMANOID_BONES, LKS_BODY_KINEMATIC) == LKS_OK);
    pose = puppet.pose();
    walk(10);
    CHECK(puppet.pose()[5].position.y == pose[5].position.y);
    // What is saved with joints between kinematic bodies can be loaded.
    const Image image = world.save();
    REQUIRE(lks_world_load(world, image.data(), image.size()) == LKS_OK);
    CHECK(world.save() == image);
}

TEST_CASE("a figure may be added as animated, with all of its joints") {
    World world(world_def(60, 8));
    Humanoid humanoid;
    for (lks_bone& bone : humanoid.bones) {
        bone.body.kind = LKS_BODY_KINEMATIC;
    }
    lks_body_id bodies[LKS_HUMANOID_BONES];
    REQUIRE(humanoid.add(world, bodies) == LKS_OK);
    CHECK(lks_world_joint_count(world) == LKS_HUMANOID_BONES - 1);
    const Vector head = state_of(world, bodies[LKS_HUMANOID_HEAD]).position;
    world.step(30);
    CHECK((state_of(world, bodies[LKS_HUMANOID_HEAD]).position - head).length() == 0);
    // Held by the head, then: all hang on it.
    REQUIRE(lks_ragdoll_set_kind(world, bodies, LKS_HUMANOID_BONES, LKS_BODY_DYNAMIC) == LKS_OK);
    REQUIRE(lks_body_set_kind(world, bodies[LKS_HUMANOID_HEAD], LKS_BODY_KINEMATIC) == LKS_OK);
    world.step(300);
    CHECK((state_of(world, bodies[LKS_HUMANOID_CHEST]).position - head).length() < 0.6);
    CHECK((state_of(world, bodies[LKS_HUMANOID_FOOT_LEFT]).position - head).length() < 2);
}

TEST_CASE("a powered ragdoll takes the pose that it is given, and goes limp without strength") {
    World world(world_def(60, 8));
    Puppet puppet(world, LKS_BODY_KINEMATIC);
    std::vector<lks_transform> pose = puppet.pose();
    // The left arm raised to the side, the right knee bent: turned as a whole, as animations have it.
    const lks_rotation raised = about(0, 0, 1, 80);
    for (const std::size_t bone : {3, 4, 5}) {
        pose[bone].rotation = product(raised, pose[bone].rotation);
    }
    const lks_rotation bent = about(1, 0, 0, 70);
    for (const std::size_t bone : {13, 14}) {
        pose[bone].rotation = product(bent, pose[bone].rotation);
    }
    for (int tick = 0; tick < 90; ++tick) {
        REQUIRE(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1),
                                  fixed(0.1)) == LKS_OK);
        world.step();
    }
    const std::vector<lks_transform> reached = puppet.pose();
    for (std::size_t bone = 0; bone < pose.size(); ++bone) {
        INFO("bone " << bone);
        CHECK(between(reached[bone].rotation, pose[bone].rotation) < 1.5);
    }
    REQUIRE(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), 0, 0) == LKS_OK);
    world.step(120);
    CHECK(between(puppet.pose()[4].rotation, pose[4].rotation) > 30);
}

TEST_CASE("a spider stands on its eight legs, and falls where its strength leaves it") {
    World world(world_def(60, 8));
    add_ground(world);
    Spider spider;
    lks_body_id bodies[LKS_SPIDER_BONES];
    lks_joint_id joints[LKS_SPIDER_BONES - 1];
    const lks_result added = spider.add(world, bodies, joints);
    INFO(world.message());
    REQUIRE(added == LKS_OK);
    lks_transform rest[LKS_SPIDER_BONES];
    REQUIRE(lks_ragdoll_pose(world, bodies, LKS_SPIDER_BONES, rest) == LKS_OK);
    for (const lks_joint_id joint : joints) {
        CHECK(error_of(world, joint) < 1e-8);
    }
    REQUIRE(lks_ragdoll_drive(world, &spider.def, joints, rest, fixed(1), fixed(0.05)) == LKS_OK);
    world.step(240);
    const double standing = state_of(world, bodies[LKS_SPIDER_THORAX]).position.y;
    CHECK(standing > 0.2);
    REQUIRE(lks_ragdoll_drive(world, &spider.def, joints, rest, 0, 0) == LKS_OK);
    world.step(240);
    CHECK(state_of(world, bodies[LKS_SPIDER_THORAX]).position.y < 0.15);
}

TEST_CASE("poses and drives that are none are refused whole") {
    World world(world_def(60, 8));
    Puppet puppet(world);
    std::vector<lks_transform> pose = puppet.pose();
    const std::uint64_t hash = world.hash();
    pose[7].rotation = {0, 0, 0, 0};
    constexpr std::uint32_t count = LKS_HUMANOID_BONES;
    CHECK(lks_ragdoll_set_pose(world, puppet.bodies, count, pose.data(), nullptr) ==
          LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1), 0) ==
          LKS_ERROR_INVALID_ARGUMENT);
    pose = puppet.pose();
    CHECK(lks_ragdoll_move_to(world, puppet.bodies, count, pose.data()) == LKS_ERROR_UNSUPPORTED);
    CHECK(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(-1), 0) ==
          LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1), fixed(101)) ==
          LKS_ERROR_INVALID_ARGUMENT);
    puppet.human.def.struct_size = 5;
    CHECK(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1), 0) ==
          LKS_ERROR_STRUCT_SIZE);
    puppet.human.def.struct_size = sizeof(lks_ragdoll_def);
    puppet.human.bones[6].parent = 9;
    CHECK(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1), 0) ==
          LKS_ERROR_INVALID_ARGUMENT);
    puppet.human.bones[6].parent = LKS_HUMANOID_CHEST;
    puppet.joints[2].generation = 9;
    CHECK(lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1), 0) ==
          LKS_ERROR_STALE_ID);
    CHECK(lks_ragdoll_set_kind(world, puppet.bodies, count, 2) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(lks_ragdoll_pose(world, nullptr, count, pose.data()) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_ragdoll_pose(nullptr, puppet.bodies, count, pose.data()) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_ragdoll_drive(world, nullptr, puppet.joints, pose.data(), 0, 0) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_spider(nullptr, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(world.hash() == hash);
    // One of them can't go that far: none goes.
    REQUIRE(lks_ragdoll_set_kind(world, puppet.bodies, count, LKS_BODY_KINEMATIC) == LKS_OK);
    const std::uint64_t still = world.hash();
    for (lks_transform& bone : pose) {
        bone.position.x += fixed(1);
    }
    pose[14].position.x += fixed(200);
    CHECK(lks_ragdoll_move_to(world, puppet.bodies, count, pose.data()) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(world.hash() == still);
}

TEST_CASE("what is refused of a pose names the bone, and a body or a joint stands in it once") {
    World world(world_def(60, 8));
    Puppet puppet(world);
    constexpr std::uint32_t count = LKS_HUMANOID_BONES;
    std::vector<lks_transform> pose = puppet.pose();
    std::vector<lks_transform> out(count);
    const auto refused = [&](lks_result expected, const char* value, const auto& call) {
        check_call_refused(world, expected, value, call);
    };
    const auto all_refuse = [&](lks_result expected, const char* value) {
        refused(expected, value, [&] { return lks_ragdoll_pose(world, puppet.bodies, count, out.data()); });
        refused(expected, value,
                [&] { return lks_ragdoll_set_pose(world, puppet.bodies, count, pose.data(), nullptr); });
        refused(expected, value,
                [&] { return lks_ragdoll_move_to(world, puppet.bodies, count, pose.data()); });
        refused(expected, value,
                [&] { return lks_ragdoll_set_kind(world, puppet.bodies, count, LKS_BODY_KINEMATIC); });
    };
    const lks_body_id body = puppet.bodies[9];
    puppet.bodies[9] = puppet.bodies[4];
    all_refuse(LKS_ERROR_INVALID_ARGUMENT, "bone 9: the body with index 4 is that of bone 4 already");
    puppet.bodies[9].generation = 7;
    all_refuse(LKS_ERROR_STALE_ID, "bone 9: ");
    puppet.bodies[9] = body;

    pose[7].rotation = {0, 0, 0, 0};
    const auto set = [&](const lks_transform* now, const lks_transform* before) {
        return lks_ragdoll_set_pose(world, puppet.bodies, count, now, before);
    };
    const auto drive = [&] {
        return lks_ragdoll_drive(world, &puppet.human.def, puppet.joints, pose.data(), fixed(1), 0);
    };
    const std::vector<lks_transform> good = puppet.pose();
    refused(LKS_ERROR_INVALID_ARGUMENT, "bone 7: ", [&] { return set(pose.data(), good.data()); });
    refused(LKS_ERROR_INVALID_ARGUMENT,
            "bone 7, a tick before: ", [&] { return set(good.data(), pose.data()); });
    refused(LKS_ERROR_INVALID_ARGUMENT, "bone 7: ", drive);
    pose = good;
    const lks_joint_id joint = puppet.joints[5];
    puppet.joints[5] = puppet.joints[2];
    refused(LKS_ERROR_INVALID_ARGUMENT, "bone 6: the joint with index 2 is that of bone 3 already", drive);
    puppet.joints[5].generation = 9;
    refused(LKS_ERROR_STALE_ID, "bone 6: ", drive);
    puppet.joints[5] = joint;
    CHECK(drive() == LKS_OK);
    refused(LKS_ERROR_UNSUPPORTED,
            "bone 0: ", [&] { return lks_ragdoll_move_to(world, puppet.bodies, count, pose.data()); });
    REQUIRE(lks_ragdoll_set_kind(world, puppet.bodies, count, LKS_BODY_KINEMATIC) == LKS_OK);
    pose[14].position.x += fixed(200);
    refused(LKS_ERROR_INVALID_ARGUMENT,
            "bone 14: ", [&] { return lks_ragdoll_move_to(world, puppet.bodies, count, pose.data()); });
    // A failure of another call names no bone.
    REQUIRE(lks_body_set_velocity(world, puppet.bodies[0], {}, {}) == LKS_ERROR_UNSUPPORTED);
    CHECK_FALSE(names(world.message(), "bone"));
}
