#include "solver/local_frame.h"

#include <algorithm>

#include "fixed/formats.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

constexpr std::int64_t tolerated_distance = coordinate_one * 8;

void shift_axis(std::int64_t* values, std::size_t count, std::int64_t shift) {
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = wrapping_subtract(values[i], shift);
    }
}

// How far to move the origin on one axis, in whole metres of Coordinate format.
std::int64_t wanted_shift(std::int64_t low, std::int64_t high) {
    const std::int64_t middle = std::clamp(low / 2 + high / 2, -coordinate_limit, coordinate_limit);
    if (middle >= -tolerated_distance && middle <= tolerated_distance) {
        return 0;
    }
    return middle / coordinate_one * coordinate_one;
}

void follow_axis(Object& object, int axis, std::int64_t& origin, std::int64_t& low, std::int64_t& high,
                 lks_world_counters& counters) {
    const std::int64_t shift = wanted_shift(low, high);
    if (shift == 0) {
        return;
    }
    const std::int64_t moved = origin + (shift >> coordinate_from_world_shift);
    if (moved > world_position_limit || moved < -world_position_limit) {
        ++counters.world_edge_hits;
        return;
    }
    origin = moved;
    low = wrapping_subtract(low, shift);
    high = wrapping_subtract(high, shift);
    const std::size_t n = object.count();
    shift_axis(object.axis(axis), n, shift);
    shift_axis(object.start_axis(axis), n, shift);
    if (!object.previous.empty()) {
        shift_axis(object.previous.data() + static_cast<std::size_t>(axis) * n, n, shift);
    }
    counters.target_clamps += object.shift_pin_targets(axis, shift);
}

std::int64_t local_axis(std::int64_t position, std::int64_t origin, bool& clamped) {
    constexpr std::int64_t limit = coordinate_limit >> coordinate_from_world_shift;
    const std::int64_t difference = saturating_subtract(position, origin);
    const std::int64_t bounded = std::clamp(difference, -limit, limit);
    clamped = clamped || bounded != difference;
    return coordinate_from_world(bounded);
}

} // namespace

void follow_object(Object& object, Bounds& bounds, lks_world_counters& counters) {
    follow_axis(object, 0, object.origin.x, bounds.low.x, bounds.high.x, counters);
    follow_axis(object, 1, object.origin.y, bounds.low.y, bounds.high.y, counters);
    follow_axis(object, 2, object.origin.z, bounds.low.z, bounds.high.z, counters);
}

Coordinates to_local(const Object& object, const fixed::Vec3& position, bool& clamped) {
    return {local_axis(position.x, object.origin.x, clamped),
            local_axis(position.y, object.origin.y, clamped),
            local_axis(position.z, object.origin.z, clamped)};
}

} // namespace lks
