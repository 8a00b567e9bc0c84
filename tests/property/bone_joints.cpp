// A bone's joint is what a joint made by hand is.
#include <doctest/doctest.h>

#include <string>

#include "support/bodies.h"

using namespace support;

namespace {

// Two bones: one stays, one falls on it.
struct TwoBones {
    TwoBones() {
        for (int i = 0; i < 2; ++i) {
            bones[i] = lks_default_bone();
            bones[i].body.shapes = &shapes[i];
            bones[i].body.shape_count = 1;
        }
        bones[0].body.kind = LKS_BODY_KINEMATIC;
        bones[1].parent = 0;
        bones[1].body.transform.position = fixed(0.5, 0, 0);
        bones[1].swing_limit = fixed(60);
        def.bones = bones;
        def.bone_count = 2;
    }
    TwoBones(const TwoBones&) = delete;
    TwoBones& operator=(const TwoBones&) = delete;

    lks_body_shape shapes[2] = {box_shape(0.1, 0.1, 0.1), box_shape(0.5, 0.05, 0.1)};
    lks_bone bones[2];
    lks_ragdoll_def def = lks_default_ragdoll_def();
};

struct Field {
    std::string name;
    lks_fixed lks_bone::*of_bone;
    lks_fixed lks_joint_def::*of_joint;
    double value;
};

const Field fields[] = {
    {"swing_limit_z", &lks_bone::swing_limit_z, &lks_joint_def::swing_limit_z, 20},
    {"compliance", &lks_bone::compliance, &lks_joint_def::compliance, 0.0005},
    {"damping", &lks_bone::damping, &lks_joint_def::damping, 40},
    {"angular_compliance", &lks_bone::angular_compliance, &lks_joint_def::angular_compliance, 0.002},
    {"angular_damping", &lks_bone::angular_damping, &lks_joint_def::angular_damping, 3},
    {"limit_compliance", &lks_bone::limit_compliance, &lks_joint_def::limit_compliance, 0.001},
    {"limit_damping", &lks_bone::limit_damping, &lks_joint_def::limit_damping, 2},
    {"friction", &lks_bone::friction, &lks_joint_def::friction, 1},
    {"break_force", &lks_bone::break_force, &lks_joint_def::break_force, 5000},
    {"break_torque", &lks_bone::break_torque, &lks_joint_def::break_torque, 4000},
};

std::uint64_t by_ragdoll(std::uint32_t kind, const Field& field, bool with) {
    World world(world_def(60, 8));
    TwoBones two;
    two.bones[1].joint_kind = kind;
    two.bones[1].*field.of_bone = with ? fixed(field.value) : lks_default_bone().*field.of_bone;
    lks_body_id bodies[2];
    REQUIRE(lks_world_add_ragdoll(world, &two.def, bodies, nullptr) == LKS_OK);
    world.step(60);
    return world.hash();
}

std::uint64_t by_hand(std::uint32_t kind, const Field& field) {
    World world(world_def(60, 8));
    const TwoBones two;
    lks_body_id bodies[2];
    for (int i = 0; i < 2; ++i) {
        bodies[i] = add_body(world, two.shapes[i], fixed(0.5 * i, 0, 0), two.bones[i].body);
    }
    lks_joint_def joint = lks_default_joint_def();
    joint.kind = kind;
    joint.frame_b.position = fixed(-0.5, 0, 0);
    joint.swing_limit = fixed(60);
    joint.*field.of_joint = fixed(field.value);
    add_joint(world, joint, bodies[0], bodies[1]);
    world.step(60);
    return world.hash();
}

} // namespace

TEST_CASE("whatever a joint has its bone has, to the bit") {
    for (const std::uint32_t kind : {LKS_JOINT_BALL, LKS_JOINT_HINGE, LKS_JOINT_FIXED}) {
        for (const Field& field : fields) {
            INFO("kind " << kind << ", " << field.name);
            const std::uint64_t hash = by_ragdoll(kind, field, true);
            CHECK(hash == by_hand(kind, field));
            CHECK(hash != by_ragdoll(kind, field, false));
        }
    }
}
