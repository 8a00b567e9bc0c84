// The ranges of joints.
#pragma once

#include "api/checks.h"

namespace lks {

// Of everything but where its points are, and between which bodies: for definitions and for images alike.
lks_result check_joint_ranges(const lks_world& world, const lks_joint_def& def);
lks_result check_joint_def(const lks_world& world, const lks_joint_def& def);
// Of a joint of this kind.
lks_result check_motor(const lks_world& world, std::uint32_t kind, const lks_motor& motor);
// LKS_OK, or reported: no such joint.
lks_result require_joint(const lks_world* world, lks_joint_id id);

} // namespace lks
