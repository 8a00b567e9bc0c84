#include "solver/laying.h"

#include <algorithm>

#include "fixed/formats.h"
#include "fixed/int128.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

using fixed::Vec3;

constexpr std::int64_t local_limit = coordinate_limit >> coordinate_from_world_shift;

bool is_in_range(const Vec3& origin, const Vec3& place) {
    const auto fits = [](std::int64_t o, std::int64_t p) {
        const std::int64_t apart = saturating_subtract(p, o);
        return apart >= -local_limit && apart <= local_limit;
    };
    return fits(origin.x, place.x) && fits(origin.y, place.y) && fits(origin.z, place.z);
}

// From the origin to the middle of the bounds, towards zero, as a frame follows its particles; no place is
// beyond the edge of the world. Opposite ends of the world are further apart than 64 bits hold.
std::int64_t whole_metres_to_middle(std::int64_t origin, std::int64_t low, std::int64_t high) {
    const auto from_origin = [origin](std::int64_t place) {
        const std::int64_t inside = std::clamp(place, -world_position_limit, world_position_limit);
        return fixed::to_int128(inside) - fixed::to_int128(origin);
    };
    const fixed::Int128 twice = from_origin(low) + from_origin(high);
    const auto metres = static_cast<std::int64_t>((fixed::abs(twice) >> (world_fraction_bits + 1)).lo);
    return twice.hi < 0 ? -metres : metres;
}

// Of pins, those of vertices that stay.
std::uint64_t move_origin(Object& object, const Laid& laid, int axis, std::int64_t& origin,
                          std::int64_t metres) {
    origin = wrapping_add(origin, wrapping_multiply(metres, world_one));
    // Wraps with what wraps: what stays is in range again.
    const std::int64_t shift = wrapping_multiply(metres, coordinate_one);
    for (std::uint32_t i = 0; i < object.count(); ++i) {
        for (std::int64_t* const values : {object.axis(axis), object.start_axis(axis)}) {
            values[i] = wrapping_subtract(values[i], shift);
        }
        if (!object.previous.empty()) {
            std::int64_t& x = object.previous[static_cast<std::size_t>(axis) * object.count() + i];
            x = wrapping_subtract(x, shift);
        }
    }
    std::uint64_t clamped = 0;
    for (const Pin& known : object.pins()) {
        if (laid.contains(object.asset().particle_to_vertex[known.particle])) {
            continue;
        }
        Pin& pin = *object.find_pin(known.particle);
        std::int64_t& target = fixed::component(pin.target, axis);
        const std::int64_t shifted = fixed::saturate_to_int64(
            fixed::to_int128(target) - (fixed::to_int128(metres) << coordinate_fraction_bits));
        target = std::clamp(shifted, -coordinate_limit, coordinate_limit);
        clamped += static_cast<std::uint64_t>(target != shifted);
    }
    return clamped;
}

void lay_particle(Object& object, std::uint32_t particle, const Coordinates& place) {
    const std::int64_t x[3] = {place.x, place.y, place.z};
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t motion =
            wrapping_subtract(object.axis(axis)[particle], object.start_axis(axis)[particle]);
        object.axis(axis)[particle] = x[axis];
        object.start_axis(axis)[particle] = wrapping_subtract(x[axis], motion);
        if (!object.previous.empty()) {
            object.previous[static_cast<std::size_t>(axis) * object.count() + particle] = x[axis];
        }
    }
    if (Pin* const pin = object.find_pin(particle); pin != nullptr) {
        pin->target = place;
    }
}

} // namespace

Bounds laid_bounds(const Object& object, const Laid& laid) {
    Bounds bounds{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
    const Vec3& o = object.origin;
    for (std::uint32_t vertex = 0; vertex < object.count(); ++vertex) {
        if (laid.contains(vertex)) {
            const lks_vec3& p = laid.positions[vertex - laid.first];
            include(bounds, {p.x, p.y, p.z});
        } else {
            const Coordinates x = object.position(object.asset().vertex_to_particle[vertex]);
            include(bounds, {o.x + world_from_coordinate(x.x), o.y + world_from_coordinate(x.y),
                             o.z + world_from_coordinate(x.z)});
        }
    }
    return bounds;
}

std::uint64_t lay(Object& object, const Laid& laid, const Bounds& bounds) {
    std::uint64_t clamped = 0;
    Vec3& origin = object.origin;
    if (!is_in_range(origin, bounds.low) || !is_in_range(origin, bounds.high)) {
        const auto follow = [&](int axis, std::int64_t& o, std::int64_t low, std::int64_t high) {
            clamped += move_origin(object, laid, axis, o, whole_metres_to_middle(o, low, high));
        };
        follow(0, origin.x, bounds.low.x, bounds.high.x);
        follow(1, origin.y, bounds.low.y, bounds.high.y);
        follow(2, origin.z, bounds.low.z, bounds.high.z);
    }
    for (std::uint32_t i = 0; i < laid.count; ++i) {
        const lks_vec3& p = laid.positions[i];
        lay_particle(object, object.asset().vertex_to_particle[laid.first + i],
                     {coordinate_from_world(p.x - origin.x), coordinate_from_world(p.y - origin.y),
                      coordinate_from_world(p.z - origin.z)});
    }
    return clamped;
}

} // namespace lks
