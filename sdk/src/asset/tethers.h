// Tethers: how far each vertex of a cloth can be from those of its vertices that the game means to pin.
//
// Kim, Chentanez, Müller-Fischer, "Long Range Attachments", SCA 2012. A tether is as long as the shortest way
// along the constraints, each as long as the weight of the whole cloth would stretch it. It says nothing that
// the constraints don't say already: what they would come to if they were solved exactly is left as it is.
#pragma once

#include <lockstitch/asset.h>

#include <cstdint>

#include "memory/array.h"

namespace lks {

// Lengths have this many fraction bits.
inline constexpr int tether_fraction_bits = 24;
// Longer than anything.
inline constexpr std::uint32_t no_tether = UINT32_MAX;
// Particles are asked after in groups of so many.
inline constexpr std::uint32_t tether_group = 64;

// Those of one group's particles that are held by one anchor with the tethers of one row.
struct TetherPart {
    std::uint64_t members; // bit i: the group's i-th particle
    std::uint32_t anchor;
    std::uint32_t row;
};

// Two anchors that hold some particle between them.
struct TetherPair {
    std::uint32_t a; // anchors
    std::uint32_t b;
    std::uint64_t length; // of the shortest way from one to the other by such a particle, as a tether's
};

struct Tethers {
    explicit Tethers(const lks_allocator& allocator)
        : anchors(allocator), lengths(allocator), first_parts(allocator), parts(allocator), pairs(allocator) {
    }

    Array<std::uint32_t> anchors;     // their particles
    Array<std::uint32_t> lengths;     // rows of one a particle; no_tether where it has less tethers
    Array<std::uint32_t> first_parts; // by group, and one more
    Array<TetherPart> parts;          // by group, row, anchor
    Array<TetherPair> pairs;

    bool empty() const { return parts.empty(); }
};

static_assert(LKS_MAX_TETHER_ANCHORS <= 256, "eight bits are an anchor while tethers are built");

} // namespace lks
