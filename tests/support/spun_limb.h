// A box that spins on a joint with limits, without weight.
#pragma once

#include "support/bodies.h"

namespace support {

struct Spin {
    lks_joint_kind kind;
    lks_vec3 of; // about the joint's axis, y, or across it; rad/s
    bool twists() const { return of.y != 0; }
};

struct SpunLimb {
    World world;
    lks_body_id limb;
    lks_joint_id joint;

    SpunLimb(const Spin& spin, lks_joint_def def, std::uint32_t substeps) : world(weightless(substeps)) {
        const lks_body_id anchor = add_anchor(world, {});
        lks_body_def body = lks_default_body_def();
        body.never_sleeps = 1;
        body.angular_velocity = spin.of;
        limb = add_body(world, box_shape(0.1, 0.3, 0.2), {}, body);
        def.kind = spin.kind;
        joint = add_joint(world, def, anchor, limb);
    }
};

} // namespace support
