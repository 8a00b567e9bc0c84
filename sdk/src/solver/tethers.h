// Holds particles within reach of pinned anchors (asset/tethers.h): a particle that is further from one than
// its tether is long is moved straight towards it, by all that it is too far, or less where the cloth is
// damped.
//
// In one iteration each particle is moved by its own tethers only, one after the other, and anchors not at
// all: any order of particles and any number of threads gives the same bits.
#pragma once

#include <cstdint>

#include "kernels/kernels.h"
#include "solver/object.h"

namespace lks {

// Where an anchor is now. No state.
struct TetherAnchor {
    Coordinates position;
    Coordinates start;   // of the substep
    bool active;         // its particle is pinned
    std::uint32_t scale; // what its tethers are lengthened by, at least one; 24 fraction bits
};

// Of all anchors of the object's asset; pins are in their places. False: none is active.
bool place_tether_anchors(const Object& object, TetherAnchor* anchors);

// For particles first .. first + count - 1.
void hold_by_tethers(Object& object, const TetherAnchor* anchors, const Kernels& kernels, std::uint32_t first,
                     std::uint32_t count);

} // namespace lks
