#include "rigid/strikes.h"

#include <algorithm>

#include "collide/saturation.h"
#include "rigid/contact_search.h"
#include "rigid/rigid_scene.h"
#include "rigid/struck_bones.h"
#include "rigid/ways.h"
#include "solver/world.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Of what is awake: below that the room that is always there is enough.
constexpr std::int64_t least_awake = near_distance / 2;
// Beside sleepers: whom they don't see stands like a wall.
constexpr std::int64_t least_beside_sleepers = world_one / 1000;
// What is slower, in a tick, bounces off such a wall by so little that nobody sees it.
constexpr std::int64_t least_speed_beside_sleepers = world_one / 200;
// What strikes in one direction: within 14° of it; bones, which are driven as a whole figure, within 45°.
constexpr std::int32_t one_direction = (std::int32_t{1} << 30) - (std::int32_t{1} << 25);
constexpr std::int32_t one_direction_of_bones = 759250125;

bool is_body(std::uint32_t other) {
    return other < other_is_collider;
}

bool is_beside_sleeper(const RigidScene& scene, std::uint32_t index) {
    return scene.bodies[index].slept || scene.strikes[index].beside_sleeper;
}

// It has room where it may pass something only.
bool is_held_by_joints(const RigidScene& scene, std::uint32_t index) {
    return scene.bodies[index].jointed && !is_beside_sleeper(scene, index);
}

bool may_be_carried(const RigidScene& scene, std::uint32_t index) {
    return scene.bodies[index].is_dynamic() &&
           (!is_held_by_joints(scene, index) || scene.thinnest_wall != INT64_MAX);
}

// From where on a strike counts. Where others are thinner than it, from where on it would go through those:
// but no pebble makes a boulder search at every step.
std::int64_t least_strike(const RigidScene& scene, std::uint32_t index) {
    if (is_beside_sleeper(scene, index)) {
        return least_beside_sleepers;
    }
    if (scene.bodies[index].jointed) {
        return least_way_through(scene, index);
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
    explicit Spread(lks_world& world)
        : world_(world), scene_(world.rigid), rate_(world.rate),
          greatest_(2 * per_tick(body_speed_limit(rate_), rate_)) {}

    bool run() {
        if (!anybody_strikes()) {
            return false;
        }
        scene_.spread_strikes.clear();
        for (const Strike& strike : scene_.strikes) {
            scene_.spread_strikes.push_reserved(strike);
        }
        const bool with_walls = scene_.thinnest_wall != INT64_MAX;
        constexpr int most_passes = 16;
        for (int pass = 0; pass < most_passes && sweep(); ++pass) {
            if (with_walls) {
                carry_figures(scene_);
            }
        }
        if (with_walls) {
            find_bones_near_walls(world_);
        }
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
        if (a.jointed && b.jointed && scene_.figures[pair.body_a] == scene_.figures[pair.other]) {
            return false; // what it does by itself is in their own ways
        }
        const PairShares shares = pair_shares(a.inverse_mass, b.inverse_mass);
        bool any = false;
        if (shares.a != 0 && may_be_carried(scene_, pair.body_a) && !sends_back(pair.other, a)) {
            any = strike(pair.body_a, pair.closing, strike_b, a.jointed ? -pair.drive : -pair.normal,
                         share_of_change(shares.a, shares.b, !a.jointed && b.jointed, pair));
        }
        if (shares.b != 0 && may_be_carried(scene_, pair.other) && !sends_back(pair.body_a, b)) {
            any = strike(pair.other, pair.closing, strike_a, b.jointed ? pair.drive : pair.normal,
                         share_of_change(shares.b, shares.a, !b.jointed && a.jointed, pair)) ||
                  any;
        }
        return any;
    }

    // What stands sends a bone back to where it came from.
    bool sends_back(std::uint32_t other, const Body& body) const {
        return body.jointed &&
               (is_body(other) ? !scene_.bodies[other].is_dynamic() && !scene_.bodies[other].is_moving()
                               : !collider_of(world_, other).moves());
    }

    // What one gets of how two close, 30 fraction bits: `all` against one that has a figure behind it.
    static std::int64_t share_of_change(std::int64_t own, std::int64_t other, bool all,
                                        const StrikePair& pair) {
        all = all || other == 0;
        // Who does not bounce pushes on: in a row each gets more than its share of the one before.
        const std::int64_t bounces = all ? pair.restitution : std::max(pair.restitution, world_one / 2);
        const std::int64_t share = all ? std::int64_t{1} << 30 : (own << 30) / (own + other);
        return fixed::multiply_shift(share, world_one + bounces, world_fraction_bits);
    }

    Strike& spread(std::uint32_t index) { return scene_.spread_strikes[index]; }

    // How far two close, the striker having been struck itself. Where it may go anywhere by that, the two do
    // not add up: each would carry the other further and further.
    static Closing with_carried(const Closing& own, const Closing& carried, bool adds_up) {
        if (adds_up || own.speed <= 0) {
            return {fixed::saturating_add(own.way, carried.way),
                    fixed::saturating_add(own.speed, carried.speed)};
        }
        const std::int64_t gap = fixed::saturating_subtract(own.speed, own.way);
        return {std::max(own.way, fixed::saturating_subtract(carried.way, gap)),
                std::max(own.speed, carried.speed)};
    }

    // `share`: of how they close, 30 fraction bits.
    bool strike(std::uint32_t index, const Closing& own, const Strike& striker, const Direction& along,
                std::int64_t share) {
        const bool bone = scene_.bodies[index].jointed;
        const Closing carried = struck_closing(striker, along);
        const Closing closing = with_carried(own, carried, !striker.anywhere && !bone);
        const auto shared = [&](std::int64_t closes) {
            return fixed::multiply_shift(std::min(closes, 2 * greatest_), share, 30);
        };
        // Nor is a bone driven faster than what strikes it: figures touch each other in many places.
        const std::int64_t most =
            bone ? std::min(std::max(shared(own.speed), carried.speed), greatest_) : greatest_;
        // What meets within a substep is struck where that begins.
        const std::int64_t way = std::min(
            fixed::saturating_add(closing.way, closing.speed / static_cast<std::int64_t>(rate_.substeps)),
            closing.speed);
        Strike& now = spread(index);
        const std::int64_t part = std::min(shared(way), most);
        if (part < least_beside_sleepers || !is_further(part, now.way)) {
            return false;
        }
        const bool handed_on = bone && carried.way > own.way;
        const Direction driven = handed_on ? striker.along : along;
        now.anywhere = goes_elsewhere(now, driven) ||
                       (bone ? handed_on && striker.anywhere : goes_elsewhere(striker, along));
        now.way = part;
        now.speed = std::max(now.speed, std::min(shared(closing.speed), most));
        now.along = driven;
        return true;
    }

    // Those that count.
    bool keep() {
        bool any = false;
        for (std::uint32_t i = 0; i < scene_.strikes.size(); ++i) {
            const Strike& now = spread(i);
            if (is_further(now.way, scene_.strikes[i].way) && now.way >= least_strike(scene_, i) &&
                now.speed >= least_speed_beside_sleepers &&
                (now.is_near_wall || !is_held_by_joints(scene_, i))) {
                scene_.strikes[i] = now;
                any = true;
            }
        }
        return any;
    }

    lks_world& world_;
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
        scene.strikes[i].of_bone = scene.bodies[i].jointed;
        if (scene.body_slots[i].used) {
            scene.thinnest = std::min(scene.thinnest, scene.descriptions[i].thickness);
        }
    }
}

bool goes_elsewhere(const Strike& strike, const Direction& along) {
    const std::int32_t least = strike.of_bone ? one_direction_of_bones : one_direction;
    return strike.way != 0 && (strike.anywhere || fixed::dot(strike.along, along) < least);
}

StruckWay struck_way(const Strike& strike) {
    if (strike.of_bone && !strike.anywhere) {
        return {fixed::scale(strike.along, strike.way), strike.way / 2};
    }
    return {{0, 0, 0}, strike.way};
}

WaysBetween ways_between(const Vec3& way, const StrikesOfPair& strikes) {
    if (strikes.a.way == 0 && strikes.b.way == 0) {
        return {{0, 0, 0}, way, 0};
    }
    const StruckWay a = struck_way(strikes.a);
    const StruckWay b = struck_way(strikes.b);
    Vec3 low{0, 0, 0};
    Vec3 high{0, 0, 0};
    for (const Vec3& part : {way, b.drive, -a.drive}) {
        low = saturating_add(low, {std::min<std::int64_t>(part.x, 0), std::min<std::int64_t>(part.y, 0),
                                   std::min<std::int64_t>(part.z, 0)});
        high = saturating_add(high, {std::max<std::int64_t>(part.x, 0), std::max<std::int64_t>(part.y, 0),
                                     std::max<std::int64_t>(part.z, 0)});
    }
    return {low, saturating_subtract(high, low), a.room + b.room};
}

Closing struck_closing(const Strike& strike, const Direction& direction) {
    if (strike.anywhere || strike.way == 0) {
        return {strike.way, strike.speed};
    }
    // Who meets others on that way is turned aside.
    const std::int64_t turned = std::int64_t{1} << (strike.of_bone ? 29 : 28);
    const std::int64_t part = std::int64_t{fixed::dot(strike.along, direction)} + turned;
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
               saturating_double(way) >=
                   (scene.any_beside_sleeper ? least_beside_sleepers : least_strike(scene, index));
    };
    return may_carry(body_a) || (is_body(other) && may_carry(other));
}

// As many as there may be contacts.
void note_strike_pair(RigidScene& scene, const StrikePair& pair) {
    if (scene.strike_pairs.size() < contact_capacity(scene.bodies.size())) {
        scene.strike_pairs.push_reserved(pair);
    }
}

bool spread_strikes(lks_world& world) {
    return Spread(world).run();
}

} // namespace lks
