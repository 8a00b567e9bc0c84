// An attachment of a rope that bears what hangs on it (rigid/rope_loads.h), in a tick.
#pragma once

#include "fixed/int128.h"
#include "fixed/vector.h"
#include "rigid/pair.h"

namespace lks {

struct RopeLoad {
    std::uint32_t object;
    std::uint32_t particle;
    std::uint32_t attachment;
    bool heavy;    // an attachment alone would not hold it
    bool anchored; // something that does not move holds the rope, too

    // Of a solve of its rope.
    std::int64_t motion;    // of the body's point by a push of one along the rope; zero: it does not move
    fixed::Vec3 before;     // where the particle was before
    fixed::Direction along; // from the particle into the rope; zero: it is no end

    // Of a held tree (rigid/held_tree.h): while the rope is taut the point does not move away from it. The
    // row of that:
    bool taut;
    fixed::Vec3 lever; // in the body's unit
    fixed::Vec3 column_shift;
    fixed::Vec3 column_turn;
    Inverse inverse;
    std::int64_t push;

    // Of an object's first: twice its energy as predicted (rigid/held_energy.h).
    fixed::Int128 predicted;

    friend constexpr bool operator<(const RopeLoad& p, const RopeLoad& q) {
        return p.object != q.object       ? p.object < q.object
               : p.particle != q.particle ? p.particle < q.particle
                                          : p.attachment < q.attachment;
    }
};

} // namespace lks
