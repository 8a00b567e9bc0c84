// What pushes a figure in a substep.
#pragma once

#include <algorithm>

#include "rigid/contact.h"
#include "rigid/figures.h"

namespace lks {

inline bool is_bone_of(const RigidScene& scene, const FigureRange& figure, std::uint32_t body) {
    return scene.bodies[body].is_awake() && scene.figures[body] == name_of(scene, figure);
}

bool pushes(const Contact& contact);

// By a contact with anything but its own bodies.
bool is_pushed_from_outside(const RigidScene& scene, const FigureRange& figure);

// A cloth or rope that counts(object) is near one of its bodies.
template <typename Counts>
bool is_near_objects(const RigidScene& scene, const FigureRange& figure, const Counts& counts) {
    const std::uint32_t own = name_of(scene, figure);
    return std::any_of(scene.object_pairs.begin(), scene.object_pairs.end(), [&](std::uint64_t pair) {
        return scene.figures[static_cast<std::uint32_t>(pair)] == own &&
               counts(static_cast<std::uint32_t>(pair >> 32));
    });
}

} // namespace lks
