// How far what a body meets in a tick may carry it off the way that its velocity says.
//
// Contacts are looked for once a tick, where bodies come near each other on their ways. A ball at rest that
// is struck at 20 m/s has gone 30 cm by the end of that tick: who stands there has to be found before it is
// struck, and must not be asleep by then: it would stand like a wall. So the search notes who may strike
// whom, what comes by its own speed and what that strikes in turn, and is done again with room for those.
//
// What is awake, among what is awake, and is carried by less than half of the thickness of the thinnest, or
// an eighth of its own, needs no room: who it has gone into by then parts from it on the side that it came
// from. Nor do bones: their joints hold them.
#pragma once

#include "fixed/vector.h"
#include "solver/step_rate.h"

namespace lks {

struct RigidScene;

// How far two close in a tick, World.
struct Closing {
    std::int64_t way; // beyond the gap between them
    std::int64_t speed;
};

// Of a body, in a tick.
struct Strike {
    std::int64_t way;       // World; 0: nothing strikes it
    std::int64_t speed;     // the same in a whole tick
    fixed::Direction along; // where to
    bool anywhere;          // by several, or by what was struck itself
    bool beside_sleeper;    // it is awake, and who sleeps is near
};

struct StrikesOfPair {
    Strike a;
    Strike b;
};

// Two that may meet.
struct StrikePair {
    std::uint32_t body_a;
    std::uint32_t other;      // as of a contact
    fixed::Direction normal;  // from a to b
    Closing closing;          // by their own speeds
    std::int64_t restitution; // World
};

void begin_strikes(RigidScene& scene);
// By how far beyond its way it may come in that direction.
Closing struck_closing(const Strike& strike, const fixed::Direction& direction);
// Both towards each other; the normal is from a to b.
Closing struck_closing(const StrikesOfPair& strikes, const fixed::Direction& normal);
// Either of them.
bool may_be_carried(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other);
// Whether two that close by so much more than the gap between them may carry each other far enough to count.
bool may_strike(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other, std::int64_t way);
void note_strike_pair(RigidScene& scene, const StrikePair& pair);
// At the end of a search, which notes all pairs anew. True: somebody has been struck since the one before, or
// further, and may find others now.
bool spread_strikes(RigidScene& scene, const StepRate& rate);

} // namespace lks
