// Contacts one after the other, each upon what the others have done: Gauss and Seidel's sweeps. Bodies stay
// where they are meanwhile; how far a point has gone follows from its body's move to first order, which takes
// 0.6 of the instructions of moving the bodies each time. Where they all have got to is measured anew in each
// iteration.
#include <algorithm>

#include "fixed/formats.h"
#include "rigid/contact.h"
#include "rigid/contact_points.h"

namespace lks {
namespace {

using fixed::Vec3;

// Beyond a push of a quarter of a metre friction grows no more.
constexpr std::int64_t greatest_gripping_push = std::int64_t{1} << (world_fraction_bits - 2);

std::int64_t grip(std::int64_t push, std::uint32_t friction) {
    return (std::min(push, greatest_gripping_push) * std::int64_t{friction}) >> friction_fraction_bits;
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

// One, of 30 fraction bits, times the quotient of two inverses of which the first is the lesser.
std::int64_t quotient(const Inverse& lesser, const Inverse& greater) {
    const auto ratio = static_cast<std::int64_t>((std::uint64_t{lesser.mantissa} << 30) / greater.mantissa);
    return fixed::shift_right_rounded(ratio, std::min(lesser.shift - greater.shift, 63));
}

// The direction in which friction pushes that bears the share `a` of what both rows want: p*, of length one.
// Of all pushes in the circle the one that leaves the least motion, weighed by the rows' weights W, is
//
//     p = (W + λ)⁻¹ W p*,    |p| = a,
//
// whose slip W (p* − p) is along p: friction pushes against what slips on. p* cut to the circle would turn a
// plank aside that is thrown at an angle to its length. With t for λ over the greater weight, times a, and q
// for the lesser weight over the greater, the parts of p / a are p*₁ / (a + t) and p*₂ q / (a q + t); t lies
// between (1 − a) q and 1 − a, and 1 / |p| is all but linear in it (the secular equation: Moré and Sorensen
// 1983).
void turn_to_slip(const ContactRows& rows, std::int64_t most, fixed::NormalisedVector& size) {
    constexpr std::int64_t one = direction_one;
    constexpr std::int64_t alike = one - one / 64;
    const Inverse& first = rows.inverses[1];
    const Inverse& second = rows.inverses[2];
    const bool first_is_heavier = &lesser(first, second) == &first;
    const std::int64_t q = first_is_heavier ? quotient(first, second) : quotient(second, first);
    if (q >= alike) {
        return;
    }
    const auto times = [](std::int64_t x, std::int64_t y) { return (x * y) >> 30; };
    const std::int64_t heavy = first_is_heavier ? size.direction.x : size.direction.y;
    const std::int64_t light = first_is_heavier ? size.direction.y : size.direction.x;
    const std::int64_t a = fixed::multiply_divide(most, one, size.length);
    // 1 / |p| in units of 1 / a.
    const auto reach = [&](std::int64_t t) {
        const std::int64_t of_heavy = a + t;
        const std::int64_t of_light = times(a, q) + t;
        fixed::NormalisedVector both{{0, 0, 0}, 1};
        fixed::normalise(Vec3{times(heavy, of_light), times(times(light, q), of_heavy), 0}, both);
        return fixed::multiply_divide(times(of_heavy, of_light), one, both.length);
    };
    const std::int64_t low = times(one - a, q);
    const std::int64_t high = one - a;
    const std::int64_t least = reach(low);
    const std::int64_t greatest = reach(high);
    const std::int64_t share =
        greatest > least
            ? std::clamp<std::int64_t>(fixed::multiply_divide(one - least, one, greatest - least), 0, one)
            : 0;
    const std::int64_t t = low + times(high - low, share);
    const std::int64_t of_heavier = times(heavy, times(a, q) + t);
    const std::int64_t of_lighter = times(times(light, q), a + t);
    fixed::normalise(first_is_heavier ? Vec3{of_heavier, of_lighter, 0} : Vec3{of_lighter, of_heavier, 0},
                     size);
}

// Both rows across the normal at once, within the circle that the normal's push allows.
void project_friction(const Contact& contact, ContactPoint& point, ContactMoves& moves,
                      const MotionRate& rate) {
    std::int64_t wanted[2];
    for (int t = 0; t < 2; ++t) {
        const std::int64_t slip = point.slip[t] + moved_along(contact, point.rows, 1 + t, moves);
        wanted[t] = point.push.across[t] - divide(slip, point.rows.inverses[1 + t]);
    }
    std::int64_t most = grip(point.push.normal, contact.dynamic_friction);
    fixed::NormalisedVector size{};
    if (fixed::normalise(Vec3{wanted[0], wanted[1], 0}, size) && size.length > most) {
        if (!slides(point, (contact.gravity_speed + slow_contact) / rate.substeps_per_second)) {
            most = std::min(size.length, grip(point.push.normal, contact.static_friction));
        }
        if (size.length > most) {
            turn_to_slip(point.rows, most, size);
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

void project(Contact& contact, ContactMoves moves, bool back, const MotionRate& rate) {
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
            project_friction(contact, point, moves, rate);
        }
    }
}

} // namespace lks
