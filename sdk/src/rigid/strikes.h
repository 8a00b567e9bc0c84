// How far what a body meets in a tick may carry it off the way that its velocity says.
//
// Contacts are looked for once a tick, where bodies come near each other on their ways. A ball at rest that
// is struck at 20 m/s has gone 30 cm by the end of that tick: who stands there has to be found before it is
// struck, and must not be asleep by then: it would stand like a wall. So the search notes who may strike
// whom, what comes by its own speed and what that strikes in turn, and is done again with room for those.
//
// What is awake, among what is awake, and is carried by less than half of the thickness of the thinnest, or
// an eighth of its own, needs no room: who it has gone into by then parts from it on the side that it came
// from. Nor do bones that may pass nothing thin (rigid/struck_bones.h).
#pragma once

#include "fixed/vector.h"

struct lks_world;

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
    bool of_bone;           // its joints turn it: it goes about there
    bool is_near_wall;      // a bone: it may pass something that is near
};

struct StrikesOfPair {
    const Strike& a;
    const Strike& b;
};

// Two that may meet.
struct StrikePair {
    std::uint32_t body_a;
    std::uint32_t other;      // as of a contact
    fixed::Direction normal;  // from a to b
    fixed::Direction drive;   // the same of how they move against each other, where they close by that
    Closing closing;          // by their own speeds
    std::int64_t restitution; // World
};

void begin_strikes(RigidScene& scene);
// Whether it goes in another direction as well.
bool goes_elsewhere(const Strike& strike, const fixed::Direction& along);
// It is carried to within `room` of the way to `drive` and back.
struct StruckWay {
    fixed::Vec3 drive;
    std::int64_t room;
};
StruckWay struck_way(const Strike& strike);
// Of b against a, with what strikes them: from `begin` on it goes a part of `way`, along each axis of the
// world, and is within `room` of that.
struct WaysBetween {
    fixed::Vec3 begin;
    fixed::Vec3 way;
    std::int64_t room;
};
WaysBetween ways_between(const fixed::Vec3& way, const StrikesOfPair& strikes);
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
bool spread_strikes(lks_world& world);

} // namespace lks
