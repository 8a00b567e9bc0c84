// A spider that no one has to like: what a ragdoll is that is no human. Nothing in it is to scale with nature
// but the number of legs.
#include <lockstitch/ragdoll.h>

#include <cstdint>

#include "api/millimetres.h"
#include "fixed/int128.h"

namespace {

using lks::millimetres;

// Where a leg's parts meet, millimetres: hip, knee, foot. Of the left side (x > 0), from front to back.
struct Leg {
    std::int32_t hip[3];
    std::int32_t knee[3];
    std::int32_t foot[3];
};

constexpr std::int32_t height = 230;

constexpr Leg legs[LKS_SPIDER_LEGS / 2] = {
    {{70, height, 85}, {220, 400, 250}, {360, 12, 420}},
    {{90, height, 30}, {290, 410, 85}, {500, 12, 150}},
    {{90, height, -30}, {290, 410, -85}, {500, 12, -150}},
    {{70, height, -85}, {220, 400, -250}, {360, 12, -430}},
};

std::int64_t root_of(std::int64_t square) {
    return static_cast<std::int64_t>(
        lks::fixed::square_root(lks::fixed::UInt128{0, static_cast<std::uint64_t>(square)}));
}

// The turn that takes +y along a unit vector (x, y, z), Q30, y > -1: (z, 0, -x, 1 + y), not normalised.
lks_rotation along(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::int64_t one = std::int64_t{1} << 30;
    // |q|² = 2 + 2y, in Q30.
    const std::int64_t w = one + y;
    const std::int64_t root = root_of(2 * w * one);
    const auto part = [root](std::int64_t c) { return static_cast<std::int32_t>(c * one / root); };
    return {part(z), 0, part(-x), part(w)};
}

struct Segment {
    lks_vec3 middle;
    lks_fixed length;
    lks_rotation rotation; // +y along it
};

Segment between(const std::int32_t (&a)[3], const std::int32_t (&b)[3], int side) {
    const std::int64_t d[3] = {side * std::int64_t{b[0] - a[0]}, b[1] - a[1], b[2] - a[2]};
    const std::int64_t squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    // Millimetres with 20 fraction bits.
    const std::int64_t length = root_of(squared << 40);
    const auto unit = [length](std::int64_t c) { return c * (std::int64_t{1} << 50) / length; };
    Segment s{};
    s.middle = {LKS_FIXED_RATIO(side * std::int64_t{a[0] + b[0]}, 2000), LKS_FIXED_RATIO(a[1] + b[1], 2000),
                LKS_FIXED_RATIO(a[2] + b[2], 2000)};
    s.length = length * (std::int64_t{1} << 20) / 1000;
    s.rotation = along(unit(d[0]), unit(d[1]), unit(d[2]));
    return s;
}

void make_bone(lks_bone& bone, lks_body_shape& shape, std::uint32_t parent, lks_vec3 position,
               lks_rotation rotation, lks_fixed mass) {
    bone = lks_default_bone();
    bone.parent = parent;
    bone.body.transform = {position, rotation};
    bone.body.shapes = &shape;
    bone.body.shape_count = 1;
    bone.body.mass = mass;
}

// Degrees, thousandths of a newton metre, newton metres.
struct BallJoint {
    std::int64_t swing, twist, friction, torque;
};

void set_joint(lks_bone& bone, const lks_transform& frame, const BallJoint& joint) {
    bone.joint_kind = LKS_JOINT_BALL;
    bone.joint_frame = frame;
    bone.swing_limit = LKS_FIXED(joint.swing);
    bone.twist_min = -LKS_FIXED(joint.twist);
    bone.twist_max = LKS_FIXED(joint.twist);
    bone.friction = LKS_FIXED_RATIO(joint.friction, 1000);
    bone.motor_torque = LKS_FIXED(joint.torque);
}

void make_leg_part(lks_bone& bone, lks_body_shape& shape, std::uint32_t parent, const Segment& segment,
                   lks_fixed radius, lks_fixed mass) {
    shape = lks_default_body_shape();
    shape.shape = LKS_SHAPE_CAPSULE;
    shape.radius = radius;
    shape.half_length = segment.length / 2 - radius;
    make_bone(bone, shape, parent, segment.middle, segment.rotation, mass);
}

void make_leg(lks_bone* bones, lks_body_shape* shapes, std::uint32_t index) {
    const int side = index < LKS_SPIDER_LEGS / 2 ? 1 : -1;
    const Leg& leg = legs[index % (LKS_SPIDER_LEGS / 2)];
    const std::uint32_t thigh = LKS_SPIDER_FIRST_LEG + 2 * index;
    const Segment upper = between(leg.hip, leg.knee, side);
    const Segment lower = between(leg.foot, leg.knee, side);
    make_leg_part(bones[thigh], shapes[thigh], LKS_SPIDER_THORAX, upper, millimetres(22),
                  LKS_FIXED_RATIO(4, 10));
    make_leg_part(bones[thigh + 1], shapes[thigh + 1], thigh, lower, millimetres(14),
                  LKS_FIXED_RATIO(25, 100));
    const auto place = [side](const std::int32_t(&p)[3]) {
        return lks_vec3{millimetres(side * std::int64_t{p[0]}), millimetres(p[1]), millimetres(p[2])};
    };
    set_joint(bones[thigh], {place(leg.hip), upper.rotation}, {55, 15, 500, 60});
    set_joint(bones[thigh + 1], {place(leg.knee), lower.rotation}, {60, 10, 300, 40});
}

} // namespace

extern "C" lks_result lks_spider(lks_bone bones[LKS_SPIDER_BONES], lks_body_shape shapes[LKS_SPIDER_BONES]) {
    if (bones == nullptr || shapes == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    constexpr lks_rotation straight = {0, 0, 0, LKS_ROTATION_ONE};
    // +y along z, for a capsule that lies.
    constexpr std::int32_t cos_45 = 759250125;
    constexpr lks_rotation lying = {cos_45, 0, 0, cos_45};
    shapes[LKS_SPIDER_THORAX] = lks_default_body_shape();
    shapes[LKS_SPIDER_THORAX].shape = LKS_SHAPE_BOX;
    shapes[LKS_SPIDER_THORAX].half_extents = {millimetres(75), millimetres(45), millimetres(110)};
    make_bone(bones[LKS_SPIDER_THORAX], shapes[LKS_SPIDER_THORAX], LKS_NO_PARENT, {0, millimetres(height), 0},
              straight, LKS_FIXED(3));
    shapes[LKS_SPIDER_ABDOMEN] = lks_default_body_shape();
    shapes[LKS_SPIDER_ABDOMEN].shape = LKS_SHAPE_CAPSULE;
    shapes[LKS_SPIDER_ABDOMEN].radius = millimetres(110);
    shapes[LKS_SPIDER_ABDOMEN].half_length = millimetres(70);
    make_bone(bones[LKS_SPIDER_ABDOMEN], shapes[LKS_SPIDER_ABDOMEN], LKS_SPIDER_THORAX,
              {0, millimetres(height + 40), millimetres(-290)}, lying, LKS_FIXED_RATIO(38, 10));
    set_joint(bones[LKS_SPIDER_ABDOMEN], {{0, millimetres(height), millimetres(-110)}, lying},
              {25, 20, 1000, 40});
    for (std::uint32_t leg = 0; leg < LKS_SPIDER_LEGS; ++leg) {
        make_leg(bones, shapes, leg);
    }
    return LKS_OK;
}
