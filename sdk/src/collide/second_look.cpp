#include "collide/second_look.h"

#include <algorithm>
#include <bit>

#include "collide/saturation.h"
#include "fixed/formats.h"
#include "solver/object.h"

namespace lks {
namespace {

using fixed::Direction;
using fixed::NormalisedVector;
using fixed::Vec3;

// After so many rounds particles are put back, and after twice as many left where they are.
constexpr std::uint32_t rounds_to_find_room = 4;

// The sine of the angle between two planes, or of a plane and where two others meet, of 1.8°: what is nearer
// to parallel leaves no room.
constexpr std::int64_t least_sine = direction_one / 32;

// A way goes into a plane where their product is less than what rounding makes of 0.
constexpr std::int32_t along = -16;

bool goes_into(const Direction& way, const Direction& normal) {
    return fixed::dot(way, normal) < along;
}

Vec3 as_vector(const Direction& d) {
    return {d.x, d.y, d.z};
}

// The part of `normal` along a plane.
Vec3 along_plane(const Direction& normal, const Direction& plane) {
    return as_vector(normal) - fixed::scale(plane, fixed::dot(plane, as_vector(normal)));
}

// The part of `normal` along the line in which two planes meet.
Vec3 along_edge(const Direction& normal, const Direction& a, const Direction& b) {
    NormalisedVector edge{};
    if (!fixed::normalise(fixed::cross(a, b), edge)) {
        return {0, 0, 0};
    }
    return fixed::scale(edge.direction, fixed::dot(edge.direction, as_vector(normal)));
}

std::int64_t in_range(std::int64_t coordinate) {
    return std::clamp(coordinate, -coordinate_limit, coordinate_limit);
}

} // namespace

SecondLook::SecondLook(const ParticleArrays& particles, std::int64_t tolerance, std::uint32_t first,
                       std::uint64_t who)
    : particles_(particles), tolerance_(tolerance), first_(first), active_(who) {
    for (Planes& planes : planes_) {
        planes.count = 0;
    }
}

Bounds SecondLook::bounds() const {
    const auto one = static_cast<std::uint32_t>(std::countr_zero(active_));
    Bounds bounds{position(one), position(one)};
    std::int64_t reach = 0;
    for (std::uint64_t left = active_; left != 0; left &= left - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
        for (const Vec3& p : {position(i), start(i)}) {
            include(bounds, {p.x, p.y, p.z});
        }
        reach = std::max(reach, sum_of_magnitudes(saturating_subtract(position(i), start(i))));
    }
    return {saturating_subtract(bounds.low, {reach, reach, reach}),
            saturating_add(bounds.high, {reach, reach, reach})};
}

void SecondLook::meet(const ContactFrame& frame) {
    for (std::uint64_t left = active_; left != 0; left &= left - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
        NewDepth behind{};
        if (find_new_depth(frame, position(i), start(i), behind) && behind.depth > tolerance_) {
            behind_ |= left & -left;
            push(i, behind);
        }
    }
}

void SecondLook::end_round() {
    ++round_;
    active_ = behind_;
    behind_ = 0;
    if (round_ == rounds_to_find_room) {
        for (std::uint64_t left = active_ & ~put_back_; left != 0; left &= left - 1) {
            put_back(static_cast<std::uint32_t>(std::countr_zero(left)));
        }
    } else if (round_ == 2 * rounds_to_find_room) {
        active_ = 0;
    }
}

// The first of these ways that leads into none of the planes: straight out, along one of them, along both.
// Its length is how far one gets out on it, of 1.
bool SecondLook::find_way_out(const Direction& normal, const Planes& planes, NormalisedVector& out) const {
    const auto leads_out = [&](const Vec3& way) {
        if (!fixed::normalise(way, out)) {
            return false;
        }
        for (std::uint32_t p = 0; p < planes.count; ++p) {
            if (goes_into(out.direction, planes.normals[p])) {
                return false;
            }
        }
        return true;
    };
    bool found = leads_out(as_vector(normal));
    for (std::uint32_t p = 0; !found && p < planes.count; ++p) {
        found = leads_out(along_plane(normal, planes.normals[p]));
    }
    if (!found && planes.count == 2) {
        found = leads_out(along_edge(normal, planes.normals[0], planes.normals[1]));
    }
    return found && out.length >= least_sine;
}

void SecondLook::push(std::uint32_t i, const NewDepth& behind) {
    Planes& planes = planes_[i];
    NormalisedVector way{};
    if (!find_way_out(behind.normal, planes, way)) {
        put_back(i);
        return;
    }
    const std::int64_t distance = fixed::multiply_divide(behind.depth, direction_one, way.length);
    move_to(i, saturating_add(position(i), fixed::scale(way.direction, distance)));
    if ((put_back_ >> i & 1) == 0) {
        planes.normals[1] = planes.normals[0];
        planes.normals[0] = behind.normal;
        planes.count = std::min(planes.count + 1, 2u);
    }
}

void SecondLook::put_back(std::uint32_t i) {
    put_back_ |= std::uint64_t{1} << i;
    planes_[i].count = 0;
    move_to(i, start(i));
}

Vec3 SecondLook::position(std::uint32_t i) const {
    const std::uint32_t p = first_ + i;
    return {particles_.x[p], particles_.y[p], particles_.z[p]};
}

Vec3 SecondLook::start(std::uint32_t i) const {
    const std::uint32_t p = first_ + i;
    return {particles_.start_x[p], particles_.start_y[p], particles_.start_z[p]};
}

void SecondLook::move_to(std::uint32_t i, const Vec3& position) {
    const std::uint32_t p = first_ + i;
    particles_.x[p] = in_range(position.x);
    particles_.y[p] = in_range(position.y);
    particles_.z[p] = in_range(position.z);
}

} // namespace lks
