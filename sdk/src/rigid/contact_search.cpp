#include "rigid/contact_search.h"

#include <algorithm>
#include <atomic>

#include "collide/filter.h"
#include "collide/saturation.h"
#include "rigid/closing.h"
#include "rigid/contact_memory.h"
#include "rigid/contact_points.h"
#include "rigid/near_pairs.h"
#include "rigid/piece_bounds.h"
#include "rigid/placed_pieces.h"
#include "rigid/shape_touch.h"
#include "rigid/sleep.h"
#include "rigid/strikes.h"
#include "rigid/struck_bones.h"
#include "rigid/ways.h"
#include "threads/blocks.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

template <typename Scene>
auto& body_of(Scene& scene, std::uint32_t other) {
    return other >= other_is_collider ? scene.collider_bodies[other & ~other_is_collider]
                                      : scene.bodies[other];
}

// Who comes more slowly than this wakes nobody by being near: a centimetre a second.
constexpr std::int64_t gentle_speed = world_one / 100;

// Where they are now.
bool touch(const RigidScene& scene, std::uint32_t a, std::uint32_t b) {
    const Body& body_a = scene.bodies[a];
    const Body& body_b = scene.bodies[b];
    const BodyDescription& description_a = scene.descriptions[a];
    const BodyDescription& description_b = scene.descriptions[b];
    const std::int64_t reach = description_a.radius + description_b.radius + touching_distance;
    if (passes_by(saturating_subtract(body_b.position, body_a.position), {0, 0, 0}, {reach, reach, reach})) {
        return false;
    }
    for (std::uint32_t i = 0; i < description_a.shape_count; ++i) {
        const Piece piece_a = piece_of_body(body_a, description_a.shapes[i], body_a.position);
        for (std::uint32_t j = 0; j < description_b.shape_count; ++j) {
            Manifold manifold{};
            collide(piece_a, piece_of_body(body_b, description_b.shapes[j], body_a.position),
                    touching_distance, no_side, manifold);
            if (manifold.count != 0) {
                return true;
            }
        }
    }
    return false;
}

class Search {
public:
    Search(lks_world& world, Team* team) : world_(world), scene_(world.rigid), team_(team) {}

    // False: somebody was woken, or struck and finds others now, and it has to be done again.
    bool run(int wave) {
        // Each wakes those next to the ones that the wave before has woken.
        constexpr int most_waves = 8;
        constexpr int most_waves_among_sleepers = 16;
        find_near_pairs(world_);
        if (wave == 1) {
            find_thinnest_wall(world_);
        }
        scene_.contacts.clear();
        scene_.contact_points.clear();
        scene_.strike_pairs.clear();
        next_memory_ = 0;
        woken_ = false;
        if (team_ == nullptr || !find_by_team()) {
            for (const std::uint64_t pair : scene_.pairs) {
                for_each_found(pair, [this](const FoundContact& found) { add_contact(found); });
            }
        }
        const bool again = wave < (scene_.any_beside_sleeper ? most_waves_among_sleepers : most_waves);
        const bool struck = again && spread_strikes(world_);
        return !woken_ && !struck;
    }

private:
    const Strike& strike_of(std::uint32_t other) const {
        static constexpr Strike none{};
        return other >= other_is_collider ? none : scene_.strikes[other];
    }

    // Of b against a.
    Vec3 way_between(std::uint32_t a, std::uint32_t other) const {
        const Vec3 way = other >= other_is_collider ? way_in_tick(other_body(scene_, other), world_.rate)
                                                    : scene_.ways[other];
        return saturating_subtract(way, scene_.ways[a]);
    }

    // What is found does not depend on what is added, so that it may be found in any order. False: there is
    // more than there is room for.
    bool find_by_team() {
        constexpr std::uint32_t pairs_a_block = 64;
        static_cast<void>(scene_.found.resize(contact_capacity(scene_.bodies.size()))); // within its room
        std::atomic<std::uint32_t> count{0};
        run_each(team_, scene_.pairs.size(), pairs_a_block, [&](std::uint32_t i, std::uint32_t) {
            for_each_found(scene_.pairs[i], [&](const FoundContact& found) {
                const std::uint32_t at = count.fetch_add(1, std::memory_order_relaxed);
                if (at < scene_.found.size()) {
                    scene_.found[at] = found;
                }
            });
        });
        const std::uint32_t found_count = count.load(std::memory_order_relaxed);
        if (found_count > scene_.found.size()) {
            return false;
        }
        scene_.found_order.clear();
        for (std::uint32_t i = 0; i < found_count; ++i) {
            scene_.found_order.push_reserved(i);
        }
        std::sort(
            scene_.found_order.begin(), scene_.found_order.end(),
            [this](std::uint32_t i, std::uint32_t j) { return scene_.found[i].key < scene_.found[j].key; });
        for (const std::uint32_t i : scene_.found_order) {
            add_contact(scene_.found[i]);
        }
        return true;
    }

    // Calls use(found) for each pair of their shapes that may touch in this tick.
    template <typename Use>
    void for_each_found(std::uint64_t pair, const Use& use) const {
        const auto a = static_cast<std::uint32_t>(pair >> 32);
        const auto other = static_cast<std::uint32_t>(pair);
        const Body& body_a = scene_.bodies[a];
        const Body& body_b = other_body(scene_, other);
        const BodyDescription& description_a = scene_.descriptions[a];
        const bool with_collider = other >= other_is_collider;
        const std::uint32_t shapes_b = with_collider ? 1 : scene_.descriptions[other].shape_count;
        // The motion of one against the other in this tick.
        const std::int64_t spins =
            scene_.travels[a] + (with_collider ? collider_turns(body_b, other) : scene_.travels[other]);
        const StrikesOfPair strikes{strike_of(a), strike_of(other)};
        const Vec3 way = way_between(a, other);
        const std::int64_t travel = sum_of_magnitudes(way);
        const WaysBetween ways = ways_between(way, strikes);
        const std::int64_t room =
            near_distance + spins + ways.room + (keeps_side(body_a, body_b) ? aside(travel) : 0);
        const Vec3 between = body_b.position - body_a.position;
        const auto pass_by = [&](const Vec3& centre_a, const Vec3& centre_b, const Vec3& around) {
            return passes_by(saturating_add(saturating_subtract(centre_b, centre_a), ways.begin), ways.way,
                             around);
        };
        for (std::uint32_t i = 0; i < description_a.shape_count; ++i) {
            for (std::uint32_t j = 0; j < shapes_b; ++j) {
                Piece piece_b;
                if (with_collider) {
                    piece_b = piece_of_collider(body_b, collider_of(world_, other), body_a.position);
                    if (piece_b.kind != LKS_SHAPE_PLANE &&
                        pass_by(scene_.piece(a, i).centre, piece_b.centre,
                                room_around(scene_.piece_extent(a, i), extent(piece_b), room))) {
                        continue;
                    }
                } else {
                    const Vec3 centre = scene_.piece(other, j).centre + between;
                    if (pass_by(
                            scene_.piece(a, i).centre, centre,
                            room_around(scene_.piece_extent(a, i), scene_.piece_extent(other, j), room))) {
                        continue;
                    }
                    piece_b = scene_.piece(other, j);
                    piece_b.centre = centre;
                }
                FoundContact found;
                found.key = {a, other, i * LKS_MAX_BODY_SHAPES + j};
                if (touches({scene_.piece(a, i), piece_b}, {body_a, body_b}, way, spins, strikes, found)) {
                    use(found);
                }
            }
        }
    }

    // How far the points of a collider that turns go at most.
    std::int64_t collider_turns(const Body& body, std::uint32_t other) const {
        const ColliderState& collider = collider_of(world_, other);
        const bool turns = !(body.angular_velocity == Vec3{0, 0, 0}) || collider.rotates();
        return turns ? quarter_turn(collider) : 0;
    }

    Surface surface_of(std::uint32_t other) const {
        if (other < other_is_collider) {
            return scene_.descriptions[other].surface;
        }
        const ColliderState& collider = collider_of(world_, other);
        return {collider.static_friction, collider.dynamic_friction, collider.restitution};
    }

    std::int64_t gravity_speed(const Body& body, std::uint32_t index) const {
        return body.is_dynamic() ? static_cast<std::int64_t>(fixed::length(scene_.ticks[index].gravity_step))
                                 : 0;
    }

    void add_contact(const FoundContact& found) {
        const ContactKey& key = found.key;
        while (next_memory_ < scene_.memories.size() && scene_.memories[next_memory_].key < key) {
            ++next_memory_;
        }
        const bool known = next_memory_ < scene_.memories.size() && scene_.memories[next_memory_].key == key;
        const Surface& own = scene_.descriptions[key.body_a].surface;
        const Surface other = surface_of(key.other);
        const std::int64_t restitution = std::max(own.restitution, other.restitution);
        note_strike(found.manifold, key, restitution);
        if (disturb_sleep(found.manifold, key)) {
            return;
        }
        if (scene_.contacts.size() >= contact_capacity(scene_.bodies.size())) {
            ++world_.counters.lost_contacts;
            return;
        }
        static_cast<void>(scene_.contacts.resize(scene_.contacts.size() + 1)); // within its room
        Contact& contact = scene_.contacts[scene_.contacts.size() - 1];
        const Body& body_a = scene_.bodies[key.body_a];
        const Body& body_b = other_body(scene_, key.other);
        contact.key = key;
        contact.shares = pair_shares(body_a.effective_inverse_mass(), body_b.effective_inverse_mass());
        contact.fast = found.fast;
        contact.radius_a = found.radius_a;
        contact.radius_b = found.radius_b;
        contact.static_friction = combined_friction(own.static_friction, other.static_friction);
        contact.dynamic_friction = combined_friction(own.dynamic_friction, other.dynamic_friction);
        contact.restitution = restitution;
        contact.gravity_speed = std::max(gravity_speed(body_a, key.body_a), gravity_speed(body_b, key.other));
        OldContact old{{}, no_side};
        ContactMemory beside; // as of a wall
        Direction side = no_side;
        if (known && scene_.memories[next_memory_].forgotten == 0) {
            const ContactMemory& memory = scene_.memories[next_memory_];
            old = {{memory.pushes, memory.count}, memory.normal};
            if (is_with_sleeper(scene_, key)) {
                beside = memory;
                scale_pushes({beside.pushes, beside.count},
                             fixed::Scaled::from_u64(1) / wall_ratio(scene_, key));
                old.pushes = {beside.pushes, beside.count};
            }
            side = keeps_side(body_a, body_b) ? memory.normal : no_side;
        }
        const bool passed = against(found.manifold.normal, side);
        contact.every_substep = found.every_substep || passed;
        const std::size_t first_point = scene_.contact_points.size();
        scene_.contact_points.extend_reserved(point_room(contact.every_substep, found.manifold));
        contact.points = scene_.contact_points.begin() + first_point;
        take_manifold(contact, old, found.manifold, body_a, body_b);
        if (passed) {
            find_points(world_, contact, side);
        }
    }

    // Wakes a sleeping body that this one is about to touch. True: the contact is of no use (yet). What lies
    // beside a sleeper does not wake it; if it comes to push, they are one island (wake_islands).
    bool disturb_sleep(const Manifold& manifold, const ContactKey& key) {
        Body& a = scene_.bodies[key.body_a];
        Body& b = other_body(scene_, key.other);
        if (a.asleep == 0 && b.asleep == 0) {
            return false;
        }
        // What has just been woken is about to be pushed: its neighbours are not to stand like walls.
        const bool carried = !a.is_dynamic() || !b.is_dynamic() || a.has_woken() || b.has_woken();
        const bool comes = a.is_awake() || b.is_awake();
        const PairClosing pair(world_, key, manifold);
        const std::int64_t struck = struck_closing(manifold, key);
        for (std::uint32_t i = 0; (comes || carried) && i < manifold.count; ++i) {
            const std::int64_t closing = pair.at(manifold.points[i]) + struck;
            // What comes may speed up on its way.
            const std::int64_t way = std::max<std::int64_t>(closing + closing / 4, 0);
            if ((carried || closing > per_tick(gentle_speed, world_.rate)) &&
                manifold.points[i].separation <= touching_distance + way) {
                wake(a.asleep != 0 ? a : b);
                woken_ = true;
                return true;
            }
        }
        return !comes;
    }

    // Who may carry the other off its way, or both, and by what. What hardly strikes may hand a strike on:
    // for that the motion of the middles is enough. What stands sends a body back along its way, which is
    // looked at as it is.
    void note_strike(const Manifold& manifold, const ContactKey& key, std::int64_t restitution) {
        const bool with_body = key.other < other_is_collider;
        if (!may_be_carried(scene_, key.body_a, key.other)) {
            return;
        }
        const std::int64_t travels = scene_.travels[key.body_a] + (with_body ? scene_.travels[key.other] : 0);
        const Vec3 way = way_between(key.body_a, key.other);
        const std::int64_t speed = -fixed::dot(manifold.normal, way);
        StrikePair pair{key.body_a,
                        key.other,
                        manifold.normal,
                        manifold.normal,
                        {fixed::saturating_subtract(speed, least_gap(manifold)), speed},
                        restitution};
        const bool strikes =
            may_strike(scene_, key.body_a, key.other, fixed::saturating_add(pair.closing.way, travels));
        fixed::NormalisedVector closes{};
        if (strikes && speed > 0 && fixed::normalise(saturating_subtract(Vec3{0, 0, 0}, way), closes)) {
            pair.drive = closes.direction;
        }
        if (strikes && manifold.count != 0) {
            pair.closing = PairClosing(world_, key, manifold).greatest();
        }
        if (strikes || with_body) {
            note_strike_pair(scene_, pair);
        }
    }

    // What they may close in a tick by having been struck, at the beginning of a substep already.
    std::int64_t struck_closing(const Manifold& manifold, const ContactKey& key) const {
        const StrikesOfPair strikes{strike_of(key.body_a), strike_of(key.other)};
        const Closing struck = lks::struck_closing(strikes, manifold.normal);
        return struck.way + struck.speed / world_.rate.substeps;
    }

    lks_world& world_;
    RigidScene& scene_;
    Team* team_;
    std::size_t next_memory_ = 0;
    bool woken_ = false;
};

} // namespace

Body& other_body(RigidScene& scene, std::uint32_t other) {
    return body_of(scene, other);
}

const Body& other_body(const RigidScene& scene, std::uint32_t other) {
    return body_of(scene, other);
}

const ColliderState& collider_of(const lks_world& world, std::uint32_t other) {
    return world.colliders[other & ~other_is_collider].collider;
}

void place_collider_bodies(lks_world& world) {
    RigidScene& scene = world.rigid;
    const MotionRate rate(world.rate);
    scene.collider_bodies.clear();
    for (const ColliderSlot& slot : world.colliders) {
        Body body{};
        if (slot.used) {
            body.position = slot.collider.position;
            body.target_position = slot.collider.target_position;
            body.orientation = widen(slot.collider.rotation);
            body.target_orientation =
                slot.collider.rotates() ? widen(slot.collider.target_rotation) : body.orientation;
            body.rotation = fixed::to_matrix(slot.collider.rotation);
            body.tick_position = body.position;
            body.tick_orientation = body.orientation;
            body.start_position = body.position;
            body.start_orientation = body.orientation;
            if (slot.collider.moves()) {
                aim_kinematic(body, rate, world.rate.substeps);
            }
        }
        scene.collider_bodies.push_reserved(body);
    }
}

void find_contacts(lks_world& world, Team* team) {
    begin_strikes(world.rigid);
    const std::uint64_t lost_before = world.counters.lost_contacts;
    for (int wave = 1; !Search(world, team).run(wave); ++wave) {
        wake_islands(world);
        world.counters.lost_contacts = lost_before; // the last one counts
    }
}

void wake_touched(lks_world& world, std::uint32_t body) {
    RigidScene& scene = world.rigid;
    if (scene.bodies[body].is_dynamic()) {
        return;
    }
    scene.follow_joints();
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].asleep != 0 && !scene.are_jointed(std::min(i, body), std::max(i, body)) &&
            filters_meet(scene.descriptions[i].filter, scene.descriptions[body].filter) &&
            touch(scene, i, body)) {
            wake(scene.bodies[i]);
        }
    }
}

} // namespace lks
