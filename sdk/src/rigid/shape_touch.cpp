#include "rigid/shape_touch.h"

#include <algorithm>

#include "collide/saturation.h"
#include "collide/shape.h"
#include "rigid/contact_search.h"
#include "rigid/meeting.h"
#include "rigid/piece_bounds.h"
#include "rigid/placed_pieces.h"
#include "rigid/ways.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::Vec3;

// Whether what they do on their way counts, and not only where they are. Joints turn the ways of two bones.
// And they draw what is fast past an edge that it would only graze: figures that are thrown at a fence pass
// it more often.
bool follows_way(const Body& a, const Body& b, bool fast) {
    return fast ? !a.jointed && !b.jointed : keeps_side(a, b);
}

// Whatever of it is pushed, something else of it goes in.
bool sticks(const Manifold& manifold) {
    return std::any_of(manifold.points, manifold.points + manifold.count,
                       [](const ManifoldPoint& point) { return point.separation < -sticking_depth; });
}

bool is_round(const Piece& piece) {
    return piece.kind == LKS_SHAPE_SPHERE || piece.kind == LKS_SHAPE_CAPSULE;
}

// Whether the way that they push each other turns in this tick: of round surfaces by more than a 64th.
// Balls that pass each other off centre would part as if they had met where the tick began: 5° astray at
// 5 m/s. Of what is about to meet a box by more than a 16th: its edge would be a wall that goes on.
bool normal_turns(const PiecePair& pieces, const BodyPair& bodies, const Manifold& manifold, const Vec3& way,
                  std::int64_t strikes) {
    const Piece& a = pieces.a;
    const Piece& b = pieces.b;
    if (b.kind == LKS_SHAPE_PLANE) {
        return false;
    }
    const Vec3 across = way - fixed::scale(manifold.normal, fixed::dot(manifold.normal, way));
    std::int64_t gap = INT64_MAX;
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        gap = std::min(gap, manifold.points[i].separation);
    }
    // Who is struck where he lies meets nobody on his way whom he does not push already.
    const std::int64_t turning = sum_of_magnitudes(across) + (gap > touching_distance ? strikes : 0);
    if (is_round(a) && is_round(b)) {
        return !bodies.a.jointed && !bodies.b.jointed && turning > (a.radius + b.radius) / 64;
    }
    return keeps_side(bodies.a, bodies.b) && manifold.count != 0 && gap > touching_distance &&
           turning > (a.radius + b.radius + gap) / 16;
}

// Of the motion that the search allowed for, only what closes the gap counts.
void drop_what_stays_apart(Manifold& manifold, const Vec3& way, std::int64_t spins) {
    const std::int64_t closing = std::max<std::int64_t>(0, -fixed::dot(manifold.normal, way));
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        if (manifold.points[i].separation <= near_distance + closing + spins) {
            manifold.points[kept++] = manifold.points[i];
        }
    }
    manifold.count = kept;
}

// What gravity adds to the way of a substep, beyond what is near: in long ones.
std::int64_t fall_in_substep(const lks_world& world, std::uint32_t body) {
    const RigidScene& scene = world.rigid;
    const auto n = static_cast<std::int64_t>(world.rate.substeps_per_second);
    return scene.bodies[body].is_awake()
               ? std::max<std::int64_t>(0,
                                        sum_of_magnitudes(scene.ticks[body].gravity_step) / n - near_distance)
               : 0;
}

} // namespace

bool touches(const PiecePair& pieces, const BodyPair& bodies, const Vec3& way, std::int64_t spins,
             const StrikesOfPair& strikes, FoundContact& found) {
    const Piece& a = pieces.a;
    const Piece& b = pieces.b;
    const std::int64_t struck = strikes.a.way + strikes.b.way;
    const std::int64_t motion = sum_of_magnitudes(way) + spins + struck;
    // One look a tick is enough where neither passes the other's middle in it, and where what is inside
    // the other does not turn out of it.
    const bool fast = motion > fixed::saturating_add(thickness(a), thickness(b));
    found.radius_a = a.radius;
    found.radius_b = b.radius;
    found.manifold.normal = {0, 0, 0};
    found.manifold.count = 0;
    collide_on_way(a, b, follows_way(bodies.a, bodies.b, fast) ? way : Vec3{0, 0, 0}, motion + near_distance,
                   no_side, found.manifold);
    // Boxes beside each other show no points, and may yet meet at their edges.
    const bool unclear = fast && found.manifold.count == 0;
    drop_what_stays_apart(found.manifold, way, spins + struck_closing(strikes, found.manifold.normal).way);
    found.fast = fast;
    found.every_substep =
        fast || sticks(found.manifold) || normal_turns(pieces, bodies, found.manifold, way, struck);
    return found.manifold.count != 0 || unclear;
}

void find_points(const lks_world& world, Contact& contact, const Direction& side) {
    const RigidScene& scene = world.rigid;
    const Body& a = scene.bodies[contact.key.body_a];
    const std::uint32_t other = contact.key.other;
    const bool with_collider = other >= other_is_collider;
    const Body& b = other_body(scene, other);
    const BodyDescription& description = scene.descriptions[contact.key.body_a];
    const BodyShape& shape_a = description.shapes[contact.key.shapes / LKS_MAX_BODY_SHAPES];
    const Piece piece_a = piece_of_body(a, shape_a, a.position);
    const Piece piece_b =
        with_collider
            ? piece_of_collider(b, collider_of(world, other), a.position)
            : piece_of_body(b, scene.descriptions[other].shapes[contact.key.shapes % LKS_MAX_BODY_SHAPES],
                            a.position);
    const auto n = static_cast<std::int64_t>(world.rate.substeps_per_second);
    const std::int64_t radius_b = with_collider ? reach(piece_b) : scene.descriptions[other].radius;
    const std::int64_t falls =
        fall_in_substep(world, contact.key.body_a) + (with_collider ? 0 : fall_in_substep(world, other));
    const std::int64_t spins =
        turn_in(a, description.radius, n, world.rate) + turn_in(b, radius_b, n, world.rate);
    const Vec3 way = way_in_substep(a, b, world.rate);
    const std::int64_t motion =
        falls + std::max((greatest_speed(a, description.radius) + greatest_speed(b, radius_b)) / n,
                         sum_of_magnitudes(way) + spins);
    Manifold manifold;
    manifold.normal = contact.normal();
    manifold.count = 0;
    const bool keeps = keeps_side(a, b);
    const std::int64_t room = spins + falls + near_distance + (keeps ? aside(sum_of_magnitudes(way)) : 0);
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
    take_manifold(contact, {{old_pushes, contact.count}, contact.normal()}, manifold, a, b);
}

void find_points_again(const lks_world& world, Contact& contact) {
    find_points(world, contact, contact.count == 0 ? no_side : contact.normal());
}

} // namespace lks
