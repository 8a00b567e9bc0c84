// Links in a ring, hung up at one of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "support/bodies.h"

namespace support {

// Its joints, that of the one it hangs by last.
inline std::vector<lks_joint_id> hang_ring(const World& world, int count) {
    const lks_body_id anchor = add_anchor(world, {});
    std::vector<lks_body_id> links;
    std::vector<lks_joint_id> joints;
    const double radius = 0.2 / std::sin(std::numbers::pi / count);
    for (int i = 0; i < count; ++i) {
        const double turned = 2 * std::numbers::pi * i / count;
        lks_body_def def = lks_default_body_def();
        def.mass = fixed(2);
        def.transform.rotation = about(0, 0, 1, 360.0 * i / count + 90);
        const double inner = radius * std::cos(std::numbers::pi / count);
        links.push_back(add_body(world, capsule_shape(0.04, 0.12),
                                 fixed(inner * std::sin(turned), -inner * std::cos(turned), 0), def));
    }
    const auto join = [&](lks_body_id a, double ya, lks_body_id b, double yb) {
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = fixed(0, ya, 0);
        joint.frame_b.position = fixed(0, yb, 0);
        joints.push_back(add_joint(world, joint, a, b));
    };
    for (int i = 0; i < count; ++i) {
        join(links[static_cast<std::size_t>(i)], -0.2, links[static_cast<std::size_t>((i + 1) % count)], 0.2);
    }
    join(anchor, 0, links[static_cast<std::size_t>(count / 2)], 0);
    return joints;
}

} // namespace support
