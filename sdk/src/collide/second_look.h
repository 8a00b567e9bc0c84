// What a later collider has pushed through an earlier one.
//
// Colliders push a particle one after the other, each to in front of a plane with all of the shape behind it
// (contact.h). Where two planes meet at less than a right angle, the second push goes back into the first
// shape, of 20° by 0.94 of its length: beyond the middle of a plate, and the next substep takes it for having
// come from the other side. One after the other again and again would come to an end, but by 0.88 a time.
//
// Here who was pushed far meets all colliders again, and each pushes along the planes of the last two instead
// of into them: two planes, or three, are done with at once. That is the point nearest to where the particle
// was of all in front of the planes, so that nothing gets faster by it. Where there is no such way, or it is
// not found soon, the particle stays where it was when the substep began. No friction: the first look had it.
//
// Only of colliders that move alike: where they close on a cloth pushes that give way to each other would
// bring all of it to one point, out of which it can't get.
#pragma once

#include <cstddef>
#include <cstdint>

#include "collide/contact.h"

namespace lks {

struct Bounds; // solver/object.h

inline constexpr std::uint32_t particles_a_look = 64;
constexpr std::size_t look_words(std::uint32_t particles) {
    return (particles + particles_a_look - 1) / particles_a_look;
}

// Of at most 64 particles.
class SecondLook {
public:
    // Bit i of `who`: particle first + i.
    SecondLook(const ParticleArrays& particles, std::int64_t tolerance, std::uint32_t first,
               std::uint64_t who);

    // Until done(), a round: meet() with each collider that touches the bounds, in one order, and
    // end_round(). The bounds contain who is still looked at, where the substep began, now, and as far again
    // around.
    Bounds bounds() const;
    void meet(const ContactFrame& frame);
    void end_round();
    bool done() const { return active_ == 0; }

private:
    struct Planes {
        fixed::Direction normals[2]; // the latest first
        std::uint32_t count;
    };

    bool find_way_out(const fixed::Direction& normal, const Planes& planes,
                      fixed::NormalisedVector& out) const;
    void push(std::uint32_t i, const NewDepth& behind);
    void put_back(std::uint32_t i);
    fixed::Vec3 position(std::uint32_t i) const;
    fixed::Vec3 start(std::uint32_t i) const;
    void move_to(std::uint32_t i, const fixed::Vec3& position);

    ParticleArrays particles_;
    std::int64_t tolerance_;
    std::uint32_t first_;
    std::uint64_t active_;       // bits as `who`
    std::uint64_t behind_ = 0;   // were behind somebody's plane in this round
    std::uint64_t put_back_ = 0; // to where they began
    std::uint32_t round_ = 0;
    Planes planes_[particles_a_look];
};

} // namespace lks
