// A contact between two shapes, at least one of them a dynamic body's: up to four points that keep apart and
// rub.
//
// What is constrained is the motion within one substep, d − d₀ with d = p_b − p_a of two points that are
// fixed in the bodies: along the normal it must not close what was open (nor deepen what overlapped), and
// across it friction stops it within Coulomb's cone. Each row starts with the push that the same point
// needed in the substep before, so a pile that rests is held exactly and stays as it is, to the bit. What
// overlaps is undone by moving the two bodies without giving them speed. Where joints hold one of them they
// would take most of that back: up to a centimetre these have to part, by a share of the overlap in a
// substep, so that joints and neighbours take part in it, and pushes grow until what is squeezed comes free.
#pragma once

#include <span>

#include "collide/manifold.h"
#include "rigid/body_motion.h"
#include "rigid/pair.h"

namespace lks {

// What overlaps by more than this, five millimetres, sticks in the other.
inline constexpr std::int64_t sticking_depth = world_one / 200;

// Surfaces that are nearer than this, a millimetre, touch.
inline constexpr std::int64_t touching_distance = world_one / 1000;

// Points that are further apart than this, a centimetre, push nothing yet; others may still push them
// together.
inline constexpr std::int64_t near_point = world_one / 100;

// Names a contact: the same pair of shapes has the same key from tick to tick.
struct ContactKey {
    std::uint32_t body_a;
    std::uint32_t other;  // body b > body a, or collider | other_is_collider
    std::uint32_t shapes; // shape of a · 8 + shape of b

    friend constexpr bool operator==(const ContactKey&, const ContactKey&) = default;
    friend constexpr bool operator<(const ContactKey& p, const ContactKey& q) {
        return p.body_a != q.body_a ? p.body_a < q.body_a
               : p.other != q.other ? p.other < q.other
                                    : p.shapes < q.shapes;
    }
};
inline constexpr std::uint32_t other_is_collider = 0x80000000u;

// How much a point pushed in the last substep: lengths, World (rigid/pair.h).
struct ContactPush {
    std::uint32_t feature;
    std::uint32_t reserved; // 0
    fixed::Vec3 place;      // in a's frame, World
    std::int64_t normal;
    std::int64_t across[2];
};

// What pushes at one place do to two bodies: along the normal, and across it.
struct ContactRowSide {
    std::int32_t turn_shift; // as UnitLever has them
    std::int32_t arm_shift;
    PushRow rows[3];
};
inline constexpr int normal_row = 0; // of the three
struct ContactRows {
    ContactRowSide a, b;
    Inverse inverses[3];
};

// Kernels take its numbers by four: they stand in this order (kernels/contact_point_lanes.h).
struct ContactPoint {
    ContactPush push;
    // In the frames of the bodies, World.
    fixed::Vec3 core_a;
    fixed::Vec3 core_b;
    // Of the substep.
    std::int64_t separation;
    std::int64_t approach;  // World m/s: how fast the surfaces closed
    fixed::Vec3 material_a; // the surface point, in a's frame
    fixed::Vec3 material_b;
    fixed::Vec3 start;      // p_b − p_a at its beginning
    fixed::Vec3 core_start; // the same of the cores
    ContactRows rows;
    std::int64_t allowed; // how far the surfaces may close; where they overlap, less than nothing
    // Of an iteration: how far the surfaces have parted along the normal in this substep, less what was open
    // at its beginning, and how far they have slid.
    std::int64_t gap;
    std::int64_t slip[2];
    // Of an impact that gives back speed, World m/s: how fast it is to part, and what it was given.
    std::int64_t parting;
    std::int64_t given;
    bool active; // in the substep
    bool struck;
};

struct Contact {
    ContactKey key;
    std::uint32_t count; // of its points
    // Kernels take these four numbers at once (kernels/contact_point_lanes.h).
    PairShares shares;
    std::int64_t radius_a;
    std::int64_t radius_b;
    std::uint32_t static_friction; // friction_fraction_bits
    std::uint32_t dynamic_friction;
    std::int64_t restitution;       // World
    std::int64_t given_speed;       // World m/s: what it gave along its normals in this tick, added up
    bool every_substep;             // its points are looked for in each, not once a tick
    std::int64_t gravity_speed;     // World m/s: that a substep of gravity gives its bodies at most
    bool of_foot;                   // solved with the trees (rigid/light_feet.h)
    bool fast;                      // one may pass the middle of the other in a tick; never a plane's
    fixed::Direction directions[3]; // the normal, from a to b, and two across it
    // Of the substep: a push along the normal at the middle of all active points, where they are several.
    ContactRows middle;
    std::int64_t middle_gap; // of an iteration
    // What it carried on from the substep before has done to its bodies, where they are awake.
    Move carried_a, carried_b;
    std::uint32_t active_count;
    std::uint32_t struck_count;
    ContactPoint* points; // in RigidScene::contact_points

    const fixed::Direction& normal() const { return directions[normal_row]; }
};

// What a substep of gravity alone does, and a centimetre a second more, is no impact and no sliding.
inline constexpr std::int64_t slow_contact = world_one / 100;
constexpr std::int64_t least_approach(std::int64_t gravity_speed) {
    return 4 * gravity_speed + slow_contact;
}

// What the search found of it.
struct FoundContact {
    ContactKey key;
    bool every_substep;
    bool fast;
    std::int64_t radius_a;
    std::int64_t radius_b;
    Manifold manifold;
};

// What a contact knows of its bodies.
struct ContactBodies {
    Body& a;
    Body& b;
};
// What contacts have done to them in the sweeps of an iteration.
struct ContactMoves {
    Move& a;
    Move& b;
};

struct ContactSpeeds {
    Speeds a, b;
};

// Whether what is pressed into the other comes out where it went in (collide/manifold.h). Two figures part
// the shorter way: to undo all of it jams heaps of them.
inline bool keeps_side(const Body& a, const Body& b) {
    return !a.jointed || !b.jointed;
}

// How many points a contact needs room for.
constexpr std::uint32_t point_room(bool every_substep, const Manifold& manifold) {
    return every_substep ? greatest_point_count : manifold.count;
}
// Pushes, and the normal across which they rub.
struct OldContact {
    std::span<const ContactPush> pushes;
    fixed::Direction normal;
};
// Fills the points from a new manifold. Each takes over the old push of the same feature, or else of the
// nearest place that is left: where edges lie upon edges, features come and go. What rubbed goes on the same
// way, whatever the two directions across the normal are now.
void take_manifold(Contact& contact, const OldContact& old, const Manifold& manifold, const Body& a,
                   const Body& b);
// Before the bodies are predicted.
void begin_substep(Contact& contact, const Body& a, const Body& b, const MotionRate& rate);
// Whether an impact that gives back speed is due in this substep: before the bodies are predicted.
bool is_about_to_strike(const Contact& contact, const ContactBodies& bodies, const MotionRate& rate);
// An impact of two single points that give back speed, before the bodies are predicted: the impulse that
// reverses their approach. True where there was one. Impacts of several points at once are left to what
// follows the sweeps: a box would take them one after the other and spin.
bool strike(Contact& contact, ContactBodies bodies, const MotionRate& rate);
// Once the bodies are predicted and joints have pushed: its rows. Then: what they pushed in the substep
// before, on one of its bodies.
void make_rows(Contact& contact, ContactBodies bodies);
void carry_on(Contact& contact, bool to_a, Move& move);
// Adds a share of its pushes, 30 fraction bits, -1 .. 1.
void carry_more(Contact& contact, ContactBodies bodies, std::int32_t share);
// In each iteration: where the bodies are before contacts push them. They stay there in the sweeps forward
// and back, to which their moves are small.
void measure(Contact& contact, ContactBodies bodies);
void project(Contact& contact, ContactMoves moves, bool back, const MotionRate& rate);
// Whether what pushes is still closing by more than this in the substep.
bool closes(const Contact& contact, const ContactBodies& bodies, std::int64_t distance);
// For events: what it pushed in this substep.
void add_up_pushes(Contact& contact, const MotionRate& rate);
// Once velocities are known, of all contacts: each of a contact's points parts as restitution wants it to
// where it pushes, and pushes nothing where it parts faster: what it pushed may be taken back, no more. So
// the work of all of them is what of it restitution does not give back. `predicted`: before anything was
// pushed.
void begin_impact(Contact& contact, const ContactBodies& bodies, const ContactSpeeds& predicted);
// What all its points owe alike, at their middle: one after the other they turn what comes down flat.
void give_alike(Contact& contact, ContactBodies bodies);
// One after the other. Whether any was given anything that is worth another round.
bool give_each(Contact& contact, ContactBodies bodies, const MotionRate& rate);
// Last: what was given rubs.
void rub_by_impact(Contact& contact, ContactBodies bodies);
// For events, World m/s: what it has yet to give where it pushes and they still close, as if nobody else did.
std::int64_t speed_to_come(const Contact& contact, const ContactBodies& bodies);
// Last: overlaps that do not part by a motion, by moving bodies without giving them speed.
void undo_overlap(const Contact& contact, ContactBodies bodies, const MotionRate& rate);
// Whether any of its points overlaps by more than this.
bool is_deeper(const Contact& contact, std::int64_t depth);

// The geometric mean of two coefficients, friction_fraction_bits.
std::uint32_t combined_friction(std::int64_t a, std::int64_t b);

} // namespace lks
