// Where the ready-made human's limbs go, and where not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

// Of its motors' aims, which stay within limits: how far the bone is from where it is asked to be, degrees.
double missed_by(std::uint32_t bone, const lks_rotation& turned) {
    World world(world_def(60, 8));
    REQUIRE(lks_world_set_gravity(world, {}) == LKS_OK);
    Humanoid human;
    lks_bone(&bones)[LKS_HUMANOID_BONES] = human.bones;
    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
        bones[i].body.filter.mask = 0; // limits only
        if (i == bones[bone].parent) {
            bones[i].body.kind = LKS_BODY_KINEMATIC;
        }
    }
    lks_body_id bodies[LKS_HUMANOID_BONES];
    lks_joint_id joints[LKS_HUMANOID_BONES - 1];
    REQUIRE(human.add(world, bodies, joints) == LKS_OK);
    lks_transform pose[LKS_HUMANOID_BONES];
    REQUIRE(lks_ragdoll_pose(world, bodies, LKS_HUMANOID_BONES, pose) == LKS_OK);
    pose[bone].rotation = turned;
    for (std::uint32_t i = bone + 1; i < LKS_HUMANOID_BONES; ++i) {
        if (bones[i].parent >= bone && bones[i].parent != LKS_NO_PARENT) {
            pose[i].rotation = pose[bones[i].parent].rotation;
        }
    }
    REQUIRE(lks_ragdoll_drive(world, &human.def, joints, pose, fixed(1), fixed(0.1)) == LKS_OK);
    world.step(180);
    const Vector down{0, -1, 0};
    const Vector meant = rotate(turned, down);
    const Vector is = rotate(state_of(world, bodies[bone]).rotation, down);
    const double apart = std::hypot(is.x - meant.x, is.y - meant.y, is.z - meant.z);
    return 2 * std::asin(std::min(1.0, apart / 2)) * 180 / std::acos(-1.0);
}

} // namespace

// x is to the left, z to the front: what hangs goes to the front by turns about -x.
TEST_CASE("a human's limbs go where most people's do") {
    struct Reach {
        std::string what;
        std::uint32_t bone;
        double x, y, z, degrees;
    };
    for (const Reach& reach : {
             Reach{"a thigh to sit", LKS_HUMANOID_UPPER_LEG_LEFT, -1, 0, 0, 90},
             Reach{"a knee to the chest", LKS_HUMANOID_UPPER_LEG_RIGHT, -1, 0, 0, 110},
             Reach{"a step back", LKS_HUMANOID_UPPER_LEG_LEFT, 1, 0, 0, 12},
             Reach{"legs apart", LKS_HUMANOID_UPPER_LEG_LEFT, 0, 0, 1, 35},
             Reach{"legs crossed", LKS_HUMANOID_UPPER_LEG_RIGHT, 0, 0, 1, 15},
             Reach{"an arm to the front", LKS_HUMANOID_UPPER_ARM_LEFT, -1, 0, 0, 90},
             Reach{"an arm overhead", LKS_HUMANOID_UPPER_ARM_RIGHT, -1, 0, 0, 175},
             Reach{"an arm to the side", LKS_HUMANOID_UPPER_ARM_LEFT, 0, 0, 1, 90},
             Reach{"an arm overhead by the side", LKS_HUMANOID_UPPER_ARM_LEFT, 0, 0, 1, 170},
             Reach{"an arm to the back", LKS_HUMANOID_UPPER_ARM_RIGHT, 1, 0, 0, 35},
             Reach{"a bow", LKS_HUMANOID_CHEST, 1, 0, 0, 45},
             Reach{"a look down", LKS_HUMANOID_HEAD, 1, 0, 0, 40},
             Reach{"toes up", LKS_HUMANOID_FOOT_LEFT, -1, 0, 0, 18},
             Reach{"toes down", LKS_HUMANOID_FOOT_RIGHT, 1, 0, 0, 38},
         }) {
        INFO(reach.what);
        CHECK(missed_by(reach.bone, about(reach.x, reach.y, reach.z, reach.degrees)) < 0.5);
    }
}

// Before, thighs swung back by as much as to the front, 75°, and arms no further than 95° up.
TEST_CASE("a human's limbs do not go where nobody's do") {
    struct Reach {
        std::string what;
        std::uint32_t bone;
        double x, y, z, degrees;
        double least; // missed by
    };
    for (const Reach& reach : {
             Reach{"a thigh far back", LKS_HUMANOID_UPPER_LEG_LEFT, 1, 0, 0, 60, 40},
             Reach{"a thigh through the other", LKS_HUMANOID_UPPER_LEG_LEFT, 0, 0, -1, 75, 15},
             Reach{"an arm far back", LKS_HUMANOID_UPPER_ARM_LEFT, 1, 0, 0, 90, 15},
             Reach{"a back bent far back", LKS_HUMANOID_CHEST, -1, 0, 0, 60, 30},
             Reach{"toes far up", LKS_HUMANOID_FOOT_RIGHT, -1, 0, 0, 60, 35},
         }) {
        INFO(reach.what);
        CHECK(missed_by(reach.bone, about(reach.x, reach.y, reach.z, reach.degrees)) > reach.least);
    }
}

TEST_CASE("a bone's joint rests where it is told to") {
    World world(world_def(60, 8));
    Humanoid human;
    human.bones[LKS_HUMANOID_HEAD].joint_rest = about(0, 0, 1, 25);
    human.bones[LKS_HUMANOID_UPPER_ARM_LEFT].joint_rest = about(0, 1, 0, -30);
    lks_body_id bodies[LKS_HUMANOID_BONES];
    lks_joint_id joints[LKS_HUMANOID_BONES - 1];
    REQUIRE(human.add(world, bodies, joints) == LKS_OK);
    lks_fixed swing = 0, twist = 0;
    REQUIRE(lks_joint_angles(world, joints[LKS_HUMANOID_HEAD - 1], &swing, &twist) == LKS_OK);
    CHECK(std::abs(metres(swing) - 25) < 1e-3);
    CHECK(std::abs(metres(twist)) < 1e-3);
    REQUIRE(lks_joint_angles(world, joints[LKS_HUMANOID_UPPER_ARM_LEFT - 1], &swing, &twist) == LKS_OK);
    CHECK(std::abs(metres(swing)) < 1e-3);
    CHECK(std::abs(metres(twist) + 30) < 1e-3);
    human.bones[3].joint_rest = {0, 0, 0, 1};
    CHECK(human.add(world, bodies, joints) == LKS_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(lks_world_last_error(world)->message).find("one 3") != std::string::npos);
}
