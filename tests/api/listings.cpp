// What a world holds, found by number: as after an image was loaded, whose ids nobody has told.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

bool operator==(const lks_body_id& a, const lks_body_id& b) {
    return a.index == b.index && a.generation == b.generation;
}

Chain short_rope() {
    Chain chain;
    chain.segments = 4;
    chain.length = 0.4;
    return chain;
}

// Two balls on rods under an anchor, a rope on one of them, and three colliders; some were removed.
struct Held {
    Held() : world(world_def(60, 8)) {
        anchor = add_anchor(world, {});
        for (int i = 0; i < 3; ++i) {
            balls.push_back(add_body(world, ball_shape(0.1), fixed(0.3 * i, -0.5, 0)));
            lks_joint_def joint = lks_default_joint_def();
            joint.frame_b.position = fixed(0, 0.5, 0);
            joint.frame_a.position = fixed(0.3 * i, 0, 0);
            joints.push_back(add_joint(world, joint, anchor, balls.back()));
        }
        for (int i = 0; i < 3; ++i) {
            lks_collider_def collider = lks_default_collider_def();
            collider.shape = LKS_SHAPE_SPHERE;
            collider.radius = fixed(0.5);
            collider.transform.position = fixed(i, -5, 0);
            colliders.push_back({});
            REQUIRE(lks_world_add_collider(world, &collider, &colliders.back()) == LKS_OK);
        }
        const lks_object_id object = world.add(rope, at(0.6, -0.6, 0));
        hold = attach(world, to_body(object, 0, balls[2], fixed(0, -0.1, 0)));
        REQUIRE(lks_world_remove_body(world, balls[0]) == LKS_OK); // and its joint
        REQUIRE(lks_world_remove_collider(world, colliders[1]) == LKS_OK);
    }
    World world;
    lks_body_id anchor{};
    std::vector<lks_body_id> balls;
    std::vector<lks_joint_id> joints;
    std::vector<lks_collider_id> colliders;
    Asset rope = short_rope().build();
    lks_attachment_id hold{};
};

void check_list(const lks_world* world, const Held& held) {
    lks_body_id body{};
    REQUIRE(lks_world_body_count(world) == 3);
    const lks_body_id bodies[] = {held.anchor, held.balls[1], held.balls[2]};
    for (std::uint32_t n = 0; n < 3; ++n) {
        REQUIRE(lks_world_body_at(world, n, &body) == LKS_OK);
        CHECK(body == bodies[n]);
    }
    REQUIRE(lks_world_joint_count(world) == 2);
    for (std::uint32_t n = 0; n < 2; ++n) {
        lks_joint_id joint{};
        REQUIRE(lks_world_joint_at(world, n, &joint) == LKS_OK);
        CHECK(joint.index == held.joints[n + 1].index);
        CHECK(joint.generation == held.joints[n + 1].generation);
        lks_body_id a{}, b{};
        REQUIRE(lks_joint_bodies(world, joint, &a, &b) == LKS_OK);
        CHECK(a == held.anchor);
        CHECK(b == held.balls[n + 1]);
        REQUIRE(lks_joint_bodies(world, joint, nullptr, nullptr) == LKS_OK);
    }
    REQUIRE(lks_world_collider_count(world) == 2);
    for (std::uint32_t n = 0; n < 2; ++n) {
        lks_collider_id collider{};
        REQUIRE(lks_world_collider_at(world, n, &collider) == LKS_OK);
        CHECK(collider.index == held.colliders[2 * n].index);
        CHECK(collider.generation == held.colliders[2 * n].generation);
    }
    REQUIRE(lks_world_attachment_count(world) == 1);
    lks_attachment_id attachment{};
    REQUIRE(lks_world_attachment_at(world, 0, &attachment) == LKS_OK);
    CHECK(attachment.index == held.hold.index);
    CHECK(attachment.generation == held.hold.generation);
}

std::string sentence(const World& world) {
    return lks_world_last_error(world)->message;
}

} // namespace

TEST_CASE("bodies, joints, attachments and colliders are listed in the order of their indices") {
    const Held held;
    check_list(held.world, held);
}

TEST_CASE("who loads an image finds by number what came with it") {
    Held held;
    held.world.step(30);
    const Image image = held.world.save();
    World fresh(world_def(60, 8));
    REQUIRE(lks_world_register_asset(fresh, held.rope) == LKS_OK);
    REQUIRE(lks_world_load(fresh, image.data(), image.size()) == LKS_OK);
    check_list(fresh, held);
}

TEST_CASE("nothing is listed in no world, or into nothing") {
    lks_body_id body{};
    lks_joint_id joint{};
    lks_attachment_id attachment{};
    lks_collider_id collider{};
    constexpr lks_result null = LKS_ERROR_NULL_ARGUMENT;
    CHECK(lks_world_body_at(nullptr, 0, &body) == null);
    CHECK(lks_world_joint_at(nullptr, 0, &joint) == null);
    CHECK(lks_world_attachment_at(nullptr, 0, &attachment) == null);
    CHECK(lks_world_collider_at(nullptr, 0, &collider) == null);
    CHECK(lks_world_collider_count(nullptr) == 0);
    CHECK(lks_joint_bodies(nullptr, joint, &body, &body) == null);
    CHECK(lks_body_apply_angular_impulse(nullptr, body, {}) == null);
    const Held held;
    CHECK(lks_world_body_at(held.world, 0, nullptr) == null);
    CHECK(sentence(held.world).find("lks_world_body_at") != std::string::npos);
    CHECK(lks_world_joint_at(held.world, 0, nullptr) == null);
    CHECK(lks_world_attachment_at(held.world, 0, nullptr) == null);
    CHECK(lks_world_collider_at(held.world, 0, nullptr) == null);
}

TEST_CASE("what is beyond the last is refused with the number, and nothing is written") {
    const Held held;
    const World& world = held.world;
    lks_body_id body{7, 8};
    CHECK(lks_world_body_at(world, 3, &body) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(sentence(world) == "There is no body 3: the world has 3.");
    CHECK(body == lks_body_id{7, 8});
    lks_joint_id joint{7, 8};
    CHECK(lks_world_joint_at(world, 2, &joint) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(sentence(world) == "There is no joint 2: the world has 2.");
    CHECK(joint.index == 7);
    lks_attachment_id attachment{7, 8};
    CHECK(lks_world_attachment_at(world, 4294967295u, &attachment) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(sentence(world) == "There is no attachment 4294967295: the world has 1.");
    lks_collider_id collider{7, 8};
    CHECK(lks_world_collider_at(world, 2, &collider) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(sentence(world) == "There is no collider 2: the world has 2.");
    CHECK(lks_joint_bodies(world, held.joints[0], &body, nullptr) == LKS_ERROR_STALE_ID);
    CHECK(body == lks_body_id{7, 8});
}
