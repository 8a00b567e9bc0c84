// A joint between two bodies: two frames, one in each, that it keeps together (lockstitch/joint.h).
//
// The points are brought together by a block solve: K·p = −C with the 3×3 matrix K = Σ wᵢ(1 − r̂ᵢ Ĵᵢ r̂ᵢ) of
// rigid/pair.h. What turns (a hinge's and a fixed joint's axes, limits, friction) is a row each, about the
// axis of its own error.
//
// Of a ball joint's points, as of contacts, the motion within a substep is constrained, beginning with the
// push of the one before; what is left of the error is undone at its end without giving speed. (Where the
// whole error is corrected with speed, as XPBD has it, pushes can't be carried on: chains gained energy.)
// What turns is corrected as XPBD has it: without speed limits were exceeded by 30° in a pile, where they are
// by 8°.
#pragma once

#include <lockstitch/joint.h>

#include "rigid/body_motion.h"
#include "rigid/pair.h"

namespace lks {

// An angle's sine and cosine, 30 fraction bits.
struct SinCos {
    std::int32_t sine;
    std::int32_t cosine;
};

struct JointDescription {
    std::uint32_t kind; // lks_joint_kind
    std::uint32_t body_a;
    std::uint32_t body_b;
    std::uint32_t bodies_collide; // 0 or 1
    fixed::Vec3 point_a;          // World, from the centre of mass, in the body's frame
    fixed::Vec3 point_b;
    fixed::Rotation frame_a;
    fixed::Rotation frame_b;
    std::int64_t swing_limit; // World, degrees
    std::int64_t twist_min;
    std::int64_t twist_max;
    std::int64_t distance_min; // World
    std::int64_t distance_max;
    std::int64_t compliance; // World, m/N
    std::int64_t friction;   // World, N·m
};

// What follows from the description and the bodies' masses.
struct JointConstants {
    PairShares shares;
    fixed::Direction axis_a; // of the frames, in the bodies' axes
    fixed::Direction axis_b;
    bool swing_limited;
    bool twist_limited;
    std::int32_t swing_cosine; // of the limit, 30 fraction bits
    std::int64_t swing_limit;  // World, radians
    SinCos half_min;           // of half the least twist
    SinCos half_max;
    std::int64_t twist_min; // World, radians
    std::int64_t twist_max;
    std::int64_t softness; // α̃ / the greater inverse mass, 30 fraction bits
    std::int64_t friction; // the greatest push of friction in a substep: an angle, World
    int reach;             // of turns (rigid/pair.h)
};

struct Joint {
    JointDescription description;
    JointConstants constants;

    // State: what it pushed in the last substep, World.
    fixed::Vec3 push; // from a to b, a length; a ball joint begins with it
    fixed::Vec3 turn; // of b against a, an angle; for reading out

    // Of the substep.
    fixed::Vec3 start; // how far the points were apart at its beginning
    fixed::Vec3 grip;  // what friction turned
    BlockSide side_a;
    BlockSide side_b;
    SymmetricMatrix inverse; // K⁻¹ = inverse · 2^inverse_shift
    std::int32_t inverse_shift;
};

// The definition that a description came from, without bodies and points.
lks_joint_def define_joint(const JointDescription& description);
JointConstants make_joint_constants(const JointDescription& description, const Body& a, const Body& b,
                                    const StepRate& rate);

// Before the bodies are predicted.
void begin_substep(Joint& joint, const Body& a, const Body& b);
// Once they are: K, and the pushes of the substep before.
void warm_start(Joint& joint, Body& a, Body& b);
// Friction takes part in forward sweeps only.
void project(Joint& joint, Body& a, Body& b, bool forward);

// Once velocities are known: what is left of the points' error, without giving speed.
void undo_error(const Joint& joint, Body& a, Body& b);

// How far the points are apart in world axes, b less a.
fixed::Vec3 joint_offset(const Joint& joint, const Body& a, const Body& b);
// Radians, World.
struct JointAngles {
    std::int64_t swing;
    std::int64_t twist;
};
JointAngles joint_angles(const Joint& joint, const Body& a, const Body& b);

} // namespace lks
