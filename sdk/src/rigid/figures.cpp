#include "rigid/figures.h"

#include <algorithm>

#include "memory/sort_numbers.h"

namespace lks {
namespace {

InverseMass heaviest_of(const RigidScene& scene, const FigureRange& figure) {
    InverseMass best = scene.bodies[name_of(scene, figure)].inverse_mass;
    for_each_part(scene, figure, Part::body, [&](std::uint32_t i) {
        const InverseMass& other = scene.bodies[i].inverse_mass;
        best = heavier(other, best) ? other : best;
    });
    return best;
}

std::uint32_t closures_of(const RigidScene& scene, std::uint32_t figure) {
    const Array<ClosureRange>& ranges = scene.closure_ranges;
    const ClosureRange* const range =
        std::lower_bound(ranges.begin(), ranges.end(), figure,
                         [](const ClosureRange& r, std::uint32_t name) { return r.figure < name; });
    return range != ranges.end() && range->figure == figure
               ? static_cast<std::uint32_t>(range - ranges.begin())
               : no_closures;
}

void find_ranges(RigidScene& scene) {
    const Array<std::uint64_t>& parts = scene.figure_parts;
    scene.figure_ranges.clear();
    static_cast<void>(scene.figure_masses.resize(scene.bodies.size())); // within its room
    for (std::uint32_t i = 0; i < parts.size();) {
        const std::uint32_t figure = figure_of(parts[i]);
        FigureRange range{};
        for (std::size_t kind = 0; kind < part_kinds; ++kind) {
            range.begins[kind] = i;
            while (i < parts.size() && figure_of(parts[i]) == figure &&
                   kind_of(parts[i]) == static_cast<Part>(kind)) {
                ++i;
            }
        }
        range.begins[part_kinds] = i;
        for_each_part(scene, range, Part::joint, [&](std::uint32_t joint) {
            const JointDescription& d = scene.joints[joint].description;
            range.is_held =
                range.is_held || !scene.bodies[d.body_a].is_awake() || !scene.bodies[d.body_b].is_awake();
        });
        for_each_part(scene, range, Part::attachment, [&](std::uint32_t attachment) {
            range.is_pinned = range.is_pinned || !scene.attachments[attachment].constants.moves_particle();
        });
        for_each_part(scene, range, Part::tree, [&](std::uint32_t tree) {
            range.is_loaded = range.is_loaded || scene.trees[tree].is_loaded;
            range.has_held_tree = range.has_held_tree || scene.trees[tree].is_held;
        });
        range.closures = closures_of(scene, figure);
        range.heaviest = heaviest_of(scene, range);
        for_each_part(scene, range, Part::body, [&](std::uint32_t body) {
            scene.figure_masses[body] = mass_in(range.heaviest, scene.bodies[body]);
        });
        scene.figure_ranges.push_reserved(range);
    }
}

} // namespace

void find_figures(RigidScene& scene) {
    scene.figure_parts.clear();
    const auto add = [&](std::uint32_t body, Part kind, std::size_t index) {
        if (scene.bodies[body].is_awake()) {
            scene.figure_parts.push_reserved(name_part(scene.figures[body], kind, index));
        }
    };
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.body_slots[i].used) {
            add(i, Part::body, i);
        }
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (scene.joint_slots[i].used) {
            const JointDescription& joint = scene.joints[i].description;
            add(scene.bodies[joint.body_a].is_awake() ? joint.body_a : joint.body_b, Part::joint, i);
        }
    }
    for (std::size_t i = 0; i < scene.trees.size(); ++i) {
        add(scene.tree_bodies[scene.trees[i].first_body], Part::tree, i);
    }
    scene.shared_contacts.clear();
    for (std::uint32_t i = 0; i < scene.contacts.size(); ++i) {
        const ContactKey& key = scene.contacts[i].key;
        const bool a_moves = scene.bodies[key.body_a].is_awake();
        const bool b_moves = key.other < other_is_collider && scene.bodies[key.other].is_awake();
        if (a_moves && b_moves && scene.figures[key.body_a] != scene.figures[key.other]) {
            add(key.body_a, Part::shared_contact, i);
            add(key.other, Part::shared_contact, i);
            scene.shared_contacts.push_reserved(i);
        } else if (a_moves || b_moves) {
            add(a_moves ? key.body_a : key.other, Part::contact, i);
        }
    }
    for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
        const AttachmentDescription& d = scene.attachments[i].description;
        if (scene.attachment_slots[i].used && d.kind == LKS_ATTACHMENT_TO_BODY) {
            add(d.other, Part::attachment, i);
        }
    }
    sort_numbers(scene.figure_parts, scene.sorting);
    find_ranges(scene);
}

} // namespace lks
