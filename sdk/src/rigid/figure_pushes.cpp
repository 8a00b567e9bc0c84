#include "rigid/figure_pushes.h"

#include <algorithm>

namespace lks {

bool pushes(const Contact& contact) {
    return std::any_of(contact.points, contact.points + contact.count,
                       [](const ContactPoint& point) { return point.active && point.push.normal != 0; });
}

bool is_pushed_from_outside(const RigidScene& scene, const FigureRange& figure) {
    bool pushed = false;
    for (const Part kind : {Part::contact, Part::shared_contact}) {
        for_each_part(scene, figure, kind, [&](std::uint32_t i) {
            const ContactKey& key = scene.contacts[i].key;
            const bool within = is_bone_of(scene, figure, key.body_a) && key.other < other_is_collider &&
                                is_bone_of(scene, figure, key.other);
            pushed = pushed || (!within && pushes(scene.contacts[i]));
        });
    }
    return pushed;
}

} // namespace lks
