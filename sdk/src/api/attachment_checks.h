// The ranges of attachments.
#pragma once

#include "api/checks.h"

namespace lks {

// For definitions and for images alike.
lks_result check_attachment_ranges(const lks_world& world, lks_fixed compliance, lks_fixed damping,
                                   lks_fixed break_force);
lks_result check_attachment_def(const lks_world& world, const lks_attachment_def& def);
// LKS_OK, or reported: no such attachment.
lks_result require_attachment(const lks_world* world, lks_attachment_id id);

} // namespace lks
