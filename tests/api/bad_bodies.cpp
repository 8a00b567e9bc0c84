// Bodies, joints and ragdolls that are refused, each with a sentence, and hard ones that are not.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <utility>

#include "support/bodies.h"
#include "support/refusals.h"

using namespace support;

namespace {

void check_refused(const World& world, lks_result result, lks_result expected, const std::string& value,
                   std::uint64_t hash) {
    INFO("value: " << value);
    CHECK(result == expected);
    check_sentence(world.message(), value);
    CHECK(world.hash() == hash);
}

struct BodyCase {
    std::function<void(lks_body_def&, lks_body_shape&)> change;
    const char* value;
    lks_result expected = LKS_ERROR_INVALID_ARGUMENT;
};

struct JointCase {
    std::function<void(lks_joint_def&)> change;
    const char* value;
    lks_result expected = LKS_ERROR_INVALID_ARGUMENT;
};

} // namespace

TEST_CASE("bodies out of range are refused") {
    World world;
    add_body(world, ball_shape(0.1), {});
    const std::uint64_t hash = world.hash();
    const BodyCase cases[] = {
        {[](lks_body_def& d, lks_body_shape&) { d.mass = fixed(-1); }, "-1"},
        {[](lks_body_def& d, lks_body_shape&) { d.mass = fixed(1e-9); }, "mass"},
        {[](lks_body_def& d, lks_body_shape&) { d.mass = fixed(2000000); }, "2000000"},
        {[](lks_body_def&, lks_body_shape& s) { s.density = 0; }, "density 0"},
        {[](lks_body_def&, lks_body_shape& s) { s.radius = 0; }, "radius 0"},
        {[](lks_body_def&, lks_body_shape& s) { s.radius = fixed(31); }, "31"},
        {[](lks_body_def&, lks_body_shape& s) { s.shape = LKS_SHAPE_PLANE; }, "shape 0"},
        {[](lks_body_def&, lks_body_shape& s) { s.shape = 9; }, "shape 9"},
        {[](lks_body_def&, lks_body_shape& s) {
             s.shape = LKS_SHAPE_BOX;
             s.half_extents.y = fixed(-0.5);
         },
         "half extent y -0.5"},
        {[](lks_body_def&, lks_body_shape& s) {
             s.shape = LKS_SHAPE_BOX;
             s.half_extents.z = 0;
         },
         "half extent z 0"},
        {[](lks_body_def&, lks_body_shape& s) {
             s.shape = LKS_SHAPE_CAPSULE;
             s.half_length = fixed(-0.25);
         },
         "half_length -0.25"},
        {[](lks_body_def&, lks_body_shape& s) { s.transform.position.x = fixed(40); }, "40"},
        {[](lks_body_def&, lks_body_shape& s) { s.transform.rotation.w = 0; }, "quaternion"},
        {[](lks_body_def&, lks_body_shape& s) { s.reserved = 5; }, "5"},
        {[](lks_body_def& d, lks_body_shape&) {
             d.transform.rotation = {0, 0, 0, 0};
         },
         "quaternion"},
        {[](lks_body_def& d, lks_body_shape&) {
             d.transform.rotation = {1 << 30, 0, 0, 1 << 30};
         },
         "1073741824"},
        {[](lks_body_def& d, lks_body_shape&) { d.transform.position.y = LKS_FIXED(8388001); }, "8388001"},
        {[](lks_body_def& d, lks_body_shape&) { d.velocity.z = fixed(1001); }, "1001"},
        {[](lks_body_def& d, lks_body_shape&) { d.angular_velocity.x = fixed(5000); }, "5000"},
        {[](lks_body_def& d, lks_body_shape&) { d.kind = 2; }, "kind is 2"},
        {[](lks_body_def& d, lks_body_shape&) { d.shape_count = 0; }, "0 shapes"},
        {[](lks_body_def& d, lks_body_shape&) { d.shape_count = 9; }, "9 shapes"},
        {[](lks_body_def& d, lks_body_shape&) { d.shapes = nullptr; }, "null", LKS_ERROR_NULL_ARGUMENT},
        {[](lks_body_def& d, lks_body_shape&) { d.struct_size = 12; }, "12", LKS_ERROR_STRUCT_SIZE},
        {[](lks_body_def& d, lks_body_shape&) { d.restitution = fixed(1.5); }, "1.5"},
        {[](lks_body_def& d, lks_body_shape&) { d.dynamic_friction = fixed(0.75); }, "0.75"},
        {[](lks_body_def& d, lks_body_shape&) { d.linear_damping = fixed(-1); }, "damping -1"},
        {[](lks_body_def& d, lks_body_shape&) { d.gravity_factor = fixed(101); }, "101"},
    };
    for (const BodyCase& bad : cases) {
        lks_body_shape shape = ball_shape(0.1);
        lks_body_def def = lks_default_body_def();
        def.shapes = &shape;
        def.shape_count = 1;
        bad.change(def, shape);
        lks_body_id id{77, 88};
        check_refused(world, lks_world_add_body(world, &def, &id), bad.expected, bad.value, hash);
        CHECK(id.index == 77);
    }
    CHECK(lks_world_body_count(world) == 1);
}

TEST_CASE("calls on bodies that are gone or of the wrong kind are refused") {
    World world;
    const lks_body_id body = add_body(world, ball_shape(0.1), {});
    const lks_body_id gone = add_body(world, ball_shape(0.1), fixed(1, 0, 0));
    const lks_body_id anchor = add_anchor(world, fixed(2, 0, 0));
    REQUIRE(lks_world_remove_body(world, gone) == LKS_OK);
    const std::uint64_t hash = world.hash();
    const lks_transform here = lks_transform_identity();
    check_refused(world, lks_world_remove_body(world, gone), LKS_ERROR_STALE_ID, "index 1", hash);
    check_refused(world, lks_body_set_transform(world, gone, here), LKS_ERROR_STALE_ID, "index 1", hash);
    check_refused(world, lks_body_apply_impulse(world, gone, {}, {}), LKS_ERROR_STALE_ID, "index 1", hash);
    check_refused(world, lks_body_move_to(world, body, here), LKS_ERROR_UNSUPPORTED, "dynamic", hash);
    check_refused(world, lks_body_set_velocity(world, anchor, {}, {}), LKS_ERROR_UNSUPPORTED, "kinematic",
                  hash);
    check_refused(world, lks_body_apply_impulse(world, body, {}, fixed(70, 0, 0)), LKS_ERROR_INVALID_ARGUMENT,
                  "70", hash);
    check_refused(world, lks_body_apply_angular_impulse(world, gone, {}), LKS_ERROR_STALE_ID, "index 1",
                  hash);
    check_refused(world, lks_body_apply_angular_impulse(world, body, {0, INT64_MIN, 0}),
                  LKS_ERROR_INVALID_ARGUMENT, "-8388608", hash);
    lks_transform far = here;
    far.position.x = fixed(500);
    check_refused(world, lks_body_move_to(world, anchor, far), LKS_ERROR_INVALID_ARGUMENT, "498", hash);
    check_refused(world, lks_body_set_velocity(world, body, fixed(2000, 0, 0), {}),
                  LKS_ERROR_INVALID_ARGUMENT, "2000", hash);
    CHECK(lks_world_has_body(world, gone) == 0);
    CHECK(lks_world_has_body(world, body) == 1);
}

TEST_CASE("joints out of range, or between a body and itself, are refused") {
    World world;
    const lks_body_id a = add_body(world, ball_shape(0.1), {});
    const lks_body_id b = add_body(world, ball_shape(0.1), fixed(1, 0, 0));
    const std::uint64_t hash = world.hash();
    const JointCase cases[] = {
        {[](lks_joint_def& d) { d.kind = 4; }, "kind 4"},
        {[](lks_joint_def& d) { d.body_b = d.body_a; }, "same"},
        {[](lks_joint_def& d) { d.body_b.generation = 9; }, "generation 9", LKS_ERROR_STALE_ID},
        {[](lks_joint_def& d) { d.twist_min = fixed(30), d.twist_max = fixed(20); }, "twist_min 30"},
        {[](lks_joint_def& d) { d.twist_max = fixed(181); }, "181"},
        {[](lks_joint_def& d) { d.swing_limit = fixed(200); }, "200"},
        {[](lks_joint_def& d) { d.swing_limit = fixed(-1); }, "-1"},
        {[](lks_joint_def& d) { d.distance_min = fixed(2), d.distance_max = fixed(1); }, "distance_min 2"},
        {[](lks_joint_def& d) { d.frame_a.position.z = fixed(65); }, "65"},
        {[](lks_joint_def& d) {
             d.frame_b.rotation = {0, 0, 0, 5};
         },
         "quaternion"},
        {[](lks_joint_def& d) { d.compliance = fixed(-1); }, "compliance -1"},
        {[](lks_joint_def& d) { d.friction = fixed(-1); }, "friction -1"},
        {[](lks_joint_def& d) { d.swing_limit_z = fixed(181); }, "swing_limit_z 181"},
        {[](lks_joint_def& d) { d.damping = fixed(-2); }, "damping -2"},
        {[](lks_joint_def& d) { d.angular_compliance = fixed(1001); }, "angular_compliance 1001"},
        {[](lks_joint_def& d) { d.angular_damping = fixed(-3); }, "angular_damping -3"},
        {[](lks_joint_def& d) { d.limit_compliance = fixed(1001); }, "limit_compliance 1001"},
        {[](lks_joint_def& d) { d.limit_damping = fixed(-6); }, "limit_damping -6"},
        {[](lks_joint_def& d) { d.break_force = fixed(-4); }, "break_force -4"},
        {[](lks_joint_def& d) { d.break_torque = fixed(-5); }, "break_torque -5"},
        {[](lks_joint_def& d) { d.bodies_collide = 2; }, "2"},
        {[](lks_joint_def& d) { d.struct_size = 1; }, "1", LKS_ERROR_STRUCT_SIZE},
    };
    for (const JointCase& bad : cases) {
        lks_joint_def def = lks_default_joint_def();
        def.body_a = a;
        def.body_b = b;
        bad.change(def);
        lks_joint_id id{};
        check_refused(world, lks_world_add_joint(world, &def, &id), bad.expected, bad.value, hash);
    }
    const lks_joint_id joint = add_joint(world, lks_default_joint_def(), a, b);
    CHECK(lks_world_joint_count(world) == 1);
    const auto refuse_motor = [&](const lks_motor& motor, const char* value) {
        check_refused(world, lks_joint_set_motor(world, joint, &motor), LKS_ERROR_INVALID_ARGUMENT, value,
                      world.hash());
    };
    const lks_rotation none{0, 0, 0, LKS_ROTATION_ONE};
    refuse_motor({fixed(-1), 0, none}, "max_torque -1");
    refuse_motor({fixed(1), fixed(101), none}, "response 101");
    refuse_motor({fixed(1), 0, {0, 0, 0, 0}}, "rotation");
    CHECK(lks_joint_set_motor(world, joint, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    CHECK(lks_joint_motor(world, joint, nullptr) == LKS_ERROR_NULL_ARGUMENT);
    lks_joint_def rigid = lks_default_joint_def();
    rigid.kind = LKS_JOINT_FIXED;
    const lks_motor motor{fixed(1), 0, none};
    const lks_joint_id plain = add_joint(world, rigid, a, b);
    check_refused(world, lks_joint_set_motor(world, plain, &motor), LKS_ERROR_UNSUPPORTED, "kind 2",
                  world.hash());
    REQUIRE(lks_world_remove_joint(world, plain) == LKS_OK);
    REQUIRE(lks_world_remove_body(world, b) == LKS_OK);
    CHECK(lks_world_joint_count(world) == 0);
    CHECK(lks_world_has_joint(world, joint) == 0);
    check_refused(world, lks_world_remove_joint(world, joint), LKS_ERROR_STALE_ID, "index 0", world.hash());
}

TEST_CASE("ragdolls with trees that are none are refused whole") {
    World world;
    const auto check = [&](const std::function<void(Humanoid&)>& change, const char* value,
                           lks_result expected = LKS_ERROR_INVALID_ARGUMENT) {
        Humanoid humanoid;
        change(humanoid);
        const std::uint64_t hash = world.hash();
        check_refused(world, humanoid.add(world), expected, value, hash);
        CHECK(lks_world_body_count(world) == 0);
    };
    check([](Humanoid& h) { h.bones[6].body.struct_size = 7; }, "Bone 6", LKS_ERROR_STRUCT_SIZE);
    check([](Humanoid& h) { h.bones[3].parent = 5; }, "bone 3");
    check([](Humanoid& h) { h.bones[3].parent = 3; }, "parent 3");
    check([](Humanoid& h) { h.bones[0].parent = 1; }, "root");
    check([](Humanoid& h) { h.bones[4].parent = LKS_NO_PARENT; }, "bone 4");
    check([](Humanoid& h) { h.bones[4].joint_kind = LKS_JOINT_DISTANCE; }, "kind 3");
    check([](Humanoid& h) { h.bones[14].twist_min = fixed(90); }, "bone 14: ");
    check([](Humanoid& h) { h.bones[5].swing_limit_z = fixed(181); }, "swing_limit_z 181");
    check([](Humanoid& h) { h.bones[5].compliance = fixed(-1); }, "compliance -1");
    check([](Humanoid& h) { h.bones[5].damping = fixed(-2); }, "damping -2");
    check([](Humanoid& h) { h.bones[5].angular_compliance = fixed(1001); }, "angular_compliance 1001");
    check([](Humanoid& h) { h.bones[5].angular_damping = fixed(-3); }, "angular_damping -3");
    check([](Humanoid& h) { h.bones[5].break_force = fixed(-4); }, "break_force -4");
    check([](Humanoid& h) { h.bones[5].break_force = fixed(8000001); }, "bone 5: the break_force 8000001");
    check([](Humanoid& h) { h.bones[5].break_torque = fixed(-5); }, "break_torque -5");
    check([](Humanoid& h) { h.bones[5].motor_torque = fixed(-6); }, "motor_torque -6");
    check(
        [](Humanoid& h) {
            h.def.scale = fixed(20);
            h.bones[5].joint_frame.position.x = fixed(5); // 95 m from the bone
        },
        "64");
    check([](Humanoid& h) { h.shapes[7].radius = 0; }, "radius 0");
    check([](Humanoid& h) { h.bones[7].body.shapes = nullptr; }, "bone 7: ", LKS_ERROR_NULL_ARGUMENT);
    check([](Humanoid& h) { h.def.bone_count = 0; }, "0 bones");
    check([](Humanoid& h) { h.def.bone_count = 300; }, "300 bones");
    check([](Humanoid& h) { h.def.scale = fixed(0.01); }, "0.01");
    check([](Humanoid& h) { h.def.scale = fixed(25); }, "25");
    check([](Humanoid& h) { h.def.transform.rotation.w = 1; }, "quaternion");
    check([](Humanoid& h) { h.def.struct_size = 3; }, "3", LKS_ERROR_STRUCT_SIZE);
}

TEST_CASE("a ragdoll has room where its bodies have, in places that are free again, too") {
    World world;
    const lks_body_shape shape = ball_shape(0.1);
    for (std::uint32_t i = 0; i < LKS_MAX_BODIES; ++i) {
        add_body(world, shape, {});
    }
    const Humanoid humanoid;
    lks_body_id bodies[LKS_HUMANOID_BONES];
    check_refused(world, humanoid.add(world, bodies), LKS_ERROR_LIMIT, "65536 bodies", world.hash());
    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
        REQUIRE(lks_world_remove_body(world, {1000 * i, 1}) == LKS_OK);
    }
    REQUIRE(humanoid.add(world, bodies) == LKS_OK);
    CHECK(bodies[LKS_HUMANOID_BONES - 1].index == 1000 * (LKS_HUMANOID_BONES - 1));
    CHECK(lks_world_body_count(world) == LKS_MAX_BODIES);
}

TEST_CASE("what bones bear at a scale stays within what joints can be given, and never becomes everything") {
    for (const auto& row : {std::pair{20.0, 8000000.0}, {0.05, 1e-9}}) {
        const double scale = row.first;
        const double strength = row.second;
        World world(world_def(60, 8));
        Humanoid humanoid;
        humanoid.def.scale = fixed(scale);
        for (lks_bone& bone : humanoid.bones) {
            bone.break_force = bone.break_torque = fixed(strength);
        }
        lks_body_id bodies[LKS_HUMANOID_BONES];
        const lks_result added = humanoid.add(world, bodies);
        INFO("scale " << scale << ": " << world.message());
        REQUIRE(added == LKS_OK);
        REQUIRE(lks_body_set_kind(world, bodies[LKS_HUMANOID_PELVIS], LKS_BODY_KINEMATIC) == LKS_OK);
        world.step(2);
        CHECK(lks_world_joint_count(world) == (scale > 1 ? LKS_HUMANOID_BONES - 1 : 0));
    }
}

TEST_CASE("what is hard but allowed ends where it can") {
    World world(world_def(60, 8));
    add_ground(world);
    // In exactly the same place; a capsule without length; two bodies that share nothing but a point.
    for (int i = 0; i < 3; ++i) {
        add_body(world, box_shape(0.2, 0.2, 0.2), fixed(0, 1, 0));
        add_body(world, capsule_shape(0.2, 0), fixed(0, 1, 0));
        add_body(world, ball_shape(0.2), fixed(0, 1, 0));
    }
    // A bone pulled at the speed limit, far from where its joint has it.
    lks_body_def def = lks_default_body_def();
    const lks_body_id anchor = add_anchor(world, fixed(3, 2, 0));
    def.velocity = fixed(1000, -1000, 1000);
    def.angular_velocity = {lks_world_spin_limit(world), -lks_world_spin_limit(world), 0};
    const lks_body_id bone = add_body(world, capsule_shape(0.05, 0.2), fixed(20, 2, 0), def);
    lks_joint_def joint = lks_default_joint_def();
    joint.frame_b.position = fixed(0, 0.25, 0);
    const lks_joint_id id = add_joint(world, joint, anchor, bone);
    // A mass of a ton on a rod that is all but massless.
    def = lks_default_body_def();
    def.mass = fixed(0.001);
    const lks_body_id thread = add_body(world, capsule_shape(0.002, 0.5), fixed(-3, 3, 0), def);
    def.mass = fixed(1000);
    const lks_body_id weight = add_body(world, ball_shape(0.3), fixed(-3, 2.2, 0), def);
    joint = lks_default_joint_def();
    joint.frame_a.position = fixed(0, -0.5, 0);
    joint.frame_b.position = fixed(0, 0.3, 0);
    add_joint(world, joint, thread, weight);
    world.step(1200);
    lks_fixed error = 0;
    REQUIRE(lks_joint_error(world, id, &error) == LKS_OK);
    CHECK(metres(error) < 0.05);
    for (std::uint32_t i = 0; i < 9; ++i) {
        const BodyState state = state_of(world, {i, 1});
        CHECK(state.position.length() < 30);
        CHECK(state.position.y > 0.15);
    }
    CHECK(energy_of(world) < 20e3); // the bone, of megajoules, whirls on about its anchor
    CHECK(world.counters().lost_contacts == 0);
}

TEST_CASE("a joint whose bodies both become kinematic rests, and holds again when one is free") {
    World world(world_def(60, 8));
    const lks_body_id a = add_anchor(world, {});
    const lks_body_id b = add_body(world, ball_shape(0.1), fixed(0.3, 0, 0));
    lks_joint_def def = lks_default_joint_def();
    def.frame_b.position = fixed(-0.3, 0, 0);
    const lks_joint_id joint = add_joint(world, def, a, b);
    world.step(10);
    REQUIRE(lks_body_set_kind(world, b, LKS_BODY_KINEMATIC) == LKS_OK);
    const Vector still = state_of(world, b).position;
    world.step(30);
    CHECK((state_of(world, b).position - still).length() == 0);
    // Torn apart by hand, which neither of them can resist.
    lks_transform away = lks_transform_identity();
    away.position = fixed(50, 0, 0);
    REQUIRE(lks_body_move_to(world, b, away) == LKS_OK);
    world.step();
    lks_fixed error = 0;
    REQUIRE(lks_joint_error(world, joint, &error) == LKS_OK);
    CHECK(std::abs(metres(error) - 49.7) < 1e-6);
    lks_vec3 force{};
    REQUIRE(lks_joint_load(world, joint, &force, nullptr) == LKS_OK);
    CHECK(metres(force).length() == 0);
    REQUIRE(lks_body_set_kind(world, b, LKS_BODY_DYNAMIC) == LKS_OK);
    world.step(1200);
    REQUIRE(lks_joint_error(world, joint, &error) == LKS_OK);
    CHECK(metres(error) < 1e-3);
    CHECK(energy_of(world) < 1e6);
}

TEST_CASE("a body that two places pull at stays between them") {
    // Two anchors two metres apart, and joints that have the body at both.
    World world(world_def(60, 8));
    const lks_body_id left = add_anchor(world, fixed(-1, 2, 0));
    const lks_body_id right = add_anchor(world, fixed(1, 2, 0));
    const lks_body_id body = add_body(world, ball_shape(0.1), fixed(0.4, 2, 0));
    add_joint(world, lks_default_joint_def(), left, body);
    add_joint(world, lks_default_joint_def(), right, body);
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        const BodyState state = state_of(world, body);
        REQUIRE(std::abs(state.position.x) < 1.1);
        REQUIRE(std::abs(state.position.y - 2) < 0.2);
        REQUIRE(std::abs(state.position.z) < 0.1);
    }
    CHECK(world.counters().speed_clamps == 0);
}
