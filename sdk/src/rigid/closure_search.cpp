#include <algorithm>

#include "memory/sort_numbers.h"
#include "rigid/articulation.h"
#include "rigid/articulation_joint.h"
#include "rigid/closure_rows.h"
#include "rigid/closures.h"
#include "rigid/joint_distance.h"

namespace lks {
namespace {

// Of a body, and of all of a tree.
constexpr std::uint32_t most_pins_a_body = 3;
constexpr std::uint32_t most_pins_a_tree = 12;

class ClosureSearch {
public:
    explicit ClosureSearch(RigidScene& scene) : scene_(scene) {}

    void find() {
        scene_.closing_joints.clear();
        scene_.tree_pins.clear();
        scene_.closures.clear();
        scene_.closure_ranges.clear();
        scene_.closure_rows.clear();
        scene_.closure_matrix.clear();
        find_candidates();
        find_pins();
        Found joints{scene_.closing_joints.begin(), scene_.closing_joints.end()};
        Found pins{scene_.tree_pins.begin(), scene_.tree_pins.end()};
        Found feet{scene_.foot_contacts.begin(), scene_.foot_contacts.end()};
        while (!joints.empty() || !pins.empty() || !feet.empty()) {
            const std::uint32_t figure =
                std::min({joints.next_figure(), pins.next_figure(), feet.next_figure()});
            take(figure, joints.cut_off(figure), pins.cut_off(figure), feet.cut_off(figure));
        }
        if (!scene_.closures.empty()) { // within its room
            static_cast<void>(scene_.closure_tree_joints.resize(scene_.tree_joints.size()));
        }
    }

private:
    // Indices of joints, attachments, or contacts, behind that of their figure; ascending.
    struct Found {
        const std::uint64_t* first;
        const std::uint64_t* end;

        bool empty() const { return first == end; }
        std::size_t size() const { return static_cast<std::size_t>(end - first); }
        std::uint32_t next_figure() const {
            return empty() ? UINT32_MAX : static_cast<std::uint32_t>(*first >> 32);
        }
        // Those of the figure, which are its first ones.
        Found cut_off(std::uint32_t figure) {
            Found its{first, first};
            while (next_figure() == figure) {
                its.end = ++first;
            }
            return its;
        }
    };

    Joint& joint_of(std::uint64_t found) { return scene_.joints[static_cast<std::uint32_t>(found)]; }
    const Body& body(std::uint32_t index) const { return scene_.bodies[index]; }

    void find_candidates() {
        mark_jointed();
        for (std::uint32_t i = 0; i < scene_.joints.size(); ++i) {
            const Joint& joint = scene_.joints[i];
            if (scene_.joint_slots[i].used && !joint.in_tree && closes(joint)) {
                const JointDescription& d = joint.description;
                const std::uint32_t moving = body(d.body_a).is_awake() ? d.body_a : d.body_b;
                scene_.closing_joints.push_reserved(std::uint64_t{scene_.figures[moving]} << 32 | i);
            }
        }
        sort_numbers(scene_.closing_joints, scene_.sorting);
    }

    // The first ones that hold a body; what else does is swept.
    void find_pins() {
        for (ArticulatedBody& part : scene_.articulated) {
            part.pins = 0;
        }
        for (std::uint32_t i = 0; i < scene_.attachments.size(); ++i) {
            const Attachment& attachment = scene_.attachments[i];
            if (!scene_.attachment_slots[i].used || !fits_trees(scene_, attachment)) {
                continue;
            }
            const std::uint32_t index = attachment.description.other;
            ArticulatedBody& part = scene_.articulated[index];
            if (part.tree == no_tree || part.pins == most_pins_a_body) {
                continue;
            }
            ArticulatedTree& tree = scene_.trees[part.tree];
            if (tree.is_pinned && tree.pins < most_pins_a_tree) {
                ++part.pins;
                ++tree.pins;
                scene_.tree_pins.push_reserved(std::uint64_t{scene_.figures[index]} << 32 | i);
            }
        }
        sort_numbers(scene_.tree_pins, scene_.sorting);
    }

    // Bodies with joints that hold points, whether a tree has them or not.
    void mark_jointed() {
        for (ArticulatedBody& part : scene_.articulated) {
            part.has_points = false;
        }
        for (std::uint32_t i = 0; i < scene_.joints.size(); ++i) {
            if (scene_.joint_slots[i].used && !is_distance(scene_.joints[i])) {
                const JointDescription& d = scene_.joints[i].description;
                scene_.articulated[d.body_a].has_points = scene_.articulated[d.body_b].has_points = true;
            }
        }
    }

    // Its bodies are in trees that nothing else bears, or alone.
    bool closes(const Joint& joint) const {
        const JointDescription& d = joint.description;
        return fits_trees(scene_, joint) && may_hold(d.body_a) && may_hold(d.body_b);
    }
    bool may_hold(std::uint32_t index) const {
        if (!body(index).is_awake()) {
            return true;
        }
        const ArticulatedBody& part = scene_.articulated[index];
        return part.tree != no_tree ? !scene_.trees[part.tree].is_loaded
                                    : !part.has_points && !part.pinned && part.pins == 0 && !part.loads_rope;
    }

    // All that closes its loops, or none: where there is no room for it. Of what it is attached to, and of
    // its feet, as many as there is.
    void take(std::uint32_t figure, Found joints, Found pins, Found feet) {
        std::size_t rows = 0;
        std::size_t beside = 0; // of the greatest tree
        for (const std::uint64_t* joint = joints.first; joint != joints.end; ++joint) {
            const JointDescription& d = joint_of(*joint).description;
            rows += closing_rows(joint_of(*joint));
            beside = std::max({beside, joints_beside(d.body_a), joints_beside(d.body_b)});
        }
        pins.end = pins.first + std::min<std::size_t>(pins.size(), most_closure_rows / closure_rows_a_pin);
        const std::size_t pin_rows = closure_rows_a_pin * pins.size();
        if (rows > std::min<std::size_t>(closure_rows_a_joint * (joints.size() + beside),
                                         most_closure_rows - pin_rows)) {
            joints.end = joints.first;
            rows = 0;
        }
        rows += pin_rows;
        if (joints.empty() && pins.empty() && feet.empty()) {
            return;
        }
        ClosureRange range{};
        range.figure = figure;
        range.stands = !feet.empty();
        range.first = static_cast<std::uint32_t>(scene_.closures.size());
        for (const std::uint64_t* joint = joints.first; joint != joints.end; ++joint) {
            add_closing(static_cast<std::uint32_t>(*joint));
        }
        for (const std::uint64_t* pin = pins.first; pin != pins.end; ++pin) {
            add_pin(static_cast<std::uint32_t>(*pin));
        }
        const std::size_t room = foot_room(joints, feet, rows);
        for (const std::uint64_t* foot = feet.first; foot != feet.end && foot != feet.first + room; ++foot) {
            const auto contact = static_cast<std::uint32_t>(*foot);
            scene_.contacts[contact].of_foot = true;
            scene_.closures.push_reserved(foot_of(contact));
        }
        range.end = static_cast<std::uint32_t>(scene_.closures.size());
        find_shares(range);
        const std::size_t tree_joints = add_trees(range);
        const std::uint32_t rows_a_joint = range.stands ? standing_rows_a_joint : closure_rows_a_joint;
        range.row_room = static_cast<std::uint32_t>(std::min<std::size_t>(
            rows_a_joint * (joints.size() + tree_joints) + pin_rows, most_closure_rows));
        range.first_row = static_cast<std::uint32_t>(scene_.closure_rows.size());
        range.first_entry = static_cast<std::uint32_t>(scene_.closure_matrix.size());
        // Within their room.
        static_cast<void>(scene_.closure_rows.resize(range.first_row + range.row_room));
        static_cast<void>(scene_.closure_matrix.resize(range.first_entry + entry_of(range.row_room, 0)));
        scene_.closure_ranges.push_reserved(range);
    }

    // How many of its feet.
    std::size_t foot_room(Found joints, Found feet, std::size_t rows) const {
        std::size_t beside = 0; // of the least tree that stands
        for (const std::uint64_t* foot = feet.first; foot != feet.end; ++foot) {
            const std::size_t its = joints_beside_foot(static_cast<std::uint32_t>(*foot));
            beside = beside == 0 || (its != 0 && its < beside) ? its : beside;
        }
        const std::size_t all = (standing_rows_a_joint - closure_rows_a_joint) * (joints.size() + beside);
        return std::min<std::size_t>(all, most_closure_rows - rows) / greatest_point_count;
    }
    std::size_t joints_beside_foot(std::uint32_t contact) const {
        const ContactKey& key = scene_.contacts[contact].key;
        return std::max(joints_beside(key.body_a),
                        key.other < other_is_collider ? joints_beside(key.other) : 0);
    }
    // Contacts keep colliders as others; what does not move is never looked at.
    Closure foot_of(std::uint32_t contact) {
        const ContactKey& key = scene_.contacts[contact].key;
        Closure closure{};
        closure.kind = Closure::Kind::foot;
        closure.index = contact;
        closure.a = {key.body_a, tree_of(key.body_a), {}};
        closure.b = key.other < other_is_collider ? ClosureSide{key.other, tree_of(key.other), {}}
                                                  : ClosureSide{key.body_a, no_tree, {}};
        return closure;
    }

    // In its tree.
    std::size_t joints_beside(std::uint32_t index) const {
        const std::uint32_t tree = body(index).is_awake() ? scene_.articulated[index].tree : no_tree;
        return tree == no_tree ? 0 : scene_.trees[tree].joint_end - scene_.trees[tree].first_joint;
    }

    Closure closure_of(std::uint32_t joint, Closure::Kind kind) {
        const JointDescription& d = scene_.joints[joint].description;
        Closure closure{};
        closure.kind = kind;
        closure.index = joint;
        closure.a = {d.body_a, tree_of(d.body_a), {}};
        closure.b = {d.body_b, tree_of(d.body_b), {}};
        return closure;
    }

    void add_closing(std::uint32_t index) {
        Joint& joint = scene_.joints[index];
        joint.in_tree = joint.closes_loop = joint.turns_in_tree = true;
        scene_.closures.push_reserved(closure_of(index, Closure::Kind::closing));
    }

    void add_pin(std::uint32_t index) {
        Attachment& attachment = scene_.attachments[index];
        attachment.holds_in_tree = true;
        const std::uint32_t body = attachment.description.other;
        Closure closure{};
        closure.kind = Closure::Kind::pin;
        closure.index = index;
        closure.a = {body, no_tree, {}}; // where the particle is
        closure.b = {body, tree_of(body), {}};
        scene_.closures.push_reserved(closure);
    }

    // What their joints turn is solved with them, and so are their limits. How many joints they have.
    std::size_t add_trees(ClosureRange& range) {
        std::size_t joints = 0;
        for (std::uint32_t i = range.first; i < range.end; ++i) {
            const Closure closing = scene_.closures[i];
            for (const ClosureSide* side : {&closing.a, &closing.b}) {
                if (side->tree != no_tree && !scene_.trees[side->tree].has_closures()) {
                    ArticulatedTree& tree = scene_.trees[side->tree];
                    add_tree(tree, range);
                    joints += tree.joint_end - tree.first_joint;
                }
            }
        }
        const std::uint32_t end_of_closing = range.end;
        range.end = static_cast<std::uint32_t>(scene_.closures.size());
        for (std::uint32_t i = range.first; i < end_of_closing; ++i) {
            for (const ClosureSide* side : {&scene_.closures[i].a, &scene_.closures[i].b}) {
                if (side->tree != no_tree) {
                    scene_.trees[side->tree].closure_end = range.end;
                }
            }
        }
        return joints;
    }
    void add_tree(ArticulatedTree& tree, const ClosureRange& range) {
        if (!tree.is_uneven) {
            find_fine_shares(scene_, tree);
        }
        tree.first_closure = range.first;
        tree.closure_end = range.end;
        for (std::uint32_t i = tree.first_joint; i < tree.joint_end; ++i) {
            ArticulatedJoint& part = scene_.tree_joints[i];
            part.pair_share = tree_detail::pair_share_of(scene_, part);
            scene_.joints[part.joint].turns_in_tree = true;
            scene_.joints[part.joint].carries_torque |= range.stands;
            if (has_limits(scene_.joints[part.joint].constants)) {
                Closure closure = closure_of(part.joint, Closure::Kind::limits);
                closure.pair_share = pair_share_of(closure, range);
                scene_.closures.push_reserved(closure);
            }
        }
    }

    // Of a body that is alone: one by itself.
    std::uint32_t tree_of(std::uint32_t index) {
        ArticulatedBody& part = scene_.articulated[index];
        if (!body(index).is_awake()) {
            return no_tree;
        }
        if (part.tree == no_tree) {
            ArticulatedTree tree{};
            tree.first_body = static_cast<std::uint32_t>(scene_.tree_bodies.size());
            tree.body_end = tree.first_body + 1;
            tree.first_joint = tree.joint_end = static_cast<std::uint32_t>(scene_.tree_joints.size());
            tree.lightest = index;
            part.tree = static_cast<std::uint32_t>(scene_.trees.size());
            part.share = std::int64_t{1} << 32;
            part.incoming = no_joint;
            scene_.tree_bodies.push_reserved(index);
            scene_.trees.push_reserved(tree);
        }
        return part.tree;
    }

    // Of all trees in the lightest body of any.
    void find_shares(ClosureRange& range) {
        InverseMass greatest{};
        const auto for_each_side = [&](const auto& use) {
            for (std::uint32_t i = range.first; i < range.end; ++i) {
                for (const ClosureSide* side : {&scene_.closures[i].a, &scene_.closures[i].b}) {
                    if (side->tree != no_tree) {
                        use(scene_.trees[side->tree]);
                    }
                }
            }
        };
        for_each_side([&](const ArticulatedTree& tree) {
            const InverseMass& mass = body(tree.lightest).inverse_mass;
            greatest = heavier(greatest, mass) ? mass : greatest;
        });
        for_each_side([&](ArticulatedTree& tree) {
            tree.figure_share = share_of(body(tree.lightest).inverse_mass, greatest);
        });
        range.lightest = greatest;
        for (std::uint32_t i = range.first; i < range.end; ++i) {
            scene_.closures[i].pair_share = pair_share_of(scene_.closures[i], range);
        }
    }
    std::int64_t pair_share_of(const Closure& closure, const ClosureRange& range) const {
        std::int64_t share = 0;
        for (const ClosureSide* side : {&closure.a, &closure.b}) {
            if (side->tree != no_tree) {
                share = std::max(share, share_of(body(side->body).inverse_mass, range.lightest));
            }
        }
        return share;
    }
    // With 32 fraction bits.
    static std::int64_t share_of(const InverseMass& mass, const InverseMass& greatest) {
        return std::int64_t{share_in_greater(mass, greatest)} * 4;
    }

    RigidScene& scene_;
};

} // namespace

void find_closures(RigidScene& scene) {
    for (Attachment& attachment : scene.attachments) {
        attachment.holds_in_tree = false;
    }
    if (!scene.joints.empty()) {
        ClosureSearch(scene).find();
    }
}

} // namespace lks
