// What closes loops, solved with the trees of its figure: joints between two bodies that a tree already
// holds together, and distance joints.
//
// Rows that are swept beside the trees know the masses of their two bodies, and what they bring together the
// trees part again: with two hands on a pole, or a wheel on two arms, joints came centimetres apart. So how
// the points of each such joint part by a push in each of them, with all that the trees make of it, is found
// once a substep (rigid/closure_matrix.h; Schur complement; loop closure in Featherstone 2008, 8.5):
//
//     S = C (M⁻¹ − M⁻¹Jᵀ (J M⁻¹ Jᵀ)⁻¹ J M⁻¹) Cᵀ
//
// and behind each solve of the trees S·λ = −C is solved, and pushed from outside on them. A spring adds what
// it gives way by. Ropes only pull, and struts only push: which of them do is found by exchange
// (rigid/exchange.h). What is held twice leaves nothing in S: each row is soft by a small part of what its
// two bodies by themselves give way by.
//
// As points of trees have it, what is constrained is the motion within a substep; errors are undone at its
// end without giving speed.
#pragma once

#include "rigid/rigid_scene.h"

namespace lks {

// Once the trees are found: which joints are solved so in this tick; marks them. Bodies that only distances
// hold get a tree each.
void find_closures(RigidScene& scene);

// After the factors of all trees of the figure.
void factor_closures(RigidScene& scene, const FigureRange& figure);
// Once its rows are: what light feet pushed in the substep before is what the next solve begins with.
void carry_feet(RigidScene& scene, const FigureRange& figure);
// With speed: its trees that have any, which solve_articulation leaves to this, and what closes their loops.
void solve_closures(RigidScene& scene, const FigureRange& figure);
// Once velocities are known, and the trees' errors are undone: without.
void undo_closures(RigidScene& scene, const FigureRange& figure);

} // namespace lks
