// What the solver of rigid/held_tree.h keeps of a joint.
#pragma once

#include "rigid/held_row.h"
#include "rigid/row_joint.h"

namespace lks {

struct HeldJoint : RowJoint<CoarseRows> { // its points' rows, and those that push
    HeldRow rows[most_held_rows];
    bool pushes[most_held_rows]; // or is a limit that is not reached
    std::uint32_t row_count;
    std::int64_t softness[most_held_rows];
    fixed::Vec3 child_axes[most_held_rows]; // times the reach, in the body's unit
    fixed::Vec3 parent_axes[most_held_rows];
    fixed::Vec3 error; // of the points: child less parent, World
};

} // namespace lks
