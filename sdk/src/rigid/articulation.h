// Joints' points solved all at once, where joints form trees: bodies on ball joints, hinges and fixed joints,
// whose points may be springs.
//
// Sweeps bring the points of one joint together and part those of the next; what is to move a long limb, or a
// heavy end, takes many of them. In a tree the linear system of all points is solved exactly in one pass from
// the leaves to the root and one back, as in articulated-body dynamics (Featherstone 1983; in the form for
// constraints of Baraff 1996): at each joint the bodies beyond it are folded into the inverse mass, six by
// six, of the body that carries them:
//
//     D = L_p W_p L_pᵀ + L_c W_c L_cᵀ     W_p ← W_p − (W_p L_pᵀ) D⁻¹ (W_p L_pᵀ)ᵀ
//
// with L the motion of the joint's point by that of the body. A spring adds what it gives way by to D (XPBD's
// α̃ / (1 + γ)), and pushes from nothing in each substep; what is undone without speed strains none. Joints
// that close a loop, and distances, are solved behind it (rigid/closures.h); soft turns are left to the
// sweeps.
//
// Numbers: inverse masses are shares of the greatest one in the tree, levers and turns in each body's own
// unit of length (rigid/inertia.h), 32 fraction bits; pushes and errors are lengths in World. Where masses
// are uneven they have more (rigid/uneven_tree.h).
#pragma once

#include "rigid/rigid_scene.h"

namespace lks {

// Which joints are solved so in this tick, from the leaves on; marks them.
void find_articulations(RigidScene& scene);
// Its points are near enough to its bodies, and not too soft, and no spring holds what it turns.
bool fits_trees(const RigidScene& scene, const Joint& joint);
// A body's point is near enough, and the body not too thin.
bool fits_trees(const Body& body, const fixed::Vec3& point);
// What it is attached to does not move, is near enough and not too soft.
bool fits_trees(const RigidScene& scene, const Attachment& attachment);
// For solves of more than 32 fraction bits: its bodies' inverse masses (ArticulatedBody::fine_share).
void find_fine_shares(RigidScene& scene, const ArticulatedTree& tree);
// Once the bodies are predicted: the factors of a tree.
void factor_articulation(RigidScene& scene, const ArticulatedTree& tree);
// Brings back to zero how much the points have parted in this substep, with speed.
void solve_articulation(RigidScene& scene, const ArticulatedTree& tree);
// What holds it from outside (rigid/rope_loads.h): how far a body's point, from its centre of mass in its
// frame, moves by a push of one along a direction, with its joints and all that they carry; and a push there.
// Both in the tree's unit, World.
std::int64_t response_of(RigidScene& scene, const ArticulatedTree& tree, std::uint32_t body,
                         const fixed::Vec3& point, const fixed::Direction& along);
void push_from_outside(RigidScene& scene, const ArticulatedTree& tree, std::uint32_t body,
                       const fixed::Vec3& point, const fixed::Vec3& push);
// The same at a substep's end, without giving speed: no joint remembers it.
void shift_from_outside(RigidScene& scene, const ArticulatedTree& tree, std::uint32_t body,
                        const fixed::Vec3& point, const fixed::Vec3& push);
// Where it pushes much more in this substep than in the one before: bodies turn yet more heavily. Its factors
// are to be found again.
void stiffen_further(RigidScene& scene, const ArticulatedTree& tree);
// Once velocities are known: all errors of its joints (undo_error, and the points), without giving speed.
void undo_articulation(RigidScene& scene, const ArticulatedTree& tree);

// Its parts, for trees that are solved side by side (rigid/wide_trees.h). Before the factors: bodies turn as
// heavily as a substep can follow.
void stiffen_articulation(RigidScene& scene, const ArticulatedTree& tree);
// What the tree has pushed its joint:
void add_tree_push(Joint& joint, const fixed::Vec3& push, bool is_uneven);
// D⁻¹ of lanes first .. first + count − 1.
void invert_points(const TreeLanes (&motion)[6], std::uint32_t first, std::uint32_t count,
                   TreeLanes (&inverse)[6]);
// What a round of undoing begins with, before it brings the points together; true: a limit was far off. A
// limit that turns one bone back on its joint takes the points along: some rounds bring both right. From
// `round` on:
inline constexpr int most_undoing_rounds = 6;
bool undo_tree_errors(RigidScene& scene, const ArticulatedTree& tree);
void finish_undoing(RigidScene& scene, const ArticulatedTree& tree, bool far_off, int round);

} // namespace lks
