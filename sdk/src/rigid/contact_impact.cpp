// Impacts that give back speed: of single points before the prediction, and of several once velocities are
// known.
#include <algorithm>

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
    const std::int64_t most = fixed::multiply_shift(normal, contact.dynamic_friction, 18);
    const std::int64_t stops = divide(bounded(way.length, greatest_given), invert(weight));
    const std::int64_t p = -std::min(stops, most);
    accelerate(bodies.a, a.row, contact.shares.a, a.turn_shift, way.direction, p, -1);
    accelerate(bodies.b, b.row, contact.shares.b, b.turn_shift, way.direction, p, 1);
}

bool has_struck(const ContactPoint& point, std::int64_t least_approach) {
    return point.active && point.push.normal != 0 && point.approach > least_approach;
}

// Gives back speed at a contact's points, so that each of them parts as restitution wants it to where it
// pushes, and pushes nothing where it parts faster: what it pushed may be taken back, no more. So the work of
// all of them is what of it restitution does not give back.
class Restoring {
public:
    Restoring(Contact& contact, const ContactBodies& bodies, const ContactSpeeds& predicted,
              std::int64_t substeps_per_second)
        : contact_(contact), bodies_(bodies) {
        const fixed::Matrix3 turned_a = fixed::to_matrix(narrow(bodies.a.predicted_orientation));
        const fixed::Matrix3 turned_b = fixed::to_matrix(narrow(bodies.b.predicted_orientation));
        for (std::uint32_t i = 0; i < contact.count; ++i) {
            const ContactPoint& point = contact.points[i];
            if (!point.active) {
                continue;
            }
            const bool struck = has_struck(point, least_approach(contact.gravity_speed));
            struck_count_ += struck ? 1u : 0u;
            // Where it was when its rows were made: only so does what is given back do as much work as what
            // was taken.
            const Levers levers = surfaces_of(
                contact, {fixed::rotate(turned_a, point.core_a), fixed::rotate(turned_b, point.core_b)});
            const std::int64_t parting =
                struck ? fixed::multiply_shift(closing_speed(contact, levers, predicted), contact.restitution,
                                               world_fraction_bits)
                       : -closing_speed(contact, levers, now());
            points_[count_++] = {
                i, struck, levers, parting, -fixed::multiply_shift(point.push.normal, substeps_per_second, 0),
                0};
        }
    }

    bool any_struck() const { return struck_count_ > 0; }

    void run() {
        // What all points owe alike is given at their middle: one after the other they turn what comes down
        // flat.
        if (struck_count_ > 1 && struck_count_ == count_) {
            give_alike();
        }
        constexpr int most_rounds = 16;
        for (int round = 0; round < most_rounds && give_each(); ++round) {}
        rub_each();
    }

private:
    struct Point {
        std::uint32_t index;
        bool struck;
        Levers levers;
        std::int64_t parting; // World m/s: how fast it is to part
        std::int64_t least;   // what it may be given: less than nothing where it has pushed
        std::int64_t given;
    };

    ContactSpeeds now() const { return {bodies_.a.speeds(), bodies_.b.speeds()}; }

    std::int64_t owed(const Point& point) const {
        return bounded(point.parting + closing_speed(contact_, point.levers, now()), greatest_given);
    }

    void give_alike() {
        std::int64_t sum = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            sum += owed(points_[i]);
        }
        const std::int64_t speed = sum / static_cast<std::int64_t>(count_);
        if (speed > 0) {
            const std::int64_t p = divide(speed, contact_.middle.inverses[normal_row]);
            accelerate(contact_, contact_.middle, normal_row, p, bodies_);
            for (std::uint32_t i = 0; i < count_; ++i) {
                points_[i].given = p / count_;
            }
            contact_.given_speed = fixed::saturating_add(contact_.given_speed, p);
        }
    }

    // Whether anybody was given anything that is worth another round.
    bool give_each() {
        constexpr std::int64_t little = std::int64_t{1} << (world_fraction_bits - 14);
        constexpr std::int64_t most_given = std::int64_t{1} << 60;
        bool more = false;
        for (std::uint32_t i = 0; i < count_; ++i) {
            Point& point = points_[i];
            const ContactRows& rows = contact_.points[point.index].rows;
            const std::int64_t speed = owed(point);
            const std::int64_t wanted =
                fixed::saturating_add(point.given, divide(speed, rows.inverses[normal_row]));
            const std::int64_t most = point.struck ? most_given : 0;
            const std::int64_t p = std::clamp(wanted, point.least, most) - point.given;
            if (p != 0) {
                accelerate(contact_, rows, normal_row, p, bodies_);
                point.given += p;
                contact_.given_speed = fixed::saturating_add(contact_.given_speed, p);
                more = more || !within(speed, little);
            }
        }
        return more;
    }

    // What pushed in the substep rubbed then.
    void rub_each() {
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Point& point = points_[i];
            if (point.given > 0) {
                rub(contact_, point.levers, point.given, bodies_);
            }
        }
    }

    Contact& contact_;
    const ContactBodies& bodies_;
    Point points_[greatest_point_count];
    std::uint32_t count_ = 0;
    std::uint32_t struck_count_ = 0;
};

} // namespace

bool strike(Contact& contact, ContactBodies bodies, const MotionRate& rate) {
    if (contact.restitution == 0 || contact.count != 1) {
        return false;
    }
    const ContactPoint& point = contact.points[0];
    const Levers levers = surfaces_of(contact, cores_now(point, bodies.a, bodies.b));
    const std::int64_t approach = closing_speed(contact, levers, bodies.a, bodies.b);
    if (approach <= least_approach(contact.gravity_speed) ||
        point.separation > approach / rate.substeps_per_second) {
        return false;
    }
    ContactRows rows;
    fill_rows(contact, bodies, levers, 1, rows);
    const std::int64_t back = fixed::multiply_shift(approach, contact.restitution, world_fraction_bits);
    const std::int64_t p = divide(bounded(approach + back, greatest_given), rows.inverses[normal_row]);
    contact.given_speed = fixed::saturating_add(contact.given_speed, p);
    accelerate(contact, rows, normal_row, p, bodies);
    rub(contact, levers, p, bodies);
    return true;
}

void restore_speed(Contact& contact, ContactBodies bodies, const ContactSpeeds& predicted,
                   const MotionRate& rate) {
    if (contact.restitution == 0) {
        return;
    }
    Restoring restoring(contact, bodies, predicted, rate.substeps_per_second);
    if (restoring.any_struck()) {
        restoring.run();
    }
}

} // namespace lks
