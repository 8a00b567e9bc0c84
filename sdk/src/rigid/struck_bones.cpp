#include "rigid/struck_bones.h"

#include <algorithm>

#include "collide/filter.h"
#include "collide/saturation.h"
#include "collide/shape.h"
#include "rigid/contact_search.h"
#include "rigid/piece_bounds.h"
#include "rigid/placed_pieces.h"
#include "rigid/strikes.h"
#include "rigid/ways.h"

namespace lks {
namespace {

using fixed::Vec3;

bool is_wall(const RigidScene& scene, std::uint32_t body) {
    return scene.body_slots[body].used && !scene.bodies[body].jointed;
}

bool is_wall(const ColliderSlot& slot) {
    return slot.used && slot.collider.shape.kind != LKS_SHAPE_PLANE;
}

std::int64_t thickness_of(const ColliderState& collider) {
    return world_from_coordinate(thickness(collider.shape));
}

std::int64_t thickness_of_wall(const lks_world& world, std::uint32_t other) {
    return other < other_is_collider ? world.rigid.descriptions[other].thickness
                                     : thickness_of(collider_of(world, other));
}

Box box_around(const Vec3& centre, const Vec3& way, const Vec3& reach) {
    Box box = empty_box;
    include(box, centre, reach);
    include(box, saturating_add(centre, way), reach);
    return box;
}

Box box_around(const Vec3& centre, const Vec3& way, std::int64_t reach) {
    return box_around(centre, way, Vec3{reach, reach, reach});
}

// On its way in this tick.
Box box_of_collider(const lks_world& world, std::uint32_t other) {
    const ColliderState& collider = collider_of(world, other);
    const Vec3 way = saturating_subtract(collider.target_position, collider.position);
    const Piece piece = piece_of_collider(other_body(world.rigid, other), collider, collider.position);
    if (collider.rotates()) {
        return box_around(collider.position, way, reach(piece));
    }
    return box_around(collider.position, way, extent(piece));
}

class BonesNearWalls {
public:
    explicit BonesNearWalls(lks_world& world) : world_(world), scene_(world.rigid) {}

    void find() {
        if (!add_struck_bones()) {
            return;
        }
        const std::size_t bones = scene_.boxed.size();
        add_walls();
        scene_.overlaps.for_each_pair([&](std::uint32_t i, std::uint32_t j) {
            if (i < bones && j >= bones) {
                meet(scene_.boxed[i], scene_.boxed[j]);
            }
        });
    }

private:
    // False: there is none.
    bool add_struck_bones() {
        scene_.overlaps.clear();
        scene_.boxed.clear();
        for (std::uint32_t i = 0; i < scene_.bodies.size(); ++i) {
            const Strike& strike = scene_.spread_strikes[i];
            if (scene_.bodies[i].jointed && strike.way >= least_way_through(scene_, i)) {
                const std::int64_t room = scene_.descriptions[i].radius + near_distance + strike.way;
                add(box_around(scene_.bodies[i].position, scene_.ways[i], room), i);
            }
        }
        return !scene_.boxed.empty();
    }

    void add_walls() {
        for (std::uint32_t i = 0; i < scene_.bodies.size(); ++i) {
            if (is_wall(scene_, i)) {
                const std::int64_t room = scene_.descriptions[i].radius + scene_.spread_strikes[i].way;
                add(box_around(scene_.bodies[i].position, scene_.ways[i], room), i);
            }
        }
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            if (is_wall(world_.colliders[i])) {
                const std::uint32_t other = i | other_is_collider;
                add(box_of_collider(world_, other), other);
            }
        }
    }

    void add(const Box& box, std::uint32_t who) {
        scene_.overlaps.add(box);
        scene_.boxed.push_reserved(who);
    }

    void meet(std::uint32_t bone, std::uint32_t wall) {
        const lks_filter& filter =
            wall < other_is_collider ? scene_.descriptions[wall].filter : collider_of(world_, wall).filter;
        Strike& strike = scene_.spread_strikes[bone];
        strike.is_near_wall =
            strike.is_near_wall ||
            (filters_meet(scene_.descriptions[bone].filter, filter) &&
             strike.way >= scene_.descriptions[bone].thickness + thickness_of_wall(world_, wall));
    }

    lks_world& world_;
    RigidScene& scene_;
};

// Of anything in this tick.
std::int64_t greatest_way(const lks_world& world) {
    const RigidScene& scene = world.rigid;
    std::int64_t greatest = 0;
    const auto look = [&greatest](const Vec3& way, std::int64_t beside) {
        greatest = std::max(greatest, fixed::saturating_add(sum_of_magnitudes(way), beside));
    };
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        look(scene.ways[i], scene.travels[i]);
    }
    for (const ColliderSlot& slot : world.colliders) {
        if (slot.used && slot.collider.moves()) {
            look(saturating_subtract(slot.collider.target_position, slot.collider.position),
                 slot.collider.rotates() ? quarter_turn(slot.collider) : 0);
        }
    }
    return greatest;
}

// Of one that the other is added to.
Strike carried_with(const Strike& now, const Strike& other) {
    Strike both = now;
    both.anywhere = goes_elsewhere(now, other.along) || other.anywhere;
    both.way = other.way;
    both.speed = std::max(now.speed, other.speed);
    both.along = other.along;
    return both;
}

} // namespace

void find_thinnest_wall(lks_world& world) {
    RigidScene& scene = world.rigid;
    scene.thinnest_wall = INT64_MAX;
    if (scene.joints.empty()) {
        return;
    }
    // Two that meet close by both their ways, and what is struck goes off by twice that at most.
    const std::int64_t farthest = saturating_double(saturating_double(greatest_way(world)));
    if (farthest <= least_shape_size) {
        return;
    }
    const auto look = [&](std::int64_t thickness) {
        if (thickness < farthest) {
            scene.thinnest_wall = std::min(scene.thinnest_wall, thickness);
        }
    };
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (is_wall(scene, i)) {
            look(scene.descriptions[i].thickness);
        }
    }
    for (const ColliderSlot& slot : world.colliders) {
        if (is_wall(slot)) {
            look(thickness_of(slot.collider));
        }
    }
}

std::int64_t least_way_through(const RigidScene& scene, std::uint32_t bone) {
    return fixed::saturating_add(scene.descriptions[bone].thickness, scene.thinnest_wall);
}

void carry_figures(RigidScene& scene) {
    Array<Strike>& strikes = scene.spread_strikes;
    const auto carry = [&](std::uint32_t from, std::uint32_t to) {
        if (scene.bodies[from].jointed && strikes[from].way >= scene.thinnest_wall &&
            strikes[from].way > strikes[to].way) {
            strikes[to] = carried_with(strikes[to], strikes[from]);
        }
    };
    for (std::uint32_t i = 0; i < strikes.size(); ++i) {
        carry(i, scene.figures[i]);
    }
    for (std::uint32_t i = 0; i < strikes.size(); ++i) {
        carry(scene.figures[i], i);
    }
}

void find_bones_near_walls(lks_world& world) {
    BonesNearWalls(world).find();
}

} // namespace lks
