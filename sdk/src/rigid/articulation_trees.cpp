#include <algorithm>

#include "collide/saturation.h"
#include "memory/sort_numbers.h"
#include "rigid/articulation.h"
#include "rigid/body_roots.h"
#include "rigid/heavy_sides.h"
#include "rigid/rope_loads.h"
#include "rigid/uneven_tree.h"

namespace lks {
namespace {

using fixed::Vec3;

// Bodies thinner than this would leave 64 bits, and joints further out. What counts is the inverse inertia
// times the square of the lever: of what is as thick as long, levers may be longer.
constexpr std::int32_t greatest_inverse_shift = 14;
constexpr std::int64_t farthest_lever = 8;

// Of points: of one that is softer the sweeps push as much.
constexpr std::int64_t greatest_tree_softness = std::int64_t{1} << (30 + 12);

// Of masses in a tree (ArticulatedTree::is_uneven). Those of ragdolls are below it. With ropes that bear them
// uneven trees are not solved: there even ones bear more.
constexpr std::int64_t uneven_ratio = 100;
constexpr std::int64_t uneven_ratio_on_ropes = 1000;

// Of 32 fraction bits and more.
std::int64_t share_of(const InverseMass& part, const InverseMass& whole, int more_bits = 0) {
    if (part.mantissa == 0) {
        return 0;
    }
    const int down = whole.exponent - part.exponent;
    if (down > 62) {
        return 0;
    }
    const std::uint64_t quotient = (std::uint64_t{part.mantissa} << 32) / whole.mantissa;
    const int shift = down - more_bits;
    const std::uint64_t share = shift >= 0 ? quotient >> shift : quotient << -shift;
    return static_cast<std::int64_t>(std::min(share, std::uint64_t{1} << (32 + more_bits)));
}

// As a power of two: how often the farthest lever would have to be doubled to reach the point.
int doublings_to(const Body& body, const Vec3& point) {
    const std::int64_t unit =
        body.scale >= 0 ? std::int64_t{1} << (world_fraction_bits + body.scale) : world_one >> -body.scale;
    const std::int64_t distance = sum_of_magnitudes(point);
    int doublings = 0;
    while (distance >> doublings > farthest_lever * unit) {
        ++doublings;
    }
    return doublings;
}

class Trees {
public:
    explicit Trees(RigidScene& scene) : scene_(scene), roots_(scene, scene.tree_roots) {}

    void find() {
        static_cast<void>(scene_.articulated.resize(scene_.bodies.size())); // within its room
        scene_.tree_links.clear();
        scene_.tree_bodies.clear();
        scene_.tree_joints.clear();
        scene_.trees.clear();
        for (Joint& joint : scene_.joints) {
            joint.in_tree = joint.in_held_tree = joint.closes_loop = false;
            joint.turns_in_tree = joint.limits_in_tree = joint.motor_in_tree = joint.carries_torque = false;
        }
        // What closes a loop is rather a soft one.
        for (const bool soft : {false, true}) {
            for (std::uint32_t i = 0; i < scene_.joints.size(); ++i) {
                const Joint& joint = scene_.joints[i];
                if (scene_.joint_slots[i].used && has_soft_points(joint.constants) == soft &&
                    may_be_solved(joint) && !is_anchor(joint)) {
                    choose(i);
                }
            }
        }
        choose_anchors();
        mark_attached();
        mark_loads();
        sort_numbers(scene_.tree_links, scene_.sorting);
        std::size_t end = 0;
        for (std::size_t i = 0; i < scene_.tree_links.size(); i = end) {
            const std::uint32_t body = body_of(scene_.tree_links[i]);
            end = after(i);
            if (roots_.root(body) == body) {
                walk(body);
            }
        }
        if (any_left_out_) {
            drop_loads(scene_);
            for (ArticulatedBody& body : scene_.articulated) {
                body.rope_load = no_rope_load;
            }
            mark_loads();
        }
        const std::size_t count = scene_.tree_joints.size(); // within their room
        static_cast<void>(scene_.held_joints.resize(any_held_ ? count : 0));
        static_cast<void>(scene_.uneven_joints.resize(any_uneven_ ? count : 0));
    }

private:
    static std::uint32_t body_of(std::uint64_t link) { return static_cast<std::uint32_t>(link >> 32); }
    static std::uint32_t joint_of(std::uint64_t link) { return static_cast<std::uint32_t>(link); }

    bool may_be_solved(const Joint& joint) const {
        return joint.description.kind != LKS_JOINT_DISTANCE && fits_trees(scene_, joint);
    }

    // Of one body that moves and one that does not.
    bool is_anchor(const Joint& joint) const {
        const JointDescription& d = joint.description;
        return scene_.bodies[d.body_a].is_awake() != scene_.bodies[d.body_b].is_awake();
    }

    // Unless it closes a loop.
    void choose(std::uint32_t index) {
        const JointDescription& d = scene_.joints[index].description;
        if (roots_.root(d.body_a) == roots_.root(d.body_b)) {
            return;
        }
        roots_.join(d.body_a, d.body_b);
        scene_.tree_links.push_reserved(std::uint64_t{d.body_a} << 32 | index);
        scene_.tree_links.push_reserved(std::uint64_t{d.body_b} << 32 | index);
    }

    // A second joint to what does not move closes a loop, too: each tree has one, rather a rigid one.
    void choose_anchors() {
        for (ArticulatedBody& body : scene_.articulated) {
            body.tree_has_anchor = false;
        }
        for (const bool soft : {false, true}) {
            for (std::uint32_t i = 0; i < scene_.joints.size(); ++i) {
                const Joint& joint = scene_.joints[i];
                if (!scene_.joint_slots[i].used || has_soft_points(joint.constants) != soft ||
                    !may_be_solved(joint) || !is_anchor(joint)) {
                    continue;
                }
                const JointDescription& d = joint.description;
                const std::uint32_t held = scene_.bodies[d.body_a].is_awake() ? d.body_a : d.body_b;
                ArticulatedBody& root = scene_.articulated[roots_.root(held)];
                if (!root.tree_has_anchor) {
                    root.tree_has_anchor = true;
                    scene_.tree_links.push_reserved(std::uint64_t{held} << 32 | i);
                }
            }
        }
    }

    // The end of the links of the body at `i`.
    std::size_t after(std::size_t i) const {
        const std::uint32_t body = body_of(scene_.tree_links[i]);
        while (i < scene_.tree_links.size() && body_of(scene_.tree_links[i]) == body) {
            ++i;
        }
        return i;
    }

    void mark_attached() {
        for (ArticulatedBody& body : scene_.articulated) {
            body.pinned = body.loads_rope = false;
            body.pins = 0;
            body.tree = no_tree;
            body.rope_load = no_rope_load;
        }
        for (std::size_t i = 0; i < scene_.attachments.size(); ++i) {
            const AttachmentDescription& d = scene_.attachments[i].description;
            if (scene_.attachment_slots[i].used && d.kind == LKS_ATTACHMENT_TO_BODY) {
                ArticulatedBody& body = scene_.articulated[d.other];
                const Attachment& attachment = scene_.attachments[i];
                const bool fits = fits_trees(scene_, attachment);
                body.loads_rope = body.loads_rope || attachment.loads_rope;
                body.pins += fits ? 1u : 0u;
                body.pinned = body.pinned || (!fits && !attachment.constants.moves_particle());
            }
        }
    }

    // A second rope of the same body is left to itself.
    void mark_loads() {
        for (std::uint32_t i = 0; i < scene_.rope_loads.size(); ++i) {
            const std::uint32_t body = scene_.attachments[scene_.rope_loads[i].attachment].description.other;
            std::uint32_t& load = scene_.articulated[body].rope_load;
            load = load == no_rope_load ? i : load;
        }
    }

    // Bodies and joints from the root on. What does not move is a leaf. Trees that hang on nothing but pinned
    // particles with which they can't be solved are left to the sweeps: an attachment begins from nothing and
    // would find the bodies in free fall. What hangs on a rope that bears it is pushed as a
    // whole, unless its masses are uneven: no rope bears those.
    void walk(std::uint32_t root) {
        const auto begin = static_cast<std::uint32_t>(scene_.tree_bodies.size());
        const auto begin_joints = static_cast<std::uint32_t>(scene_.tree_joints.size());
        bool pinned = false;
        std::uint32_t pins = 0;
        bool loaded = false;
        bool anchored = false;
        scene_.tree_bodies.push_reserved(root);
        scene_.articulated[root].incoming = no_joint;
        std::uint32_t lightest = root;
        for (std::size_t next = begin; next < scene_.tree_bodies.size(); ++next) {
            const std::uint32_t parent = scene_.tree_bodies[next];
            if (heavier(scene_.bodies[lightest].inverse_mass, scene_.bodies[parent].inverse_mass)) {
                lightest = parent;
            }
            pinned = pinned || scene_.articulated[parent].pinned;
            pins += scene_.articulated[parent].pins;
            loaded = loaded || scene_.articulated[parent].loads_rope;
            anchored = anchored || is_anchored(scene_.articulated[parent]);
            add_joints(parent);
        }
        const bool is_pinned = pins != 0 && !loaded;
        if ((pinned || pins != 0) && !is_pinned && !has_anchor(begin_joints)) {
            drop_from(begin, begin_joints);
            return;
        }
        const std::int64_t most = loaded ? uneven_ratio_on_ropes : uneven_ratio;
        bool uneven = false;
        for (std::size_t i = begin; i < scene_.tree_bodies.size(); ++i) {
            const std::uint32_t body = scene_.tree_bodies[i];
            const std::int64_t share =
                share_of(scene_.bodies[body].inverse_mass, scene_.bodies[lightest].inverse_mass);
            scene_.articulated[body].share = share;
            uneven = uneven || share * most <= std::int64_t{1} << 32;
        }
        if (uneven && loaded) {
            leave_out_loads(begin);
            drop_from(begin, begin_joints);
            return;
        }
        name_tree(begin);
        const bool held =
            mark_held(begin_joints, anchored || lies_between_heavy_bodies(scene_, begin, begin_joints));
        ArticulatedTree tree{};
        tree.first_body = begin;
        tree.body_end = static_cast<std::uint32_t>(scene_.tree_bodies.size());
        tree.first_joint = begin_joints;
        tree.joint_end = static_cast<std::uint32_t>(scene_.tree_joints.size());
        tree.is_held = held;
        tree.is_loaded = loaded;
        tree.is_pinned = is_pinned;
        tree.has_springs = has_springs(begin_joints);
        tree.is_uneven = uneven;
        tree.lever_doublings = find_doublings(begin_joints);
        tree.lightest = lightest;
        if (uneven) {
            find_fine_shares(scene_, tree);
        }
        scene_.trees.push_reserved(tree);
        any_held_ = any_held_ || held;
        any_uneven_ = any_uneven_ || uneven;
    }

    // By a joint of the tree that begins there to what does not move.
    bool has_anchor(std::size_t joint) const {
        return std::any_of(scene_.tree_joints.begin() + joint, scene_.tree_joints.end(),
                           [](const ArticulatedJoint& at) { return !at.child_moves; });
    }

    bool has_springs(std::size_t joint) const {
        return std::any_of(scene_.tree_joints.begin() + joint, scene_.tree_joints.end(),
                           [this](const ArticulatedJoint& at) {
                               return has_soft_points(scene_.joints[at.joint].constants);
                           });
    }

    // Of the joints of the tree that begins there.
    int find_doublings(std::size_t joint) const {
        int most = 0;
        for (std::size_t i = joint; i < scene_.tree_joints.size(); ++i) {
            const JointDescription& d = scene_.joints[scene_.tree_joints[i].joint].description;
            for (const bool on_a : {true, false}) {
                const Body& body = scene_.bodies[on_a ? d.body_a : d.body_b];
                if (body.is_awake()) {
                    most = std::max(most, doublings_to(body, on_a ? d.point_a : d.point_b));
                }
            }
        }
        return most;
    }

    // Of the bodies of the tree that begins there.
    void name_tree(std::size_t body) {
        for (std::size_t i = body; i < scene_.tree_bodies.size(); ++i) {
            scene_.articulated[scene_.tree_bodies[i]].tree = static_cast<std::uint32_t>(scene_.trees.size());
        }
    }
    void leave_out_loads(std::size_t body) {
        for (std::size_t i = body; i < scene_.tree_bodies.size(); ++i) {
            scene_.articulated[scene_.tree_bodies[i]].loads_rope = false;
        }
        any_left_out_ = true;
    }
    bool is_anchored(const ArticulatedBody& body) const {
        return body.rope_load != no_rope_load && scene_.rope_loads[body.rope_load].anchored;
    }

    // The joints of the tree that begins there, where something holds it or one of them is to what does not
    // move.
    bool mark_held(std::size_t joint, bool held) {
        held = held || has_anchor(joint);
        for (std::size_t i = joint; i < scene_.tree_joints.size(); ++i) {
            Joint& at = scene_.joints[scene_.tree_joints[i].joint];
            at.in_held_tree = at.carries_torque = held;
        }
        return held;
    }

    void drop_from(std::size_t body, std::size_t joint) {
        for (std::size_t i = joint; i < scene_.tree_joints.size(); ++i) {
            scene_.joints[scene_.tree_joints[i].joint].in_tree = false;
        }
        static_cast<void>(scene_.tree_bodies.resize(body)); // never grows
        static_cast<void>(scene_.tree_joints.resize(joint));
    }

    void add_joints(std::uint32_t parent) {
        const Array<std::uint64_t>& links = scene_.tree_links;
        const auto first = std::lower_bound(links.begin(), links.end(), std::uint64_t{parent} << 32);
        for (auto link = first; link != links.end() && body_of(*link) == parent; ++link) {
            Joint& joint = scene_.joints[joint_of(*link)];
            if (joint.in_tree) {
                continue;
            }
            joint.in_tree = true;
            static_cast<void>(scene_.tree_joints.resize(scene_.tree_joints.size() + 1)); // within its room
            ArticulatedJoint& part = scene_.tree_joints[scene_.tree_joints.size() - 1];
            part.joint = joint_of(*link);
            part.parent = parent;
            part.child_is_a = joint.description.body_b == parent;
            part.child = part.child_is_a ? joint.description.body_a : joint.description.body_b;
            part.child_moves = scene_.bodies[part.child].is_awake();
            if (part.child_moves) {
                scene_.articulated[part.child].incoming =
                    static_cast<std::uint32_t>(scene_.tree_joints.size() - 1);
                scene_.tree_bodies.push_reserved(part.child);
            }
        }
    }

    RigidScene& scene_;
    BodyRoots roots_;
    bool any_held_ = false;
    bool any_uneven_ = false;
    bool any_left_out_ = false;
};

} // namespace

void find_fine_shares(RigidScene& scene, const ArticulatedTree& tree) {
    for (std::uint32_t i = tree.first_body; i < tree.body_end; ++i) {
        const std::uint32_t index = scene.tree_bodies[i];
        scene.articulated[index].fine_share =
            share_of(scene.bodies[index].inverse_mass, scene.bodies[tree.lightest].inverse_mass,
                     uneven_fraction_bits - 32);
    }
}

bool fits_trees(const Body& body, const Vec3& point) {
    return !body.is_awake() || (body.inverse_shift <= greatest_inverse_shift &&
                                2 * doublings_to(body, point) <= greatest_inverse_shift - body.inverse_shift);
}

bool fits_trees(const RigidScene& scene, const Joint& joint) {
    const JointDescription& d = joint.description;
    const Body& a = scene.bodies[d.body_a];
    const Body& b = scene.bodies[d.body_b];
    return joint.constants.points.softness <= greatest_tree_softness &&
           joint.constants.angular_softness == 0 && (a.is_awake() || b.is_awake()) &&
           fits_trees(a, d.point_a) && fits_trees(b, d.point_b);
}

bool fits_trees(const RigidScene& scene, const Attachment& attachment) {
    const AttachmentDescription& d = attachment.description;
    return d.kind == LKS_ATTACHMENT_TO_BODY && !attachment.constants.moves_particle() &&
           scene.bodies[d.other].is_awake() &&
           attachment.constants.softness.softness <= greatest_tree_softness &&
           fits_trees(scene.bodies[d.other], d.point);
}

void find_articulations(RigidScene& scene) {
    Trees(scene).find();
}

} // namespace lks
