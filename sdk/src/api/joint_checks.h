// The ranges of joints.
#pragma once

#include "api/checks.h"

namespace lks {

// Of a joint's break_force, N, and break_torque, N·m.
inline constexpr lks_fixed greatest_break_strength = LKS_FIXED(8000000);

// Of everything but where its points are, and between which bodies: for definitions and for images alike.
lks_result check_joint_ranges(const lks_world& world, const lks_joint_def& def);
// Where they are.
lks_result check_joint_points(const lks_world& world, const lks_joint_def& def);
lks_result check_joint_def(const lks_world& world, const lks_joint_def& def);
// Of a joint of this kind.
lks_result check_motor(const lks_world& world, std::uint32_t kind, const lks_motor& motor);
// LKS_OK, or reported: no such joint.
lks_result require_joint(const lks_world* world, lks_joint_id id);

} // namespace lks
