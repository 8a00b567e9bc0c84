// Which objects go through a tick together with bodies and with each other: those that attachments hold, and
// those that may touch a body. All others need nobody.
#pragma once

#include "solver/world.h"

namespace lks {

// At the beginning of a tick: fills the scene's is_coupled, coupled, object_pairs and object_pushes. Pairs
// beyond their room are left out and counted.
void find_coupled(lks_world& world);

inline bool is_coupled(const RigidScene& scene, std::size_t object) {
    return !scene.is_coupled.empty() && scene.is_coupled[object] != 0;
}

// The two sides of an attachment in use.
AttachmentSides sides_of(lks_world& world, const Attachment& attachment);
// For reading.
inline AttachmentSides sides_of(const lks_world& world, const Attachment& attachment) {
    return sides_of(const_cast<lks_world&>(world), attachment);
}
// Calls use(attachment, sides) for each attachment in use.
template <typename Use>
void for_each_attachment(lks_world& world, const Use& use) {
    RigidScene& scene = world.rigid;
    for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
        if (scene.attachment_slots[i].used) {
            use(scene.attachments[i], sides_of(world, scene.attachments[i]));
        }
    }
}

// After something was pinned, or has changed its kind.
inline void follow_masses(lks_world& world) {
    for_each_attachment(world, [&world](Attachment& attachment, const AttachmentSides& sides) {
        follow_masses(attachment, sides, world.rate);
    });
}

} // namespace lks
