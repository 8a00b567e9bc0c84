#include "rigid/attachment.h"

#include <algorithm>
#include <iterator>

#include "collide/saturation.h"
#include "fixed/world_times.h"
#include "rigid/body_motion.h"
#include "rigid/make_body.h"
#include "rigid/push_limits.h"

namespace lks {
namespace {

using fixed::Scaled;
using fixed::Vec3;

InverseMass other_inverse_mass(const AttachmentDescription& d, const AttachmentSides& sides) {
    return sides.body != nullptr ? sides.body->inverse_mass
                                 : particle_inverse_mass(*sides.other, d.other_particle);
}

Vec3 held_point(const AttachmentDescription& d, const Body& body) {
    return body.position + fixed::rotate(body.rotation, d.point);
}

void push_apart(const Attachment& attachment, const AttachmentSides& sides, const Vec3& p) {
    const AttachmentDescription& d = attachment.description;
    const PairShares& shares = attachment.constants.shares;
    move_particle(sides.object, d.particle, -fixed::scaled(shares.a, p));
    if (sides.body != nullptr) {
        push(*sides.body, attachment.side, p, 1);
    } else {
        move_particle(*sides.other, d.other_particle, fixed::scaled(shares.b, p));
    }
}

} // namespace

InverseMass particle_inverse_mass(const Object& object, std::uint32_t particle) {
    return object.find_pin(particle) != nullptr ? InverseMass{0, 0}
                                                : to_inverse_mass(object.asset().inverse_masses[particle]);
}

std::uint32_t movable_sides(const AttachmentDescription& d, const AttachmentSides& sides) {
    const bool particle = particle_inverse_mass(sides.object, d.particle).mantissa != 0;
    const bool other = other_inverse_mass(d, sides).mantissa != 0;
    return (particle ? 1u : 0u) | (other ? 2u : 0u);
}

Vec3 particle_position(const Object& object, std::uint32_t particle) {
    const Coordinates at = object.position(particle);
    return object.origin +
           Vec3{world_from_coordinate(at.x), world_from_coordinate(at.y), world_from_coordinate(at.z)};
}

void move_particle(Object& object, std::uint32_t particle, const Vec3& shift) {
    // No more than the range is wide, so that nothing overflows.
    constexpr std::int64_t most = std::int64_t{128} << world_fraction_bits;
    const std::int64_t shifts[3] = {shift.x, shift.y, shift.z};
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t by = coordinate_from_world(std::clamp(shifts[axis], -most, most - 1));
        std::int64_t& x = object.axis(axis)[particle];
        x = std::clamp(fixed::saturating_add(x, by), -coordinate_limit, coordinate_limit);
    }
}

Vec3 attachment_offset(const Attachment& attachment, const AttachmentSides& sides) {
    const AttachmentDescription& d = attachment.description;
    const Vec3 here = particle_position(sides.object, d.particle);
    const Vec3 there = sides.body != nullptr ? held_point(d, *sides.body)
                                             : particle_position(*sides.other, d.other_particle);
    return saturating_subtract(there, here);
}

Vec3 attachment_error(const Attachment& attachment, const AttachmentSides& sides) {
    return saturating_subtract(attachment_offset(attachment, sides), attachment.left);
}

Vec3 pin_error(const Attachment& attachment, const Body& body) {
    return saturating_subtract(
        saturating_subtract(held_point(attachment.description, body), attachment.held_at), attachment.left);
}

AttachmentConstants make_attachment_constants(const AttachmentDescription& d, const AttachmentSides& sides,
                                              const StepRate& rate) {
    AttachmentConstants c{};
    c.movable = movable_sides(d, sides);
    const InverseMass a = particle_inverse_mass(sides.object, d.particle);
    const InverseMass b = other_inverse_mass(d, sides);
    c.shares = pair_shares(a, b);
    const Scaled greater = to_scaled(c.shares.a == direction_one ? a : b);
    c.greater_inverse_mass = greater;
    if (!greater.is_zero()) {
        const Scaled inverse_h = rate.inverse_h();
        c.softness = make_softness(d.compliance, d.damping, greater, rate);
        c.break_push = greatest_sum(d.break_force, greater / (inverse_h * inverse_h), rate);
    }
    return c;
}

void follow_masses(Attachment& attachment, const AttachmentSides& sides, const StepRate& rate) {
    if (attachment.constants.movable == movable_sides(attachment.description, sides)) {
        return;
    }
    const Scaled before = attachment.constants.greater_inverse_mass;
    attachment.constants = make_attachment_constants(attachment.description, sides, rate);
    const Scaled now = attachment.constants.greater_inverse_mass;
    if (before.is_zero() || now.is_zero()) {
        attachment.pushed = {0, 0, 0};
        return;
    }
    const Scaled ratio = now / before;
    const std::int64_t greatest_sum = greatest_push * static_cast<std::int64_t>(rate.substeps);
    for (std::int64_t* sum : {&attachment.pushed.x, &attachment.pushed.y, &attachment.pushed.z}) {
        *sum = std::clamp(times(*sum, ratio), -greatest_sum, greatest_sum);
    }
}

void begin_tick(Attachment& attachment, const AttachmentSides& sides, const StepRate& rate) {
    follow_masses(attachment, sides, rate);
    const auto n = static_cast<std::int64_t>(rate.substeps);
    const Vec3& sum = attachment.pushed;
    attachment.expected = {sum.x / n, sum.y / n, sum.z / n};
    attachment.pushed = {0, 0, 0};
}

void measure_left(Attachment& attachment, const AttachmentSides& sides, const MotionRate& rate) {
    attachment.left = {0, 0, 0};
    const bool thrown = (attachment.constants.movable & 2) != 0;
    if (!thrown || attachment.constants.softness.softness != 0) {
        return;
    }
    const std::int64_t most = LKS_FIXED(2) / rate.substeps_per_second;
    fixed::NormalisedVector gap{};
    if (fixed::normalise(attachment_offset(attachment, sides), gap) && gap.length > most) {
        attachment.left = fixed::scale(gap.direction, gap.length - most);
    }
}

void begin_substep(Attachment& attachment, const AttachmentSides& sides) {
    const AttachmentConstants& c = attachment.constants;
    attachment.push = {0, 0, 0};
    attachment.begin = attachment_error(attachment, sides);
    if (attachment.holds_in_tree) {
        attachment.held_at = particle_position(sides.object, attachment.description.particle);
        return;
    }
    const std::int64_t diagonal = c.softness.softness + c.shares.a + (sides.body == nullptr ? c.shares.b : 0);
    std::int64_t k[6] = {};
    attachment.side = {};
    if (sides.body != nullptr) {
        const Vec3 lever = fixed::rotate(sides.body->rotation, attachment.description.point);
        attachment.side = block_side(*sides.body, c.shares.b, lever, k);
    }
    std::copy(std::begin(k), std::end(k), std::begin(attachment.body_motion));
    for (const int i : {0, 3, 5}) {
        k[i] += diagonal;
    }
    if (c.movable != 0) {
        attachment.inverse = invert_block(k);
    }
}

void project(Attachment& attachment, const AttachmentSides& sides) {
    if (attachment.constants.movable == 0 || attachment.holds_in_tree) {
        return;
    }
    const Vec3 error = attachment_error(attachment, sides);
    const Vec3 before = attachment.push;
    attachment.push = next_push(attachment.inverse, attachment.constants.softness, error,
                                saturating_subtract(error, attachment.begin), before);
    push_apart(attachment, sides, attachment.push - before);
}

void add_push(Attachment& attachment, const Vec3& push) {
    attachment.push = attachment.push + push;
    clamp_vector(attachment.push, greatest_push);
}

void finish_substep(Attachment& attachment) {
    attachment.pushed = attachment.pushed + attachment.push;
}

bool breaks(const Attachment& attachment) {
    return exceeds(attachment.pushed, attachment.constants.break_push);
}

} // namespace lks
