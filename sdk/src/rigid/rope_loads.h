// What bodies weigh on ropes that are solved at once.
//
// An attachment shares its error out by masses: of what a particle of 20 g and a body of 80 kg are apart, the
// body would get a four-thousandth in an iteration, and fall on, however taut the rope is. But where a rope
// is solved at once it is solved exactly with any masses. So its particles that bodies hang on count in it
// with what hangs there,
//
//     1 / w = m + Σ 1 / (nᵀ K n)        K: how a push moves the body's point (rigid/block.h)
//
// n being along the rope's last segment; and what the solve moves such a particle by, each body's point is
// moved by, too, by the push m_body·Δ that it has been counted with: momentum is kept exactly. What is
// kinematic counts as a pin.
//
// Bodies in a tree of joints are counted, and pushed, with all that hangs on them (rigid/articulation.h), and
// a tree whose rope something holds is one that is held (rigid/held_tree.h): limits of its joints are solved
// with it where they are exceeded. One of very uneven masses (rigid/uneven_tree.h) is left to its
// attachments: a push from outside knows shares of 32 fraction bits only. So that rope and body are where the
// solve takes them to be, attachments come before it as well; it is done at the beginning of an iteration and
// at its end.
#pragma once

#include <algorithm>

#include "solver/world.h"

namespace lks {

// Whether the attachment may weigh on its object: that needs coefficients of its own then.
inline bool may_load_rope(const AttachmentDescription& d, const Object& object) {
    return d.kind == LKS_ATTACHMENT_TO_BODY && d.compliance == 0 && !object.coefficients().chain.empty();
}

// At the beginning of a tick, after attachments have begun it: which ropes bear something. A rope whose
// bodies are so light that attachments alone hold them goes without.
void find_rope_loads(lks_world& world);
// Without what trees of uneven masses weigh: bodies that are marked so no more (ArticulatedBody::loads_rope).
void drop_loads(RigidScene& scene);
// The constraints of one of these objects, in an iteration, with what hangs on it.
void project_loaded_rope(lks_world& world, std::uint32_t object);
// At a substep's end, where errors are undone without giving speed: what they have moved bodies off by.
void undo_rope_loads(lks_world& world, std::uint32_t object);
// At the end of a tick's substeps: ropes know nothing of it any more.
void forget_rope_loads(lks_world& world);

inline bool bears_loads(const RigidScene& scene, std::uint32_t object) {
    return !scene.rope_loads_of(object).empty();
}

// use(object)
template <typename Use>
void for_each_loaded_rope(const RigidScene& scene, const Use& use) {
    const Array<RopeLoad>& loads = scene.rope_loads;
    for (std::size_t i = 0; i < loads.size(); ++i) {
        if (i == 0 || loads[i].object != loads[i - 1].object) {
            use(loads[i].object);
        }
    }
}

// Whether any(body) of one of those that weigh on it.
template <typename Any>
bool any_rope_load(const RigidScene& scene, std::uint32_t object, const Any& any) {
    const std::span<const RopeLoad> loads = scene.rope_loads_of(object);
    return std::any_of(loads.begin(), loads.end(), [&](const RopeLoad& load) {
        return any(scene.attachments[load.attachment].description.other);
    });
}

} // namespace lks
