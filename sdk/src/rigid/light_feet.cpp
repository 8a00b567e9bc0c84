#include "rigid/light_feet.h"

#include "memory/sort_numbers.h"
#include "rigid/joint_drive.h"

namespace lks {
namespace {

// What touches has less than a third of the mass.
constexpr std::int64_t light_ratio = 3;
// What turns freely, as wheels do: an eighth of what leans on it.
constexpr std::int64_t wheel_ratio = 8;

class LightFeet {
public:
    explicit LightFeet(RigidScene& scene) : scene_(scene) {}

    void find() {
        for (ArticulatedBody& body : scene_.articulated) {
            body.touches = false;
        }
        for_each_touch(
            [this](std::uint32_t, std::uint32_t body) { scene_.articulated[body].touches = true; });
        for (ArticulatedTree& tree : scene_.trees) {
            tree.stands = stands(tree);
        }
        for_each_touch([this](std::uint32_t contact, std::uint32_t body) {
            if (scene_.trees[scene_.articulated[body].tree].stands) {
                scene_.foot_contacts.push_reserved(std::uint64_t{scene_.figures[body]} << 32 | contact);
            }
        });
        sort_numbers(scene_.foot_contacts, scene_.sorting);
    }

private:
    // use(contact, body): of one of a tree with what does not move.
    template <typename Use>
    void for_each_touch(const Use& use) const {
        for (std::uint32_t i = 0; i < scene_.contacts.size(); ++i) {
            const ContactKey& key = scene_.contacts[i].key;
            const bool is_collider = key.other >= other_is_collider;
            const bool a_moves = scene_.bodies[key.body_a].is_awake();
            const bool b_moves = !is_collider && scene_.bodies[key.other].is_awake();
            if (a_moves == b_moves) {
                continue;
            }
            const std::uint32_t body = a_moves ? key.body_a : key.other;
            if (scene_.articulated[body].tree != no_tree) {
                use(i, body);
            }
        }
    }

    bool stands(const ArticulatedTree& tree) const {
        if (tree.is_loaded || !is_borne(tree)) {
            return false;
        }
        std::int64_t all = 0;
        std::int64_t touching = 0;
        for (std::uint32_t i = tree.first_body; i < tree.body_end; ++i) {
            const ArticulatedBody& body = scene_.articulated[scene_.tree_bodies[i]];
            // In the lightest one's.
            constexpr std::int64_t one = std::int64_t{1} << 40;
            const std::int64_t mass = body.share == 0 ? one : one / body.share;
            all += mass;
            touching += body.touches ? mass : 0;
        }
        return touching != 0 && touching < all / light_ratio;
    }

    // Nothing that does not move holds it, and one of its feet bears what it is joined to.
    bool is_borne(const ArticulatedTree& tree) const {
        bool borne = false;
        for (std::uint32_t i = tree.first_joint; i < tree.joint_end; ++i) {
            const ArticulatedJoint& part = scene_.tree_joints[i];
            if (!part.child_moves) {
                return false;
            }
            borne = borne || bears(part.joint, part.child, part.parent) ||
                    bears(part.joint, part.parent, part.child);
        }
        return borne;
    }

    // Limbs that hang loosely bear little.
    bool bears(std::uint32_t index, std::uint32_t foot, std::uint32_t other) const {
        const Joint& joint = scene_.joints[index];
        const ArticulatedBody& body = scene_.articulated[foot];
        if (!body.touches) {
            return false;
        }
        const bool is_stiff =
            joint.description.kind == LKS_JOINT_FIXED || (has_motor(joint) && !is_exhausted(joint));
        return is_stiff ||
               (!has_limits(joint.constants) && body.share / wheel_ratio >= scene_.articulated[other].share);
    }

    RigidScene& scene_;
};

} // namespace

void find_light_feet(RigidScene& scene) {
    scene.foot_contacts.clear();
    if (!scene.trees.empty()) {
        LightFeet(scene).find();
    }
}

} // namespace lks
