// The bodies and joints of one tree (rigid/articulation.h), one after the other.
#pragma once

#include "rigid/body_motion.h"
#include "rigid/rigid_scene.h"

namespace lks {

class ArticulationWalk {
public:
    void make_units() {
        for_each_body(
            [](Body& body, const ArticulatedBody&) { body.orientation = normalise(body.orientation); });
    }

protected:
    ArticulationWalk(RigidScene& scene, const ArticulatedTree& range) : scene_(scene), range_(range) {}

    template <typename Use>
    void for_each_body(const Use& use) {
        for (std::uint32_t i = range_.first_body; i < range_.body_end; ++i) {
            const std::uint32_t index = scene_.tree_bodies[i];
            use(scene_.bodies[index], scene_.articulated[index]);
        }
    }
    // From the root on.
    template <typename Use>
    void for_each_joint(const Use& use) {
        for (std::uint32_t i = range_.first_joint; i < range_.joint_end; ++i) {
            ArticulatedJoint& part = scene_.tree_joints[i];
            use(part, scene_.joints[part.joint]);
        }
    }
    template <typename Use>
    void for_each_joint_back(const Use& use) {
        for (std::uint32_t i = range_.joint_end; i-- > range_.first_joint;) {
            ArticulatedJoint& part = scene_.tree_joints[i];
            use(part, scene_.joints[part.joint]);
        }
    }

    Body& body_a(const Joint& joint) { return scene_.bodies[joint.description.body_a]; }
    Body& body_b(const Joint& joint) { return scene_.bodies[joint.description.body_b]; }

    RigidScene& scene_;
    const ArticulatedTree& range_;
};

} // namespace lks
