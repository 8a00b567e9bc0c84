#include "rigid/contact_search.h"

#include <algorithm>
#include <atomic>

#include "collide/filter.h"
#include "collide/plane_motion.h"
#include "collide/saturation.h"
#include "memory/sort_numbers.h"
#include "rigid/meeting.h"
#include "rigid/piece_bounds.h"
#include "rigid/sleep.h"
#include "threads/blocks.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// In its place, relative to `reference`.
Piece piece_of_body(const Body& body, const BodyShape& shape, const Vec3& reference) {
    Piece piece{};
    piece.kind = shape.kind;
    piece.radius = shape.radius;
    piece.half_length = shape.half_length;
    piece.half_extents = shape.half_extents;
    piece.centre = (body.position - reference) + fixed::rotate(body.rotation, shape.position);
    piece.axes = shape_axes(body.rotation, shape);
    return piece;
}

Piece piece_of_collider(const Body& body, const ColliderState& collider, const Vec3& reference) {
    Piece piece{};
    const Shape shape = world_shape(collider.shape);
    piece.kind = shape.kind;
    piece.radius = shape.radius;
    piece.half_length = shape.half_length;
    piece.half_extents = shape.half_extents;
    piece.axes = body.rotation;
    if (collider.shape.kind == LKS_SHAPE_PLANE) {
        // The point of the plane that is nearest to the reference: the plane's own may be anywhere.
        const Direction up = plane_normal(body.rotation);
        const std::int64_t lift = world_height_above_plane(up, body.position, reference);
        constexpr std::int64_t limit = std::int64_t{128} << world_fraction_bits;
        piece.centre = -fixed::scale(up, std::clamp(lift, -limit, limit));
    } else {
        piece.centre = saturating_subtract(body.position, reference);
    }
    return piece;
}

// Who comes more slowly than this wakes nobody by being near: a centimetre a second.
constexpr std::int64_t gentle_speed = (std::int64_t{1} << world_fraction_bits) / 100;

// A velocity over one of n parts of a second, rounded away from zero.
Vec3 way_in(const Vec3& velocity, std::int64_t n) {
    const auto along = [n](std::int64_t v) {
        return fixed::saturating_add(v / n, v > 0 ? 1 : v < 0 ? -1 : 0);
    };
    return {along(velocity.x), along(velocity.y), along(velocity.z)};
}

Vec3 room_around(const Vec3& extent_a, const Vec3& extent_b, std::int64_t more) {
    return extent_a + extent_b + Vec3{more, more, more};
}

// How far what it hits on its way may turn it aside. (Figures that are thrown at a fence pass it more often
// without that.)
std::int64_t aside(std::int64_t way) {
    return way / 4;
}

// Whether what they do on their way counts, and not only where they are. Joints turn the ways of two bones.
// And they draw what is fast past an edge that it would only graze: figures that are thrown at a fence pass
// it more often.
bool follows_way(const Body& a, const Body& b, bool fast) {
    return fast ? !a.jointed && !b.jointed : keeps_side(a, b);
}

// Where its bodies are now, with what it pushed before; `side` is the normal that it had.
void find_points(const lks_world& world, Contact& contact, const Direction& side) {
    const RigidScene& scene = world.rigid;
    const Body& a = scene.bodies[contact.key.body_a];
    const bool with_collider = contact.key.other >= other_is_collider;
    const std::uint32_t index = contact.key.other & ~other_is_collider;
    const Body& b = with_collider ? scene.collider_bodies[index] : scene.bodies[index];
    const BodyDescription& description = scene.descriptions[contact.key.body_a];
    const BodyShape& shape_a = description.shapes[contact.key.shapes / LKS_MAX_BODY_SHAPES];
    const Piece piece_a = piece_of_body(a, shape_a, a.position);
    const Piece piece_b =
        with_collider
            ? piece_of_collider(b, world.colliders[index].collider, a.position)
            : piece_of_body(b, scene.descriptions[index].shapes[contact.key.shapes % LKS_MAX_BODY_SHAPES],
                            a.position);
    const auto n = static_cast<std::int64_t>(world.rate.substeps_per_second);
    const std::int64_t radius_b = with_collider ? reach(piece_b) : scene.descriptions[index].radius;
    const std::int64_t motion = (greatest_speed(a, description.radius) + greatest_speed(b, radius_b)) / n;
    const std::int64_t spins = (spin_speed(a, description.radius) + spin_speed(b, radius_b)) / n;
    Manifold manifold;
    manifold.normal = contact.normal();
    manifold.count = 0;
    const bool keeps = keeps_side(a, b);
    const Vec3 way = way_in(saturating_subtract(b.velocity, a.velocity), n);
    const std::int64_t room = spins + near_distance + (keeps ? aside(sum_of_magnitudes(way)) : 0);
    if (piece_b.kind == LKS_SHAPE_PLANE ||
        !passes_by(saturating_subtract(piece_b.centre, piece_a.centre), way,
                   room_around(extent(piece_a), extent(piece_b), room))) {
        collide_on_way(piece_a, piece_b, follows_way(a, b, contact.fast) ? way : Vec3{0, 0, 0},
                       motion + near_distance, keeps ? side : no_side, manifold);
    }
    ContactPush old_pushes[greatest_point_count];
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        old_pushes[i] = contact.points[i].push;
    }
    take_manifold(contact, {old_pushes, contact.count}, manifold, a, b);
}

// Of surfaces that touch: a millimetre.
constexpr std::int64_t touching_distance = (std::int64_t{1} << world_fraction_bits) / 1000;

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

    // False: somebody was woken, and it has to be done again.
    bool run() {
        find_pairs();
        scene_.contacts.clear();
        scene_.contact_points.clear();
        next_memory_ = 0;
        woken_ = false;
        if (team_ == nullptr || !find_by_team()) {
            for (const std::uint64_t pair : scene_.pairs) {
                for_each_found(pair, [this](const FoundContact& found) { add_contact(found); });
            }
        }
        return !woken_;
    }

private:
    std::int64_t per_tick(std::int64_t speed) const {
        return speed / static_cast<std::int64_t>(world_.rate.ticks_per_second);
    }
    Vec3 way_in_tick(const Body& body) const { return way_in(body.velocity, world_.rate.ticks_per_second); }
    // Of b against a.
    Vec3 way_between(std::uint32_t a, std::uint32_t other) const {
        const Vec3 way =
            other >= other_is_collider ? way_in_tick(other_body(scene_, other)) : scene_.ways[other];
        return saturating_subtract(way, scene_.ways[a]);
    }

    // Its shapes around its centre of mass, and how far they go beside its velocity.
    void place_pieces() {
        scene_.pieces.clear();
        scene_.piece_extents.clear();
        scene_.piece_starts.clear();
        scene_.travels.clear();
        scene_.ways.clear();
        for (std::uint32_t i = 0; i < scene_.bodies.size(); ++i) {
            const Body& body = scene_.bodies[i];
            const BodyDescription& description = scene_.descriptions[i];
            scene_.piece_starts.push_reserved(static_cast<std::uint32_t>(scene_.pieces.size()));
            for (std::uint32_t shape = 0; shape < description.shape_count; ++shape) {
                const Piece placed = piece_of_body(body, description.shapes[shape], body.position);
                scene_.pieces.push_reserved(placed);
                scene_.piece_extents.push_reserved(extent(placed));
            }
            scene_.travels.push_reserved(per_tick(spin_speed(body, description.radius)) + fall(i));
            scene_.ways.push_reserved(way_in_tick(body));
        }
    }

    // What gravity adds to its way in a tick, beyond what is near: with few ticks a second.
    std::int64_t fall(std::uint32_t index) const {
        if (!scene_.bodies[index].is_awake()) {
            return 0;
        }
        const std::int64_t step = sum_of_magnitudes(scene_.ticks[index].gravity_step);
        const std::int64_t way = per_tick(fixed::saturate_to_int64(
            fixed::multiply_signed(step, static_cast<std::int64_t>(world_.rate.substeps))));
        return std::max<std::int64_t>(0, way - near_distance);
    }

    const Piece& piece(std::uint32_t body, std::uint32_t shape) const {
        return scene_.pieces[scene_.piece_starts[body] + shape];
    }
    const Vec3& piece_extent(std::uint32_t body, std::uint32_t shape) const {
        return scene_.piece_extents[scene_.piece_starts[body] + shape];
    }

    // A body's box in this tick, with half of the room of a pair.
    Box box_of_body(std::uint32_t index) const {
        const Body& body = scene_.bodies[index];
        const Vec3& way = scene_.ways[index];
        const std::int64_t room = near_distance / 2 + scene_.travels[index] + aside(sum_of_magnitudes(way));
        Box box{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
        for (std::uint32_t i = 0; i < scene_.descriptions[index].shape_count; ++i) {
            const Vec3 reach = piece_extent(index, i) + Vec3{room, room, room};
            const Vec3 centre = body.position + piece(index, i).centre;
            include(box, centre, reach);
            include(box, saturating_add(centre, way), reach);
            if (!body.is_dynamic()) {
                // However it turns on its way.
                const std::int64_t radius = scene_.descriptions[index].radius + near_distance / 2;
                include(box, body.position, {radius, radius, radius});
                include(box, body.target_position, {radius, radius, radius});
            }
        }
        return box;
    }

    static void include(Box& box, const Vec3& p, const Vec3& reach) {
        const Vec3 low = saturating_subtract(p, reach);
        const Vec3 high = saturating_add(p, reach);
        box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
        box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y), std::max(box.high.z, high.z)};
    }

    void find_pairs() {
        place_pieces();
        scene_.overlaps.clear();
        scene_.boxed.clear();
        scene_.pairs.clear();
        for (std::uint32_t i = 0; i < scene_.bodies.size(); ++i) {
            if (scene_.body_slots[i].used) {
                scene_.overlaps.add(box_of_body(i));
                scene_.boxed.push_reserved(i);
            }
        }
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            add_collider(i);
        }
        scene_.overlaps.for_each_pair(
            [this](std::uint32_t i, std::uint32_t j) { add_pair(scene_.boxed[i], scene_.boxed[j]); });
        sort_numbers(scene_.pairs, scene_.sorting);
    }

    // Planes meet everybody; what is above them is found out with the points.
    void add_collider(std::uint32_t index) {
        if (!world_.colliders[index].used) {
            return;
        }
        const ColliderState& collider = world_.colliders[index].collider;
        if (collider.shape.kind == LKS_SHAPE_PLANE) {
            for (std::uint32_t body = 0; body < scene_.bodies.size(); ++body) {
                if (scene_.body_slots[body].used && near_plane(body, index)) {
                    add_pair(body, index | other_is_collider);
                }
            }
            return;
        }
        const std::int64_t room =
            world_from_coordinate(bounding_radius(collider.shape, 0)) + 1 + near_distance / 2;
        const Vec3& p = collider.position;
        Box box{{p.x - room, p.y - room, p.z - room}, {p.x + room, p.y + room, p.z + room}};
        include(box, collider.target_position, {room, room, room});
        scene_.overlaps.add(box);
        scene_.boxed.push_reserved(index | other_is_collider);
    }

    bool near_plane(std::uint32_t index, std::uint32_t collider_index) const {
        const ColliderState& collider = world_.colliders[collider_index].collider;
        const Body& body = scene_.bodies[index];
        const std::int64_t room = scene_.descriptions[index].radius + near_distance + scene_.travels[index] +
                                  sum_of_magnitudes(scene_.ways[index]);
        const auto below = [&](const fixed::Rotation& rotation, const Vec3& position) {
            const fixed::Int128 height = height_above_plane(plane_normal(fixed::to_matrix(rotation)),
                                                            position, body.position, Vec3{0, 0, 0});
            return height <= fixed::to_int128(room) << (height_fraction_bits - world_fraction_bits);
        };
        return collider.rotates() || below(collider.rotation, collider.position) ||
               below(collider.target_rotation, collider.target_position);
    }

    // One of them is a body, and stands first.
    void add_pair(std::uint32_t a, std::uint32_t b) {
        if (a >= other_is_collider) {
            std::swap(a, b);
        }
        if (a >= other_is_collider || !may_collide(a, b)) {
            return;
        }
        // By the state alone, not by how much memory happens to be there.
        if (scene_.pairs.size() >= pair_capacity(scene_.bodies.size())) {
            ++world_.counters.lost_contacts;
            return;
        }
        scene_.pairs.push_reserved(std::uint64_t{a} << 32 | b);
    }

    bool may_collide(std::uint32_t a, std::uint32_t b) const {
        const Body& body = scene_.bodies[a];
        if (b >= other_is_collider) {
            return body.is_dynamic() && (body.is_active() || collider_of(b).moves()) &&
                   filters_meet(scene_.descriptions[a].filter, collider_of(b).filter);
        }
        const Body& other = scene_.bodies[b];
        if ((!body.is_dynamic() && !other.is_dynamic()) || (!body.is_active() && !other.is_active())) {
            return false;
        }
        if (scene_.are_jointed(a, b)) {
            return false;
        }
        return filters_meet(scene_.descriptions[a].filter, scene_.descriptions[b].filter);
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
        const Vec3 way = way_between(a, other);
        const std::int64_t travel = sum_of_magnitudes(way);
        const std::int64_t room = near_distance + spins + (keeps_side(body_a, body_b) ? aside(travel) : 0);
        const Vec3 between = body_b.position - body_a.position;
        for (std::uint32_t i = 0; i < description_a.shape_count; ++i) {
            for (std::uint32_t j = 0; j < shapes_b; ++j) {
                Piece piece_b;
                if (with_collider) {
                    piece_b = piece_of_collider(body_b, collider_of(other), body_a.position);
                    if (piece_b.kind != LKS_SHAPE_PLANE &&
                        passes_by(saturating_subtract(piece_b.centre, piece(a, i).centre), way,
                                  room_around(piece_extent(a, i), extent(piece_b), room))) {
                        continue;
                    }
                } else {
                    const Vec3 centre = piece(other, j).centre + between;
                    if (passes_by(saturating_subtract(centre, piece(a, i).centre), way,
                                  room_around(piece_extent(a, i), piece_extent(other, j), room))) {
                        continue;
                    }
                    piece_b = piece(other, j);
                    piece_b.centre = centre;
                }
                FoundContact found;
                found.key = {a, other, i * LKS_MAX_BODY_SHAPES + j};
                if (touches({piece(a, i), piece_b}, {body_a, body_b}, way, spins, found)) {
                    use(found);
                }
            }
        }
    }

    // How far the points of a collider that turns go at most.
    std::int64_t collider_turns(const Body& body, std::uint32_t other) const {
        if (body.angular_velocity == Vec3{0, 0, 0} && !collider_of(other).rotates()) {
            return 0;
        }
        const Shape& shape = collider_of(other).shape;
        const bool plane = shape.kind == LKS_SHAPE_PLANE;
        const std::int64_t lever = plane ? LKS_FIXED(64) : world_from_coordinate(bounding_radius(shape, 0));
        // A collider turns by a quarter at most in a tick.
        return 2 * lever;
    }

    const ColliderState& collider_of(std::uint32_t other) const {
        return world_.colliders[other & ~other_is_collider].collider;
    }

    Surface surface_of(std::uint32_t other) const {
        if (other < other_is_collider) {
            return scene_.descriptions[other].surface;
        }
        const ColliderState& collider = collider_of(other);
        return {collider.static_friction, collider.dynamic_friction, collider.restitution};
    }

    // Whatever of it is pushed, something else of it goes in.
    static bool sticks(const Manifold& manifold) {
        return std::any_of(manifold.points, manifold.points + manifold.count,
                           [](const ManifoldPoint& point) { return point.separation < -sticking_depth; });
    }

    static bool is_round(const Piece& piece) {
        return piece.kind == LKS_SHAPE_SPHERE || piece.kind == LKS_SHAPE_CAPSULE;
    }
    struct Pieces {
        const Piece& a;
        const Piece& b;
    };
    struct Bodies {
        const Body& a;
        const Body& b;
    };

    // Whether the way that they push each other turns in this tick: of round surfaces by more than a 64th.
    // Balls that pass each other off centre would part as if they had met where the tick began: 5° astray at
    // 5 m/s. Of what is about to meet a box by more than a 16th: its edge would be a wall that goes on.
    static bool normal_turns(const Pieces& pieces, const Bodies& bodies, const Manifold& manifold,
                             const Vec3& way) {
        const Piece& a = pieces.a;
        const Piece& b = pieces.b;
        if (b.kind == LKS_SHAPE_PLANE) {
            return false;
        }
        const Vec3 aside = way - fixed::scale(manifold.normal, fixed::dot(manifold.normal, way));
        if (is_round(a) && is_round(b)) {
            return !bodies.a.jointed && !bodies.b.jointed &&
                   sum_of_magnitudes(aside) > (a.radius + b.radius) / 64;
        }
        std::int64_t gap = INT64_MAX;
        for (std::uint32_t i = 0; i < manifold.count; ++i) {
            gap = std::min(gap, manifold.points[i].separation);
        }
        return keeps_side(bodies.a, bodies.b) && manifold.count != 0 && gap > touching_distance &&
               sum_of_magnitudes(aside) > (a.radius + b.radius + gap) / 16;
    }

    // `way`: of b against a in this tick, `spins`: how far they turn each other's points at most.
    static bool touches(const Pieces& pieces, const Bodies& bodies, const Vec3& way, std::int64_t spins,
                        FoundContact& found) {
        const Piece& a = pieces.a;
        const Piece& b = pieces.b;
        const std::int64_t motion = sum_of_magnitudes(way) + spins;
        // One look a tick is enough where neither passes the other's middle in it, and where what is inside
        // the other does not turn out of it.
        const bool fast = motion > fixed::saturating_add(thickness(a), thickness(b));
        found.radius_a = a.radius;
        found.radius_b = b.radius;
        found.manifold.normal = {0, 0, 0};
        found.manifold.count = 0;
        collide_on_way(a, b, follows_way(bodies.a, bodies.b, fast) ? way : Vec3{0, 0, 0},
                       motion + near_distance, no_side, found.manifold);
        // Boxes beside each other show no points, and may yet meet at their edges.
        const bool unclear = fast && found.manifold.count == 0;
        drop_what_stays_apart(found.manifold, way, spins);
        found.fast = fast;
        found.every_substep =
            fast || sticks(found.manifold) || normal_turns(pieces, bodies, found.manifold, way);
        return found.manifold.count != 0 || unclear;
    }

    void add_contact(const FoundContact& found) {
        const ContactKey& key = found.key;
        while (next_memory_ < scene_.memories.size() && scene_.memories[next_memory_].key < key) {
            ++next_memory_;
        }
        const bool known = next_memory_ < scene_.memories.size() && scene_.memories[next_memory_].key == key;
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
        const Surface& own = scene_.descriptions[key.body_a].surface;
        const Surface other = surface_of(key.other);
        contact.static_friction = combined_friction(own.static_friction, other.static_friction);
        contact.dynamic_friction = combined_friction(own.dynamic_friction, other.dynamic_friction);
        contact.restitution = std::max(own.restitution, other.restitution);
        std::span<const ContactPush> old_pushes;
        Direction side = no_side;
        if (known && scene_.memories[next_memory_].forgotten == 0) {
            const ContactMemory& memory = scene_.memories[next_memory_];
            old_pushes = {memory.pushes, memory.count};
            side = keeps_side(body_a, body_b) ? memory.normal : no_side;
        }
        const bool passed = against(found.manifold.normal, side);
        contact.every_substep = found.every_substep || passed;
        const std::size_t first_point = scene_.contact_points.size();
        scene_.contact_points.extend_reserved(point_room(contact.every_substep, found.manifold));
        contact.points = scene_.contact_points.begin() + first_point;
        take_manifold(contact, old_pushes, found.manifold, body_a, body_b);
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
        const std::int64_t closing = per_tick(-fixed::dot(manifold.normal, b.velocity - a.velocity));
        // What has just been woken is about to be pushed: its neighbours are not to stand like walls.
        const bool comes = (a.is_awake() || b.is_awake()) &&
                           (closing > per_tick(gentle_speed) || a.has_woken() || b.has_woken());
        const bool carried = !a.is_dynamic() || !b.is_dynamic();
        for (std::uint32_t i = 0; (comes || carried) && i < manifold.count; ++i) {
            if (manifold.points[i].separation <= touching_distance + std::max<std::int64_t>(closing, 0)) {
                wake(a.asleep != 0 ? a : b);
                woken_ = true;
                return true;
            }
        }
        return !a.is_awake() && !b.is_awake();
    }

    // Of the motion that the search allowed for, only what closes the gap counts.
    static void drop_what_stays_apart(Manifold& manifold, const Vec3& way, std::int64_t spins) {
        const std::int64_t closing = std::max<std::int64_t>(0, -fixed::dot(manifold.normal, way));
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < manifold.count; ++i) {
            if (manifold.points[i].separation <= near_distance + closing + spins) {
                manifold.points[kept++] = manifold.points[i];
            }
        }
        manifold.count = kept;
    }

    lks_world& world_;
    RigidScene& scene_;
    Team* team_;
    std::size_t next_memory_ = 0;
    bool woken_ = false;
};

} // namespace

Body& other_body(RigidScene& scene, std::uint32_t other) {
    return other >= other_is_collider ? scene.collider_bodies[other & ~other_is_collider]
                                      : scene.bodies[other];
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
    while (!Search(world, team).run()) {
        wake_islands(world);
    }
}

void wake_touched(lks_world& world, std::uint32_t body) {
    RigidScene& scene = world.rigid;
    if (scene.bodies[body].is_dynamic()) {
        return;
    }
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].asleep != 0 && !scene.are_jointed(std::min(i, body), std::max(i, body)) &&
            filters_meet(scene.descriptions[i].filter, scene.descriptions[body].filter) &&
            touch(scene, i, body)) {
            wake(scene.bodies[i]);
        }
    }
}

void find_points_again(const lks_world& world, Contact& contact) {
    find_points(world, contact, contact.count == 0 ? no_side : contact.normal());
}

} // namespace lks
