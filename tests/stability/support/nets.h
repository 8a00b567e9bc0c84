// Cloths that several hard cases share.
#pragma once

#include "stability/support/trial.h"
#include "support/builders.h"

namespace stability {

// A kilogram in side × side particles of a centimetre.
inline support::Net kilogram_net(std::uint32_t side, double width) {
    support::Net net;
    net.side = side;
    net.width = width;
    net.particle_mass = 1.0 / (side * side);
    net.radius = 0.01;
    return net;
}

// A metre of 12 × 12 particles of 10 g, with tethers to the corners that a HangingNet is held by, or without.
inline support::Net small_net(bool tethered) {
    support::Net net;
    net.side = 12;
    net.width = 1;
    net.particle_mass = 0.01;
    if (tethered) {
        net.anchors = {0, net.side - 1};
    }
    return net;
}

// Let go when it is level, held by the two corners of its first row.
class HangingNet {
public:
    explicit HangingNet(const support::Net& net, const lks_world_def& world = lks_default_world_def())
        : asset_(net.build()), trial(subject(net, asset_, world)) {
        trial.pin(0);
        trial.pin(net.side - 1);
    }

private:
    static Subject subject(const support::Net& net, const support::Asset& asset, const lks_world_def& world) {
        Subject subject = subject_of(net, asset);
        subject.world = world;
        subject.transform = support::turned(lks_transform_identity(), 1, 0, 0, 90);
        return subject;
    }

    support::Asset asset_;

public:
    Trial trial;
};

} // namespace stability
