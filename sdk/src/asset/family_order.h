// In which order an asset's families are swept: what is damped more stands before what is damped less.
//
// To a constraint's damping (XPBD eq. 26) all that has moved its ends in the substep is motion, also what
// other constraints have pulled them back by. Swept after threads that don't give, a shear damped far beyond
// critical undoes what they did, so that each substep pulls anew, and that is speed without end. Swept
// before them it sees what the particles bring along, and only takes out of that.
#pragma once

#include "asset/asset.h"

namespace lks {

struct FamilyOrder {
    std::uint32_t place[family_count]; // of each family, 0 is swept first
};

// By the time that damping takes, compliance · damping in seconds, which is γ of any substep but for its
// length; the longest first, and where it is the same stretch, shear, bend.
FamilyOrder order_families(const Family (&families)[family_count]);

} // namespace lks
