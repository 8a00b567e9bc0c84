#include "collide/plane_motion.h"

#include <algorithm>

#include "collide/saturation.h"
#include "solver/object.h"

namespace lks {
namespace {

constexpr std::int64_t greatest_lift = coordinate_one * 32;
constexpr std::int64_t greatest_height = coordinate_one * 127;
// A point of the plane that moves further than this in a substep is not followed: it slides, whatever the
// friction.
constexpr std::int64_t greatest_carry = coordinate_one * 32;
// The lever of a rotating plane: differences of world positions have up to 25 bits before the point.
constexpr int lever_fraction_bits = 36;

fixed::Int128 dot_exact(const fixed::Direction& n, const fixed::Vec3& v) {
    return fixed::multiply_signed(n.x, v.x) + fixed::multiply_signed(n.y, v.y) +
           fixed::multiply_signed(n.z, v.z);
}

std::int64_t to_coordinate(fixed::Int128 height) {
    return fixed::saturate_to_int64(fixed::shift_right_rounded(height, direction_fraction_bits));
}

// Moves a point along the normal into the plane. The second time removes what the normal's length is off by.
fixed::Vec3 into_plane(fixed::Vec3 point, const fixed::Direction& normal, const fixed::Vec3& position,
                       const fixed::Vec3& origin) {
    for (int round = 0; round < 2; ++round) {
        const std::int64_t height = to_coordinate(height_above_plane(normal, position, origin, point));
        const std::int64_t bounded = std::clamp(height, -greatest_lift, greatest_height);
        point = saturating_subtract(point, fixed::scale(normal, bounded));
        if (bounded != height) {
            break;
        }
    }
    return point;
}

// a - b where both have 64 bits, in the format of levers.
std::int64_t lever(std::int64_t a, std::int64_t b) {
    const fixed::Int128 difference = fixed::to_int128(a) - fixed::to_int128(b);
    return fixed::saturate_to_int64(
        fixed::shift_right_rounded(difference, world_fraction_bits - lever_fraction_bits));
}

std::int64_t from_lever(std::int64_t value) {
    constexpr int shift = coordinate_fraction_bits - lever_fraction_bits;
    constexpr std::int64_t limit = INT64_MAX >> shift;
    return std::clamp(value, -limit, limit) * (std::int64_t{1} << shift);
}

std::int64_t from_world(std::int64_t value) {
    constexpr std::int64_t limit = INT64_MAX >> coordinate_from_world_shift;
    return std::clamp(value, -limit, limit) * (std::int64_t{1} << coordinate_from_world_shift);
}

// By how much the motion moves the plane's own point that starts at `point`. Without a turn it moves as the
// plane does, exactly; with one, its lever from the plane's position turns too.
fixed::Vec3 carried(const ContactFrame& frame, const fixed::Vec3& point, const fixed::Vec3& start,
                    const fixed::Vec3& end, const fixed::Vec3& origin) {
    const fixed::Vec3 moved = saturating_subtract(end, start);
    fixed::Vec3 result = {from_world(moved.x), from_world(moved.y), from_world(moved.z)};
    if (frame.rotating) {
        constexpr int shift = coordinate_fraction_bits - lever_fraction_bits;
        const fixed::Vec3 arm = {fixed::saturating_add(lever(origin.x, start.x), point.x >> shift),
                                 fixed::saturating_add(lever(origin.y, start.y), point.y >> shift),
                                 fixed::saturating_add(lever(origin.z, start.z), point.z >> shift)};
        const fixed::Vec3 local = fixed::rotate_transposed(frame.start_rotation, arm);
        const fixed::Vec3 turned = saturating_subtract(fixed::rotate(frame.end_rotation, local), arm);
        result = saturating_add(result, {from_lever(turned.x), from_lever(turned.y), from_lever(turned.z)});
    }
    return result;
}

bool is_carried_so_far(const fixed::Vec3& v) {
    constexpr auto limit = static_cast<std::uint64_t>(greatest_carry);
    return fixed::magnitude(v.x) <= limit && fixed::magnitude(v.y) <= limit && fixed::magnitude(v.z) <= limit;
}

} // namespace

fixed::Int128 height_above_plane(const fixed::Direction& normal, const fixed::Vec3& position,
                                 const fixed::Vec3& origin, const fixed::Vec3& point) {
    const fixed::Int128 world = dot_exact(normal, position) - dot_exact(normal, origin);
    return dot_exact(normal, point) - (world << coordinate_from_world_shift);
}

std::int64_t world_height_above_plane(const fixed::Direction& normal, const fixed::Vec3& position,
                                      const fixed::Vec3& point) {
    const fixed::Int128 height = height_above_plane(normal, position, point, {0, 0, 0});
    return fixed::saturate_to_int64(
        fixed::shift_right_rounded(height, height_fraction_bits - world_fraction_bits));
}

fixed::Int128 lowest_height(const fixed::Direction& normal, const fixed::Vec3& position,
                            const fixed::Vec3& origin, const Bounds& bounds) {
    const fixed::Vec3 corner = {normal.x > 0 ? bounds.low.x : bounds.high.x,
                                normal.y > 0 ? bounds.low.y : bounds.high.y,
                                normal.z > 0 ? bounds.low.z : bounds.high.z};
    return height_above_plane(normal, position, origin, corner);
}

bool place_plane(ContactFrame& frame, const fixed::Vec3& start, const fixed::Vec3& end,
                 const fixed::Vec3& origin, const Bounds& bounds) {
    const fixed::Direction end_normal = plane_normal(frame.end_rotation);
    if (to_coordinate(lowest_height(end_normal, end, origin, bounds)) > frame.margin) {
        return false;
    }
    const fixed::Vec3 middle = {bounds.low.x / 2 + bounds.high.x / 2, bounds.low.y / 2 + bounds.high.y / 2,
                                bounds.low.z / 2 + bounds.high.z / 2};
    if (!frame.moving) {
        frame.end_centre = into_plane(middle, end_normal, end, origin);
        frame.start_centre = frame.end_centre;
        return true;
    }
    frame.start_centre = into_plane(middle, plane_normal(frame.start_rotation), start, origin);
    const fixed::Vec3 motion = carried(frame, frame.start_centre, start, end, origin);
    const fixed::Vec3 end_point =
        is_carried_so_far(motion) ? saturating_add(frame.start_centre, motion) : middle;
    frame.end_centre = into_plane(end_point, end_normal, end, origin);
    return true;
}

} // namespace lks
