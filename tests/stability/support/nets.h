// Cloths that several hard cases share.
#pragma once

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

} // namespace stability
