// Which bodies belong together: each points towards the least index of its set.
#pragma once

#include <algorithm>

#include "rigid/rigid_scene.h"

namespace lks {

class BodyRoots {
public:
    // Everybody alone.
    BodyRoots(const RigidScene& scene, Array<std::uint32_t>& roots) : scene_(scene), roots_(roots) {
        roots_.clear();
        for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
            roots_.push_reserved(i);
        }
    }

    std::uint32_t root(std::uint32_t body) {
        while (roots_[body] != body) {
            roots_[body] = roots_[roots_[body]];
            body = roots_[body];
        }
        return body;
    }

    // Kinematic bodies hold nothing together.
    void join(std::uint32_t a, std::uint32_t b) {
        if (!scene_.bodies[a].is_dynamic() || !scene_.bodies[b].is_dynamic()) {
            return;
        }
        const std::uint32_t p = root(a);
        const std::uint32_t q = root(b);
        roots_[std::max(p, q)] = std::min(p, q);
    }

    void join_by_joints() {
        for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
            if (scene_.joint_slots[i].used) {
                const JointDescription& joint = scene_.joints[i].description;
                join(joint.body_a, joint.body_b);
            }
        }
    }

private:
    const RigidScene& scene_;
    Array<std::uint32_t>& roots_;
};

} // namespace lks
