#include "rigid/foot_rows.h"

#include "rigid/contact_points.h"

namespace lks {

std::int64_t foot_gap(const Contact& contact, const ContactPoint& point, const ContactBodies& bodies) {
    return gap_of(contact, point, cores_now(point, bodies.a, bodies.b), bodies);
}

fixed::Vec3 pushed_at(const Contact& contact, const ContactPoint& point) {
    return fixed::scale(contact.normal(), point.push.normal) +
           fixed::scale(contact.directions[1], point.push.across[0]) +
           fixed::scale(contact.directions[2], point.push.across[1]);
}

bool is_near_foot_point(const Contact& contact, const ContactPoint& point, const ContactBodies& bodies) {
    return point.push.normal != 0 || foot_gap(contact, point, bodies) < near_point;
}

fixed::Vec3 foot_lever(const Contact& contact, const ContactPoint& point, const ContactBodies& bodies,
                       bool of_a) {
    const Levers levers = surfaces_of(contact, cores_now(point, bodies.a, bodies.b));
    return of_a ? levers.a : levers.b;
}

} // namespace lks
