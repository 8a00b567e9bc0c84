// A joint between two bodies: two frames, one in each, that it keeps together (lockstitch/joint.h).
//
// The points are brought together by a block solve: K·p = −C with the 3×3 matrix K = Σ wᵢ(1 − r̂ᵢ Ĵᵢ r̂ᵢ) of
// rigid/pair.h. A hinge's axes are brought together by a block of 2×2, a fixed joint's of 3×3; limits and
// friction are a row each, about the axis of their own error.
//
// As of contacts, what is constrained is the motion within a substep, beginning with the push of the one
// before; what is left of the error is undone at its end without giving speed. (Where the whole error is
// corrected with speed, as XPBD has it, pushes can't be carried on: chains gained energy. Without carried
// pushes limits were exceeded by 30° in a pile, and it never came to rest.) Soft joints and distances are
// XPBD's.
#pragma once

#include <lockstitch/joint.h>

#include "rigid/block.h"
#include "rigid/body_motion.h"

namespace lks {

// An angle's sine and cosine, 30 fraction bits.
struct SinCos {
    std::int32_t sine;
    std::int32_t cosine;
};

// World, rad/(N·m) and N·m·s.
struct SoftLimits {
    std::int64_t compliance;
    std::int64_t damping;

    friend constexpr bool operator==(const SoftLimits&, const SoftLimits&) = default;
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
    std::int64_t swing_limit;   // World, degrees
    std::int64_t swing_limit_z; // negative: as swing_limit
    std::int64_t twist_min;
    std::int64_t twist_max;
    std::int64_t distance_min; // World
    std::int64_t distance_max;
    std::int64_t compliance;         // World, m/N
    std::int64_t damping;            // World, N·s/m
    std::int64_t angular_compliance; // World, rad/(N·m)
    std::int64_t angular_damping;    // World, N·m·s
    std::int64_t friction;           // World, N·m
    std::int64_t break_force;        // World, N; 0: never
    std::int64_t break_torque;       // World, N·m; 0: never
    // Of the motor.
    std::int64_t motor_torque;   // World, N·m; 0: off
    std::int64_t motor_response; // World, s
    SoftLimits limits;           // last: rigid ones are no part of hashes
};

// A length, World, in the body's unit.
constexpr std::int64_t in_units(const Body& body, std::int64_t length) {
    return body.scale >= 0 ? length >> body.scale : length * (std::int64_t{1} << -body.scale);
}

// How far a pull at the joint's point swings a body.
struct SwingArm {
    std::int64_t length; // of the lever, World, in the body's unit
    std::int64_t across; // tr Ĵ − r̂ᵀĴr̂, 30 fraction bits
};

// What follows from the description and the bodies' masses.
struct JointConstants {
    PairShares shares;
    SwingArm arm_a;
    SwingArm arm_b;
    fixed::Direction axis_a; // of the frames, in the bodies' axes
    fixed::Direction axis_b;
    bool loads_from_far; // a body hangs so far out that a row about its centre hardly turns it
    bool swing_limited;
    bool twist_limited;
    bool swing_round;          // a cone
    std::int32_t swing_cosine; // of the least limit, 30 fraction bits
    std::int64_t swing_limit;  // World, radians
    std::int64_t swing_limit_z;
    fixed::Direction across_a[2]; // local x and z of the frame of a, in the body's axes
    // What each component of how b has turned in a, conj(qa) qb, adds to the sine and to the cosine of half
    // the twist of the frames, times what is left of the swing.
    std::int32_t twist_sine[4];
    std::int32_t twist_cosine[4];
    SinCos half_middle; // of half of what twists are measured from
    SinCos half_min;    // of half the least twist
    SinCos half_max;
    std::int64_t twist_min; // World, radians
    std::int64_t twist_max;
    Softness points;
    Softness limits;
    std::int64_t angular_softness; // as Softness has it, 30 fraction bits
    std::int64_t drag_softness;    // of angular damping; 0: none
    std::int64_t grip;             // the greatest push of friction or motor in a substep: an angle, World
    std::int64_t break_push;       // what `pushed` and `turned` bear; 0: everything
    std::int64_t break_turn;
    std::int32_t motor_share; // what of its error the motor makes up for in a substep, 30 fraction bits
    int reach;                // of turns (rigid/pair.h)
};

inline bool has_limits(const JointConstants& c) {
    return c.swing_limited || c.twist_limited;
}

inline bool has_ellipse(const JointConstants& c) {
    return c.swing_limited && !c.swing_round;
}

// In its points.
inline bool has_soft_points(const JointConstants& c) {
    return c.points.softness != 0;
}

// In its points, or in what a hinge or a fixed joint holds.
inline bool has_spring(const JointConstants& c) {
    return c.points.softness != 0 || c.angular_softness != 0;
}

// What changes. Images and hashes have it in this order, behind the description.
struct JointState {
    fixed::Rotation motor_target; // b's frame in a's
    // What it pushed in the last substep, World. The next one begins with it.
    fixed::Vec3 push;        // from a to b, a length
    fixed::Vec3 turn;        // b against a, an angle: of hinges and fixed joints
    fixed::Vec3 grip;        // the same of friction or the motor
    std::int64_t swing_push; // the same of the limits, about their axes
    std::int64_t twist_push;
    // What it pushed and turned in the last tick, substeps added up; for reading out.
    fixed::Vec3 pushed;
    fixed::Vec3 turned;
};

struct Joint : JointState {
    JointDescription description;
    JointConstants constants;

    // Of the tick: its points are solved with those of its tree (rigid/articulation.h).
    bool in_tree;
    bool closes_loop;          // but behind it (rigid/closures.h)
    bool turns_in_tree;        // what it turns is solved with those points, as its tree has loops
    bool limits_in_tree;       // and so are its limits, in this substep
    bool motor_in_tree;        // and so is its motor, in this substep
    bool carries_torque;       // what it turned is carried on as a torque, with that of its points
    bool in_held_tree;         // and what it turns is, where a tree is held (rigid/held_tree.h)
    fixed::Rotation motor_aim; // the motor's target, or what is next to it within limits (rigid/motor_aim.h)

    // Of the substep.
    std::int64_t tension;        // how much it pushed in the one before, or since: World
    fixed::Vec3 begin;           // how far the points were apart at its beginning
    fixed::Vec3 start;           // what of it is to be kept
    std::int64_t kept_error;     // what of it a distance joint keeps: along the way, World; and, while errors
                                 // are undone, how long a soft one is held
    fixed::Vec3 turn_start;      // how far a hinge's or a fixed joint's frames are turned at its beginning
    fixed::Vec3 drag;            // what angular damping turned
    fixed::Direction swing_axis; // about which b has swung where its limit pushes
    std::int64_t swing_beyond;   // how far the swing is beyond its limit at its beginning: World, radians
    std::int64_t twist_least;    // how far limits let turn in this substep
    std::int64_t twist_most;
    std::int64_t swing_gap; // how far limits that push are to keep off: World, radians
    std::int64_t twist_gap;
    fixed::Vec3 aim; // what the motor is to turn: half turns, Turn
    BlockSide side_a;
    BlockSide side_b;
    BlockInverse inverse;
    BlockInverse turn_inverse; // of hinges and fixed joints
};

// Of a pull at this point, in the body's axes.
SwingArm swing_arm(const Body& body, const fixed::Vec3& point);

// The definition that a description came from, without bodies and points.
lks_joint_def define_joint(const JointDescription& description);
JointConstants make_joint_constants(const JointDescription& description, const Body& a, const Body& b,
                                    const StepRate& rate);

// Where its masses are others now: what it pushed says nothing any more.
void forget_pushes(Joint& joint);

// Before the bodies are predicted.
void begin_substep(Joint& joint, const Body& a, const Body& b);
// Once they are: K, and what of the pushes of the substep before is carried on.
void prepare_pushes(Joint& joint, const Body& a, const Body& b);
// Pushes them.
void carry_pushes_on(Joint& joint, Body& a, Body& b);
// Adds a share of what is carried on, 30 fraction bits, -1 .. 1.
void carry_more(Joint& joint, Body& a, Body& b, std::int32_t share);
// The same of one in a held tree, which pushes nothing by itself: what turns b against a, and what is added
// to it.
fixed::Vec3 carried_turn(const Joint& joint, const Body& a, const Body& b);
fixed::Vec3 add_to_carried_turn(Joint& joint, const Body& a, const Body& b, std::int32_t share);
void project(Joint& joint, Body& a, Body& b);

// Once velocities are known.
void add_up_pushes(Joint& joint, const Body& a, const Body& b);
// What is left of its errors, without giving speed: of turns, limits, and of points that no tree holds, but
// for a figure that a pinned particle holds, which would be drawn off it. True: a limit was exceeded by more
// than half a degree.
bool undo_error(const Joint& joint, Body& a, Body& b, bool pinned);
// Its load over the last tick is more than it bears.
bool breaks(const Joint& joint);

// How far the points are to come together: to where they were when a substep began, or, without giving speed,
// at all. Springs are not undone: `start` is then how far they are apart behind it.
fixed::Vec3 points_apart(const Joint& joint, const Body& a, const Body& b, bool in_substep);
// What a tree's solve is to bring to zero in a substep: how far the points have parted in it, or of a spring
// what it leaves to be made up for.
fixed::Vec3 left_of_points(const Joint& joint, const Body& a, const Body& b);

// How far the points are apart in world axes, b less a.
fixed::Vec3 joint_offset(const Joint& joint, const Body& a, const Body& b);
// Radians, World.
struct JointAngles {
    std::int64_t swing;
    std::int64_t twist;
};
JointAngles joint_angles(const Joint& joint, const Body& a, const Body& b);
// The swing as a vector (rigid/swing_ellipse.h): towards local x and z of a's frame.
struct SwingParts {
    std::int64_t x;
    std::int64_t z;
};
SwingParts swing_parts(const Joint& joint, const Body& a, const Body& b);

} // namespace lks
