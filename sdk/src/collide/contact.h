// Contacts of particles with one collider, at the level of positions.
//
// Why nothing tunnels. Seen from the shape, a particle goes through a substep on a straight line. If the line
// meets the shape, the particle is put in front of the plane that touches the shape where the line enters it.
// Every shape here is convex, and stays so when the particle's radius is added; a plane through the surface
// point nearest to an outside point, across the shortest way to it, then has the whole shape behind it. So
// does a plane through the face or surface point nearest to an inside point. Whatever ends in front of such a
// plane ends outside, on the side it came from, also after friction has moved it along the plane.
//
// Velocity is x - start per substep, so that putting x in front of the plane is an inelastic impact. What the
// particle was inside already at the start of the substep, start is moved by as well: recovering from an old
// overlap gives no speed.
//
// That holds of one collider. The next one's plane may lie behind this one's: second_look.h.
//
// The limit: whatever ends a substep more than 63 m from a shape's centre is not looked at, so that a
// collider which covers some 60 m in one substep passes what is in its way.
#pragma once

#include <cstdint>

#include "collide/collider_motion.h"
#include "kernels/kernels.h"

namespace lks {

// Coordinate. x, y, z now; start_* at the start of the substep.
struct ParticleArrays {
    std::int64_t* x;
    std::int64_t* y;
    std::int64_t* z;
    std::int64_t* start_x;
    std::int64_t* start_y;
    std::int64_t* start_z;
};

// A hit is accepted this close in front of the surface (0.95 µm).
inline constexpr std::int64_t contact_tolerance = coordinate_one >> 20;

// What the shape does when a particle hits it: it may give way, and change the frame by it.
class ContactReaction {
public:
    // True: this particle does not meet the shape.
    virtual bool ignores(std::uint32_t particle) const = 0;
    // The particle is to be moved by `correction` against the shape, Coordinate; returns its own part of it.
    virtual fixed::Vec3 give_way(std::uint32_t particle, const fixed::Vec3& correction) = 0;

protected:
    ~ContactReaction() = default;
};

// Whom colliders push far in this substep, old overlaps aside.
struct FarPushes {
    std::int64_t beyond;  // Coordinate
    std::uint64_t* words; // bit i % 64 of word i / 64 is set for particle i
};

// Particles first .. first + count - 1. Each result depends on that particle and the frame only, and with a
// reaction on the particles before it. Positions that are pushed beyond ±coordinate_limit stop there. No
// undefined behaviour for any positions. With `far`, `first` is a multiple of 64.
void resolve_contacts(const ContactFrame& frame, const ParticleArrays& particles, std::uint32_t first,
                      std::uint32_t count, const Kernels& kernels, ContactReaction* reaction = nullptr,
                      const FarPushes* far = nullptr);

// A plane behind which a particle has got in this substep, in object space.
struct NewDepth {
    fixed::Direction normal;
    std::int64_t depth;
};

// False: the particle has not got into the shape any deeper than it was.
bool find_new_depth(const ContactFrame& frame, const fixed::Vec3& position, const fixed::Vec3& start,
                    NewDepth& out);

} // namespace lks
