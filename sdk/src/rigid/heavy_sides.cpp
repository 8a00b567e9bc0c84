#include "rigid/heavy_sides.h"

#include <algorithm>

namespace lks {
namespace {

constexpr std::int64_t heavy_ratio = 8;

// In millionths or so of the tree's lightest body, of which it counts as no more than a million times as
// heavy.
std::int64_t mass_of(const ArticulatedBody& body) {
    constexpr int bits = 20;
    return (std::int64_t{1} << (32 + bits)) / std::max(body.share, std::int64_t{1} << (32 - bits));
}

bool holds_turns(const Joint& joint) {
    return joint.description.kind != LKS_JOINT_BALL || joint.constants.swing_limited ||
           joint.constants.twist_limited;
}

void add_behind(HeavySides& parent, std::int64_t mass) {
    parent.beyond = std::max(parent.beyond, mass);
    parent.behind_second = std::max(parent.behind_second, std::min(parent.behind_first, mass));
    parent.behind_first = std::max(parent.behind_first, mass);
}

} // namespace

bool lies_between_heavy_bodies(RigidScene& scene, std::size_t first_body, std::size_t first_joint) {
    for (std::size_t i = first_body; i < scene.tree_bodies.size(); ++i) {
        ArticulatedBody& part = scene.articulated[scene.tree_bodies[i]];
        part.heavy = {mass_of(part), 0, 0, 0};
    }
    for (std::size_t i = scene.tree_joints.size(); i-- > first_joint;) {
        const ArticulatedJoint& part = scene.tree_joints[i];
        if (part.child_moves) {
            add_behind(scene.articulated[part.parent].heavy, scene.articulated[part.child].heavy.beyond);
        }
    }
    bool between = false;
    for (std::size_t i = first_joint; i < scene.tree_joints.size(); ++i) {
        const ArticulatedJoint& part = scene.tree_joints[i];
        if (!part.child_moves) {
            continue;
        }
        const ArticulatedBody& parent = scene.articulated[part.parent];
        ArticulatedBody& child = scene.articulated[part.child];
        const HeavySides& sides = parent.heavy;
        const std::int64_t beside =
            sides.behind_first == child.heavy.beyond ? sides.behind_second : sides.behind_first;
        child.heavy.before = std::max({sides.before, mass_of(parent), beside});
        const std::int64_t lighter = std::min(mass_of(child), mass_of(parent));
        between = between || (holds_turns(scene.joints[part.joint]) &&
                              std::min(child.heavy.beyond, child.heavy.before) >= heavy_ratio * lighter);
    }
    return between;
}

} // namespace lks
