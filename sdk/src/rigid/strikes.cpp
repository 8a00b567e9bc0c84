#include "rigid/strikes.h"

#include <algorithm>

#include "rigid/contact_search.h"
#include "rigid/rigid_scene.h"
#include "rigid/ways.h"

namespace lks {
namespace {

using fixed::Direction;

constexpr std::int64_t world_one = std::int64_t{1} << world_fraction_bits;
// Of what is awake: below that the room that is always there is enough.
constexpr std::int64_t least_awake = near_distance / 2;
// Beside sleepers: whom they don't see stands like a wall.
constexpr std::int64_t least_beside_sleepers = world_one / 1000;
// What is slower, in a tick, bounces off such a wall by so little that nobody sees it.
constexpr std::int64_t least_speed_beside_sleepers = world_one / 200;
// What strikes in one direction: within 14° of it.
constexpr std::int32_t one_direction = (std::int32_t{1} << 30) - (std::int32_t{1} << 25);

bool is_body(std::uint32_t other) {
    return other < other_is_collider;
}

bool is_beside_sleeper(const RigidScene& scene, std::uint32_t index) {
    return scene.bodies[index].slept || scene.strikes[index].beside_sleeper;
}

bool may_be_carried(const RigidScene& scene, std::uint32_t index) {
    const Body& body = scene.bodies[index];
    return body.is_dynamic() && (!body.jointed || is_beside_sleeper(scene, index));
}

// From where on a strike counts. Where others are thinner than it, from where on it would go through those:
// but no pebble makes a boulder search at every step.
std::int64_t least_strike(const RigidScene& scene, std::uint32_t index) {
    if (is_beside_sleeper(scene, index)) {
        return least_beside_sleepers;
    }
    const std::int64_t own = scene.descriptions[index].thickness;
    return std::max({least_awake, std::min(own, scene.thinnest), own / 4});
}

// Not each time for a little more: by a quarter.
bool is_further(std::int64_t way, std::int64_t before) {
    return way > before + before / 4;
}

class Spread {
public:
    Spread(RigidScene& scene, const StepRate& rate)
        : scene_(scene), rate_(rate), greatest_(2 * per_tick(body_speed_limit(rate), rate)) {}

    bool run() {
        if (!anybody_strikes()) {
            return false;
        }
        scene_.spread_strikes.clear();
        for (const Strike& strike : scene_.strikes) {
            scene_.spread_strikes.push_reserved(strike);
        }
        constexpr int most_passes = 16;
        for (int pass = 0; pass < most_passes && sweep(); ++pass) {}
        return keep();
    }

private:
    bool anybody_strikes() const {
        return std::any_of(
            scene_.strike_pairs.begin(), scene_.strike_pairs.end(),
            [this](const StrikePair& p) { return may_strike(scene_, p.body_a, p.other, p.closing.way); });
    }

    // False: nobody is carried further by it.
    bool sweep() {
        bool any = false;
        for (const StrikePair& pair : scene_.strike_pairs) {
            any = strike_both(pair) || any;
        }
        return any;
    }

    bool strike_both(const StrikePair& pair) {
        const Strike none{};
        const Strike& strike_a = spread(pair.body_a);
        const Strike& strike_b = is_body(pair.other) ? spread(pair.other) : none;
        if (pair.closing.way <= 0 && strike_a.way == 0 && strike_b.way == 0) {
            return false;
        }
        const Body& a = scene_.bodies[pair.body_a];
        const Body& b = other_body(scene_, pair.other);
        // Of what changes of their speeds: against one that has a figure behind it all of that.
        const PairShares shares = pair_shares(a.inverse_mass, b.inverse_mass);
        const std::int64_t share_a = a.jointed && !b.jointed ? 0 : shares.a;
        const std::int64_t share_b = b.jointed && !a.jointed ? 0 : shares.b;
        if (share_a + share_b == 0) {
            return false;
        }
        // Who does not bounce pushes on: in a row each gets more than its share of the one before.
        const std::int64_t bounces =
            share_a != 0 && share_b != 0 ? std::max(pair.restitution, world_one / 2) : pair.restitution;
        const auto whole = [&](std::int64_t share) {
            return fixed::multiply_shift((share << 30) / (share_a + share_b), world_one + bounces,
                                         world_fraction_bits);
        };
        bool any = false;
        if (may_be_carried(scene_, pair.body_a)) {
            any = strike(pair.body_a, pair.closing, strike_b, -pair.normal, whole(share_a));
        }
        if (is_body(pair.other) && may_be_carried(scene_, pair.other)) {
            any = strike(pair.other, pair.closing, strike_a, pair.normal, whole(share_b)) || any;
        }
        return any;
    }

    Strike& spread(std::uint32_t index) { return scene_.spread_strikes[index]; }

    // How far two close, the striker having been struck itself. Where it may go anywhere by that, the two do
    // not add up: each would carry the other further and further.
    static Closing with_carried(const Closing& own, const Strike& striker, const Direction& along) {
        const Closing carried = struck_closing(striker, along);
        if (!striker.anywhere || own.speed <= 0) {
            return {own.way + carried.way, own.speed + carried.speed};
        }
        const std::int64_t gap = own.speed - own.way;
        return {std::max(own.way, carried.way - gap), std::max(own.speed, carried.speed)};
    }

    // `share`: of how they close, 30 fraction bits.
    bool strike(std::uint32_t index, const Closing& own, const Strike& striker, const Direction& along,
                std::int64_t share) {
        const Closing closing = with_carried(own, striker, along);
        // What meets within a substep is struck where that begins.
        const std::int64_t way = std::min(closing.way + closing.speed / rate_.substeps, closing.speed);
        Strike& now = spread(index);
        const auto shared = [&](std::int64_t closes) {
            return std::min(fixed::multiply_shift(closes, share, 30), greatest_);
        };
        const std::int64_t part = shared(way);
        if (part < least_beside_sleepers || !is_further(part, now.way)) {
            return false;
        }
        const bool aside = is_aside(now, along) || is_aside(striker, along);
        now = {part, std::max(now.speed, shared(closing.speed)), along, aside, now.beside_sleeper};
        return true;
    }

    static bool is_aside(const Strike& other, const Direction& along) {
        return other.way != 0 && (other.anywhere || fixed::dot(other.along, along) < one_direction);
    }

    // Those that count.
    bool keep() {
        bool any = false;
        for (std::uint32_t i = 0; i < scene_.strikes.size(); ++i) {
            const Strike& now = spread(i);
            if (is_further(now.way, scene_.strikes[i].way) && now.way >= least_strike(scene_, i) &&
                now.speed >= least_speed_beside_sleepers) {
                scene_.strikes[i] = now;
                any = true;
            }
        }
        return any;
    }

    RigidScene& scene_;
    const StepRate& rate_;
    std::int64_t greatest_; // whatever strikes it: along each axis no body is faster than the limit
};

} // namespace

void begin_strikes(RigidScene& scene) {
    scene.strikes.clear();
    static_cast<void>(scene.strikes.resize(scene.bodies.size())); // within its room
    scene.any_beside_sleeper = false;
    scene.thinnest = INT64_MAX;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.body_slots[i].used) {
            scene.thinnest = std::min(scene.thinnest, scene.descriptions[i].thickness);
        }
    }
}

Closing struck_closing(const Strike& strike, const Direction& direction) {
    if (strike.anywhere || strike.way == 0) {
        return {strike.way, strike.speed};
    }
    // Who meets others on that way is turned aside.
    const std::int64_t part = std::int64_t{fixed::dot(strike.along, direction)} + (std::int64_t{1} << 28);
    constexpr std::int64_t whole = std::int64_t{1} << 30;
    if (part <= whole / 4) {
        return {0, 0};
    }
    const auto along = [&](std::int64_t way) {
        return fixed::multiply_shift(way, std::min(part, whole), 30);
    };
    return {along(strike.way), along(strike.speed)};
}

Closing struck_closing(const StrikesOfPair& strikes, const Direction& normal) {
    const Closing a = struck_closing(strikes.a, normal);
    const Closing b = struck_closing(strikes.b, -normal);
    return {a.way + b.way, a.speed + b.speed};
}

bool may_be_carried(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other) {
    return may_be_carried(scene, body_a) || (is_body(other) && may_be_carried(scene, other));
}

bool may_strike(const RigidScene& scene, std::uint32_t body_a, std::uint32_t other, std::int64_t way) {
    // A body's speed changes by twice what the two close by at most. Where somebody sleeps, little strikes
    // may be handed on to him.
    const auto may_carry = [&](std::uint32_t index) {
        return may_be_carried(scene, index) &&
               2 * way >= (scene.any_beside_sleeper ? least_beside_sleepers : least_strike(scene, index));
    };
    return may_carry(body_a) || (is_body(other) && may_carry(other));
}

// As many as there may be contacts.
void note_strike_pair(RigidScene& scene, const StrikePair& pair) {
    if (scene.strike_pairs.size() < contact_capacity(scene.bodies.size())) {
        scene.strike_pairs.push_reserved(pair);
    }
}

bool spread_strikes(RigidScene& scene, const StepRate& rate) {
    return Spread(scene, rate).run();
}

} // namespace lks
