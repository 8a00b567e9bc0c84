// Light bodies whose joints turn heavy ones against each other.
//
// A row of a hinge, or of a limit, knows the masses of its two bodies. Where a link of a kilogram lies
// between two of fifty it turns the link, which the points' solve turns back: hinges of such a figure came
// 15 cm apart, and from 1 : 110 on it gained up to 3,500 times its energy. So what its joints turn is solved
// with their points, as where something holds it that does not move (rigid/held_tree.h).
#pragma once

#include <cstddef>

#include "rigid/rigid_scene.h"

namespace lks {

// Of the tree whose bodies and joints begin there: whether one of its joints holds a turn, and on both sides
// of it there is a body of eight times the mass of the lighter of its two.
bool lies_between_heavy_bodies(RigidScene& scene, std::size_t first_body, std::size_t first_joint);

} // namespace lks
