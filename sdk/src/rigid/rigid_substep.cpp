#include "rigid/rigid_substep.h"

#include "collide/saturation.h"
#include "rigid/articulation.h"
#include "rigid/carried_pushes.h"
#include "rigid/closures.h"
#include "rigid/coupling.h"
#include "rigid/figures.h"
#include "rigid/held_energy.h"
#include "rigid/held_tree.h"
#include "rigid/joint_limits.h"
#include "rigid/particle_contact.h"
#include "rigid/rope_loads.h"
#include "rigid/shape_touch.h"
#include "rigid/wide_trees.h"
#include "solver/object_tick.h"
#include "solver/pins.h"
#include "solver/world.h"

namespace lks {
namespace {

Object& coupled_object(lks_world& world, std::uint32_t index) {
    return *world.objects[index].object;
}

} // namespace

RigidSubstep::RigidSubstep(lks_world& world, Team* team)
    : world_(world), scene_(world.rigid), rate_(world.rate), blocks_(scene_, team), contacts_(world),
      impacts_(world, contacts_), strained_(world, blocks_, contacts_),
      free_figures_(scene_, rate_, world.rate.substeps) {
    least_speed_ = 2 * least_approach(sum_of_magnitudes(world.gravity) / rate_.substeps_per_second);
}

void RigidSubstep::run(std::uint32_t substep) {
    begin(substep);
    impacts_.strike_all();
    predict(substep);
    carry_pushes_on();
    for (std::uint32_t iteration = 0; iteration < world_.rate.iterations; ++iteration) {
        iterate(substep);
    }
    if (strained_.relieve()) {
        collide_objects(substep);
    }
    finish(substep);
}

void RigidSubstep::solve_trees(const FigureBundle& bundle) {
    blocks_.in_trees(bundle, solve_bundle, solve_articulation);
    blocks_.for_each_figure(bundle, [this](const FigureRange& figure) { solve_closures(scene_, figure); });
}

void RigidSubstep::begin(std::uint32_t substep) {
    blocks_.in_contact_blocks(scene_.contacts.size(), [&](std::uint32_t first, std::uint32_t end) {
        WideContacts wide = contacts_.side_by_side(ContactStage::begin);
        for (std::uint32_t i = first; i < end; ++i) {
            Contact& contact = scene_.contacts[i];
            if (contact.every_substep && substep > 1) {
                find_points_again(world_, contact);
            }
            wide.add(i);
        }
    });
    blocks_.in_figures([&](FigureRange& figure) {
        blocks_.for_each_joint(figure,
                               [](Joint& joint, Body& a, Body& b) { lks::begin_substep(joint, a, b); });
        free_figures_.begin_substep(figure, substep);
    });
    for_each_attachment(world_, [this](Attachment& attachment, const AttachmentSides& sides) {
        measure_left(attachment, sides, rate_);
    });
}

void RigidSubstep::predict(std::uint32_t substep) {
    blocks_.in_bodies([&](std::uint32_t i, std::uint32_t worker) {
        Body& body = scene_.bodies[i];
        if (body.is_awake()) {
            predict_body(body, scene_.descriptions[i], scene_.ticks[i], rate_,
                         world_.scratch[worker].counters.speed_clamps);
            body.uncarried_position = body.position;
            body.uncarried_orientation = body.orientation;
        } else if (scene_.body_slots[i].used && !body.is_dynamic()) {
            place_kinematic(body, substep, world_.rate.substeps, rate_);
        }
    });
    for (std::size_t i = 0; i < world_.colliders.size(); ++i) {
        if (world_.colliders[i].used && world_.colliders[i].collider.moves()) {
            place_kinematic(scene_.collider_bodies[i], substep, world_.rate.substeps, rate_);
        }
    }
    for (const std::uint32_t index : scene_.coupled) {
        begin_object_substep(world_, coupled_object(world_, index), world_.scratch[0], substep);
    }
    for_each_attachment(world_, [](Attachment& attachment, const AttachmentSides& sides) {
        lks::begin_substep(attachment, sides);
    });
    for_each_loaded_rope(scene_, [this](std::uint32_t object) { measure_predicted(world_, object); });
}

void RigidSubstep::carry_pushes_on() {
    blocks_.in_bundles([this](const FigureBundle& bundle) {
        blocks_.in_trees(bundle, factor_bundle, factor_articulation);
        blocks_.for_each_figure(bundle,
                                [this](const FigureRange& figure) { factor_closures(scene_, figure); });
        blocks_.for_each_figure(bundle, [this](const FigureRange& figure) {
            blocks_.for_each_joint(figure, [this](Joint& joint, Body& a, Body& b) {
                prepare_pushes(joint, a, b);
                if (joint.carries_torque) {
                    carry_torque(scene_, joint, carried_turn(joint, a, b));
                } else {
                    lks::carry_pushes_on(joint, a, b);
                }
            });
        });
    });
    static_cast<void>(scene_.contacts_act.resize(scene_.contacts.size())); // within its room
    blocks_.in_contact_blocks(scene_.contacts.size(), [this](std::uint32_t first, std::uint32_t end) {
        WideContacts wide = contacts_.side_by_side(ContactStage::make_rows);
        for (std::uint32_t i = first; i < end; ++i) {
            wide.add(i);
        }
        wide.finish();
        for (std::uint32_t i = first; i < end; ++i) {
            scene_.contacts_act[i] = scene_.contacts[i].active_count != 0 ? 1 : 0;
        }
    });
    blocks_.in_bundles([this](const FigureBundle& bundle) {
        blocks_.for_each_figure(bundle, [this](const FigureRange& figure) {
            contacts_.push_again(figure);
            carry_feet(scene_, figure);
        });
        solve_trees(bundle);
    });
    static_cast<void>(scene_.substep_motions.resize(scene_.bodies.size())); // within their room
    blocks_.in_figures([this](const FigureRange& figure) { measure_motions(scene_, figure); });
    static_cast<void>(scene_.figure_shares.resize(scene_.figure_ranges.size())); // within its room
    blocks_.in_figures([&](const FigureRange& figure) {
        scene_.figure_shares[static_cast<std::size_t>(&figure - scene_.figure_ranges.begin())] =
            share_to_add(scene_, figure, rate_, least_speed_);
    });
    if (scale_carried_pushes(scene_, rate_, least_speed_)) {
        blocks_.in_bundles([this](const FigureBundle& bundle) { solve_trees(bundle); });
    }
}

void RigidSubstep::project_joints(const FigureRange& figure) {
    blocks_.for_each_joint(figure, [](Joint& joint, Body& a, Body& b) { project(joint, a, b); });
}

void RigidSubstep::project_back(const FigureRange& figure) {
    contacts_.project_back(figure);
    blocks_.for_each_joint_back(figure, [](Joint& joint, Body& a, Body& b) { project(joint, a, b); });
}

void RigidSubstep::iterate(std::uint32_t substep) {
    for (const std::uint32_t index : scene_.coupled) {
        if (bears_loads(scene_, index)) {
            project_loaded_rope(world_, index);
        } else {
            project_object(world_, coupled_object(world_, index), world_.scratch[0]);
        }
    }
    // Forward and back: a sweep in one direction only makes tall stacks sway.
    project_attachments();
    blocks_.in_bundles([this](const FigureBundle& bundle) {
        blocks_.for_each_figure(bundle, [this](const FigureRange& figure) { project_joints(figure); });
        solve_trees(bundle);
        contacts_.measure(bundle);
        blocks_.for_each_figure(bundle, [this](const FigureRange& figure) { contacts_.project(figure); });
    });
    const Array<std::uint32_t>& shared = scene_.shared_contacts;
    blocks_.in_contact_blocks(shared.size(), [&](std::uint32_t first, std::uint32_t end) {
        WideContacts wide = contacts_.side_by_side(ContactStage::measure);
        for (std::uint32_t i = first; i < end; ++i) {
            if (scene_.acts(shared[i])) {
                wide.add(shared[i]);
            }
        }
    });
    for (std::size_t i = 0; i < shared.size(); ++i) {
        contacts_.project(shared[i], false);
    }
    for (std::size_t i = shared.size(); i-- > 0;) {
        contacts_.project(shared[i], true);
    }
    blocks_.in_bundles([this](const FigureBundle& bundle) {
        blocks_.for_each_figure(bundle, [this](const FigureRange& figure) { project_back(figure); });
        solve_trees(bundle);
    });
    project_attachments();
    project_loaded_ropes();
    collide_objects(substep);
}

void RigidSubstep::project_loaded_ropes() {
    for_each_loaded_rope(scene_, [this](std::uint32_t object) { project_loaded_rope(world_, object); });
}

void RigidSubstep::project_attachments() {
    for_each_attachment(world_, [](Attachment& attachment, const AttachmentSides& sides) {
        lks::project(attachment, sides);
    });
}

// Cloth and ropes against colliders and bodies, so that a substep ends with nothing inside either.
void RigidSubstep::collide_objects(std::uint32_t substep) {
    std::size_t pair = 0;
    for (const std::uint32_t index : scene_.coupled) {
        Object& object = coupled_object(world_, index);
        collide_object(world_, object, world_.scratch[0], substep);
        SweptParticles swept(object, *world_.kernels);
        bool touched = false;
        for (; pair < scene_.object_pairs.size() && scene_.object_pairs[pair] >> 32 == index; ++pair) {
            const auto body = static_cast<std::uint32_t>(scene_.object_pairs[pair]);
            collide_with_body(object, scene_.bodies[body], scene_.descriptions[body],
                              held_particles(scene_.held, index, body), rate_, *world_.kernels, swept,
                              world_.event_log.wants_particles() ? &scene_.object_pushes[pair] : nullptr);
            touched = true;
        }
        if (touched) {
            place_pins(object, substep, world_.rate.substeps);
        }
    }
}

// By more than a 64th of a radian a substep, about any axis.
bool RigidSubstep::turns_fast(std::uint32_t index) const {
    const Body& body = scene_.bodies[index];
    const std::int64_t most =
        (static_cast<std::int64_t>(rate_.substeps_per_second) << world_fraction_bits) / 64;
    const auto is_more = [most](std::int64_t spin) { return spin > most || spin < -most; };
    const fixed::Vec3& spin = body.angular_velocity;
    return body.is_awake() && (is_more(spin.x) || is_more(spin.y) || is_more(spin.z));
}

// Where light bones may have turned further than a substep follows, where joints of what is held are swept
// one by one, as soft ones are, and where it turns fast against limits, or at the narrow ends of ellipses,
// about which limits turn fast.
bool RigidSubstep::may_gain(const FigureRange& figure) const {
    bool loose = false;
    if (figure.is_held) {
        for_each_part(scene_, figure, Part::joint, [&](std::uint32_t i) {
            const JointDescription& d = scene_.joints[i].description;
            const JointConstants& c = scene_.joints[i].constants;
            loose = loose || has_spring(c) || has_ellipse(c) ||
                    (has_limits(c) && (turns_fast(d.body_a) || turns_fast(d.body_b)));
        });
    }
    return has_uneven_tree(scene_, figure) || loose || figure.relieved || figure.closures != no_closures;
}

// For events: where they give most. Also of those that don't act, but were struck.
void RigidSubstep::mark_contacts() {
    blocks_.in_contact_blocks(scene_.contacts.size(), [this](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end; ++i) {
            const ContactBodies bodies = contacts_.bodies_of(scene_.contacts[i]);
            look(scene_.contact_marks[i], scene_.contacts[i], bodies.a, bodies.b);
        }
    });
}

void RigidSubstep::finish_bodies() {
    blocks_.in_bodies([&](std::uint32_t i, std::uint32_t worker) {
        if (scene_.bodies[i].is_awake()) {
            finish_body(scene_.bodies[i], scene_.descriptions[i], rate_,
                        world_.scratch[worker].counters.speed_clamps);
        }
    });
}

// What they gained is taken out again. Where ropes bear a figure these move, too: the caller alone.
void RigidSubstep::finish_figures(std::uint32_t substep) {
    blocks_.in_figures([&](FigureRange& figure) {
        free_figures_.finish_substep(figure, substep);
        if ((figure.is_held || (figure.has_held_tree && !figure.is_loaded)) && may_gain(figure)) {
            take_out_gain(scene_, figure, rate_);
        }
    });
    for (const FigureRange& figure : scene_.figure_ranges) {
        if (figure.is_loaded && may_gain(figure)) {
            take_out_gain_on_ropes(world_, figure, rate_);
        }
    }
}

// For events.
void RigidSubstep::add_up_contact_pushes() {
    blocks_.in_contact_blocks(scene_.contacts.size(), [this](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end; ++i) {
            if (scene_.acts(i)) {
                add_up_pushes(scene_.contacts[i], rate_);
            }
        }
    });
}

// What joints are off, and deep overlaps, without giving speed.
void RigidSubstep::undo_errors() {
    const auto undo = [this](std::uint32_t i) {
        if (scene_.acts(i)) {
            undo_overlap(scene_.contacts[i], contacts_.bodies_of(scene_.contacts[i]), rate_);
        }
    };
    blocks_.in_figures([&](const FigureRange& figure) {
        blocks_.for_each_joint(figure, [&](Joint& joint, Body& a, Body& b) {
            add_up_pushes(joint, a, b);
            if (!joint.in_tree || joint.closes_loop) {
                undo_error(joint, a, b, figure.is_pinned);
            }
        });
        for_each_part(scene_, figure, Part::contact, undo);
    });
    for (const std::uint32_t i : scene_.shared_contacts) {
        undo(i);
    }
    blocks_.in_bundles([this](const FigureBundle& bundle) {
        blocks_.in_trees(bundle, undo_bundle, undo_articulation);
        blocks_.for_each_figure(bundle, [this](const FigureRange& figure) { undo_closures(scene_, figure); });
    });
    for_each_loaded_rope(scene_, [this](std::uint32_t object) { undo_rope_loads(world_, object); });
}

void RigidSubstep::finish(std::uint32_t substep) {
    impacts_.keep_predicted_speeds();
    finish_bodies();
    finish_figures(substep);
    if (world_.event_log.wants_contacts()) {
        add_up_contact_pushes();
    }
    impacts_.restore_speeds();
    if (world_.event_log.wants_contacts()) {
        mark_contacts();
    }
    undo_errors();
    for_each_attachment(world_,
                        [](Attachment& attachment, const AttachmentSides&) { finish_substep(attachment); });
}

} // namespace lks
