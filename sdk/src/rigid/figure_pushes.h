// What pushes a figure in a substep.
#pragma once

#include "rigid/contact.h"
#include "rigid/figures.h"

namespace lks {

inline bool is_bone_of(const RigidScene& scene, const FigureRange& figure, std::uint32_t body) {
    return scene.bodies[body].is_awake() && scene.figures[body] == name_of(scene, figure);
}

bool pushes(const Contact& contact);

// By a contact with anything but its own bodies.
bool is_pushed_from_outside(const RigidScene& scene, const FigureRange& figure);

} // namespace lks
