#include "solver/carrying.h"

#include <algorithm>

#include "fixed/formats.h"
#include "solver/wrapping.h"

namespace lks {
namespace {

using fixed::Int128;
using fixed::Vec3;

constexpr std::int64_t whole_world_units(std::int64_t coordinate) {
    return coordinate_from_world(world_from_coordinate(coordinate));
}

std::int64_t middle_of(std::int64_t low, std::int64_t high) {
    return whole_world_units(std::clamp(low / 2 + high / 2, -coordinate_limit, coordinate_limit));
}

std::int64_t sum_of(std::int64_t a, Int128 b) {
    return fixed::saturate_to_int64(fixed::to_int128(a) + b);
}

// The difference of opposite ends of the world needs 65 bits.
Int128 difference_of(std::int64_t a, std::int64_t b) {
    return fixed::to_int128(a) - fixed::to_int128(b);
}

Vec3 turned(const fixed::TurnMatrix& matrix, const Vec3& v) {
    return {fixed::round_turned(fixed::turn_row(matrix, 0, v)),
            fixed::round_turned(fixed::turn_row(matrix, 1, v)),
            fixed::round_turned(fixed::turn_row(matrix, 2, v))};
}

void place(Object& object, std::uint32_t particle, const Coordinates& position, const Vec3& motion) {
    const std::int64_t x[3] = {position.x, position.y, position.z};
    const std::int64_t moved[3] = {motion.x, motion.y, motion.z};
    for (int axis = 0; axis < 3; ++axis) {
        object.axis(axis)[particle] = x[axis];
        object.start_axis(axis)[particle] = wrapping_subtract(x[axis], moved[axis]);
    }
}

} // namespace

Carrying plan_carrying(const Kernels& kernels, const Object& object, const Frame& from, const Frame& to) {
    Carrying plan{};
    plan.turn = fixed::turn_between(from.rotation, to.rotation);
    const Vec3& o = object.origin;
    const Vec3& p = from.position;
    if (!plan.turn.turns) {
        plan.origin = {sum_of(to.position.x, difference_of(o.x, p.x)),
                       sum_of(to.position.y, difference_of(o.y, p.y)),
                       sum_of(to.position.z, difference_of(o.z, p.z))};
        return plan;
    }
    const Bounds bounds = object.bounds(kernels);
    plan.middle = {middle_of(bounds.low.x, bounds.high.x), middle_of(bounds.low.y, bounds.high.y),
                   middle_of(bounds.low.z, bounds.high.z)};
    const Vec3 pivot = o + Vec3{world_from_coordinate(plan.middle.x), world_from_coordinate(plan.middle.y),
                                world_from_coordinate(plan.middle.z)};
    const std::int64_t base[3] = {to.position.x, to.position.y, to.position.z};
    std::int64_t origin[3];
    for (int axis = 0; axis < 3; ++axis) {
        // Of opposite ends of the world, too, the difference fits: no row is longer than one.
        const Int128 sum =
            fixed::turn_row(plan.turn.matrix, axis, pivot) - fixed::turn_row(plan.turn.matrix, axis, p);
        const Int128 whole = sum >> fixed::turn_matrix_bits;
        origin[axis] = sum_of(base[axis], whole);
        plan.rest[axis] = (sum - (whole << fixed::turn_matrix_bits)) << coordinate_from_world_shift;
    }
    plan.origin = {origin[0], origin[1], origin[2]};
    return plan;
}

Coordinates carried_position(const Carrying& carrying, const Coordinates& position) {
    if (!carrying.turn.turns) {
        return position;
    }
    const Vec3& middle = carrying.middle;
    const Vec3 arm{saturating_subtract(position.x, middle.x), saturating_subtract(position.y, middle.y),
                   saturating_subtract(position.z, middle.z)};
    const auto axis = [&](int i) {
        return fixed::round_turned(fixed::turn_row(carrying.turn.matrix, i, arm) + carrying.rest[i]);
    };
    return {axis(0), axis(1), axis(2)};
}

std::uint64_t carry(Object& object, const Carrying& carrying) {
    object.origin = carrying.origin;
    std::uint64_t clamped = 0;
    for (std::uint32_t i = 0; carrying.turn.turns && i < object.count(); ++i) {
        const Coordinates x = object.position(i);
        const Coordinates start = object.start(i);
        const Vec3 motion{wrapping_subtract(x.x, start.x), wrapping_subtract(x.y, start.y),
                          wrapping_subtract(x.z, start.z)};
        place(object, i, carried_position(carrying, x), turned(carrying.turn.matrix, motion));
        if (Pin* const pin = object.find_pin(i); pin != nullptr) {
            const Coordinates target = carried_position(carrying, pin->target);
            const auto bounded = [](std::int64_t c) {
                return std::clamp(c, -coordinate_limit, coordinate_limit);
            };
            pin->target = {bounded(target.x), bounded(target.y), bounded(target.z)};
            const bool fits =
                pin->target.x == target.x && pin->target.y == target.y && pin->target.z == target.z;
            clamped += fits ? 0u : 1u;
        }
    }
    object.keep_previous();
    return clamped;
}

} // namespace lks
