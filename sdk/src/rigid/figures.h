// Figures: bodies that joints hold together, with their joints, contacts and attachments. Shared contacts,
// and nothing else in a substep, work on two of them.
#pragma once

#include "rigid/body_roots.h"
#include "rigid/pair.h"
#include "rigid/rigid_scene.h"

namespace lks {

// Into scene.figures, once a tick: joints come and go between ticks. join_more(roots): what else holds them
// together.
template <typename JoinMore>
void join_figures(RigidScene& scene, const JoinMore& join_more) {
    BodyRoots roots(scene, scene.figures);
    roots.join_by_joints();
    join_more(roots);
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        scene.figures[i] = roots.root(i);
    }
}
inline void join_figures(RigidScene& scene) {
    join_figures(scene, [](BodyRoots&) {});
}
// Of what is awake in this tick, in the order of the least bodies. After join_figures and find_articulations.
void find_figures(RigidScene& scene);

// The least index of its bodies, which names it.
inline std::uint32_t name_of(const RigidScene& scene, const FigureRange& figure) {
    return figure_of(scene.figure_parts[figure.begin()]);
}

// The mass of a body in that of a figure's heaviest one: 30 fraction bits, at most one.
inline std::int32_t mass_in(const InverseMass& heaviest, const Body& body) {
    return share_in_greater(heaviest, body.inverse_mass);
}

// Calls use(index) for each of its parts of one kind.
template <typename Use>
void for_each_part(const RigidScene& scene, const FigureRange& figure, Part kind, const Use& use) {
    const auto k = static_cast<std::size_t>(kind);
    for (std::uint32_t i = figure.begins[k]; i < figure.begins[k + 1]; ++i) {
        use(index_of(scene.figure_parts[i]));
    }
}
// Of its contacts of one kind, of those that act in this substep.
template <typename Use>
void for_each_acting(const RigidScene& scene, const FigureRange& figure, Part kind, const Use& use) {
    for_each_part(scene, figure, kind, [&](std::uint32_t i) {
        if (scene.acts(i)) {
            use(i);
        }
    });
}
template <typename Use>
void for_each_part_back(const RigidScene& scene, const FigureRange& figure, Part kind, const Use& use) {
    const auto k = static_cast<std::size_t>(kind);
    for (std::uint32_t i = figure.begins[k + 1]; i-- > figure.begins[k];) {
        use(index_of(scene.figure_parts[i]));
    }
}

// Contacts of its are solved with its trees (rigid/light_feet.h).
inline bool stands_on_light_feet(const RigidScene& scene, const FigureRange& figure) {
    return figure.closures != no_closures && scene.closure_ranges[figure.closures].stands;
}

// One of its trees has masses of 1 : 100 and more (rigid/uneven_tree.h).
inline bool has_uneven_tree(const RigidScene& scene, const FigureRange& figure) {
    bool uneven = false;
    for_each_part(scene, figure, Part::tree,
                  [&](std::uint32_t i) { uneven = uneven || scene.trees[i].is_uneven; });
    return uneven;
}

} // namespace lks
