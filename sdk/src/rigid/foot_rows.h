// Contacts of light feet (rigid/light_feet.h) as rows of the system of rigid/closure_rows.h: one for each of
// their points, along the normal. Friction is left to the sweeps.
#pragma once

#include "rigid/contact.h"

namespace lks {

// Whether a point may be pushed in this substep.
bool is_near_foot_point(const Contact& contact, const ContactPoint& point, const ContactBodies& bodies);

// Where the surfaces meet, from the centre of mass of one of the bodies, in world axes.
fixed::Vec3 foot_lever(const Contact& contact, const ContactPoint& point, const ContactBodies& bodies,
                       bool of_a);

// What it has pushed, and rubbed, from a to b.
fixed::Vec3 pushed_at(const Contact& contact, const ContactPoint& point);

// How far a point has parted, less what was open: what is less than nothing is to be brought to nothing.
std::int64_t foot_gap(const Contact& contact, const ContactPoint& point, const ContactBodies& bodies);

} // namespace lks
