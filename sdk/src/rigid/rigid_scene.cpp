#include "rigid/rigid_scene.h"

#include <algorithm>

namespace lks {
namespace {

template <typename Loads>
auto loads_of(Loads& loads, std::uint32_t object) {
    const auto first = std::partition_point(loads.begin(), loads.end(),
                                            [=](const RopeLoad& load) { return load.object < object; });
    const auto end =
        std::partition_point(first, loads.end(), [=](const RopeLoad& load) { return load.object == object; });
    return std::span(first, end);
}

} // namespace

RigidScene::RigidScene(const lks_allocator& allocator, const TreeKernels& tree_kernels)
    : body_slots(allocator), bodies(allocator), definitions(allocator), joint_slots(allocator),
      joints(allocator), memories(allocator), attachment_slots(allocator), attachments(allocator),
      descriptions(allocator), jointed(allocator), jointed_starts(allocator), ticks(allocator),
      collider_bodies(allocator), pieces(allocator), piece_extents(allocator), piece_starts(allocator),
      ways(allocator), travels(allocator), strikes(allocator), spread_strikes(allocator),
      strike_pairs(allocator), overlaps(allocator), boxed(allocator), pairs(allocator), sorting(allocator),
      found(allocator), found_order(allocator), contacts(allocator), contact_points(allocator),
      contact_marks(allocator), contacts_act(allocator), contact_moves(allocator), next_memories(allocator),
      islands(allocator), tree_roots(allocator), tree_links(allocator), tree_bodies(allocator),
      tree_joints(allocator), articulated(allocator), trees(allocator), held_joints(allocator),
      uneven_joints(allocator), foot_contacts(allocator), closing_joints(allocator), tree_pins(allocator),
      closures(allocator), closure_rows(allocator), closure_ranges(allocator), closure_matrix(allocator),
      closure_tree_joints(allocator), figures(allocator), figure_parts(allocator), figure_ranges(allocator),
      figure_bundles(allocator), wide_bodies(allocator), wide_joints(allocator), shared_contacts(allocator),
      figure_shares(allocator), substep_motions(allocator), predicted_speeds(allocator),
      figure_masses(allocator), figures_changed(allocator), strained_figures(allocator),
      figure_shifts(allocator), figure_pairs(allocator), island_rests(allocator), is_coupled(allocator),
      coupled(allocator), object_pairs(allocator), object_pushes(allocator), object_touches(allocator),
      held(allocator), rope_loads(allocator), particle_loads(allocator), loaded_bodies(allocator),
      loaded_joints(allocator), loaded_attachments(allocator), tree_kernels_(tree_kernels) {}

// A bundle takes the same for any number of trees.
std::size_t RigidScene::wide_room(std::size_t count) const {
    return tree_kernels_.solve != nullptr ? count / least_trees_in_lanes : 0;
}

bool RigidScene::reserve(std::size_t body_count, std::size_t collider_count) {
    if (body_count == 0 && attachment_room_ == 0) {
        collider_room_ = std::max(collider_room_, collider_count);
        return true; // nothing of it is stepped
    }
    const std::size_t boxes = body_count + collider_count + object_room_;
    const bool done =
        body_slots.reserve(body_count) && bodies.reserve(body_count) && definitions.reserve(body_count) &&
        descriptions.reserve(body_count) && ticks.reserve(body_count) &&
        collider_bodies.reserve(collider_count) && pieces.reserve(body_count * LKS_MAX_BODY_SHAPES) &&
        piece_extents.reserve(body_count * LKS_MAX_BODY_SHAPES) && piece_starts.reserve(body_count) &&
        ways.reserve(body_count) && travels.reserve(body_count) && strikes.reserve(body_count) &&
        spread_strikes.reserve(body_count) && strike_pairs.reserve(contact_capacity(body_count)) &&
        jointed_starts.reserve(body_count + 1) && overlaps.reserve(static_cast<std::uint32_t>(boxes)) &&
        boxed.reserve(boxes) && pairs.reserve(pair_capacity(body_count)) &&
        contacts.reserve(contact_capacity(body_count)) &&
        contact_points.reserve(greatest_point_count * contact_capacity(body_count)) &&
        contact_marks.reserve(contact_capacity(body_count)) &&
        contacts_act.reserve(contact_capacity(body_count)) && contact_moves.reserve(body_count + 1) &&
        found.reserve(contact_capacity(body_count)) && found_order.reserve(contact_capacity(body_count)) &&
        memories.reserve(contact_capacity(body_count)) &&
        next_memories.reserve(contact_capacity(body_count)) && loaded_bodies.reserve(body_count) &&
        islands.reserve(body_count) && figures.reserve(body_count) && tree_roots.reserve(body_count) &&
        tree_bodies.reserve(body_count) && articulated.reserve(body_count) &&
        reserve_figures(body_count, joint_room_, attachment_room_) && island_rests.reserve(body_count) &&
        shared_contacts.reserve(contact_capacity(body_count)) && figure_shares.reserve(body_count) &&
        substep_motions.reserve(body_count) && predicted_speeds.reserve(body_count) &&
        figure_masses.reserve(body_count) && figures_changed.reserve(body_count) &&
        strained_figures.reserve(body_count) && figure_shifts.reserve(body_count + 1) &&
        figure_pairs.reserve(contact_capacity(body_count)) && figure_bundles.reserve(body_count) &&
        wide_bodies.reserve(wide_room(body_count)) && foot_contacts.reserve(contact_capacity(body_count)) &&
        object_pairs.reserve(object_pair_capacity(object_room_, body_count)) &&
        object_pushes.reserve(object_pair_capacity(object_room_, body_count)) &&
        object_touches.reserve(object_pair_capacity(object_room_, body_count));
    body_room_ = done ? std::max(body_room_, body_count) : body_room_;
    collider_room_ = done ? std::max(collider_room_, collider_count) : collider_room_;
    return done;
}

bool RigidScene::reserve_joints(std::size_t count) {
    const bool done = joint_slots.reserve(count) && joints.reserve(count) && loaded_joints.reserve(count) &&
                      jointed.reserve(count) && tree_links.reserve(2 * count) && tree_joints.reserve(count) &&
                      held_joints.reserve(count) && uneven_joints.reserve(count) &&
                      trees.reserve(3 * count) && closing_joints.reserve(count) &&
                      closure_ranges.reserve(count) && closure_tree_joints.reserve(count) &&
                      reserve_closures(count, attachment_room_) && wide_joints.reserve(wide_room(count)) &&
                      reserve_figures(body_room_, count, attachment_room_);
    joint_room_ = done ? std::max(joint_room_, count) : joint_room_;
    return done;
}

bool RigidScene::reserve_attachments(std::size_t count) {
    const std::size_t before = attachment_room_;
    attachment_room_ = std::max(attachment_room_, count);
    // Particles tied to particles are stepped here, too, with no body in the world.
    const bool done = attachment_slots.reserve(count) && attachments.reserve(count) && held.reserve(count) &&
                      loaded_attachments.reserve(count) && rope_loads.reserve(count) &&
                      particle_loads.reserve(count) && tree_pins.reserve(count) &&
                      reserve_closures(joint_room_, count) &&
                      reserve_figures(body_room_, joint_room_, count) && reserve(body_room_, collider_room_);
    attachment_room_ = done ? attachment_room_ : before;
    return done;
}

bool RigidScene::reserve_objects(std::size_t count) {
    const std::size_t before = object_room_;
    object_room_ = std::max(object_room_, count);
    const bool done =
        is_coupled.reserve(count) && coupled.reserve(count) && reserve(body_room_, collider_room_);
    object_room_ = done ? object_room_ : before;
    return done;
}

bool RigidScene::reserve_closures(std::size_t joint_count, std::size_t attachment_count) {
    // What holds a figure holds one that has joints.
    const std::size_t pins = joint_count == 0 ? 0 : attachment_count;
    return closures.reserve(closure_room(joint_count) + pins) &&
           closure_rows.reserve(greatest_closure_rows(joint_count, pins)) &&
           closure_matrix.reserve(greatest_closure_entries(greatest_closure_rows(joint_count, pins)));
}

// A contact may belong to two of them.
bool RigidScene::reserve_figures(std::size_t body_count, std::size_t joint_count,
                                 std::size_t attachment_count) {
    // As many trees as joints at most, and of bodies that only distances hold, or that bear figures, one more
    // each.
    const std::size_t parts =
        body_count + 4 * joint_count + attachment_count + 2 * contact_capacity(body_count);
    return figure_parts.reserve(parts) && figure_ranges.reserve(body_count) &&
           sorting.reserve(std::max(parts, pair_capacity(body_count)));
}

void RigidScene::free_joint(std::uint32_t index) {
    free_slot(joint_slots[index]);
    joints[index] = Joint{};
}

void RigidScene::free_attachment(std::uint32_t index) {
    free_slot(attachment_slots[index]);
    attachments[index] = Attachment{};
}

std::span<RopeLoad> RigidScene::rope_loads_of(std::uint32_t object) {
    return loads_of(rope_loads, object);
}

std::span<const RopeLoad> RigidScene::rope_loads_of(std::uint32_t object) const {
    return loads_of(rope_loads, object);
}

void RigidScene::follow_joints() {
    if (follows_joints_) {
        return;
    }
    follows_joints_ = true;
    jointed.clear();
    for (Body& body : bodies) {
        body.jointed = false;
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (!joint_slots[i].used) {
            continue;
        }
        const JointDescription& joint = joints[i].description;
        bodies[joint.body_a].jointed = bodies[joint.body_b].jointed = true;
        if (joint.bodies_collide == 0) {
            const std::uint64_t low = std::min(joint.body_a, joint.body_b);
            const std::uint64_t high = std::max(joint.body_a, joint.body_b);
            jointed.push_reserved(low << 32 | high);
        }
    }
    std::sort(jointed.begin(), jointed.end());
    jointed_starts.clear();
    if (bodies.empty()) {
        return; // there may be no room for starts
    }
    std::uint32_t next = 0;
    for (std::uint32_t body = 0; body <= bodies.size(); ++body) {
        while (next < jointed.size() && jointed[next] >> 32 < body) {
            ++next;
        }
        jointed_starts.push_reserved(next);
    }
}

bool RigidScene::are_jointed(std::uint32_t a, std::uint32_t b) const {
    // Bodies that came later have no joints yet.
    if (a + 1 >= jointed_starts.size()) {
        return false;
    }
    const std::uint64_t* const end = jointed.begin() + jointed_starts[a + 1];
    return std::find(jointed.begin() + jointed_starts[a], end, std::uint64_t{a} << 32 | b) != end;
}

void forget_attachments(RigidScene& scene, std::uint32_t index, bool of_object) {
    for (std::uint32_t i = 0; i < scene.attachments.size(); ++i) {
        const AttachmentDescription& d = scene.attachments[i].description;
        const bool to_body = d.kind == LKS_ATTACHMENT_TO_BODY;
        const bool held =
            of_object ? d.object == index || (!to_body && d.other == index) : to_body && d.other == index;
        if (scene.attachment_slots[i].used && held) {
            scene.free_attachment(i);
        }
    }
}

} // namespace lks
