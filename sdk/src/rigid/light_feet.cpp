#include "rigid/light_feet.h"

#include <algorithm>

#include "memory/sort_numbers.h"
#include "rigid/articulation.h"
#include "rigid/figures.h"
#include "rigid/joint_drive.h"

namespace lks {
namespace {

// What touches has less than a third of the mass.
constexpr std::int64_t light_ratio = 3;
// What turns freely, as wheels do: an eighth of what leans on it.
constexpr std::int64_t wheel_ratio = 8;
constexpr std::uint32_t nothing = UINT32_MAX;

class LightFeet {
public:
    LightFeet(RigidScene& scene, const fixed::Vec3& gravity)
        : scene_(scene), gravity_(gravity), gravity_size_(static_cast<std::int64_t>(fixed::length(gravity))) {
    }

    bool find() {
        for (ArticulatedBody& body : scene_.articulated) {
            body.touches = body.bears_feet = false;
        }
        for_each_touch([this](std::uint32_t, std::uint32_t body, std::uint32_t) {
            scene_.articulated[body].touches = true;
        });
        bool any_stands = false;
        for (ArticulatedTree& tree : scene_.trees) {
            tree.stands = stands(tree);
            any_stands = any_stands || tree.stands;
        }
        if (!any_stands) {
            return false;
        }
        const bool any_bears = find_bearers();
        if (any_bears) {
            join_with_bearers();
        }
        for_each_foot([this](std::uint32_t contact, std::uint32_t body, std::uint32_t bearer) {
            if (bearer == nothing || scene_.articulated[bearer].bears_feet) {
                add(contact, body);
            }
        });
        for (std::uint32_t i = 0; any_bears && i < scene_.contacts.size(); ++i) {
            const std::uint32_t body = body_on_still(i);
            if (body != nothing && scene_.articulated[body].bears_feet) {
                add(i, body);
            }
        }
        sort_numbers(scene_.foot_contacts, scene_.sorting);
        return any_bears;
    }

private:
    void add(std::uint32_t contact, std::uint32_t body) {
        scene_.foot_contacts.push_reserved(std::uint64_t{scene_.figures[body]} << 32 | contact);
    }

    // The one that moves, of a contact with what doesn't.
    std::uint32_t body_on_still(std::uint32_t contact) const {
        const ContactKey& key = scene_.contacts[contact].key;
        const bool a_moves = scene_.bodies[key.body_a].is_awake();
        const bool b_moves = key.other < other_is_collider && scene_.bodies[key.other].is_awake();
        return a_moves == b_moves ? nothing : a_moves ? key.body_a : key.other;
    }
    // A body without joints, which a tree's numbers hold.
    bool may_bear(const Contact& contact, bool a) const {
        const std::uint32_t index = a ? contact.key.body_a : contact.key.other;
        const Body& body = scene_.bodies[index];
        return scene_.articulated[index].tree == no_tree && !body.jointed &&
               std::all_of(contact.points, contact.points + contact.count, [&](const ContactPoint& point) {
                   return fits_trees(body, a ? point.core_a : point.core_b);
               });
    }
    // By at least half of what it pushes.
    bool lifts(const Contact& contact, bool a) const {
        const std::int64_t along = fixed::dot(contact.normal(), gravity_); // towards b
        return 2 * (a ? along : -along) > gravity_size_;
    }

    // use(contact, body, bearer): of one of a tree with what does not move, or with a body by itself that
    // bears it.
    template <typename Use>
    void for_each_touch(const Use& use) const {
        for (std::uint32_t i = 0; i < scene_.contacts.size(); ++i) {
            const Contact& contact = scene_.contacts[i];
            const ContactKey& key = contact.key;
            const std::uint32_t body = body_on_still(i);
            if (body != nothing) {
                if (scene_.articulated[body].tree != no_tree) {
                    use(i, body, nothing);
                }
                continue;
            }
            if (key.other >= other_is_collider || !scene_.bodies[key.body_a].is_awake()) {
                continue;
            }
            if (scene_.articulated[key.body_a].tree != no_tree && may_bear(contact, false) &&
                lifts(contact, true)) {
                use(i, key.body_a, key.other);
            } else if (scene_.articulated[key.other].tree != no_tree && may_bear(contact, true) &&
                       lifts(contact, false)) {
                use(i, key.other, key.body_a);
            }
        }
    }
    template <typename Use>
    void for_each_foot(const Use& use) const {
        for_each_touch([&](std::uint32_t contact, std::uint32_t body, std::uint32_t bearer) {
            if (scene_.trees[scene_.articulated[body].tree].stands) {
                use(contact, body, bearer);
            }
        });
    }

    // As many as joints at most.
    bool find_bearers() {
        std::size_t count = 0;
        for_each_foot([&](std::uint32_t, std::uint32_t, std::uint32_t bearer) {
            if (bearer != nothing && !scene_.articulated[bearer].bears_feet && count < scene_.joints.size()) {
                scene_.articulated[bearer].bears_feet = true;
                ++count;
            }
        });
        return count != 0;
    }
    // In this tick they are one figure.
    void join_with_bearers() {
        join_figures(scene_, [this](BodyRoots& roots) {
            for_each_foot([&](std::uint32_t, std::uint32_t body, std::uint32_t bearer) {
                if (bearer != nothing && scene_.articulated[bearer].bears_feet) {
                    roots.join(body, bearer);
                }
            });
        });
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
    fixed::Vec3 gravity_;
    std::int64_t gravity_size_;
};

} // namespace

bool find_light_feet(RigidScene& scene, const fixed::Vec3& gravity) {
    scene.foot_contacts.clear();
    return !scene.trees.empty() && LightFeet(scene, gravity).find();
}

} // namespace lks
