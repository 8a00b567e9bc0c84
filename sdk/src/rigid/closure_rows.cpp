#include "rigid/closure_rows.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "rigid/articulation.h"
#include "rigid/articulation_joint.h"
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
    return row.kind == ClosureRow::Kind::point || row.kind == ClosureRow::Kind::distance;
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
        place(closure);
        closing -= rows_to_close(closure);
        place_limits(closure, margin, range_.row_room - closing);
    });
}

std::uint32_t ClosureRows::rows_to_close(const Closure& closure) const {
    return closure.closes ? closing_rows(scene_.joints[closure.joint]) : 0;
}

// How near limits are of which there is room for all.
std::int64_t ClosureRows::find_margin(std::uint32_t room) {
    constexpr std::int64_t margins[] = {far_from_limit, far_from_limit / 4, far_from_limit / 16};
    std::uint32_t counts[std::size(margins)] = {};
    for_each([&](const Closure& closure) {
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

void ClosureRows::place(Closure& closure) {
    const Joint& joint = scene_.joints[closure.joint];
    for (ClosureSide* side : {&closure.a, &closure.b}) {
        if (side->tree != no_tree) {
            side->lever = lever_in_units(scene_.bodies[side->body], point_of(joint, side == &closure.a));
        }
    }
    if (closure.closes && is_distance(joint)) {
        add(closure, ClosureRow::Kind::distance, distance_error_of(closure).way);
    } else if (closure.closes) {
        add(closure, ClosureRow::Kind::point, {direction_one, 0, 0});
        add(closure, ClosureRow::Kind::point, {0, direction_one, 0});
        add(closure, ClosureRow::Kind::point, {0, 0, direction_one});
        HeldRow turns[most_held_rows];
        const std::uint32_t count = turn_rows(joint, body_a(closure), body_b(closure), true, turns);
        for (std::uint32_t i = 0; i < count; ++i) {
            add(closure, ClosureRow::Kind::turn, turns[i].axis);
        }
    }
}

std::uint32_t ClosureRows::limits_of(const Closure& closure, HeldRow (&limits)[most_held_rows]) const {
    return limit_rows(scene_.joints[closure.joint], body_a(closure), body_b(closure), in_substep_, limits, 0);
}

// All of a joint, where one is so near, or pushes.
void ClosureRows::place_limits(Closure& closure, std::int64_t margin, std::uint32_t room) {
    HeldRow limits[most_held_rows];
    const std::uint32_t count = limits_of(closure, limits);
    Joint& joint = scene_.joints[closure.joint];
    joint.limits_in_tree = is_near(limits, count, margin) && range_.row_count + count <= room;
    for (std::uint32_t i = 0; joint.limits_in_tree && i < count; ++i) {
        add(closure, ClosureRow::Kind::limit, limits[i].axis, limits[i].kind);
    }
}

void ClosureRows::add(Closure& closure, ClosureRow::Kind kind, const Direction& along, HeldRow::Kind limit) {
    const Joint& joint = scene_.joints[closure.joint];
    ClosureRow& row = scene_.closure_rows[range_.first_row + range_.row_count];
    row.kind = kind;
    row.limit = limit;
    row.along = along;
    for_each_side(closure, [&](const ClosureSide& side, bool is_a) {
        (is_a ? row.torque_a : row.torque_b) =
            is_along(row) ? cross_32(side.lever, to_world(along))
                          : fine_axis_in_units(scene_.bodies[side.body], joint, along);
    });
    const std::int64_t own = std::max<std::int64_t>(own_give(closure, row), 1);
    row.scale = (std::countl_zero(static_cast<std::uint64_t>(own)) - (63 - fine_fraction_bits)) / 2;
    row.own = scaled_by(own, 2 * row.scale);
    ++closure.row_count;
    ++range_.row_count;
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
    if (!in_substep_ || !is_along(row)) {
        return 0;
    }
    const std::int64_t give = points_give(scene_.joints[closure.joint], closure.pair_share);
    return scaled_by(give, fine_fraction_bits - tree_fraction_bits);
}

DistanceError ClosureRows::distance_error_of(const Closure& closure) const {
    const Joint& joint = scene_.joints[closure.joint];
    if (in_substep_) {
        return left_of_distance(joint, body_a(closure), body_b(closure));
    }
    DistanceError error = distance_beyond(joint, body_a(closure), body_b(closure));
    error.left = std::clamp(error.left, -greatest_undone, greatest_undone);
    return error;
}

Vec3 ClosureRows::left_apart_of(const Closure& closure) const {
    const Joint& joint = scene_.joints[closure.joint];
    if (in_substep_) {
        return left_of_points(joint, body_a(closure), body_b(closure));
    }
    Vec3 apart = points_apart(joint, body_a(closure), body_b(closure), false);
    clamp_vector(apart, greatest_undone);
    return apart;
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
    const Joint& joint = scene_.joints[closure.joint];
    Measured measured{};
    if (closure.closes && !is_distance(joint)) {
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
    const int reach = scene_.joints[closure.joint].constants.reach;
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
    Joint& joint = scene_.joints[closure.joint];
    const std::int64_t more = multiply_32(closure.pair_share, scaled_by(unknown.more, row.scale));
    const bool rests = unknown.side != 0 && unknown.pushed + unknown.more == 0;
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
        Joint& joint = scene_.joints[closure.joint];
        if (closure.closes && has_soft_points(joint.constants)) {
            hold_spring(joint, body_a(closure), body_b(closure));
        }
    });
}

} // namespace lks
