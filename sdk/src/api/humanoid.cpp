// A human of 1.8 m and 78 kg. Lengths and shares of the mass are those of an adult's segments (Winter,
// Biomechanics and Motor Control of Human Movement, table 4.1), rounded; joint limits are cones about what
// most people reach (American Academy of Orthopaedic Surgeons, Joint Motion, 1965), and rest poses stand
// straight.
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
    {LKS_HUMANOID_PELVIS, box, 0, 1285, 0, 0, 0, 165, 185, 100, 28100, ball, 0, 1090, 0, 35, -30, 30, 800},
    {LKS_HUMANOID_CHEST, capsule, 0, 1660, 10, 95, 50, 0, 0, 0, 5000, ball, 0, 1500, 0, 45, -70, 70, 200},
    {LKS_HUMANOID_CHEST, capsule, 225, 1300, 0, 48, 105, 0, 0, 0, 2100, ball, 205, 1430, 0, 110, -95, 95,
     150},
    {LKS_HUMANOID_UPPER_ARM_LEFT, capsule, 225, 1030, 0, 40, 90, 0, 0, 0, 1250, hinge, 225, 1160, 0, 0, -140,
     0, 100},
    {LKS_HUMANOID_LOWER_ARM_LEFT, capsule, 225, 840, 0, 38, 40, 0, 0, 0, 450, ball, 225, 910, 0, 60, -80, 80,
     50},
    {LKS_HUMANOID_CHEST, capsule, -225, 1300, 0, 48, 105, 0, 0, 0, 2100, ball, -205, 1430, 0, 110, -95, 95,
     150},
    {LKS_HUMANOID_UPPER_ARM_RIGHT, capsule, -225, 1030, 0, 40, 90, 0, 0, 0, 1250, hinge, -225, 1160, 0, 0,
     -140, 0, 100},
    {LKS_HUMANOID_LOWER_ARM_RIGHT, capsule, -225, 840, 0, 38, 40, 0, 0, 0, 450, ball, -225, 910, 0, 60, -80,
     80, 50},
    {LKS_HUMANOID_PELVIS, capsule, 95, 705, 0, 72, 145, 0, 0, 0, 8500, ball, 95, 920, 0, 65, -40, 40, 400},
    {LKS_HUMANOID_UPPER_LEG_LEFT, capsule, 95, 285, 0, 52, 150, 0, 0, 0, 3400, hinge, 95, 490, 0, 0, 0, 140,
     200},
    {LKS_HUMANOID_LOWER_LEG_LEFT, box, 95, 38, 50, 0, 0, 45, 38, 125, 1000, ball, 95, 85, 0, 30, -15, 15,
     200},
    {LKS_HUMANOID_PELVIS, capsule, -95, 705, 0, 72, 145, 0, 0, 0, 8500, ball, -95, 920, 0, 65, -40, 40, 400},
    {LKS_HUMANOID_UPPER_LEG_RIGHT, capsule, -95, 285, 0, 52, 150, 0, 0, 0, 3400, hinge, -95, 490, 0, 0, 0,
     140, 200},
    {LKS_HUMANOID_LOWER_LEG_RIGHT, box, -95, 38, 50, 0, 0, 45, 38, 125, 1000, ball, -95, 85, 0, 30, -15, 15,
     200},
};

// What its muscles turn each bone with, newton metres.
constexpr std::int32_t torques[LKS_HUMANOID_BONES] = {0,  300, 50,  100, 70,  20,  100, 70,
                                                      20, 250, 200, 100, 250, 200, 100};

// How far from the middle of its cone a bone rests, x to the left and z to the front:
constexpr lks_rotation middle = {0, 0, 0, LKS_ROTATION_ONE};
// a back 12° behind it: it bends 47° to the front and 23° to the back;
constexpr lks_rotation back = {-112236583, 0, 0, 1067859754};
// an arm hangs 80° from where it points to the front and to the side alike: it goes straight up, behind the
// neck, across the chest, and 42° to the back;
constexpr lks_rotation left_arm = {488036573, 0, -488036573, 822533958};
constexpr lks_rotation right_arm = {488036573, 0, 488036573, 822533958};
// a thigh hangs 50° behind it and 8° inside: it goes 115° to the front, 15° to the back, 40° to the side;
constexpr lks_rotation left_thigh = {453409616, 0, -72545539, 970607217};
constexpr lks_rotation right_thigh = {453409616, 0, 72545539, 970607217};
// a foot stands 10° above it: toes go 40° down and 20° up.
constexpr lks_rotation foot = {-93582766, 0, 0, 1069655912};
constexpr lks_rotation rests[LKS_HUMANOID_BONES] = {middle, back,      middle,      left_arm, middle,
                                                    middle, right_arm, middle,      middle,   left_thigh,
                                                    middle, foot,      right_thigh, middle,   foot};

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
        bone.joint_rest = rests[i];
        bone.swing_limit = LKS_FIXED(part.swing);
        bone.twist_min = LKS_FIXED(part.twist_min);
        bone.twist_max = LKS_FIXED(part.twist_max);
        bone.friction = LKS_FIXED_RATIO(part.friction, 100);
        bone.motor_torque = LKS_FIXED(torques[i]);
    }
    return LKS_OK;
}
