// What the solver of rigid/closure_tree.h keeps of a joint.
#pragma once

#include "rigid/held_row.h"
#include "rigid/row_joint.h"

namespace lks {

struct ClosureTreeJoint : RowJoint<FineRows> { // its points' rows, and those of what must not turn
    fixed::Vec3 child_lever;                   // as ArticulatedJoint's
    fixed::Vec3 parent_lever;
    std::uint32_t turn_count;
    std::uint32_t first_drive;              // of those: what the motor turns
    fixed::Direction axes[most_held_rows];  // in the world
    fixed::Vec3 child_axes[most_held_rows]; // times the reach, in the body's unit, 40 fraction bits
    fixed::Vec3 parent_axes[most_held_rows];
};

} // namespace lks
