#include "rigid/rigid_substep.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/articulation.h"
#include "rigid/carried_pushes.h"
#include "rigid/contact_search.h"
#include "rigid/coupling.h"
#include "rigid/figures.h"
#include "rigid/held_energy.h"
#include "rigid/held_tree.h"
#include "rigid/joint_limits.h"
#include "rigid/joint_turns.h"
#include "rigid/particle_contact.h"
#include "rigid/rope_loads.h"
#include "rigid/shape_touch.h"
#include "rigid/wide_trees.h"
#include "solver/object_tick.h"
#include "solver/pins.h"
#include "solver/world.h"
#include "threads/blocks.h"

namespace lks {
namespace {

// Some tens of microseconds of work: enough to be worth another thread's while.
constexpr std::uint32_t bodies_a_block = 64;
constexpr std::uint32_t contacts_a_block = 64;
constexpr std::uint32_t parts_a_block = 128; // of figures

Object& coupled_object(lks_world& world, std::uint32_t index) {
    return *world.objects[index].object;
}

} // namespace

RigidSubstep::RigidSubstep(lks_world& world, Team* team)
    : world_(world), scene_(world.rigid), team_(team), rate_(world.rate),
      free_figures_(scene_, rate_, world.rate.substeps) {
    least_speed_ = 2 * least_approach(sum_of_magnitudes(world.gravity) / rate_.substeps_per_second);
    for (const Contact& contact : scene_.contacts) {
        any_restitution_ = any_restitution_ || contact.restitution != 0;
    }
}

void RigidSubstep::run(std::uint32_t substep) {
    begin(substep);
    strike_all();
    predict(substep);
    carry_pushes_on();
    for (std::uint32_t iteration = 0; iteration < world_.rate.iterations; ++iteration) {
        iterate(substep);
    }
    if (relieve_strained()) {
        collide_objects(substep);
    }
    finish(substep);
}

ContactBodies RigidSubstep::bodies_of(const Contact& contact) {
    return {scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other)};
}

// use(first, end)
template <typename Use>
void RigidSubstep::in_contact_blocks(const Use& use) {
    run_blocks(team_, static_cast<std::uint32_t>(scene_.contacts.size()), contacts_a_block,
               [&](std::uint32_t first, std::uint32_t end, std::uint32_t) { use(first, end); });
}

WideContacts RigidSubstep::side_by_side(ContactStage stage) {
    return WideContacts(scene_, world_.kernels->contact_points, stage, rate_);
}

// use(bundle)
template <typename Use>
void RigidSubstep::in_bundles(const Use& use) {
    const Array<FigureBundle>& bundles = scene_.figure_bundles;
    const auto begin_of = [this](const FigureBundle& bundle) {
        return scene_.figure_ranges[bundle.first].begin();
    };
    // A block has the bundles whose parts begin in it.
    run_blocks(team_, static_cast<std::uint32_t>(scene_.figure_parts.size()), parts_a_block,
               [&](std::uint32_t first, std::uint32_t end, std::uint32_t) {
                   const FigureBundle* bundle = std::lower_bound(
                       bundles.begin(), bundles.end(), first,
                       [&](const FigureBundle& b, std::uint32_t part) { return begin_of(b) < part; });
                   for (; bundle != bundles.end() && begin_of(*bundle) < end; ++bundle) {
                       use(*bundle);
                   }
               });
}

template <typename Use>
void RigidSubstep::for_each_figure(const FigureBundle& bundle, const Use& use) {
    for (std::uint32_t i = bundle.first; i < bundle.end; ++i) {
        use(scene_.figure_ranges[i]);
    }
}

// use(figure)
template <typename Use>
void RigidSubstep::in_figures(const Use& use) {
    in_bundles([&](const FigureBundle& bundle) { for_each_figure(bundle, use); });
}

// use(figure, bundle, number in it).
template <typename Use>
void RigidSubstep::in_strained(const Use& use) {
    in_bundles([&](const FigureBundle& bundle) {
        for (std::uint32_t i = bundle.first; i < bundle.end; ++i) {
            const FigureRange& figure = scene_.figure_ranges[i];
            if (is_strained(figure)) {
                use(figure, bundle, i - bundle.first);
            }
        }
    });
}

template <typename Use>
void RigidSubstep::for_each_joint(const FigureRange& figure, const Use& use) {
    for_each_part(scene_, figure, Part::joint, [&](std::uint32_t i) {
        Joint& joint = scene_.joints[i];
        use(joint, scene_.bodies[joint.description.body_a], scene_.bodies[joint.description.body_b]);
    });
}

// A bundle's trees side by side, or those of its one figure one by one.
void RigidSubstep::in_trees(const FigureBundle& bundle, void (*wide)(RigidScene&, const FigureBundle&),
                            void (*plain)(RigidScene&, const ArticulatedTree&)) {
    if (bundle.is_wide()) {
        wide(scene_, bundle);
        return;
    }
    for_each_part(scene_, scene_.figure_ranges[bundle.first], Part::tree,
                  [&](std::uint32_t i) { plain(scene_, scene_.trees[i]); });
}

void RigidSubstep::solve_trees(const FigureRange& figure) {
    for_each_part(scene_, figure, Part::tree,
                  [this](std::uint32_t i) { solve_articulation(scene_, scene_.trees[i]); });
}

void RigidSubstep::solve_trees(const FigureBundle& bundle) {
    in_trees(bundle, solve_bundle, solve_articulation);
}

void RigidSubstep::begin(std::uint32_t substep) {
    in_contact_blocks([&](std::uint32_t first, std::uint32_t end) {
        WideContacts wide = side_by_side(ContactStage::begin);
        for (std::uint32_t i = first; i < end; ++i) {
            Contact& contact = scene_.contacts[i];
            if (contact.every_substep && substep > 1) {
                find_points_again(world_, contact);
            }
            wide.add(i);
        }
    });
    in_figures([&](FigureRange& figure) {
        for_each_joint(figure, [](Joint& joint, Body& a, Body& b) { lks::begin_substep(joint, a, b); });
        free_figures_.begin_substep(figure, substep);
    });
    for_each_attachment(world_, [this](Attachment& attachment, const AttachmentSides& sides) {
        measure_left(attachment, sides, rate_);
    });
}

// An impact may cause the next one: forward and back, until nothing strikes any more. What several strike at
// once takes them together, behind the sweeps.
void RigidSubstep::strike_all() {
    if (!any_restitution_) {
        return;
    }
    for (Body& body : scene_.bodies) {
        body.impacts = 0;
    }
    for (const Contact& contact : scene_.contacts) {
        const ContactBodies bodies = bodies_of(contact);
        if (is_about_to_strike(contact, bodies, rate_)) {
            ++bodies.a.impacts;
            ++bodies.b.impacts;
        }
    }
    const auto takes_one = [](const Body& body) { return !body.is_awake() || body.impacts < 2; };
    constexpr int most_passes = 8;
    bool again = true;
    for (int pass = 0; pass < most_passes && again; ++pass) {
        again = false;
        for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
            Contact& contact = scene_.contacts[pass % 2 == 0 ? i : scene_.contacts.size() - 1 - i];
            const ContactBodies bodies = bodies_of(contact);
            if (takes_one(bodies.a) && takes_one(bodies.b)) {
                again = strike(contact, bodies, rate_) || again;
            }
        }
    }
}

void RigidSubstep::predict(std::uint32_t substep) {
    run_each(team_, scene_.bodies.size(), bodies_a_block, [&](std::uint32_t i, std::uint32_t worker) {
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
    in_bundles([this](const FigureBundle& bundle) {
        in_trees(bundle, factor_bundle, factor_articulation);
        for_each_figure(bundle, [this](const FigureRange& figure) {
            for_each_joint(figure, [this](Joint& joint, Body& a, Body& b) {
                prepare_pushes(joint, a, b);
                if (joint.in_held_tree) {
                    carry_torque(scene_, joint, carried_turn(joint, a, b));
                } else {
                    lks::carry_pushes_on(joint, a, b);
                }
            });
        });
    });
    static_cast<void>(scene_.contacts_act.resize(scene_.contacts.size())); // within its room
    in_contact_blocks([this](std::uint32_t first, std::uint32_t end) {
        WideContacts wide = side_by_side(ContactStage::make_rows);
        for (std::uint32_t i = first; i < end; ++i) {
            wide.add(i);
        }
        wide.finish();
        for (std::uint32_t i = first; i < end; ++i) {
            scene_.contacts_act[i] = scene_.contacts[i].active_count != 0 ? 1 : 0;
        }
    });
    in_bundles([this](const FigureBundle& bundle) {
        for_each_figure(bundle, [this](const FigureRange& figure) { push_contacts_again(figure); });
        solve_trees(bundle);
    });
    static_cast<void>(scene_.substep_motions.resize(scene_.bodies.size())); // within their room
    in_figures([this](const FigureRange& figure) { measure_motions(scene_, figure); });
    static_cast<void>(scene_.figure_shares.resize(scene_.figure_ranges.size())); // within its room
    in_figures([&](const FigureRange& figure) {
        scene_.figure_shares[static_cast<std::size_t>(&figure - scene_.figure_ranges.begin())] =
            share_to_add(scene_, figure, rate_, least_speed_);
    });
    if (scale_carried_pushes(scene_, rate_, least_speed_)) {
        in_bundles([this](const FigureBundle& bundle) { solve_trees(bundle); });
    }
}

// Each body those that are its figure's: the other one of a shared contact may be at work.
void RigidSubstep::push_contacts_again(const FigureRange& figure) {
    for_each_acting(scene_, figure, Part::contact, [this](std::uint32_t i) {
        Contact& contact = scene_.contacts[i];
        const ContactBodies bodies = bodies_of(contact);
        if (bodies.a.is_awake()) {
            carry_on(contact, true, move_of(contact.key.body_a));
        }
        if (bodies.b.is_awake()) {
            carry_on(contact, false, move_of(contact.key.other));
        }
    });
    const std::uint32_t own = name_of(scene_, figure);
    for_each_acting(scene_, figure, Part::shared_contact, [&](std::uint32_t i) {
        Contact& contact = scene_.contacts[i];
        const bool is_a = scene_.figures[contact.key.body_a] == own;
        carry_on(contact, is_a, move_of(is_a ? contact.key.body_a : contact.key.other));
    });
    apply_contact_moves(figure);
}

void RigidSubstep::measure_contact(std::uint32_t index) {
    if (scene_.acts(index)) {
        Contact& contact = scene_.contacts[index];
        measure(contact, bodies_of(contact));
    }
}

// Colliders have the one that stays zero.
Move& RigidSubstep::move_of(std::uint32_t other) {
    return scene_.contact_moves[other >= other_is_collider ? scene_.bodies.size() : other];
}

void RigidSubstep::project_contact(std::uint32_t index, bool back) {
    if (scene_.acts(index)) {
        Contact& contact = scene_.contacts[index];
        project(contact, {move_of(contact.key.body_a), move_of(contact.key.other)}, back, rate_);
    }
}

void RigidSubstep::apply_contact_moves(const FigureRange& figure) {
    for_each_part(scene_, figure, Part::body, [this](std::uint32_t i) {
        apply(scene_.bodies[i], scene_.contact_moves[i]);
        scene_.contact_moves[i] = {};
    });
}

void RigidSubstep::project_joints(const FigureRange& figure) {
    for_each_joint(figure, [](Joint& joint, Body& a, Body& b) { lks::project(joint, a, b); });
}

// Held trees with what they hold, and the others' joints by rows.
void RigidSubstep::solve_strained(const FigureRange& figure) {
    for_each_joint(figure, [](Joint& joint, Body& a, Body& b) {
        if (!joint.in_held_tree) {
            lks::project(joint, a, b);
        }
    });
    solve_strained_trees(figure);
}

void RigidSubstep::solve_strained_trees(const FigureRange& figure) {
    for_each_part(scene_, figure, Part::tree, [this](std::uint32_t i) {
        const ArticulatedTree& tree = scene_.trees[i];
        if (!tree.is_held || !solve_held_tree(scene_, tree)) {
            solve_articulation(scene_, tree);
        }
    });
}

void RigidSubstep::measure_contacts(const FigureBundle& bundle) {
    WideContacts wide = side_by_side(ContactStage::measure);
    for_each_figure(bundle, [&](const FigureRange& figure) {
        for_each_acting(scene_, figure, Part::contact, [&](std::uint32_t i) { wide.add(i); });
    });
}

void RigidSubstep::measure_contacts(const FigureRange& figure) {
    for_each_part(scene_, figure, Part::contact, [this](std::uint32_t i) { measure_contact(i); });
}

void RigidSubstep::project_contacts(const FigureRange& figure) {
    for_each_part(scene_, figure, Part::contact, [this](std::uint32_t i) { project_contact(i, false); });
}

void RigidSubstep::project_back(const FigureRange& figure, bool strained) {
    for_each_part_back(scene_, figure, Part::contact, [this](std::uint32_t i) { project_contact(i, true); });
    apply_contact_moves(figure);
    for_each_part_back(scene_, figure, Part::joint, [&](std::uint32_t i) {
        Joint& joint = scene_.joints[i];
        if (strained && joint.in_held_tree) {
            return; // solved with their tree
        }
        lks::project(joint, scene_.bodies[joint.description.body_a], scene_.bodies[joint.description.body_b]);
    });
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
    in_bundles([this](const FigureBundle& bundle) {
        for_each_figure(bundle, [this](const FigureRange& figure) { project_joints(figure); });
        solve_trees(bundle);
        measure_contacts(bundle);
        for_each_figure(bundle, [this](const FigureRange& figure) { project_contacts(figure); });
    });
    const Array<std::uint32_t>& shared = scene_.shared_contacts;
    run_blocks(team_, static_cast<std::uint32_t>(shared.size()), contacts_a_block,
               [&](std::uint32_t first, std::uint32_t end, std::uint32_t) {
                   WideContacts wide = side_by_side(ContactStage::measure);
                   for (std::uint32_t i = first; i < end; ++i) {
                       if (scene_.acts(shared[i])) {
                           wide.add(shared[i]);
                       }
                   }
               });
    for (std::size_t i = 0; i < shared.size(); ++i) {
        project_contact(shared[i], false);
    }
    for (std::size_t i = shared.size(); i-- > 0;) {
        project_contact(shared[i], true);
    }
    in_bundles([this](const FigureBundle& bundle) {
        for_each_figure(bundle, [this](const FigureRange& figure) { project_back(figure, false); });
        solve_trees(bundle);
    });
    project_attachments();
    project_loaded_ropes();
    collide_objects(substep);
}

// The figure of a body.
void RigidSubstep::mark_strained(std::uint32_t body) {
    static_cast<void>(scene_.strained_figures.resize(scene_.bodies.size())); // within its room
    scene_.strained_figures[scene_.figures[body]] = 1;
}

// What something stops that might pass it, or that it might pass, and that goes on by more than a centimetre.
void RigidSubstep::mark_hard_impacts() {
    constexpr std::int64_t hard = (std::int64_t{1} << world_fraction_bits) / 100;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
        if (!scene_.acts(i)) {
            continue;
        }
        const Contact& contact = scene_.contacts[i];
        const ContactBodies bodies = bodies_of(contact);
        if (!contact.fast || (bodies.a.jointed && bodies.b.jointed) || !closes(contact, bodies, hard)) {
            continue;
        }
        mark_strained(contact.key.body_a);
        if (contact.key.other < other_is_collider) {
            mark_strained(contact.key.other);
        }
    }
}

// By what hangs on it.
bool RigidSubstep::is_strained_rope(std::uint32_t object) const {
    return any_rope_load(scene_, object, [this](std::uint32_t body) {
        return scene_.bodies[body].is_awake() && scene_.strained_figures[scene_.figures[body]] != 0;
    });
}

// Of those that are held, or hang on ropes, or hold heavy bodies by light ones: by more than an eighth of a
// degree.
void RigidSubstep::mark_exceeded_limits() {
    for (const FigureRange& figure : scene_.figure_ranges) {
        if (figure.is_held || figure.has_held_tree || figure.is_loaded) {
            for_each_joint(figure, [&](const Joint& joint, const Body& a, const Body& b) {
                const std::int64_t turned =
                    joint.in_held_tree ? turned_away(joint, a, b, !figure.is_held) : 0;
                if (turned > far_turned || exceeded_limits(joint, a, b, true) > far_turned) {
                    mark_strained(name_of(scene_, figure));
                }
            });
        }
    }
}

// False: no figure is.
bool RigidSubstep::find_strained() {
    scene_.strained_figures.clear();
    mark_hard_impacts();
    mark_exceeded_limits();
    return !scene_.strained_figures.empty();
}

bool RigidSubstep::is_strained(const FigureRange& figure) const {
    return scene_.strained_figures[name_of(scene_, figure)] != 0;
}

bool RigidSubstep::are_strained(const Contact& shared) const {
    return scene_.strained_figures[scene_.figures[shared.key.body_a]] != 0 &&
           scene_.strained_figures[scene_.figures[shared.key.other]] != 0;
}

// A hand that a wall has stopped is drawn on by the arm and the chest behind it: its contact knows its own
// mass only, and at 60 m/s it would be 8 cm in the wall before all of them have stopped. And limits know the
// masses of their two bones: those of a hand that all of a figure hangs on would find too little in one
// iteration, be exceeded, and in the end throw the figure about. Where that happens the figure, and nobody
// else, has some iterations more, with the ropes that it hangs on. True: these have moved.
bool RigidSubstep::relieve_strained() {
    constexpr int most_rounds = 16;
    bool roped = false;
    for (FigureRange& figure : scene_.figure_ranges) {
        figure.relieved = false;
    }
    for (int round = 0; round < most_rounds && find_strained(); ++round) {
        for (FigureRange& figure : scene_.figure_ranges) {
            figure.relieved = figure.relieved || is_strained(figure);
        }
        in_strained([this](const FigureRange& figure, const FigureBundle& bundle, std::uint32_t number) {
            if (bundle.is_wide()) {
                hand_out_factors(scene_, bundle, number);
            }
            solve_strained(figure);
            measure_contacts(figure);
            project_contacts(figure);
        });
        const Array<std::uint32_t>& shared = scene_.shared_contacts;
        for (const std::uint32_t i : shared) {
            if (are_strained(scene_.contacts[i])) {
                measure_contact(i);
                project_contact(i, false);
            }
        }
        for (std::size_t k = shared.size(); k-- > 0;) {
            if (are_strained(scene_.contacts[shared[k]])) {
                project_contact(shared[k], true);
            }
        }
        in_strained([this](const FigureRange& figure, const FigureBundle&, std::uint32_t) {
            project_back(figure, true);
            solve_strained_trees(figure);
        });
        for_each_loaded_rope(scene_, [&](std::uint32_t object) {
            if (is_strained_rope(object)) {
                project_loaded_rope(world_, object);
                roped = true;
            }
        });
    }
    return roped;
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
    return has_uneven_tree(scene_, figure) || loose || figure.relieved;
}

// All contacts together: what comes down on several at once, on four feet or across a seam, would spin if
// they gave back its speed one after the other.
void RigidSubstep::restore_speeds() {
    const auto for_each_struck = [this](const auto& use) {
        for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
            Contact& contact = scene_.contacts[i];
            if (scene_.acts(i) && contact.struck_count != 0) {
                use(contact, bodies_of(contact));
            }
        }
    };
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
        if (scene_.acts(i)) {
            Contact& contact = scene_.contacts[i];
            begin_impact(contact, bodies_of(contact), predicted_speeds(contact));
        }
    }
    for_each_struck([](Contact& contact, const ContactBodies& bodies) { give_alike(contact, bodies); });
    constexpr int most_rounds = 32;
    bool more = true;
    for (int round = 0; round < most_rounds && more; ++round) {
        more = false;
        for_each_struck([&](Contact& contact, const ContactBodies& bodies) {
            more = give_each(contact, bodies, rate_) || more;
        });
    }
    for_each_struck([](Contact& contact, const ContactBodies& bodies) { rub_by_impact(contact, bodies); });
    for (Body& body : scene_.bodies) {
        if (body.is_awake()) {
            limit_speeds(body, rate_, world_.counters.speed_clamps);
        }
    }
}

// The other one's, too: what is no body, or does not move by pushes, has the same before and behind them.
ContactSpeeds RigidSubstep::predicted_speeds(const Contact& contact) {
    const ContactBodies bodies = bodies_of(contact);
    const auto of = [this](const Body& body, std::uint32_t index) {
        return body.is_awake() ? scene_.predicted_speeds[index] : body.speeds();
    };
    return {of(bodies.a, contact.key.body_a), of(bodies.b, contact.key.other)};
}

// For events: where they give most. Also of those that don't act, but were struck.
void RigidSubstep::mark_contacts() {
    in_contact_blocks([this](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end; ++i) {
            const ContactBodies bodies = bodies_of(scene_.contacts[i]);
            look(scene_.contact_marks[i], scene_.contacts[i], bodies.a, bodies.b);
        }
    });
}

// Before impacts change them.
void RigidSubstep::keep_predicted_speeds() {
    scene_.predicted_speeds.clear();
    for (const Body& body : scene_.bodies) {
        scene_.predicted_speeds.push_reserved(body.speeds());
    }
}

void RigidSubstep::finish_bodies() {
    run_each(team_, scene_.bodies.size(), bodies_a_block, [&](std::uint32_t i, std::uint32_t worker) {
        if (scene_.bodies[i].is_awake()) {
            finish_body(scene_.bodies[i], scene_.descriptions[i], rate_,
                        world_.scratch[worker].counters.speed_clamps);
        }
    });
}

// What they gained is taken out again. Where ropes bear a figure these move, too: the caller alone.
void RigidSubstep::finish_figures(std::uint32_t substep) {
    in_figures([&](FigureRange& figure) {
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
    in_contact_blocks([this](std::uint32_t first, std::uint32_t end) {
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
            undo_overlap(scene_.contacts[i], bodies_of(scene_.contacts[i]), rate_);
        }
    };
    in_figures([&](const FigureRange& figure) {
        for_each_joint(figure, [&](Joint& joint, Body& a, Body& b) {
            add_up_pushes(joint, a, b);
            if (!joint.in_tree) {
                undo_error(joint, a, b, figure.is_pinned);
            }
        });
        for_each_part(scene_, figure, Part::contact, undo);
    });
    for (const std::uint32_t i : scene_.shared_contacts) {
        undo(i);
    }
    in_bundles([this](const FigureBundle& bundle) { in_trees(bundle, undo_bundle, undo_articulation); });
    for_each_loaded_rope(scene_, [this](std::uint32_t object) { undo_rope_loads(world_, object); });
}

void RigidSubstep::finish(std::uint32_t substep) {
    if (any_restitution_) {
        keep_predicted_speeds();
    }
    finish_bodies();
    finish_figures(substep);
    if (world_.event_log.wants_contacts()) {
        add_up_contact_pushes();
    }
    if (any_restitution_) {
        restore_speeds();
    }
    if (world_.event_log.wants_contacts()) {
        mark_contacts();
    }
    undo_errors();
    for_each_attachment(world_,
                        [](Attachment& attachment, const AttachmentSides&) { finish_substep(attachment); });
}

} // namespace lks
