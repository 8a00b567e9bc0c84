#include "rigid/strained_figures.h"

#include "rigid/articulation.h"
#include "rigid/closures.h"
#include "rigid/held_tree.h"
#include "rigid/joint_limits.h"
#include "rigid/joint_turns.h"
#include "rigid/rope_loads.h"
#include "rigid/wide_trees.h"

namespace lks {
namespace {

// By its row, where it is not solved with its tree.
void project_swept(Joint& joint, Body& a, Body& b) {
    if (!joint.in_held_tree) {
        project(joint, a, b);
    }
}

} // namespace

// use(figure, bundle, number in it).
template <typename Use>
void StrainedFigures::in_strained(const Use& use) const {
    blocks_.in_bundles([&](const FigureBundle& bundle) {
        for (std::uint32_t i = bundle.first; i < bundle.end; ++i) {
            const FigureRange& figure = scene_.figure_ranges[i];
            if (is_strained(figure)) {
                use(figure, bundle, i - bundle.first);
            }
        }
    });
}

// Held trees with what they hold, and the others' joints by rows.
void StrainedFigures::solve(const FigureRange& figure) const {
    blocks_.for_each_joint(figure, project_swept);
    solve_trees(figure);
}

void StrainedFigures::solve_trees(const FigureRange& figure) const {
    for_each_part(scene_, figure, Part::tree, [this](std::uint32_t i) {
        const ArticulatedTree& tree = scene_.trees[i];
        if (!tree.is_held || tree.has_closures() || !solve_held_tree(scene_, tree)) {
            solve_articulation(scene_, tree);
        }
    });
    solve_closures(scene_, figure);
}

// The figure of a body.
void StrainedFigures::mark(std::uint32_t body) const {
    static_cast<void>(scene_.strained_figures.resize(scene_.bodies.size())); // within its room
    scene_.strained_figures[scene_.figures[body]] = 1;
}

// What something stops that might pass it, or that it might pass, and that goes on by more than a centimetre.
void StrainedFigures::mark_hard_impacts() const {
    constexpr std::int64_t hard = world_one / 100;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
        if (!scene_.acts(i)) {
            continue;
        }
        const Contact& contact = scene_.contacts[i];
        const ContactBodies bodies = contacts_.bodies_of(contact);
        if (!contact.fast || (bodies.a.jointed && bodies.b.jointed) || !closes(contact, bodies, hard)) {
            continue;
        }
        mark(contact.key.body_a);
        if (contact.key.other < other_is_collider) {
            mark(contact.key.other);
        }
    }
}

// By what hangs on it.
bool StrainedFigures::is_strained_rope(std::uint32_t object) const {
    return any_rope_load(scene_, object, [this](std::uint32_t body) {
        return scene_.bodies[body].is_awake() && scene_.strained_figures[scene_.figures[body]] != 0;
    });
}

// Of those that are held, or hang on ropes, or hold heavy bodies by light ones: by more than an eighth of a
// degree.
void StrainedFigures::mark_exceeded_limits() const {
    for (const FigureRange& figure : scene_.figure_ranges) {
        if (figure.is_held || figure.has_held_tree || figure.is_loaded) {
            blocks_.for_each_joint(figure, [&](const Joint& joint, const Body& a, const Body& b) {
                const std::int64_t turned =
                    joint.in_held_tree ? turned_away(joint, a, b, !figure.is_held) : 0;
                if (turned > far_turned || exceeded_limits(joint, a, b, true) > far_turned) {
                    mark(name_of(scene_, figure));
                }
            });
        }
    }
}

// False: no figure is.
bool StrainedFigures::find() const {
    scene_.strained_figures.clear();
    mark_hard_impacts();
    mark_exceeded_limits();
    return !scene_.strained_figures.empty();
}

bool StrainedFigures::is_strained(const FigureRange& figure) const {
    return scene_.strained_figures[name_of(scene_, figure)] != 0;
}

bool StrainedFigures::are_strained(const Contact& shared) const {
    return scene_.strained_figures[scene_.figures[shared.key.body_a]] != 0 &&
           scene_.strained_figures[scene_.figures[shared.key.other]] != 0;
}

void StrainedFigures::project_back(const FigureRange& figure) const {
    contacts_.project_back(figure);
    blocks_.for_each_joint_back(figure, project_swept);
}

bool StrainedFigures::relieve() const {
    constexpr int most_rounds = 16;
    bool roped = false;
    for (FigureRange& figure : scene_.figure_ranges) {
        figure.relieved = false;
    }
    for (int round = 0; round < most_rounds && find(); ++round) {
        for (FigureRange& figure : scene_.figure_ranges) {
            figure.relieved = figure.relieved || is_strained(figure);
        }
        in_strained([this](const FigureRange& figure, const FigureBundle& bundle, std::uint32_t number) {
            if (bundle.is_wide()) {
                hand_out_factors(scene_, bundle, number);
            }
            solve(figure);
            contacts_.measure(figure);
            contacts_.project(figure);
        });
        const Array<std::uint32_t>& shared = scene_.shared_contacts;
        for (const std::uint32_t i : shared) {
            if (are_strained(scene_.contacts[i])) {
                contacts_.measure(i);
                contacts_.project(i, false);
            }
        }
        for (std::size_t k = shared.size(); k-- > 0;) {
            if (are_strained(scene_.contacts[shared[k]])) {
                contacts_.project(shared[k], true);
            }
        }
        in_strained([this](const FigureRange& figure, const FigureBundle&, std::uint32_t) {
            project_back(figure);
            solve_trees(figure);
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

} // namespace lks
