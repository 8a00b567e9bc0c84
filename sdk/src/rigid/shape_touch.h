// Whether two shapes touch in a tick, how often their contact has to be looked for in it, and where they
// touch.
#pragma once

#include "rigid/contact.h"
#include "rigid/strikes.h"
#include "solver/world.h"

namespace lks {

struct PiecePair {
    const Piece& a;
    const Piece& b;
};
struct BodyPair {
    const Body& a;
    const Body& b;
};

// Fills `found` but for its key. `way`: of b against a in this tick, `spins`: how far they turn each other's
// points at most, beside what may carry them off their ways, `strikes`. False: they do not touch.
bool touches(const PiecePair& pieces, const BodyPair& bodies, const fixed::Vec3& way, std::int64_t spins,
             const StrikesOfPair& strikes, FoundContact& found);
// Fills the contact's points from where its bodies are, with what it pushed before: on the side of its bodies
// that `side` says, a normal that it had.
void find_points(const lks_world& world, Contact& contact, const fixed::Direction& side);
// For contacts that need more than one look a tick, at the beginning of a substep.
void find_points_again(const lks_world& world, Contact& contact);

} // namespace lks
