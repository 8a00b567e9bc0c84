// Impacts that give back speed: of single points before the prediction, and of several once velocities are
// known.
#include <algorithm>

#include "fixed/formats.h"
#include "kernels/bounded.h"
#include "rigid/contact.h"
#include "rigid/contact_points.h"

namespace lks {
namespace {

// At once, World m/s: what divide() takes.
constexpr std::int64_t greatest_given = std::int64_t{1} << 55;

// By an impulse along one of the contact's directions.
void accelerate(const Contact& contact, const ContactRows& rows, int row, std::int64_t p,
                const ContactBodies& bodies) {
    const fixed::Direction& along = contact.directions[row];
    accelerate(bodies.a, rows.a.rows[row], contact.shares.a, rows.a.turn_shift, along, p, -1);
    accelerate(bodies.b, rows.b.rows[row], contact.shares.b, rows.b.turn_shift, along, p, 1);
}

// One side of a row of its own: what it does to a body, its weight being added to.
struct ImpactSide {
    PushRow row;
    std::int32_t turn_shift;
};
ImpactSide impact_side(const Body& body, std::int32_t share, const fixed::Direction& along,
                       const fixed::Vec3& lever, std::int64_t& weight) {
    if (share == 0) {
        return {};
    }
    const UnitLever unit = to_unit(body, lever);
    return {push_row(body, share, along, unit, weight), unit.turn_shift};
}

// Coulomb's friction of an impulse along the normal, at once: what slips is stopped, or slides on by what
// that leaves. It pushes against the way that it slips, whichever way that is, and takes energy out: it
// undoes no more than the slip there is.
void rub(const Contact& contact, const Levers& levers, std::int64_t normal, const ContactBodies& bodies) {
    const fixed::Direction& n = contact.normal();
    const fixed::Vec3 slip = velocity_at(bodies.b, levers.b) - velocity_at(bodies.a, levers.a);
    fixed::NormalisedVector way{};
    if (!fixed::normalise(slip - fixed::scale(n, fixed::dot(n, slip)), way)) {
        return;
    }
    std::int64_t weight = 0;
    const ImpactSide a = impact_side(bodies.a, contact.shares.a, way.direction, levers.a, weight);
    const ImpactSide b = impact_side(bodies.b, contact.shares.b, way.direction, levers.b, weight);
    const std::int64_t most = fixed::multiply_shift(normal, contact.dynamic_friction, friction_fraction_bits);
    const std::int64_t stops = divide(bounded(way.length, greatest_given), invert(weight));
    const std::int64_t p = -std::min(stops, most);
    accelerate(bodies.a, a.row, contact.shares.a, a.turn_shift, way.direction, p, -1);
    accelerate(bodies.b, b.row, contact.shares.b, b.turn_shift, way.direction, p, 1);
}

bool has_struck(const ContactPoint& point, std::int64_t least_approach) {
    return point.active && point.push.normal != 0 && point.approach > least_approach;
}

// A contact's points where its rows were made: only so does what is given back do as much work as what was
// taken.
class ImpactLevers {
public:
    ImpactLevers(const Contact& contact, const ContactBodies& bodies)
        : contact_(contact), turned_a_(fixed::to_matrix(narrow(bodies.a.predicted_orientation))),
          turned_b_(fixed::to_matrix(narrow(bodies.b.predicted_orientation))) {}

    Levers of(const ContactPoint& point) const {
        return surfaces_of(contact_,
                           {fixed::rotate(turned_a_, point.core_a), fixed::rotate(turned_b_, point.core_b)});
    }

private:
    const Contact& contact_;
    fixed::Matrix3 turned_a_;
    fixed::Matrix3 turned_b_;
};

ContactSpeeds speeds_now(const ContactBodies& bodies) {
    return {bodies.a.speeds(), bodies.b.speeds()};
}

std::int64_t owed(const Contact& contact, const ContactPoint& point, const Levers& levers,
                  const ContactBodies& bodies) {
    return bounded(point.parting + closing_speed(contact, levers, speeds_now(bodies)), greatest_given);
}

} // namespace

bool is_about_to_strike(const Contact& contact, const ContactBodies& bodies, const MotionRate& rate) {
    if (contact.restitution == 0) {
        return false;
    }
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        const Levers levers = surfaces_of(contact, cores_now(point, bodies.a, bodies.b));
        const std::int64_t approach = closing_speed(contact, levers, bodies.a, bodies.b);
        if (approach > least_approach(contact.gravity_speed) &&
            point.separation <= approach / rate.substeps_per_second) {
            return true;
        }
    }
    return false;
}

bool strike(Contact& contact, ContactBodies bodies, const MotionRate& rate) {
    if (contact.count != 1 || !is_about_to_strike(contact, bodies, rate)) {
        return false;
    }
    const Levers levers = surfaces_of(contact, cores_now(contact.points[0], bodies.a, bodies.b));
    const std::int64_t approach = closing_speed(contact, levers, bodies.a, bodies.b);
    ContactRows rows;
    fill_rows(contact, bodies, levers, 1, rows);
    const std::int64_t back = fixed::multiply_shift(approach, contact.restitution, world_fraction_bits);
    const std::int64_t p = divide(bounded(approach + back, greatest_given), rows.inverses[normal_row]);
    contact.given_speed = fixed::saturating_add(contact.given_speed, p);
    accelerate(contact, rows, normal_row, p, bodies);
    rub(contact, levers, p, bodies);
    return true;
}

void begin_impact(Contact& contact, const ContactBodies& bodies, const ContactSpeeds& predicted) {
    contact.struck_count = 0;
    if (contact.restitution == 0) {
        return;
    }
    const ImpactLevers levers(contact, bodies);
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        point.given = 0;
        point.struck = has_struck(point, least_approach(contact.gravity_speed));
        contact.struck_count += point.struck ? 1u : 0u;
        const Levers at = levers.of(point);
        point.parting = point.struck ? fixed::multiply_shift(closing_speed(contact, at, predicted),
                                                             contact.restitution, world_fraction_bits)
                                     : -closing_speed(contact, at, speeds_now(bodies));
    }
}

void give_alike(Contact& contact, ContactBodies bodies) {
    if (contact.struck_count < 2 || contact.struck_count != contact.active_count) {
        return;
    }
    const ImpactLevers levers(contact, bodies);
    const auto count = static_cast<std::int64_t>(contact.active_count);
    std::int64_t sum = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        sum += point.active ? owed(contact, point, levers.of(point), bodies) : 0;
    }
    if (sum / count <= 0) {
        return;
    }
    const std::int64_t p = divide(sum / count, contact.middle.inverses[normal_row]);
    accelerate(contact, contact.middle, normal_row, p, bodies);
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        contact.points[i].given = contact.points[i].active ? p / count : 0;
    }
    contact.given_speed = fixed::saturating_add(contact.given_speed, p);
}

bool give_each(Contact& contact, ContactBodies bodies, const MotionRate& rate) {
    constexpr std::int64_t little = std::int64_t{1} << (world_fraction_bits - 14);
    constexpr std::int64_t most_given = std::int64_t{1} << 60;
    const ImpactLevers levers(contact, bodies);
    bool more = false;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        ContactPoint& point = contact.points[i];
        if (!point.active) {
            continue;
        }
        const std::int64_t speed = owed(contact, point, levers.of(point), bodies);
        const std::int64_t wanted =
            fixed::saturating_add(point.given, divide(speed, point.rows.inverses[normal_row]));
        const std::int64_t least = -fixed::multiply_shift(point.push.normal, rate.substeps_per_second, 0);
        const std::int64_t p = std::clamp(wanted, least, point.struck ? most_given : 0) - point.given;
        if (p != 0) {
            accelerate(contact, point.rows, normal_row, p, bodies);
            point.given += p;
            contact.given_speed = fixed::saturating_add(contact.given_speed, p);
            more = more || !within(speed, little);
        }
    }
    return more;
}

// What pushed in the substep rubbed then.
void rub_by_impact(Contact& contact, ContactBodies bodies) {
    const ImpactLevers levers(contact, bodies);
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const ContactPoint& point = contact.points[i];
        if (point.active && point.given > 0) {
            rub(contact, levers.of(point), point.given, bodies);
        }
    }
}

} // namespace lks
