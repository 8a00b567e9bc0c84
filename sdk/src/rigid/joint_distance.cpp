#include "rigid/joint_distance.h"

#include <algorithm>

namespace lks {
namespace {

using fixed::Direction;
using fixed::NormalisedVector;
using fixed::Vec3;

bool is_soft(const Joint& joint) {
    return joint.constants.points.softness != 0;
}

bool is_rod(const JointDescription& d) {
    return d.distance_min == d.distance_max;
}

// From a's point to b's; where one is in the other: against what it has pushed, or any direction.
NormalisedVector way_along(const Vec3& offset, const Vec3& pushed) {
    NormalisedVector way{};
    if (fixed::normalise(offset, way)) {
        return way;
    }
    if (fixed::normalise(-pushed, way)) {
        way.length = 0;
        return way;
    }
    return NormalisedVector{{direction_one, 0, 0}, 0};
}

class DistanceRow {
public:
    DistanceRow(const Joint& joint, const Body& a, const Body& b, const Direction& way)
        : way_(way), weight_(joint.constants.points.softness),
          side_a_(push_side(a, joint.constants.shares.a, way,
                            fixed::rotate(a.rotation, joint.description.point_a), weight_)),
          side_b_(push_side(b, joint.constants.shares.b, way,
                            fixed::rotate(b.rotation, joint.description.point_b), weight_)),
          most_(greatest_step_of(joint.constants.points)) {}

    // What brings them nearer by that.
    std::int64_t push_for(std::int64_t nearer) const {
        return -divide(std::clamp(nearer, -most_, most_), invert(weight_));
    }
    // How far a push moves them.
    std::int64_t moved_by(std::int64_t p) const { return fixed::multiply_shift(p, weight_, 30); }
    void apply(Body& a, Body& b, std::int64_t p) const {
        const Vec3 along = fixed::scale(way_, p);
        push(a, side_a_, along, p, -1);
        push(b, side_b_, along, p, 1);
    }

private:
    Direction way_;
    std::int64_t weight_;
    RowSide side_a_;
    RowSide side_b_;
    std::int64_t most_;
};

// By how much it is too long, or, below zero, too short.
std::int64_t distance_error(const JointDescription& d, std::int64_t length) {
    return length - std::clamp(length, d.distance_min, d.distance_max);
}

struct Range {
    std::int64_t least;
    std::int64_t most;
};

// What the substep lets be: a rod is held where it is, what is too long for a rope may get shorter.
Range allowed_range(const Joint& joint) {
    const JointDescription& d = joint.description;
    const std::int64_t kept = joint.kept_error;
    if (is_rod(d)) {
        return {d.distance_min + kept, d.distance_max + kept};
    }
    return {d.distance_min + std::min<std::int64_t>(kept, 0),
            d.distance_max + std::max<std::int64_t>(kept, 0)};
}

// Whether it is a rope or a strut by now: by what it has pushed, or by which of the two it is nearer to.
int side_of(std::int64_t length, std::int64_t least, std::int64_t most, std::int64_t pushed) {
    return pushed != 0 ? (pushed < 0 ? -1 : 1) : most - length <= length - least ? -1 : 1;
}

} // namespace

void begin_distance(Joint& joint, const Body& a, const Body& b) {
    joint.kept_error = 0;
    const NormalisedVector way = way_along(joint.begin, joint.push);
    const std::int64_t error = distance_error(joint.description, way.length);
    if (joint.in_tree) {
        joint.kept_error = is_soft(joint) ? 0 : error;
    } else if (error != 0 && !is_soft(joint)) {
        const std::int64_t pushed = fixed::dot(way.direction, joint.push);
        const std::int64_t moved =
            DistanceRow(joint, a, b, way.direction).moved_by(pushed < 0 ? -pushed : pushed);
        joint.kept_error = error - std::clamp(error, -moved, moved);
    }
}

void project_distance(Joint& joint, Body& a, Body& b) {
    const JointDescription& d = joint.description;
    const Vec3 offset = joint_offset(joint, a, b);
    const NormalisedVector way = way_along(offset, joint.push);
    const bool rod = is_rod(d);
    const auto [least, most] = allowed_range(joint);
    // What the push along the way was, and what it may be: it holds back, or off.
    const std::int64_t pushed = fixed::dot(way.direction, joint.push);
    std::int64_t error = 0;
    bool pulls = false;
    if (way.length > most || (pushed < 0 && !rod)) {
        error = way.length - most;
        pulls = true;
    } else if (way.length < least || (pushed > 0 && !rod)) {
        error = way.length - least;
    } else if (!rod) {
        joint.push = {0, 0, 0};
        return;
    }
    const std::int64_t motion = fixed::dot(way.direction, offset - joint.begin);
    const DistanceRow row(joint, a, b, way.direction);
    std::int64_t p = row.push_for(soften(joint.constants.points, error, motion, pushed));
    if (!rod) {
        // A rope only pulls, a strut only pushes.
        const std::int64_t total =
            pulls ? std::min<std::int64_t>(pushed + p, 0) : std::max<std::int64_t>(pushed + p, 0);
        p = total - pushed;
    }
    joint.push = fixed::scale(way.direction, pushed + p);
    row.apply(a, b, p);
}

DistanceError left_of_distance(const Joint& joint, const Body& a, const Body& b) {
    const Softness& softness = joint.constants.points;
    const Vec3 offset = joint_offset(joint, a, b);
    const NormalisedVector way = way_along(offset, joint.push);
    const auto [least, most] = allowed_range(joint);
    const std::int64_t pushed = fixed::dot(way.direction, joint.push);
    const std::int64_t motion = fixed::dot(way.direction, offset - joint.begin);
    const int side = is_rod(joint.description) ? 0 : side_of(way.length, least, most, pushed);
    const std::int64_t left = soften(softness, way.length - (side > 0 ? least : most), motion, pushed);
    const std::int64_t step = greatest_step_of(softness);
    return {way.direction, std::clamp(left, -step, step), pushed, side};
}

DistanceError distance_beyond(const Joint& joint, const Body& a, const Body& b) {
    const JointDescription& d = joint.description;
    const NormalisedVector way = way_along(joint_offset(joint, a, b), joint.push);
    if (is_soft(joint)) {
        return {way.direction, way.length - joint.kept_error, 0, 0};
    }
    const int side = is_rod(d) ? 0 : side_of(way.length, d.distance_min, d.distance_max, 0);
    return {way.direction, way.length - (side > 0 ? d.distance_min : d.distance_max), 0, side};
}

void hold_spring(Joint& joint, const Body& a, const Body& b) {
    joint.start = joint_offset(joint, a, b);
    joint.kept_error = way_along(joint.start, joint.push).length;
}

void undo_distance(const Joint& joint, Body& a, Body& b) {
    if (joint.kept_error == 0) {
        return;
    }
    const NormalisedVector way = way_along(joint_offset(joint, a, b), joint.push);
    const std::int64_t error = distance_error(joint.description, way.length);
    const std::int64_t undone = std::clamp(error, std::min<std::int64_t>(joint.kept_error, 0),
                                           std::max<std::int64_t>(joint.kept_error, 0));
    const DistanceRow row(joint, a, b, way.direction);
    row.apply(a, b, row.push_for(undone));
}

} // namespace lks
