#include "rigid/near_pairs.h"

#include <algorithm>

#include "collide/filter.h"
#include "collide/plane_motion.h"
#include "collide/saturation.h"
#include "memory/sort_numbers.h"
#include "rigid/contact_search.h"
#include "rigid/piece_bounds.h"
#include "rigid/placed_pieces.h"
#include "rigid/ways.h"

namespace lks {
namespace {

using fixed::Vec3;

class NearPairs {
public:
    explicit NearPairs(lks_world& world) : world_(world), scene_(world.rigid) {}

    void find() {
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

private:
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
            scene_.travels.push_reserved(
                turn_in(body, description.radius, world_.rate.ticks_per_second, world_.rate) + fall(i));
            scene_.ways.push_reserved(way_in_tick(body, world_.rate));
        }
    }

    // What gravity adds to its way in a tick, beyond what is near: with few ticks a second.
    std::int64_t fall(std::uint32_t index) const {
        if (!scene_.bodies[index].is_awake()) {
            return 0;
        }
        const std::int64_t way = sum_of_magnitudes(fall_in_tick(scene_.ticks[index], world_.rate));
        return std::max<std::int64_t>(0, way - near_distance);
    }

    // A body's box in this tick, with half of the room of a pair.
    Box box_of_body(std::uint32_t index) const {
        const Body& body = scene_.bodies[index];
        const Vec3& way = scene_.ways[index];
        const StruckWay struck = struck_way(scene_.strikes[index]);
        const std::int64_t room =
            near_distance / 2 + scene_.travels[index] + struck.room + aside(sum_of_magnitudes(way));
        Box box = empty_box;
        for (std::uint32_t i = 0; i < scene_.descriptions[index].shape_count; ++i) {
            const Vec3 reach = scene_.piece_extent(index, i) + Vec3{room, room, room};
            const Vec3 centre = body.position + scene_.piece(index, i).centre;
            include(box, centre, reach);
            include(box, saturating_add(centre, way), reach);
            if (!(struck.drive == Vec3{0, 0, 0})) {
                include(box, saturating_add(centre, struck.drive), reach);
                include(box, saturating_add(saturating_add(centre, way), struck.drive), reach);
            }
            if (!body.is_dynamic()) {
                // However it turns on its way.
                const std::int64_t radius = scene_.descriptions[index].radius + near_distance / 2;
                include(box, body.position, {radius, radius, radius});
                include(box, body.target_position, {radius, radius, radius});
            }
        }
        return box;
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
                                  scene_.strikes[index].way + sum_of_magnitudes(scene_.ways[index]);
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
        if (b < other_is_collider) {
            mark_beside_sleeper(a, b);
        }
        // By the state alone, not by how much memory happens to be there.
        if (scene_.pairs.size() >= pair_capacity(scene_.bodies.size())) {
            ++world_.counters.lost_contacts;
            return;
        }
        scene_.pairs.push_reserved(std::uint64_t{a} << 32 | b);
    }

    // At most one of them sleeps.
    void mark_beside_sleeper(std::uint32_t a, std::uint32_t b) {
        const bool a_sleeps = scene_.bodies[a].asleep != 0;
        if (a_sleeps || scene_.bodies[b].asleep != 0) {
            scene_.strikes[a_sleeps ? b : a].beside_sleeper = true;
            scene_.any_beside_sleeper = true;
        }
    }

    bool may_collide(std::uint32_t a, std::uint32_t b) const {
        const Body& body = scene_.bodies[a];
        if (b >= other_is_collider) {
            return body.is_dynamic() && (body.is_active() || collider_of(world_, b).moves()) &&
                   filters_meet(scene_.descriptions[a].filter, collider_of(world_, b).filter);
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

    lks_world& world_;
    RigidScene& scene_;
};

} // namespace

void find_near_pairs(lks_world& world) {
    NearPairs(world).find();
}

} // namespace lks
