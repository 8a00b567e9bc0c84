// A particle that is held at a point of a body, or at another particle (lockstitch/attachment.h).
//
// Positions of particles are Coordinate values around their object's origin; here they are rounded down to
// World, which the error and the pushes are in.
#pragma once

#include <lockstitch/attachment.h>

#include "rigid/block.h"
#include "rigid/body_motion.h"
#include "solver/object.h"

namespace lks {

struct AttachmentDescription {
    std::uint32_t kind; // lks_attachment_kind
    std::uint32_t object;
    std::uint32_t particle;
    std::uint32_t other; // body, or object
    std::uint32_t other_particle;
    std::uint32_t reserved; // 0
    fixed::Vec3 point;      // World, from the body's centre of mass, in its frame
    std::int64_t compliance;
    std::int64_t damping;
    std::int64_t break_force;

    // It neither stretches nor breaks.
    bool is_rigid() const { return compliance == 0 && break_force == 0; }
    // Both hold one particle at one body, at two points of it, and neither gives way.
    bool contradicts(const AttachmentDescription& d) const {
        return kind == LKS_ATTACHMENT_TO_BODY && d.kind == kind && d.object == object &&
               d.particle == particle && d.other == other && is_rigid() && d.is_rigid() &&
               !(d.point == point);
    }
};

// What follows from the description and the masses.
struct AttachmentConstants {
    std::uint32_t movable;              // movable_sides
    fixed::Scaled greater_inverse_mass; // 1/kg: what shares are shares of
    PairShares shares;
    Softness softness;
    std::int64_t break_push; // what `pushed` bears; 0: everything

    bool moves_particle() const { return (movable & 1) != 0; }
};

struct Attachment {
    AttachmentDescription description;
    AttachmentConstants constants;

    // State: what it pushed in the last tick, substeps added up; for reading out.
    fixed::Vec3 pushed;

    // Of the tick: what it pushed in a substep of the last one.
    fixed::Vec3 expected;

    bool loads_rope;    // its rope bears what hangs here (rigid/rope_loads.h)
    bool holds_in_tree; // what holds here is solved with the body's tree (rigid/closures.h)

    // Of the substep.
    fixed::Vec3 left;    // how far the sides stay apart for now
    fixed::Vec3 held_at; // where it holds in a tree: where the particle is once it is predicted
    fixed::Vec3 push;
    fixed::Vec3 begin; // how far they are apart once they are predicted
    // Not where it holds in a tree.
    BlockSide side;
    BlockInverse inverse;
    std::int64_t body_motion[6]; // by a push at it: the body's part of what `inverse` is of
};

// The two sides; `body` or `other` is null.
struct AttachmentSides {
    Object& object;
    Body* body;
    Object* other;
};

// A particle that is attached to a body, and therefore does not collide with it.
struct HeldParticle {
    std::uint32_t object;
    std::uint32_t body;
    std::uint32_t particle;

    friend constexpr bool operator<(const HeldParticle& p, const HeldParticle& q) {
        return p.object != q.object ? p.object < q.object
               : p.body != q.body   ? p.body < q.body
                                    : p.particle < q.particle;
    }
};

// Zero where it is pinned, or infinitely heavy from the start.
InverseMass particle_inverse_mass(const Object& object, std::uint32_t particle);
// Which sides can move now: bit 0 the particle, bit 1 the other side.
std::uint32_t movable_sides(const AttachmentDescription& d, const AttachmentSides& sides);
AttachmentConstants make_attachment_constants(const AttachmentDescription& description,
                                              const AttachmentSides& sides, const StepRate& rate);
// After a side was pinned, or made kinematic, or lets go: what it pushed is the same force in other masses.
void follow_masses(Attachment& attachment, const AttachmentSides& sides, const StepRate& rate);

// Before a tick's substeps.
void begin_tick(Attachment& attachment, const AttachmentSides& sides, const StepRate& rate);
// Before the prediction. What is attached where it is not comes together by two metres a second at most: all
// at once it would be thrown.
void measure_left(Attachment& attachment, const AttachmentSides& sides, const MotionRate& rate);
// After the prediction.
void begin_substep(Attachment& attachment, const AttachmentSides& sides);
void project(Attachment& attachment, const AttachmentSides& sides);
// Only remembers what has been pushed otherwise (rigid/rope_loads.h, rigid/closures.h).
void add_push(Attachment& attachment, const fixed::Vec3& push);
// Adds up what it pushed.
void finish_substep(Attachment& attachment);
bool breaks(const Attachment& attachment);

// How far the sides are apart in world axes: the other less the particle.
fixed::Vec3 attachment_offset(const Attachment& attachment, const AttachmentSides& sides);
// The same beyond what stays in this substep.
fixed::Vec3 attachment_error(const Attachment& attachment, const AttachmentSides& sides);
// The same where the particle does not move: the body less where that is held.
fixed::Vec3 pin_error(const Attachment& attachment, const Body& body);
// A particle in the world.
fixed::Vec3 particle_position(const Object& object, std::uint32_t particle);
// By a World shift; what leaves the object's range stops at its edge.
void move_particle(Object& object, std::uint32_t particle, const fixed::Vec3& shift);

} // namespace lks
