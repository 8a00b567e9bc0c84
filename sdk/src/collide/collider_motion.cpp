#include "collide/collider_motion.h"

#include "collide/extent.h"
#include "collide/plane_motion.h"
#include "collide/saturation.h"
#include "solver/object.h"

namespace lks {
namespace {

// Centres are kept within this on each axis: particles reach 64 m and shapes 61 m, so no shape touches from
// outside.
constexpr std::int64_t centre_limit = std::int64_t{126} << world_fraction_bits;
// Beyond this at either end, the whole substep is out of reach, for a collider moves at most 100 m a tick.
constexpr std::int64_t hopeless = std::int64_t{512} << world_fraction_bits;

// Moves `from` towards `to` until its axis has the value `limit`, which lies between the two.
void move_to_limit(fixed::Vec3& from, const fixed::Vec3& to, int axis, std::int64_t limit) {
    fixed::Vec3 end = to;
    const std::int64_t done = limit - component(from, axis);
    const std::int64_t whole = component(end, axis) - component(from, axis);
    for (int other = 0; other < 3; ++other) {
        std::int64_t& value = component(from, other);
        value += fixed::multiply_divide(component(end, other) - value, done, whole);
    }
    component(from, axis) = limit;
}

bool is_hopeless(const fixed::Vec3& v) {
    return fixed::magnitude(v.x) > hopeless || fixed::magnitude(v.y) > hopeless ||
           fixed::magnitude(v.z) > hopeless;
}

// Cuts the way from a to b down to what lies within the limit of centres. False: nothing. Only colliders that
// cover tens of metres in one substep are ever cut; the particle then covers its own way while the collider
// covers the rest of its.
bool cut_to_limit(fixed::Vec3& a, fixed::Vec3& b) {
    if (is_hopeless(a) || is_hopeless(b)) {
        return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (const std::int64_t limit : {centre_limit, -centre_limit}) {
            const auto outside = [axis, limit](fixed::Vec3& v) {
                return limit > 0 ? component(v, axis) > limit : component(v, axis) < limit;
            };
            if (outside(a) && outside(b)) {
                return false;
            }
            if (outside(a)) {
                move_to_limit(a, b, axis, limit);
            } else if (outside(b)) {
                move_to_limit(b, a, axis, limit);
            }
        }
    }
    return true;
}

fixed::Vec3 to_coordinate(const fixed::Vec3& v) {
    return {coordinate_from_world(v.x), coordinate_from_world(v.y), coordinate_from_world(v.z)};
}

fixed::Vec3 position_at(const ColliderState& collider, std::uint32_t substep, std::uint32_t substeps) {
    const fixed::Vec3& a = collider.position;
    const fixed::Vec3& b = collider.target_position;
    return {interpolate_position(a.x, b.x, substep, substeps),
            interpolate_position(a.y, b.y, substep, substeps),
            interpolate_position(a.z, b.z, substep, substeps)};
}

fixed::Rotation rotation_at(const ColliderState& collider, std::uint32_t substep, std::uint32_t substeps) {
    if (substep == 0 || !collider.rotates()) {
        return collider.rotation;
    }
    if (substep == substeps) {
        return collider.target_rotation;
    }
    return fixed::interpolate(collider.rotation, collider.target_rotation, substep, substeps);
}

// A bound of |end - start| of two rotation matrices, 2·sin(angle/2), Q30, rounded up: for a rotation that
// norm is the root of half the sum of the squares of all entries; 3/4 instead of 0.7071 leaves room for the
// matrices' own rounding.
std::int64_t turn_bound(const fixed::Matrix3& start, const fixed::Matrix3& end) {
    std::uint64_t sum = 0;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const std::int64_t difference = std::int64_t{end.m[row][column]} - start.m[row][column];
            const std::uint64_t size = (fixed::magnitude(difference) >> 2) + 1;
            sum += size * size;
        }
    }
    return (std::int64_t{fixed::square_root(sum)} + 1) * 3 + 4;
}

// A collider's coefficient for particles of this factor.
std::uint32_t scaled_friction(std::int64_t coefficient, std::int64_t factor) {
    const fixed::UInt128 product =
        fixed::multiply_unsigned(fixed::magnitude(coefficient), fixed::magnitude(factor));
    const fixed::UInt128 scaled =
        fixed::shift_right_rounded(product, 2 * world_fraction_bits - friction_fraction_bits);
    return scaled.hi != 0 || scaled.lo > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(scaled.lo);
}

// How much larger than the shape at its end pose the box has to be for what happens between the poses.
//
// A particle at q(t) that the shape touches at its local point p(t) is away from where the end pose has p(t)
// by at most |dc| + turn·|local start|, turn being the norm of the difference of the rotations and dc the
// centre's motion. The local start is at most radius + |m| away from the centre, and |m| <= |x - start| +
// |dc| + turn·|local start|. With turn <= 1/3 that makes |local start| <= 3/2 (radius + |x - start| + |dc|):
// the particle's share, turn·3/2 <= 1/2, is added when it is tested.
struct Slack {
    bool known;
    std::int64_t distance;
};

Slack motion_slack(const ContactFrame& frame, std::int64_t radius) {
    if (!frame.moving) {
        return {true, 0};
    }
    const std::uint64_t travelled = fixed::length(saturating_subtract(frame.end_centre, frame.start_centre));
    const std::int64_t travel = fixed::saturating_add(saturate(travelled), 1);
    if (!frame.rotating) {
        return {true, travel};
    }
    const std::int64_t turn = turn_bound(frame.start_rotation, frame.end_rotation);
    if (turn > direction_one / 3) {
        return {false, 0};
    }
    const std::int64_t lever = fixed::saturating_add(radius, travel);
    const std::int64_t share = (fixed::scale_component(static_cast<std::int32_t>(turn), lever) / 2 + 1) * 3;
    return {true, fixed::saturating_add(travel, share)};
}

void place_box(ContactFrame& frame, const Bounds& bounds) {
    const Slack slack = motion_slack(frame, bounding_radius(frame.shape, frame.margin));
    frame.has_box = slack.known;
    frame.reachable = true;
    if (!slack.known) {
        return;
    }
    // The rotation's rounding moves a surface point by less than 1e-7 m.
    const std::int64_t room = fixed::saturating_add(slack.distance, coordinate_one >> 20);
    const fixed::Vec3 extent = axis_extent(frame.shape, frame.end_rotation, frame.margin);
    const fixed::Vec3 reach = saturating_add(extent, {room, room, room});
    frame.box_low = saturating_subtract(frame.end_centre, reach);
    frame.box_high = saturating_add(frame.end_centre, reach);

    std::int64_t own = 0;
    if (frame.rotating) {
        own = sum_of_magnitudes(saturating_subtract(bounds.high, bounds.low)) / 2 + 1;
    }
    const fixed::Vec3 low = saturating_subtract(bounds.low, {own, own, own});
    const fixed::Vec3 high = saturating_add(bounds.high, {own, own, own});
    frame.reachable = low.x <= frame.box_high.x && high.x >= frame.box_low.x && low.y <= frame.box_high.y &&
                      high.y >= frame.box_low.y && low.z <= frame.box_high.z && high.z >= frame.box_low.z;
}

} // namespace

std::int64_t interpolate_position(std::int64_t a, std::int64_t b, std::uint32_t numerator,
                                  std::uint32_t denominator) {
    const std::int64_t whole = fixed::wrapping_subtract(b, a);
    const auto n = static_cast<std::int64_t>(denominator);
    const auto j = static_cast<std::int64_t>(numerator);
    const std::int64_t moved = fixed::wrapping_multiply(whole / n, j);
    return fixed::wrapping_add(fixed::wrapping_add(a, moved), fixed::wrapping_multiply(whole % n, j) / n);
}

ContactFrame make_contact_frame(const ShapeWay& way, const fixed::Vec3& origin, const Bounds& bounds,
                                std::int64_t margin, std::int64_t friction_factor) {
    ContactFrame frame{};
    frame.shape = way.shape;
    frame.margin = margin;
    frame.static_friction = scaled_friction(way.static_friction, friction_factor);
    frame.dynamic_friction = scaled_friction(way.dynamic_friction, friction_factor);
    frame.greatest_recovery = INT64_MAX;
    frame.greatest_growth = INT64_MAX;
    frame.rotating = way.rotating;
    frame.moving = way.rotating || !(way.start == way.end);
    frame.end_rotation = way.end_rotation;
    frame.start_rotation = way.start_rotation;
    if (way.shape.kind == LKS_SHAPE_PLANE) {
        frame.reachable = place_plane(frame, way.start, way.end, origin, bounds);
        return frame;
    }
    fixed::Vec3 start_centre = saturating_subtract(way.start, origin);
    fixed::Vec3 end_centre = saturating_subtract(way.end, origin);
    if (!cut_to_limit(start_centre, end_centre)) {
        return frame;
    }
    frame.start_centre = to_coordinate(start_centre);
    frame.end_centre = to_coordinate(end_centre);
    place_box(frame, bounds);
    return frame;
}

ContactFrame make_contact_frame(const ColliderState& collider, std::uint32_t substep, std::uint32_t substeps,
                                const fixed::Vec3& origin, const Bounds& bounds, std::int64_t margin,
                                std::int64_t friction_factor) {
    const fixed::Rotation start_rotation = rotation_at(collider, substep - 1, substeps);
    const fixed::Rotation end_rotation = rotation_at(collider, substep, substeps);
    ShapeWay way{};
    way.shape = collider.shape;
    way.start = position_at(collider, substep - 1, substeps);
    way.end = position_at(collider, substep, substeps);
    way.rotating = !(start_rotation == end_rotation);
    way.end_rotation = fixed::to_matrix(end_rotation);
    way.start_rotation = way.rotating ? fixed::to_matrix(start_rotation) : way.end_rotation;
    way.static_friction = collider.static_friction;
    way.dynamic_friction = collider.dynamic_friction;
    return make_contact_frame(way, origin, bounds, margin, friction_factor);
}

} // namespace lks
