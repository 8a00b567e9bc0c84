#include "crowd.h"

#include <algorithm>

namespace lks_bench {
namespace {

bool is_small(std::uint32_t bone) {
    return bone == LKS_HUMANOID_HEAD || bone == LKS_HUMANOID_HAND_LEFT || bone == LKS_HUMANOID_HAND_RIGHT;
}

// As all peers have them: cones around the rest pose, and twists to both sides alike.
void limit_around_rest(lks_bone& bone, std::uint32_t index) {
    struct Limits {
        lks_fixed swing, twist;
    };
    constexpr Limits chest = {30, 30}, head = {40, 60}, arm = {95, 60}, hand = {60, 20}, thigh = {75, 35},
                     foot = {30, 15}, none = {0, 0};
    constexpr Limits all[LKS_HUMANOID_BONES] = {none, chest, head, arm,  none,  hand, arm, none,
                                                hand, thigh, none, foot, thigh, none, foot};
    if (bone.joint_kind == LKS_JOINT_BALL && all[index].swing != 0) {
        bone.joint_rest = {0, 0, 0, LKS_ROTATION_ONE};
        bone.swing_limit = all[index].swing * LKS_FIXED_ONE;
        bone.twist_max = all[index].twist * LKS_FIXED_ONE;
        bone.twist_min = -bone.twist_max;
    }
}

} // namespace

double degrees_beyond(const lks_bone& bone, double swing, double twist) {
    const double cone = bone.joint_kind == LKS_JOINT_BALL
                            ? lks_fixed_to_double(std::max(bone.swing_limit, bone.swing_limit_z))
                            : 0;
    return std::max({0.0, swing - cone, twist - lks_fixed_to_double(bone.twist_max),
                     lks_fixed_to_double(bone.twist_min) - twist});
}

Crowd::Crowd(bool with_head_and_hands) {
    lks_bone all[LKS_HUMANOID_BONES];
    lks_body_shape all_shapes[LKS_HUMANOID_BONES];
    lks_humanoid(all, all_shapes);
    std::uint32_t renamed[LKS_HUMANOID_BONES] = {};
    for (std::uint32_t i = 0; i < LKS_HUMANOID_BONES; ++i) {
        if (!with_head_and_hands && is_small(i)) {
            continue;
        }
        renamed[i] = bone_count;
        shapes[bone_count] = all_shapes[i];
        lks_bone& bone = bones[bone_count];
        bone = all[i];
        bone.body.shapes = &shapes[bone_count];
        bone.body.never_sleeps = 1;
        bone.friction = 0;
        limit_around_rest(bone, i);
        if (bone.parent != LKS_NO_PARENT) {
            bone.parent = renamed[bone.parent];
        }
        ++bone_count;
    }
}

CrowdBlock::CrowdBlock() : Crowd(false) {
    for (int layer = 0; layer < 4; ++layer) {
        for (int row = 0; row < 5; ++row) {
            for (int column = 0; column < 5; ++column) {
                lks_transform place = lks_transform_identity();
                place.position =
                    millimetres(900 * column + 100 * layer, 500 + 1900 * layer, 600 * row + 100 * layer);
                places.push_back(place);
            }
        }
    }
}

CrowdPile::CrowdPile() : Crowd(true) {
    constexpr int columns = 5;
    constexpr int layers = 6;
    for (int i = 0; i < columns * layers; ++i) {
        const int column = i % columns;
        const int layer = i / columns;
        const bool across = layer % 2 == 1;
        const int beside = 560 * (column - columns / 2) + 40 * layer - 100;
        const int along = -900 + 30 * column;
        lks_transform place = lks_transform_identity();
        place.position =
            millimetres(across ? along : beside, 900 + 1150 * layer + 90 * column, across ? beside : along);
        // Face down, head first along z, or along x: a third of a turn about (1, 1, -1).
        if (across) {
            lks_rotation_from_axis_angle(1, 1, -1, 120, &place.rotation);
        } else {
            lks_rotation_from_axis_angle(1, 0, 0, 90, &place.rotation);
        }
        places.push_back(place);
    }
    for (const int side : {-1, 1}) {
        walls.push_back({millimetres(0, 450, 1900 * side), millimetres(2100, 450, 200)});
        walls.push_back({millimetres(1900 * side, 450, 0), millimetres(200, 450, 1700)});
    }
}

CrowdStairs::CrowdStairs() : Crowd(true) {
    constexpr int steps = 10;
    constexpr int rise = 170;
    constexpr int depth = 300;
    const auto add_step = [&](int x, int half_x, int top) {
        walls.push_back({millimetres(x, top / 2, 0), millimetres(half_x, top / 2, 2400)});
    };
    add_step(-900, 900, rise * steps);
    for (int i = 1; i < steps; ++i) {
        add_step(depth / 2 + depth * (i - 1), depth / 2, rise * (steps - i));
    }
    for (int i = 0; i < 4; ++i) {
        lks_transform place = lks_transform_identity();
        // They lean forward, and are turned a little, each in its own way.
        lks_rotation_from_axis_angle(0.3 * (i - 1.5), 0.2 * i, -1, 25 + 5 * i, &place.rotation);
        place.position = millimetres(-250, rise * steps + 120, 1100 * i - 1650);
        places.push_back(place);
    }
    velocity = millimetres(1500, 0, 100);
}

CrowdRows::CrowdRows() : Crowd(true) {
    constexpr int hand_x = 225;
    constexpr int hand_y = 840;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            lks_transform place = lks_transform_identity();
            place.position =
                millimetres((2 * hand_x + rope_length) * column, hand_height - hand_y, 1800 * row);
            places.push_back(place);
        }
    }
    velocity = millimetres(0, 0, 2000);
}

} // namespace lks_bench
