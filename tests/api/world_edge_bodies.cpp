// Bodies at the edge of the world: a centre of mass beyond it is refused, not moved; a frame beyond it is
// not, so that what is read can be put back.
#include <doctest/doctest.h>

#include "support/bodies.h"
#include "support/refusals.h"

using namespace support;

namespace {

constexpr double edge = 8388000; // metres

// Its centre of mass 30 m along x from its frame.
lks_body_shape far_ball() {
    lks_body_shape shape = ball_shape(0.1);
    shape.transform.position = fixed(30, 0, 0);
    return shape;
}

lks_transform at_x(double x) {
    lks_transform transform = lks_transform_identity();
    transform.position = fixed(x, 0, 0);
    return transform;
}

double x_of(const World& world, lks_body_id body) {
    lks_transform transform{};
    REQUIRE(lks_body_transform(world, body, &transform) == LKS_OK);
    return metres(transform.position.x);
}

} // namespace

TEST_CASE("a centre of mass beyond the edge of the world is refused and named") {
    World world;
    const lks_body_shape shape = far_ball();
    const lks_body_id body = add_body(world, shape, {});
    lks_body_def def = lks_default_body_def();
    def.kind = LKS_BODY_KINEMATIC;
    const lks_body_id moved = add_body(world, shape, fixed(edge - 60, 0, 0), def);
    const std::uint64_t hash = world.hash();
    const auto check_refused = [&](lks_result result) {
        CHECK(result == LKS_ERROR_INVALID_ARGUMENT);
        check_sentence(world.message(), "centre of mass");
        check_sentence(world.message(), "8388030");
        CHECK(world.hash() == hash);
    };
    def.shapes = &shape;
    def.shape_count = 1;
    def.transform = at_x(edge);
    lks_body_id id{};
    check_refused(lks_world_add_body(world, &def, &id));
    check_refused(lks_body_set_transform(world, body, at_x(edge)));
    check_refused(lks_body_move_to(world, moved, at_x(edge)));
    const lks_transform pose = at_x(edge);
    const lks_transform here = lks_transform_identity();
    check_refused(lks_ragdoll_set_pose(world, &body, 1, &pose, nullptr));
    check_refused(lks_ragdoll_set_pose(world, &body, 1, &here, &pose));
    check_refused(lks_ragdoll_move_to(world, &moved, 1, &pose));
}

TEST_CASE("what is read at the edge of the world can be put back") {
    World world;
    REQUIRE(lks_world_set_gravity(world, {}) == LKS_OK);
    const lks_body_shape shape = far_ball();
    lks_body_def def = lks_default_body_def();
    def.transform.rotation = about(0, 0, 1, 180);
    const lks_body_id body = add_body(world, shape, fixed(edge + 20, 0, 0), def);
    CHECK(x_of(world, body) == edge + 20);
    lks_transform pose{};
    REQUIRE(lks_ragdoll_pose(world, &body, 1, &pose) == LKS_OK);
    REQUIRE(lks_ragdoll_set_pose(world, &body, 1, &pose, &pose) == LKS_OK);
    CHECK(x_of(world, body) == edge + 20);
    CHECK(world.counters().world_edge_hits == 0);
}

TEST_CASE("a bone beyond the range of coordinates is refused with the side that it is on") {
    World world;
    const lks_body_shape shape = ball_shape(0.1);
    lks_bone bone = lks_default_bone();
    bone.body.shapes = &shape;
    bone.body.shape_count = 1;
    bone.body.transform.position = fixed(30, 30, 0);
    lks_ragdoll_def def = lks_default_ragdoll_def();
    def.bones = &bone;
    def.bone_count = 1;
    def.scale = fixed(20);
    def.transform.position = fixed(edge, 0, 0);
    def.transform.rotation = about(0, 0, 1, -45);
    lks_body_id body{};
    const std::uint64_t hash = world.hash();
    CHECK(lks_world_add_ragdoll(world, &def, &body, nullptr) == LKS_ERROR_INVALID_ARGUMENT);
    check_sentence(world.message(), "(8388607|(8388608");
    CHECK(world.hash() == hash);
}
