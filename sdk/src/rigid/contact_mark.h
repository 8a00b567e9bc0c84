// Where in a tick a contact gave most, for events. Kept beside the contacts and only while anybody asks.
#pragma once

#include "rigid/contact.h"

namespace lks {

struct ContactMark {
    std::int64_t known; // World m/s: what the contact had given in this tick when it was last looked at
    std::int64_t most;  // and the most that it gave between two looks
    fixed::Vec3 place;  // World: then
    fixed::Direction normal;
};

// Between both surfaces, the middle of the points that push, weighed by their pushes; where none does of
// those that are active, or of all.
fixed::Vec3 place_of(const Contact& contact, const Body& a, const Body& b);

// At the end of a substep.
inline void look(ContactMark& mark, const Contact& contact, const Body& a, const Body& b) {
    const std::int64_t given = contact.given_speed - mark.known;
    if (given > mark.most) {
        mark.most = given;
        mark.place = place_of(contact, a, b);
        mark.normal = contact.normal();
    }
    mark.known = contact.given_speed;
}

} // namespace lks
