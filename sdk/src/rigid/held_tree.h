// Trees of joints that are held by something that does not move, or whose light bodies hold heavy ones
// (rigid/heavy_sides.h): points, hinges' and fixed joints' axes and limits solved all at once.
//
// A row of a limit knows the masses of its two bones. Where all of a figure hangs on a hand that is led, the
// limits of the wrist would have to push a forearm of a kilogram with what turns eighty, and rows that go in
// turn with the points (rigid/rigid_substep.h) come there slowly: meanwhile the forearm, pushed by itself,
// turns by more than a substep can follow, and throws the figure about (up to 1.8 MJ). So here
//   - what turned in the last substep is carried on as a torque, which the points' solve begins with: nothing
//     is turned by itself;
//   - where limits are exceeded all the same, and where errors are undone, the tree is eliminated as in
//     rigid/articulation.h, with the rows of what does not turn beside those of the points, three to six a
//     joint. Which limits push is found by exchanging those that would pull for those that would be exceeded
//     (block principal pivoting; Júdice and Pires 1994), a few passes as a rule.
//
// Where a rope holds it (rigid/rope_loads.h) the point that it pulls at does not move away from it: a row
// more, of the body by itself, that is eliminated before all joints.
//
// Errors of turns, and their pushes, count as lengths at the joint's reach (rigid/pair.h).
#pragma once

#include "rigid/rigid_scene.h"

namespace lks {

// A turning push of a joint's, World, with the next solve of its points.
void carry_torque(RigidScene& scene, const Joint& joint, const fixed::Vec3& push);

// Brings back to zero how much points have parted and what must not turn has turned in this substep, with
// speed. False: points are further apart than can be told which way to turn, or a hundred times heavier and
// lighter bodies are to turn further than is safe, and nothing was done.
bool solve_held_tree(RigidScene& scene, const ArticulatedTree& tree);

// Once velocities are known: all errors, without giving speed. False: they are small, or that, and nothing
// was done.
bool undo_held_tree(RigidScene& scene, const ArticulatedTree& tree);

} // namespace lks
