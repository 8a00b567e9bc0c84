// All rigid bodies of a world, what holds them together, and what a tick needs for them. Empty, and free of
// cost, where there are none.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/tree_task.h"
#include "memory/array.h"
#include "rigid/articulation_parts.h"
#include "rigid/attachment.h"
#include "rigid/body.h"
#include "rigid/body_definition.h"
#include "rigid/closure_parts.h"
#include "rigid/closure_tree_parts.h"
#include "rigid/contact_mark.h"
#include "rigid/figure_parts.h"
#include "rigid/held_tree_parts.h"
#include "rigid/joint.h"
#include "rigid/overlaps.h"
#include "rigid/particle_pushes.h"
#include "rigid/rope_load.h"
#include "rigid/strikes.h"
#include "rigid/substep_motion.h"
#include "rigid/uneven_tree_parts.h"
#include "solver/slot.h"

namespace lks {

// What a contact hands on to the next tick. State: kept in ascending order of keys, and only where something
// pushes. What the game has put elsewhere, or made another, pushes nothing on; until the next tick has told
// its end it is known yet, with pushes as if both bodies were dynamic.
struct ContactMemory {
    ContactKey key;
    std::uint32_t count;
    fixed::Direction normal; // of its last substep
    std::uint32_t forgotten; // 0 or 1
    ContactPush pushes[greatest_point_count];
};

// How long the bodies of an island have rested.
struct IslandRest {
    std::uint32_t least; // as Body::rest
    std::uint32_t count; // of bodies
    std::uint64_t sum;   // of their rest
    bool squeezed;       // any of them is
};

// How far a figure is moved as a whole (rigid/figure_overlaps.h).
struct FigureShift {
    InverseMass inverse_mass;
    std::uint64_t masses; // all of its bodies in the heaviest one's, 30 fraction bits
    fixed::Vec3 shift;
};

// Two figures, or a figure and what stays, that are to part by so much, or, less than nothing, may close.
struct FigurePair {
    std::uint32_t a, b;
    PairShares shares;
    fixed::Direction normal; // from a to b
    std::int64_t parted;
    std::int64_t pushed; // apart, by now
};

// What a load puts into a slot: nothing, what is defined as what is there, or something else.
enum class Loaded : std::uint8_t { nothing, same, other };

struct RigidScene {
    RigidScene(const lks_allocator& allocator, const TreeKernels& tree_kernels);
    RigidScene(const RigidScene&) = delete;
    RigidScene& operator=(const RigidScene&) = delete;

    // State, by slot.
    Array<Slot> body_slots;
    Array<Body> bodies;
    Array<BodyDefinition> definitions;
    Array<Slot> joint_slots;
    Array<Joint> joints;
    Array<ContactMemory> memories;
    Array<Slot> attachment_slots;
    Array<Attachment> attachments;

    Array<BodyDescription> descriptions; // derived, by body
    // Derived: body a << 32 | body b > a of joints whose bodies don't collide, ascending, and by body a where
    // its own begin.
    Array<std::uint64_t> jointed;
    Array<std::uint32_t> jointed_starts;

    // Of a tick.
    Array<BodyTick> ticks;             // by body
    Array<Body> collider_bodies;       // colliders as bodies of infinite mass, by slot
    Array<Piece> pieces;               // of all bodies, around their centres of mass
    Array<fixed::Vec3> piece_extents;  // of each: half its size along the axes of the world
    Array<std::uint32_t> piece_starts; // by body, into pieces
    Array<fixed::Vec3> ways;           // by body: where its velocity takes it in a tick
    Array<std::int64_t> travels;       // by body: how far any point of it goes beside that at most
    Array<Strike> strikes;             // by body (rigid/strikes.h)
    Array<Strike> spread_strikes;      // beside them, while they are made
    Array<StrikePair> strike_pairs;
    bool any_beside_sleeper = false;
    std::int64_t thinnest = 0; // of all bodies
    // Of what bones are not to pass (rigid/struck_bones.h); INT64_MAX: nothing.
    std::int64_t thinnest_wall = 0;
    Overlaps overlaps;
    Array<std::uint32_t> boxed;   // by box: body, or collider | other_is_collider
    Array<std::uint64_t> pairs;   // body a << 32 | other, ascending
    Array<std::uint64_t> sorting; // room to sort the numbers of a tick in
    Array<FoundContact> found;    // by a team, in any order
    Array<std::uint32_t> found_order;
    Array<Contact> contacts;
    Array<ContactPoint> contact_points; // contact by contact
    Array<ContactMark> contact_marks;   // by contact, while events want to know
    // By contact: whether any of its points is active in this substep. More than half only come near, and
    // would push the others' numbers out of the cache if each stage looked at them.
    Array<std::uint8_t> contacts_act;
    Array<Move> contact_moves; // by body, of a contact sweep; and one that stays zero
    Array<ContactMemory> next_memories;
    Array<std::uint32_t> islands; // by body: towards the least index in its island
    // Of rigid/articulation.h.
    Array<std::uint32_t> tree_roots;     // by body
    Array<std::uint64_t> tree_links;     // body << 32 | joint, ascending
    Array<std::uint32_t> tree_bodies;    // from the roots on
    Array<ArticulatedJoint> tree_joints; // from the roots on
    Array<ArticulatedBody> articulated;  // by body
    Array<ArticulatedTree> trees;
    Array<HeldJoint> held_joints;       // by tree joint, where a tree is held (rigid/held_tree.h)
    Array<UnevenJoint> uneven_joints;   // the same where one's masses are uneven (rigid/uneven_tree.h)
    Array<std::uint64_t> foot_contacts; // figure << 32 | contact, ascending (rigid/light_feet.h)
    // Of rigid/closures.h.
    Array<std::uint64_t> closing_joints; // figure << 32 | joint, ascending
    Array<std::uint64_t> tree_pins;      // figure << 32 | attachment, ascending
    Array<Closure> closures;             // figure by figure: what closes loops, and trees' joints with limits
    Array<ClosureRow> closure_rows;      // room for those of each figure
    Array<ClosureRange> closure_ranges;  // of figures that have any, ascending
    Array<std::int64_t> closure_matrix;  // of each of them
    Array<ClosureTreeJoint> closure_tree_joints; // by tree joint, where any loop is closed
    // Of rigid/figures.h.
    Array<std::uint32_t> figures;      // by body: the least index in its figure
    Array<std::uint64_t> figure_parts; // of awake figures, ascending
    Array<FigureRange> figure_ranges;  // by awake figure
    // Of rigid/wide_trees.h.
    Array<FigureBundle> figure_bundles; // all awake figures, in their order
    Array<WideTreeBody> wide_bodies;
    Array<WideTreeJoint> wide_joints;
    Array<std::uint32_t> shared_contacts; // of two figures, ascending
    Array<std::int32_t>
        figure_shares;              // by awake figure: what is added to its pushes (rigid/carried_pushes.h)
    Array<Motion> substep_motions;  // by body, while it is awake (rigid/carried_pushes.h)
    Array<Speeds> predicted_speeds; // by body, in a substep's end, where anything gives back speed
    Array<std::int32_t> figure_masses;    // by body: its mass in its figure's heaviest one's
    Array<std::uint8_t> figures_changed;  // by the least body: while shares are added
    Array<std::uint8_t> strained_figures; // by the least body; empty where none is
    Array<FigureShift> figure_shifts;     // by the least body; and one for what stays
    Array<FigurePair> figure_pairs;
    Array<IslandRest> island_rests; // by the least body of an island
    // Objects that go through the tick together with bodies and with each other: a flag by slot, empty where
    // there is none; their indices; and whom each may touch: object << 32 | body, ascending.
    Array<std::uint8_t> is_coupled;
    Array<std::uint32_t> coupled;
    Array<std::uint64_t> object_pairs;
    Array<ParticlePushes> object_pushes; // beside them: what particles pushed, for events
    Array<std::uint8_t> object_touches;  // beside them: asleep and touched when the tick began
    Array<HeldParticle> held;            // ascending
    // Of ropes that bear loads (rigid/rope_loads.h), ascending, and room for what that makes of particles.
    Array<RopeLoad> rope_loads;
    Array<ParticleLoad> particle_loads;
    // Scratch of a load, by slot.
    Array<Loaded> loaded_bodies;
    Array<Loaded> loaded_joints;
    Array<AttachmentDescription> loaded_attachments; // rigid ones to bodies

    // Room for everything that a tick with so many slots may need. False: no memory.
    [[nodiscard]] bool reserve(std::size_t body_count, std::size_t collider_count);
    [[nodiscard]] bool reserve_joints(std::size_t count);
    [[nodiscard]] bool reserve_attachments(std::size_t count);
    [[nodiscard]] bool reserve_objects(std::size_t count);
    // How many slots everything has room for: where memory ran out, some arrays may have more.
    std::size_t body_room() const { return body_room_; }
    std::size_t joint_room() const { return joint_room_; }
    std::size_t attachment_room() const { return attachment_room_; }
    void free_joint(std::uint32_t index);
    void free_attachment(std::uint32_t index);
    // After joints came or went. Which bodies have any, and which don't collide, is looked for once somebody
    // asks, not with each of many.
    void joints_changed() { follows_joints_ = false; }
    // Before `jointed`, of bodies too, and are_jointed are read.
    void follow_joints();
    // By a joint whose bodies don't collide; a < b.
    bool are_jointed(std::uint32_t a, std::uint32_t b) const;

    // Of a tick.
    const Piece& piece(std::uint32_t body, std::uint32_t shape) const {
        return pieces[piece_starts[body] + shape];
    }
    const fixed::Vec3& piece_extent(std::uint32_t body, std::uint32_t shape) const {
        return piece_extents[piece_starts[body] + shape];
    }
    // Those of an object.
    std::span<RopeLoad> rope_loads_of(std::uint32_t object);
    std::span<const RopeLoad> rope_loads_of(std::uint32_t object) const;
    bool empty() const { return bodies.empty() && attachments.empty(); }
    // Whether a contact does anything in this substep, once its rows are made.
    bool acts(std::size_t contact) const { return contacts_act[contact] != 0; }

    // What solves trees side by side, where the processor has lanes for it.
    const TreeKernels& tree_kernels() const { return tree_kernels_; }

private:
    // Of bodies, or joints, side by side.
    std::size_t wide_room(std::size_t count) const;
    [[nodiscard]] bool reserve_closures(std::size_t joint_count, std::size_t attachment_count);
    [[nodiscard]] bool reserve_figures(std::size_t body_count, std::size_t joint_count,
                                       std::size_t attachment_count);

    TreeKernels tree_kernels_;
    bool follows_joints_ = true;
    std::size_t body_room_ = 0;
    std::size_t collider_room_ = 0;
    std::size_t joint_room_ = 0;
    std::size_t attachment_room_ = 0;
    std::size_t object_room_ = 0;
};

// Those that hold the object, or the body.
void forget_attachments(RigidScene& scene, std::uint32_t index, bool of_object);

// What is this near is looked at, whatever its speed: two centimetres.
inline constexpr std::int64_t near_distance = world_one / 50;

// How many pairs of bodies, and contacts of shapes, a tick has room for with so many slots.
constexpr std::size_t pair_capacity(std::size_t bodies) {
    return 64 + 32 * bodies;
}
constexpr std::size_t contact_capacity(std::size_t bodies) {
    return 64 + 16 * bodies;
}
// How many pairs of objects and bodies.
constexpr std::size_t object_pair_capacity(std::size_t objects, std::size_t bodies) {
    return 64 + 8 * (objects + bodies);
}

} // namespace lks
