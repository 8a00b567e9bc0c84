// What has to be right of a ragdoll's description before anything else can be looked at.
#pragma once

#include <lockstitch/ragdoll.h>

#include "api/checks.h"

namespace lks {

// LKS_OK, or reported: its size, how many bones there are, its scale, each bone's parent, and what its joint
// bears and its motor turns with, which the scale is put on.
lks_result check_bone_tree(const lks_world& world, const lks_ragdoll_def& def);

} // namespace lks
