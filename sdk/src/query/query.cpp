#include "query/query.h"

#include <algorithm>

#include "collide/filter.h"
#include "collide/plane_motion.h"
#include "collide/saturation.h"
#include "collide/trace.h"
#include "query/near_particles.h"
#include "query/near_way.h"
#include "rigid/attachment.h"
#include "rigid/body_motion.h"
#include "rigid/placed_shape.h"

namespace lks {
namespace {

using fixed::Vec3;

// A hit is accepted this close in front of the surface: a micrometre.
constexpr std::int64_t tolerance = std::int64_t{1} << (world_fraction_bits - 20);

// Calls use(placed, hit) for all that the query is about; the hit says what it is.
class Everything {
public:
    // The way of the query's ball, from here to there or where it is.
    Everything(const lks_world& world, const lks_query& query, const Vec3& from, const Vec3& to)
        : world_(world), query_(query), way_{from, to, query.radius}, box_(way_.box()),
          halvings_(way_.halvings()) {}

    template <typename Use>
    void visit(const Use& use) const {
        if (wants(LKS_HIT_COLLIDER)) {
            visit_colliders(use);
        }
        if (wants(LKS_HIT_BODY)) {
            visit_bodies(use);
        }
        if (wants(LKS_HIT_PARTICLE)) {
            visit_particles(use);
        }
    }

private:
    bool wants(lks_hit_kind kind) const { return (query_.kinds & LKS_HIT_BIT(kind)) != 0; }

    template <typename Use>
    void visit_colliders(const Use& use) const {
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            const ColliderSlot& slot = world_.colliders[i];
            if (!slot.used || !is_asked_for(slot.collider.filter, query_.mask) || !may_meet(slot.collider)) {
                continue;
            }
            lks_hit hit{};
            hit.kind = LKS_HIT_COLLIDER;
            hit.collider = {i, slot.generation};
            use(PlacedShape{world_shape(slot.collider.shape), slot.collider.position,
                            fixed::to_matrix(slot.collider.rotation)},
                hit);
        }
    }

    bool may_meet(const ColliderState& collider) const {
        const Shape& shape = collider.shape;
        const Vec3& half = shape.half_extents;
        const std::int64_t reach =
            world_from_coordinate(shape.radius + shape.half_length + half.x + half.y + half.z);
        return shape.kind == LKS_SHAPE_PLANE || is_near(collider.position, reach);
    }

    template <typename Use>
    void visit_bodies(const Use& use) const {
        const RigidScene& scene = world_.rigid;
        for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
            const BodyDescription& d = scene.descriptions[i];
            const lks_body_id id{i, scene.body_slots[i].generation};
            const bool ignored =
                query_.ignored.index == id.index && query_.ignored.generation == id.generation;
            if (!scene.body_slots[i].used || !is_asked_for(d.filter, query_.mask) || ignored ||
                !is_near(scene.bodies[i].position, d.radius)) {
                continue;
            }
            for (std::uint32_t part = 0; part < d.shape_count; ++part) {
                lks_hit hit{};
                hit.kind = LKS_HIT_BODY;
                hit.part = part;
                hit.body = id;
                use(place_shape(scene.bodies[i], d.shapes[part]), hit);
            }
        }
    }

    template <typename Use>
    void visit_particles(const Use& use) const {
        for (std::uint32_t i = 0; i < world_.objects.size(); ++i) {
            const Object* object = world_.objects[i].object;
            if (object == nullptr) {
                continue;
            }
            const std::int64_t radius = world_from_coordinate(object->asset().particle_radius);
            visit_near_particles(*object, *world_.kernels, way_, [&](std::uint32_t particle) {
                lks_hit hit{};
                hit.kind = LKS_HIT_PARTICLE;
                hit.part = object->asset().particle_to_vertex[particle];
                hit.object = {i, world_.objects[i].generation};
                use(PlacedShape{{LKS_SHAPE_SPHERE, radius, 0, {0, 0, 0}},
                                particle_position(*object, particle),
                                fixed::to_matrix(fixed::identity_rotation())},
                    hit);
            });
        }
    }

    // Of what lies within a radius of p.
    bool is_near(const Vec3& p, std::int64_t radius) const {
        const Box box{{p.x - radius, p.y - radius, p.z - radius}, {p.x + radius, p.y + radius, p.z + radius}};
        return box_.overlaps(box) && (halvings_ == 0 || is_near_way(way_, halvings_, box));
    }

    const lks_world& world_;
    const lks_query& query_;
    BallWay way_;
    Box box_; // of all of it
    int halvings_;
};

// What is 2,000 km away is nowhere near.
constexpr std::int64_t far_away = std::int64_t{1} << 61;
// Nothing is deeper than the world is wide. A way is shorter than what is left to the end of the range.
constexpr std::int64_t deepest = INT64_MAX - LKS_FIXED(4096);

// A plane may be anywhere: of it the height counts alone.
Vec3 to_local(const PlacedShape& placed, const Vec3& p) {
    if (placed.shape.kind == LKS_SHAPE_PLANE) {
        const std::int64_t height = world_height_above_plane(plane_normal(placed.axes), placed.centre, p);
        return {0, std::clamp(height, -deepest, far_away), 0};
    }
    Vec3 relative = saturating_subtract(p, placed.centre);
    clamp_vector(relative, far_away);
    return fixed::rotate_transposed(placed.axes, relative);
}

// In the world, of length one in World.
lks_vec3 world_normal(const PlacedShape& placed, const fixed::Direction& normal) {
    const fixed::Direction n = fixed::rotate(placed.axes, normal);
    return {world_from_direction(n.x), world_from_direction(n.y), world_from_direction(n.z)};
}

// p less a length along a normal.
lks_vec3 behind(const Vec3& p, const lks_vec3& normal, std::int64_t length) {
    const auto part = [length](std::int64_t n) {
        return fixed::multiply_shift(n, length, world_fraction_bits);
    };
    const Vec3 place = saturating_subtract(p, {part(normal.x), part(normal.y), part(normal.z)});
    return {place.x, place.y, place.z};
}

// Where no way is left to go, the shape is entered only if it is begun in.
bool trace_shape(const PlacedShape& placed, const Vec3& from, const Vec3& to, std::int64_t radius,
                 Trace& found) {
    const auto nearest_to = [&](const Vec3& p) { return nearest_surface(placed.shape, p, radius); };
    const Vec3 start = to_local(placed, from);
    found.start = nearest_to(start);
    if (found.start.distance <= 0) {
        found.hit = found.start;
        found.rest = to - from;
        return true;
    }
    return trace(nearest_to, start, start + fixed::rotate_transposed(placed.axes, to - from), tolerance,
                 found);
}

} // namespace

bool HitList::before(const lks_hit& a, const lks_hit& b) const {
    if (nearest_first_ && a.distance != b.distance) {
        return a.distance < b.distance;
    }
    const auto index = [](const lks_hit& hit) {
        return hit.kind == LKS_HIT_COLLIDER ? hit.collider.index
               : hit.kind == LKS_HIT_BODY   ? hit.body.index
                                            : hit.object.index;
    };
    return a.kind != b.kind ? a.kind < b.kind : index(a) != index(b) ? index(a) < index(b) : a.part < b.part;
}

// Until `finish`, those that are kept stand as a heap with the last of them in front.
void HitList::add(const lks_hit& hit) {
    const auto order = [this](const lks_hit& a, const lks_hit& b) { return before(a, b); };
    if (count_ < capacity_) {
        hits_[count_] = hit;
        std::push_heap(hits_, hits_ + count_ + 1, order);
    } else if (capacity_ > 0 && before(hit, hits_[0])) {
        std::pop_heap(hits_, hits_ + capacity_, order);
        hits_[capacity_ - 1] = hit;
        std::push_heap(hits_, hits_ + capacity_, order);
    }
    ++count_;
}

std::uint32_t HitList::finish() {
    std::sort_heap(hits_, hits_ + std::min(count_, capacity_),
                   [this](const lks_hit& a, const lks_hit& b) { return before(a, b); });
    return count_;
}

void cast_ball(const lks_world& world, const lks_query& query, const Vec3& from, const Vec3& to,
               HitList& hits) {
    const auto whole = static_cast<std::int64_t>(fixed::length(to - from));
    Everything(world, query, from, to).visit([&](const PlacedShape& placed, lks_hit hit) {
        Trace found{};
        if (!trace_shape(placed, from, to, query.radius, found)) {
            return;
        }
        const auto rest = static_cast<std::int64_t>(fixed::length(found.rest));
        hit.distance = std::max<std::int64_t>(whole - rest, 0);
        hit.normal = world_normal(placed, found.hit.normal);
        const Vec3 ball = to - fixed::rotate(placed.axes, found.rest);
        // The ball's centre, less its radius and what is between them.
        const bool inside = found.start.distance <= 0;
        hit.point = behind(inside ? from : ball, hit.normal, query.radius + found.hit.distance);
        hits.add(hit);
    });
}

void find_within(const lks_world& world, const lks_query& query, const Vec3& centre, HitList& hits) {
    Everything(world, query, centre, centre).visit([&](const PlacedShape& placed, lks_hit hit) {
        const SurfacePoint nearest = nearest_surface(placed.shape, to_local(placed, centre), 0);
        if (nearest.distance > query.radius) {
            return;
        }
        hit.distance = nearest.distance;
        hit.normal = world_normal(placed, nearest.normal);
        hit.point = behind(centre, hit.normal, nearest.distance);
        hits.add(hit);
    });
}

} // namespace lks
