// A human of 1.8 m and 78 kg. Lengths and shares of the mass are those of an adult's segments (Winter,
// Biomechanics and Motor Control of Human Movement, table 4.1), rounded; joint limits are what most people
// reach, and rest poses stand straight.
#include <lockstitch/ragdoll.h>

#include <cstdint>

#include "api/millimetres.h"

namespace {

using lks::millimetres;

// One bone. Lengths in millimetres, the mass in grams; x is to the left, y up, z to the front.
struct Bone {
    std::uint32_t parent;
    std::uint32_t shape;
    std::int32_t x, y, z;             // centre
    std::int32_t radius, half;        // of a capsule
    std::int32_t box_x, box_y, box_z; // half extents
    std::int32_t mass;
    std::uint32_t joint;
    std::int32_t joint_x, joint_y, joint_z;
    std::int32_t swing, twist_min, twist_max; // degrees
    std::int32_t friction;                    // hundredths of a newton metre
};

constexpr std::uint32_t capsule = LKS_SHAPE_CAPSULE;
constexpr std::uint32_t box = LKS_SHAPE_BOX;
constexpr std::uint32_t ball = LKS_JOINT_BALL;
constexpr std::uint32_t hinge = LKS_JOINT_HINGE;

constexpr Bone parts[LKS_HUMANOID_BONES] = {
    {LKS_NO_PARENT, box, 0, 990, 0, 0, 0, 150, 90, 95, 11500, ball, 0, 0, 0, 0, 0, 0, 0},
    {LKS_HUMANOID_PELVIS, box, 0, 1285, 0, 0, 0, 165, 185, 100, 28100, ball, 0, 1090, 0, 30, -30, 30, 800},
    {LKS_HUMANOID_CHEST, capsule, 0, 1660, 10, 95, 50, 0, 0, 0, 5000, ball, 0, 1500, 0, 40, -60, 60, 200},
    {LKS_HUMANOID_CHEST, capsule, 225, 1300, 0, 48, 105, 0, 0, 0, 2100, ball, 205, 1430, 0, 95, -60, 60, 150},
    {LKS_HUMANOID_UPPER_ARM_LEFT, capsule, 225, 1030, 0, 40, 90, 0, 0, 0, 1250, hinge, 225, 1160, 0, 0, -140,
     0, 100},
    {LKS_HUMANOID_LOWER_ARM_LEFT, capsule, 225, 840, 0, 38, 40, 0, 0, 0, 450, ball, 225, 910, 0, 60, -20, 20,
     50},
    {LKS_HUMANOID_CHEST, capsule, -225, 1300, 0, 48, 105, 0, 0, 0, 2100, ball, -205, 1430, 0, 95, -60, 60,
     150},
    {LKS_HUMANOID_UPPER_ARM_RIGHT, capsule, -225, 1030, 0, 40, 90, 0, 0, 0, 1250, hinge, -225, 1160, 0, 0,
     -140, 0, 100},
    {LKS_HUMANOID_LOWER_ARM_RIGHT, capsule, -225, 840, 0, 38, 40, 0, 0, 0, 450, ball, -225, 910, 0, 60, -20,
     20, 50},
    {LKS_HUMANOID_PELVIS, capsule, 95, 705, 0, 72, 145, 0, 0, 0, 8500, ball, 95, 920, 0, 75, -35, 35, 400},
    {LKS_HUMANOID_UPPER_LEG_LEFT, capsule, 95, 285, 0, 52, 150, 0, 0, 0, 3400, hinge, 95, 490, 0, 0, 0, 140,
     200},
    {LKS_HUMANOID_LOWER_LEG_LEFT, box, 95, 38, 50, 0, 0, 45, 38, 125, 1000, ball, 95, 85, 0, 30, -15, 15,
     200},
    {LKS_HUMANOID_PELVIS, capsule, -95, 705, 0, 72, 145, 0, 0, 0, 8500, ball, -95, 920, 0, 75, -35, 35, 400},
    {LKS_HUMANOID_UPPER_LEG_RIGHT, capsule, -95, 285, 0, 52, 150, 0, 0, 0, 3400, hinge, -95, 490, 0, 0, 0,
     140, 200},
    {LKS_HUMANOID_LOWER_LEG_RIGHT, box, -95, 38, 50, 0, 0, 45, 38, 125, 1000, ball, -95, 85, 0, 30, -15, 15,
     200},
};

// What its muscles turn each bone with, newton metres.
constexpr std::int32_t torques[LKS_HUMANOID_BONES] = {0,  300, 50,  100, 70,  20,  100, 70,
                                                      20, 250, 200, 100, 250, 200, 100};

// By -90° about z: local y along x, the axis of elbows and knees.
constexpr std::int32_t cos_45 = 759250125;
constexpr lks_rotation sideways = {0, 0, -cos_45, cos_45};

} // namespace

extern "C" lks_result lks_humanoid(lks_bone bones[LKS_HUMANOID_BONES],
                                   lks_body_shape shapes[LKS_HUMANOID_BONES]) {
    if (bones == nullptr || shapes == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
        const Bone& part = parts[i];
        lks_body_shape& shape = shapes[i];
        shape = lks_default_body_shape();
        shape.shape = part.shape;
        shape.radius = millimetres(part.radius);
        shape.half_length = millimetres(part.half);
        shape.half_extents = {millimetres(part.box_x), millimetres(part.box_y), millimetres(part.box_z)};
        lks_bone& bone = bones[i];
        bone = lks_default_bone();
        bone.parent = part.parent;
        bone.joint_kind = part.joint;
        bone.body.transform.position = {millimetres(part.x), millimetres(part.y), millimetres(part.z)};
        bone.body.shapes = &shape;
        bone.body.shape_count = 1;
        bone.body.mass = LKS_FIXED_RATIO(part.mass, 1000);
        bone.joint_frame.position = {millimetres(part.joint_x), millimetres(part.joint_y),
                                     millimetres(part.joint_z)};
        if (part.joint == hinge) {
            bone.joint_frame.rotation = sideways;
        }
        bone.swing_limit = LKS_FIXED(part.swing);
        bone.twist_min = LKS_FIXED(part.twist_min);
        bone.twist_max = LKS_FIXED(part.twist_max);
        bone.friction = LKS_FIXED_RATIO(part.friction, 100);
        bone.motor_torque = LKS_FIXED(torques[i]);
    }
    return LKS_OK;
}
