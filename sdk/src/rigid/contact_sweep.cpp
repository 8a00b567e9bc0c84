// Contacts one after the other, each upon what the others have done: Gauss and Seidel's sweeps. Bodies stay
// where they are meanwhile; how far a point has gone follows from its body's move to first order, which takes
// 0.6 of the instructions of moving the bodies each time. Where they all have got to is measured anew in each
// iteration.
#include <algorithm>

#include "rigid/contact.h"
#include "rigid/contact_points.h"

namespace lks {
namespace {

using fixed::Vec3;

// Beyond a push of a quarter of a metre friction grows no more.
constexpr std::int64_t greatest_gripping_push = std::int64_t{1} << (world_fraction_bits - 2);

std::int64_t grip(std::int64_t push, std::uint32_t friction) {
    return (std::min(push, greatest_gripping_push) * std::int64_t{friction}) >> 18;
}

// How far b's point has gone along a direction, less a's.
std::int64_t moved_along(const Contact& contact, const ContactRows& rows, int i, const ContactMoves& moves) {
    return fixed::dot(contact.directions[i], moves.b.shift - moves.a.shift) +
           turned_along(rows.b.rows[i], rows.b.arm_shift, moves.b) -
           turned_along(rows.a.rows[i], rows.a.arm_shift, moves.a);
}

void push(const Contact& contact, const ContactRows& rows, int i, std::int64_t p, ContactMoves& moves) {
    if (p == 0) {
        return;
    }
    const Vec3 along = fixed::scale(contact.directions[i], p);
    add_push(moves.a, rows.a.rows[i], contact.shares.a, rows.a.turn_shift, along, p, -1);
    add_push(moves.b, rows.b.rows[i], contact.shares.b, rows.b.turn_shift, along, p, 1);
}

// What all points need alike: one after the other they would turn a body that only has to be lifted.
void project_middle(Contact& contact, ContactMoves& moves) {
    std::int64_t least = greatest_push;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (point.active) {
            least = std::min(least, point.push.normal);
        }
    }
    const auto n = static_cast<std::int64_t>(contact.active_count);
    const std::int64_t gap = contact.middle_gap + moved_along(contact, contact.middle, normal_row, moves);
    const std::int64_t wanted = -divide(gap, contact.middle.inverses[normal_row]) / n;
    const std::int64_t more = std::clamp<std::int64_t>(wanted, -least, greatest_push);
    if (more == 0) {
        return;
    }
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        if (point.active) {
            point.push.normal = std::min(point.push.normal + more, greatest_push);
        }
    }
    push(contact, contact.middle, normal_row, n * more, moves);
}

void project_normal(const Contact& contact, ContactPoint& point, ContactMoves& moves) {
    const std::int64_t gap = point.gap + moved_along(contact, point.rows, normal_row, moves);
    const std::int64_t wanted = std::clamp<std::int64_t>(
        point.push.normal - divide(gap, point.rows.inverses[normal_row]), 0, greatest_push);
    const std::int64_t more = wanted - point.push.normal;
    point.push.normal = wanted;
    push(contact, point.rows, normal_row, more, moves);
}

// Whether a point slides, and not only gives way: friction's dynamic coefficient counts then. All points of a
// box on a slope bear what they can before it slides; as its lower edge bears more of it, its upper one is at
// its limit long before, and must keep what it has there.
bool slides(const ContactPoint& point, std::int64_t slow_slip) {
    fixed::NormalisedVector slip{};
    return fixed::normalise(Vec3{point.slip[0], point.slip[1], 0}, slip) && slip.length > slow_slip;
}

// Both rows across the normal at once, within the circle that the normal's push allows.
void project_friction(const Contact& contact, ContactPoint& point, ContactMoves& moves,
                      std::int64_t slow_slip) {
    std::int64_t wanted[2];
    for (int t = 0; t < 2; ++t) {
        const std::int64_t slip = point.slip[t] + moved_along(contact, point.rows, 1 + t, moves);
        wanted[t] = point.push.across[t] - divide(slip, point.rows.inverses[1 + t]);
    }
    std::int64_t most = grip(point.push.normal, contact.dynamic_friction);
    fixed::NormalisedVector size{};
    if (fixed::normalise(Vec3{wanted[0], wanted[1], 0}, size) && size.length > most) {
        if (!slides(point, slow_slip)) {
            most = std::min(size.length, grip(point.push.normal, contact.static_friction));
        }
        wanted[0] = fixed::scale_component(size.direction.x, most);
        wanted[1] = fixed::scale_component(size.direction.y, most);
    }
    for (int t = 0; t < 2; ++t) {
        const std::int64_t more = wanted[t] - point.push.across[t];
        point.push.across[t] = wanted[t];
        push(contact, point.rows, 1 + t, more, moves);
    }
}

} // namespace

void measure(Contact& contact, ContactBodies bodies) {
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        if (!point.active) {
            continue;
        }
        point.gap = gap_of(contact, point, cores_now(point, bodies.a, bodies.b), bodies);
        const Vec3 slid = distance_now(bodies.a, point.material_a, bodies.b, point.material_b) - point.start;
        for (int t = 0; t < 2; ++t) {
            point.slip[t] = fixed::dot(contact.directions[1 + t], slid);
        }
    }
    measure_middle(contact);
}

void measure_middle(Contact& contact) {
    if (contact.active_count <= 1) {
        return;
    }
    constexpr std::int64_t greatest_gap = std::int64_t{1} << 60; // so that four have a sum
    std::int64_t sum = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        if (contact.points[i].active) {
            sum += std::clamp(contact.points[i].gap, -greatest_gap, greatest_gap);
        }
    }
    contact.middle_gap = sum / static_cast<std::int64_t>(contact.active_count);
}

bool closes(const Contact& contact, const ContactBodies& bodies, std::int64_t distance) {
    return std::any_of(contact.points, contact.points + contact.count, [&](const ContactPoint& point) {
        return point.active && point.push.normal != 0 &&
               gap_of(contact, point, cores_now(point, bodies.a, bodies.b), bodies) < -distance;
    });
}

void project(Contact& contact, ContactMoves moves, bool back, std::int64_t slow_slip) {
    if (contact.active_count > 1) {
        project_middle(contact, moves);
    }
    for (std::uint32_t k = 0; k < contact.count; ++k) {
        ContactPoint& point = contact.points[back ? contact.count - 1 - k : k];
        if (!point.active) {
            continue;
        }
        project_normal(contact, point, moves);
        if (point.push.normal != 0 || point.push.across[0] != 0 || point.push.across[1] != 0) {
            project_friction(contact, point, moves, slow_slip);
        }
    }
}

} // namespace lks
