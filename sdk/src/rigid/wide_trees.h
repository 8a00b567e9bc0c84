// Trees of joints that are built alike, as those of many ragdolls of one kind: solved side by side where the
// processor has lanes for it (kernels/tree_task.h), with the same bits as one by one.
//
// Figures that follow each other and have such a tree each make a bundle, whose factors stand lane by lane
// from one solve of a substep to the next. What lanes don't have, such as large turns and rounds that one
// figure only needs, is done as ever.
#pragma once

#include "rigid/rigid_scene.h"

namespace lks {

// Once the figures of the tick are known. Without kernels for them each figure is a bundle by itself.
void find_bundles(RigidScene& scene);

// For bundles of several figures: as factor_articulation, solve_articulation and undo_articulation.
void factor_bundle(RigidScene& scene, const FigureBundle& bundle);
void solve_bundle(RigidScene& scene, const FigureBundle& bundle);
// For solve_articulation of one figure of a bundle, after factor_bundle.
void hand_out_factors(RigidScene& scene, const FigureBundle& bundle, std::uint32_t lane);
void undo_bundle(RigidScene& scene, const FigureBundle& bundle);

} // namespace lks
