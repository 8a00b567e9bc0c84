// What tests of ropes ask of a chain.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/builders.h"

namespace support {

// |length / rest - 1| of its worst segment.
inline double worst_stretch(const World& world, lks_object_id object, const Chain& chain) {
    const std::vector<Vector> positions = world.positions_from(object, {});
    const double rest = chain.length / chain.segments;
    double worst = 0;
    for (std::size_t i = 1; i < positions.size(); ++i) {
        worst = std::max(worst, std::abs((positions[i] - positions[i - 1]).length() / rest - 1));
    }
    return worst;
}

// Its particles one after the other where `place(i)` says, in one tick by pins; then all but the first are
// let go at rest.
template <typename Place>
void let_go_from(World& world, lks_object_id object, const Chain& chain, const Place& place) {
    for (std::uint32_t i = 0; i <= chain.segments; ++i) {
        world.pin(object, i);
        world.set_target(object, i, place(i));
    }
    world.step();
    for (std::uint32_t i = 1; i <= chain.segments; ++i) {
        REQUIRE(lks_object_unpin(world, object, i) == LKS_OK);
        REQUIRE(lks_object_set_velocity(world, object, i, {}) == LKS_OK);
    }
}

} // namespace support
