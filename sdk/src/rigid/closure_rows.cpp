#include "rigid/closure_rows.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "collide/saturation.h"
#include "rigid/articulation.h"
#include "rigid/articulation_joint.h"
#include "rigid/attachment.h"
#include "rigid/contact_search.h"
#include "rigid/joint_drive.h"
#include "rigid/joint_limits.h"
#include "rigid/joint_turns.h"

namespace lks {

using namespace tree_detail;
using fixed::Direction;
using fixed::Vec3;

namespace {

// World: what a row that does not push may be exceeded by.
constexpr std::int64_t nearly_slack = world_one / 1000000;
// World, 6 cm: what is further apart is brought together in several substeps.
constexpr std::int64_t greatest_undone = world_one / 16;
// Radians, World: limits that are further off where a substep is predicted are not reached by its pushes.
constexpr std::int64_t far_from_limit = world_one / 32;
// The cosine of what a way, or an axis, may turn by until its factors are found anew, 30 fraction bits.
constexpr std::int64_t least_cosine = (std::int64_t{1} << 30) - (std::int64_t{1} << 25);

bool is_near(const HeldRow (&limits)[most_held_rows], std::uint32_t count, std::int64_t margin) {
    return std::any_of(limits, limits + count,
                       [margin](const HeldRow& limit) { return limit.error < margin || limit.push > 0; });
}

bool is_along(const ClosureRow& row) {
    return row.kind != ClosureRow::Kind::turn && row.kind != ClosureRow::Kind::limit;
}

Vec3 to_world(const Direction& way) {
    return {world_from_direction(way.x), world_from_direction(way.y), world_from_direction(way.z)};
}

} // namespace

std::uint32_t closing_rows(const Joint& joint) {
    const std::uint32_t kind = joint.description.kind;
    return kind == LKS_JOINT_DISTANCE ? 1 : kind == LKS_JOINT_FIXED ? 6 : kind == LKS_JOINT_HINGE ? 5 : 3;
}

std::int64_t scaled_by(std::int64_t value, int up) {
    constexpr std::int64_t greatest = std::int64_t{1} << 58;
    if (up <= 0) {
        return std::clamp(fixed::shift_right_rounded(value, -up), -greatest, greatest);
    }
    const std::int64_t most = greatest >> up;
    return std::clamp(value, -most, most) * (std::int64_t{1} << up);
}

void ClosureRows::place() {
    std::uint32_t closing = 0; // rows that are still to come
    for_each([&](const Closure& closure) { closing += rows_to_close(closure); });
    const std::int64_t margin = find_margin(range_.row_room - closing);
    range_.row_count = 0;
    for_each([&](Closure& closure) {
        closure.first_row = range_.row_count;
        closure.row_count = 0;
        closing -= rows_to_close(closure);
        switch (closure.kind) {
        case Closure::Kind::foot:
            place_foot(closure);
            break;
        case Closure::Kind::pin:
            place_pin(closure);
            break;
        default:
            place_joint(closure);
            place_limits(closure, margin, range_.row_room - closing);
        }
    });
}

// Of a foot: of its points that are near.
std::uint32_t ClosureRows::rows_to_close(const Closure& closure) const {
    switch (closure.kind) {
    case Closure::Kind::closing:
        return closing_rows(joint_of(closure));
    case Closure::Kind::pin:
        return closure_rows_a_pin;
    default:
        break;
    }
    std::uint32_t rows = 0; // of limits none
    for (std::uint32_t i = 0; i < feet_points(closure); ++i) {
        rows += is_near_point(closure, i) ? 1u : 0u;
    }
    return rows;
}

// How near limits are of which there is room for all.
std::int64_t ClosureRows::find_margin(std::uint32_t room) {
    constexpr std::int64_t margins[] = {far_from_limit, far_from_limit / 4, far_from_limit / 16};
    std::uint32_t counts[std::size(margins)] = {};
    for_each([&](const Closure& closure) {
        if (!is_of_joint(closure)) {
            return;
        }
        HeldRow limits[most_held_rows];
        const std::uint32_t count = limits_of(closure, limits);
        for (std::size_t i = 0; i < std::size(margins); ++i) {
            counts[i] += is_near(limits, count, margins[i]) ? count : 0;
        }
    });
    for (std::size_t i = 0; i < std::size(margins); ++i) {
        if (counts[i] <= room) {
            return margins[i];
        }
    }
    return 0;
}

ContactBodies ClosureRows::foot_bodies(const Closure& closure) const {
    const ContactKey& key = contact_of(closure).key;
    return {scene_.bodies[key.body_a], other_body(scene_, key.other)};
}

bool ClosureRows::is_near_point(const Closure& closure, std::uint32_t point) const {
    const Contact& contact = contact_of(closure);
    return is_near_foot_point(contact, contact.points[point], foot_bodies(closure));
}

// In the units of the bodies that move.
void ClosureRows::place_levers_of_foot(Closure& closure, std::uint32_t point) const {
    const Contact& contact = contact_of(closure);
    for (ClosureSide* side : {&closure.a, &closure.b}) {
        if (side->tree != no_tree) {
            const bool of_a = side == &closure.a;
            side->lever = arm_in_units(scene_.bodies[side->body], foot_lever(contact, contact.points[point],
                                                                             foot_bodies(closure), of_a));
        }
    }
}

void ClosureRows::place_foot(Closure& closure) {
    const Contact& contact = contact_of(closure);
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        if (is_near_point(closure, i)) {
            place_levers_of_foot(closure, i);
            add(closure, ClosureRow::Kind::contact, contact.normal()).point = static_cast<std::uint8_t>(i);
        }
    }
}

void ClosureRows::place_pin(Closure& closure) {
    closure.b.lever = lever_in_units(body_b(closure), pin_of(closure).description.point);
    add_points(closure);
}

void ClosureRows::add_points(Closure& closure) {
    add(closure, ClosureRow::Kind::point, {direction_one, 0, 0});
    add(closure, ClosureRow::Kind::point, {0, direction_one, 0});
    add(closure, ClosureRow::Kind::point, {0, 0, direction_one});
}

void ClosureRows::place_joint(Closure& closure) {
    const Joint& joint = joint_of(closure);
    for (ClosureSide* side : {&closure.a, &closure.b}) {
        if (side->tree != no_tree) {
            side->lever = lever_in_units(scene_.bodies[side->body], point_of(joint, side == &closure.a));
        }
    }
    const bool closes = closure.kind == Closure::Kind::closing;
    if (closes && is_distance(joint)) {
        add(closure, ClosureRow::Kind::distance, distance_error_of(closure).way);
    } else if (closes) {
        add_points(closure);
        HeldRow turns[most_held_rows];
        const std::uint32_t count = turn_rows(joint, body_a(closure), body_b(closure), true, turns);
        for (std::uint32_t i = 0; i < count; ++i) {
            add(closure, ClosureRow::Kind::turn, turns[i].axis);
        }
    }
}

// What a motor turns stays within its limits as it is. Where the motor is not capable of that they are left
// to the sweeps: limbs that a blow throws about, solved with it, went on at up to ten times their speed.
bool ClosureRows::is_driven(const Joint& joint) const {
    return range_.stands && has_motor(joint);
}

std::uint32_t ClosureRows::limits_of(const Closure& closure, HeldRow (&limits)[most_held_rows]) const {
    return limit_rows(joint_of(closure), body_a(closure), body_b(closure), in_substep_, limits, 0);
}

// All of a joint, where one is so near, or pushes.
void ClosureRows::place_limits(Closure& closure, std::int64_t margin, std::uint32_t room) {
    HeldRow limits[most_held_rows];
    const std::uint32_t count = limits_of(closure, limits);
    Joint& joint = joint_of(closure);
    joint.limits_in_tree =
        is_near(limits, count, margin) && range_.row_count + count <= room && !is_driven(joint);
    for (std::uint32_t i = 0; joint.limits_in_tree && i < count; ++i) {
        add(closure, ClosureRow::Kind::limit, limits[i].axis).limit = limits[i].kind;
    }
}

ClosureRow& ClosureRows::add(Closure& closure, ClosureRow::Kind kind, const Direction& along) {
    ClosureRow& row = scene_.closure_rows[range_.first_row + range_.row_count];
    row = {};
    row.kind = kind;
    row.along = along;
    for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
        (is_a ? row.torque_a : row.torque_b) =
            is_along(row) ? cross_32(side.lever, to_world(along))
                          : fine_axis_in_units(scene_.bodies[side.body], joint_of(closure), along);
    });
    const std::int64_t own = std::max<std::int64_t>(own_give(closure, row), 1);
    row.scale = (std::countl_zero(static_cast<std::uint64_t>(own)) - (63 - fine_fraction_bits)) / 2;
    row.own = scaled_by(own, 2 * row.scale);
    ++closure.row_count;
    ++range_.row_count;
    return row;
}

Wrench ClosureRows::push_of(const ClosureRow& row, bool is_a) {
    const Wrench push{is_along(row) ? to_world(row.along) : Vec3{0, 0, 0},
                      is_a ? row.torque_a : row.torque_b};
    return is_a ? Wrench{-push.force, -push.torque} : push;
}

Wrench ClosureRows::push_of(const ClosureSide& side, const ClosureRow& row, std::uint32_t number,
                            bool is_a) const {
    if (row.kind != ClosureRow::Kind::distance) {
        return push_of(row, is_a);
    }
    const Vec3 force = is_a ? -to_world(ways_[number]) : to_world(ways_[number]);
    return {force, cross_32(side.lever, force)};
}

std::int64_t ClosureRows::own_give(const Closure& closure, const ClosureRow& row) const {
    std::int64_t give = 0;
    for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
        const ClosureTree tree(scene_, scene_.trees[side.tree]);
        give = plus(give, in_tree(side, tree.own_give(side.body, push_of(row, is_a))));
    });
    return give;
}

std::int64_t ClosureRows::spring_give(const Closure& closure, const ClosureRow& row) const {
    if (!in_substep_ || !is_along(row) || row.kind == ClosureRow::Kind::contact) {
        return 0;
    }
    const Softness& softness = closure.kind == Closure::Kind::pin ? pin_of(closure).constants.softness
                                                                  : joint_of(closure).constants.points;
    const std::int64_t give = points_give(softness, closure.pair_share);
    return scaled_by(give, fine_fraction_bits - tree_fraction_bits);
}

DistanceError ClosureRows::distance_error_of(const Closure& closure) const {
    const Joint& joint = joint_of(closure);
    if (in_substep_) {
        return left_of_distance(joint, body_a(closure), body_b(closure));
    }
    DistanceError error = distance_beyond(joint, body_a(closure), body_b(closure));
    error.left = std::clamp(error.left, -greatest_undone, greatest_undone);
    return error;
}

Vec3 ClosureRows::left_apart_of(const Closure& closure) const {
    const Joint& joint = joint_of(closure);
    if (in_substep_) {
        return left_of_points(joint, body_a(closure), body_b(closure));
    }
    Vec3 apart = points_apart(joint, body_a(closure), body_b(closure), false);
    clamp_vector(apart, greatest_undone);
    return apart;
}

// What is undone strains no spring.
Vec3 ClosureRows::left_of_pin(const Closure& closure) const {
    const Attachment& pin = pin_of(closure);
    const Softness& softness = pin.constants.softness;
    Vec3 apart = pin_error(pin, body_b(closure));
    if (in_substep_) {
        return left_of(softness, apart, saturating_subtract(apart, pin.begin), pin.push);
    }
    clamp_vector(apart, greatest_undone);
    return softness.softness == 0 ? apart : Vec3{0, 0, 0};
}

bool ClosureRows::measure(ClosureUnknown (&unknowns)[most_closure_rows]) {
    bool near = true;
    for_each([&](const Closure& closure) {
        if (closure.row_count == 0) {
            return;
        }
        const Measured measured = measure(closure);
        for (std::uint32_t i = 0; i < closure.row_count; ++i) {
            const std::uint32_t number = closure.first_row + i;
            const ClosureRow& row = scene_.closure_rows[range_.first_row + number];
            ClosureUnknown& unknown = unknowns[number];
            unknown = {};
            near = measure(closure, measured, row, number, unknown) && near;
            // What the joint has pushed, in the figure's unit.
            unknown.pushed =
                unknown.pushed == 0
                    ? 0
                    : scaled_by(fixed::multiply_divide(unknown.pushed, tree_one,
                                                       std::max<std::int64_t>(closure.pair_share, 1)),
                                -row.scale);
            unknown.left = scaled_by(unknown.left, row.scale);
            unknown.slack = scaled_by(nearly_slack, row.scale);
            unknown.own = row.own;
            unknown.give = scaled_by(spring_give(closure, row), 2 * row.scale);
        }
    });
    return near;
}

// What several of its rows need.
ClosureRows::Measured ClosureRows::measure(const Closure& closure) const {
    Measured measured{};
    if (closure.kind == Closure::Kind::pin) {
        measured.apart = left_of_pin(closure);
    }
    if (!is_of_joint(closure)) {
        return measured;
    }
    const Joint& joint = joint_of(closure);
    if (closure.kind == Closure::Kind::closing && !is_distance(joint)) {
        measured.apart = left_apart_of(closure);
        measured.turned = turn_error(joint, body_a(closure), body_b(closure), in_substep_);
    }
    if (joint.limits_in_tree) {
        measured.limit_count = limits_of(closure, measured.limits);
    }
    return measured;
}

bool ClosureRows::measure(const Closure& closure, const Measured& measured, const ClosureRow& row,
                          std::uint32_t number, ClosureUnknown& unknown) {
    switch (closure.kind) {
    case Closure::Kind::foot:
        measure_foot(closure, row, unknown);
        return true;
    case Closure::Kind::pin:
        unknown.left = fixed::dot(row.along, measured.apart);
        return true;
    default:
        return measure_joint(closure, measured, row, number, unknown);
    }
}

// What is undone moves feet as their joints have it.
void ClosureRows::measure_foot(const Closure& closure, const ClosureRow& row, ClosureUnknown& unknown) const {
    const Contact& contact = contact_of(closure);
    const ContactPoint& point = contact.points[row.point];
    unknown.side = 1;
    unknown.left = world_one;
    if (in_substep_ && point.active) {
        unknown.left = foot_gap(contact, point, foot_bodies(closure));
        unknown.pushed = point.push.normal;
    }
}

bool ClosureRows::measure_joint(const Closure& closure, const Measured& measured, const ClosureRow& row,
                                std::uint32_t number, ClosureUnknown& unknown) {
    const int reach = joint_of(closure).constants.reach;
    switch (row.kind) {
    case ClosureRow::Kind::distance: {
        const DistanceError error = distance_error_of(closure);
        ways_[number] = error.way;
        unknown.left = error.left;
        unknown.pushed = error.pushed;
        unknown.side = error.side;
        return fixed::dot(error.way, row.along) >= least_cosine;
    }
    case ClosureRow::Kind::point:
        unknown.left = fixed::dot(row.along, measured.apart);
        return true;
    case ClosureRow::Kind::turn:
        unknown.left = lks::shifted(fixed::dot(row.along, measured.turned), reach);
        return true;
    default:
        unknown.side = 1;
        for (std::uint32_t i = 0; i < measured.limit_count; ++i) {
            const HeldRow& limit = measured.limits[i];
            if (limit.kind == row.limit) {
                unknown.left = lks::shifted(limit.error, reach);
                unknown.pushed = lks::shifted(limit.push, reach);
                return fixed::dot(limit.axis, row.along) >= least_cosine;
            }
        }
        unknown.left = world_one; // none
        return row.limit == HeldRow::Kind::swing;
    }
}

void ClosureRows::keep_pushes(const ClosureUnknown (&unknowns)[most_closure_rows]) {
    for_each_row([&](const Closure& closure, const ClosureRow& row, std::uint32_t number) {
        keep_push(closure, row, number, unknowns[number]);
    });
}

void ClosureRows::keep_push(const Closure& closure, const ClosureRow& row, std::uint32_t number,
                            const ClosureUnknown& unknown) {
    const std::int64_t more = multiply_32(closure.pair_share, scaled_by(unknown.more, row.scale));
    const bool rests = unknown.side != 0 && unknown.pushed + unknown.more == 0;
    if (row.kind == ClosureRow::Kind::contact) {
        std::int64_t& push = contact_of(closure).points[row.point].push.normal;
        push = rests ? 0 : std::clamp<std::int64_t>(push + more, 0, greatest_push);
        return;
    }
    if (closure.kind == Closure::Kind::pin) {
        add_push(pin_of(closure), fixed::scale(row.along, more));
        return;
    }
    Joint& joint = joint_of(closure);
    switch (row.kind) {
    case ClosureRow::Kind::distance: {
        const std::int64_t before = fixed::dot(ways_[number], joint.push);
        joint.push = {0, 0, 0};
        add_tree_push(joint, fixed::scale(ways_[number], rests ? 0 : before + more), true);
        return;
    }
    case ClosureRow::Kind::point:
        add_tree_push(joint, fixed::scale(row.along, more), true);
        return;
    case ClosureRow::Kind::turn:
        joint.turn = joint.turn + fixed::scale(row.along, lks::shifted(more, -joint.constants.reach));
        clamp_vector(joint.turn, greatest_push);
        return;
    default: {
        const std::int64_t before = row.limit == HeldRow::Kind::swing ? joint.swing_push
                                    : joint.twist_push < 0            ? -joint.twist_push
                                                                      : joint.twist_push;
        const std::int64_t sum = before + lks::shifted(more, -joint.constants.reach);
        set_limit_push(joint, {row.limit, row.along, 0, 0},
                       rests ? 0 : std::clamp<std::int64_t>(sum, 0, greatest_push));
        return;
    }
    }
}

void ClosureRows::hold_springs() {
    for_each([&](const Closure& closure) {
        if (closure.kind != Closure::Kind::closing) {
            return;
        }
        Joint& joint = joint_of(closure);
        if (has_soft_points(joint.constants)) {
            hold_spring(joint, body_a(closure), body_b(closure));
        }
    });
}

} // namespace lks
