// The ranges of attachments.
#pragma once

#include "api/checks.h"
#include "rigid/attachment.h"

namespace lks {

// For definitions and for images alike.
lks_result check_attachment_ranges(const lks_world& world, lks_fixed compliance, lks_fixed damping,
                                   lks_fixed break_force);
lks_result check_attachment_def(const lks_world& world, const lks_attachment_def& def);
// That no attachment which neither stretches nor breaks holds the vertex at something that can't move, before
// another such attachment or a pin holds it, too: `refused` says of it what it then can't be.
lks_result check_held_nowhere(const lks_world& world, lks_object_id object, std::uint32_t vertex,
                              const char* refused);
// That none of them holds the particle at another point of the body: that contradicts itself, whatever moves.
lks_result check_held_at_one_point(const lks_world& world, const AttachmentDescription& made,
                                   std::uint32_t vertex);
// LKS_OK, or reported: no such attachment.
lks_result require_attachment(const lks_world* world, lks_attachment_id id);

} // namespace lks
