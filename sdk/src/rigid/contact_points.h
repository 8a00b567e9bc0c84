// Where the two sides of a contact's points are.
#pragma once

#include "rigid/contact.h"

namespace lks {

// From a point of a to a point of b, in world axes.
inline fixed::Vec3 distance_now(const Body& a, const fixed::Vec3& on_a, const Body& b,
                                const fixed::Vec3& on_b) {
    return (b.position - a.position) + fixed::rotate(b.rotation, on_b) - fixed::rotate(a.rotation, on_a);
}

// From each centre of mass, in world axes.
struct Levers {
    fixed::Vec3 a, b;
};

inline Levers cores_now(const ContactPoint& point, const Body& a, const Body& b) {
    return {fixed::rotate(a.rotation, point.core_a), fixed::rotate(b.rotation, point.core_b)};
}

// Where the surfaces meet. A round surface has turned away under that place: the material point there at the
// beginning would give the push an arm that it hasn't got.
inline Levers surfaces_of(const Contact& contact, const Levers& cores) {
    return {cores.a + fixed::scale(contact.normal(), contact.radius_a),
            cores.b - fixed::scale(contact.normal(), contact.radius_b)};
}

// How fast the surfaces close there, World m/s.
inline std::int64_t closing_speed(const fixed::Direction& normal, const Levers& levers,
                                  const ContactSpeeds& speeds) {
    return -fixed::dot(normal, velocity_at(speeds.b, levers.b) - velocity_at(speeds.a, levers.a));
}

inline std::int64_t closing_speed(const Contact& contact, const Levers& levers, const ContactSpeeds& speeds) {
    return closing_speed(contact.normal(), levers, speeds);
}

inline std::int64_t closing_speed(const Contact& contact, const Levers& levers, const Body& a,
                                  const Body& b) {
    return closing_speed(contact, levers, {a.speeds(), b.speeds()});
}

// How much the surfaces have parted along the normal in this substep, beyond what they may close or have to
// part. Round surfaces part as their cores do, however they turn.
inline std::int64_t gap_of(const Contact& contact, const ContactPoint& point, const Levers& cores,
                           const ContactBodies& bodies) {
    const fixed::Vec3 motion = (bodies.b.position - bodies.a.position) + cores.b - cores.a - point.core_start;
    return fixed::dot(contact.normal(), motion) + point.allowed;
}

// How far surfaces that are so far apart may close in a substep.
std::int64_t allowed_motion(std::int64_t separation, bool jointed, const MotionRate& rate);

// Once it is known where it begins the substep.
inline void begin_point(ContactPoint& point, bool jointed, const MotionRate& rate) {
    point.allowed = allowed_motion(point.separation, jointed, rate);
    point.active = false;
}

// Whether pushes at it are looked at in this substep; what is not pushed has no push of before.
inline bool activate(Contact& contact, ContactPoint& point, bool near) {
    point.active = near || point.push.normal != 0;
    if (point.active) {
        ++contact.active_count;
    } else {
        point.push = {point.push.feature, 0, point.push.place, 0, {0, 0}};
    }
    return point.active;
}

// Of several active points the rows at their middle: their levers added up.
void make_middle(Contact& contact, const ContactBodies& bodies, const Levers& sum);
// And its gap.
void measure_middle(Contact& contact);

// Rows at these levers along the first `count` directions.
void fill_rows(const Contact& contact, const ContactBodies& bodies, const Levers& levers, int count,
               ContactRows& rows);

} // namespace lks
