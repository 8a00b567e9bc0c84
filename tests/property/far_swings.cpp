// Ball joints that swing all around, but hardly twist: opposite to where it began an axis has no twist.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/bodies.h"

using namespace support;

// Near there a small turn twists by much. Where all of the twist was turned back, that went ever further to
// the other side: up to 49 times the energy came of nothing.
TEST_CASE("a rod that swings past where it has no twist gains no energy by its twist's limits") {
    Random random(5);
    const auto any = [&random](double most) {
        return fixed(most * 1e-6 * static_cast<double>(random.between(-1000000, 1000000)));
    };
    double most = 0;
    for (const double spin : {10.0, 50.0}) {
        for (const double twist : {0.5, 10.0, 45.0}) {
            for (int thrown = 0; thrown < 25; ++thrown) {
                World world(world_def(60, 20));
                REQUIRE(lks_world_set_gravity(world, {}) == LKS_OK);
                const lks_body_id anchor = add_anchor(world, {});
                const lks_body_id rod = add_body(world, box_shape(0.05, 0.25, 0.05), fixed(0, -0.25, 0));
                lks_joint_def def = lks_default_joint_def();
                def.frame_b.position.y = fixed(0.25);
                def.twist_min = fixed(-twist);
                def.twist_max = fixed(twist);
                add_joint(world, def, anchor, rod);
                REQUIRE(lks_body_set_velocity(world, rod, {any(spin / 5), any(spin / 5), any(spin / 5)},
                                              {any(spin), any(spin), any(spin)}) == LKS_OK);
                double least = energy_of(world);
                const double start = least;
                double rise = 0;
                for (int tick = 0; tick < 120; ++tick) {
                    world.step();
                    rise = std::max(rise, energy_of(world) - least);
                    least = std::min(least, energy_of(world));
                }
                most = std::max(most, rise / start);
            }
        }
    }
    MESSAGE("gained at the most: " << most << " of the energy");
    CHECK(most < 0.05);
}
