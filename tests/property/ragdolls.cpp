// How well ragdolls hold together: on stairs, in a crowd, and led by a hand. Piles: ragdoll_piles.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/ragdolls.h"
#include "support/sanitised.h"

using namespace support;

TEST_CASE("a ragdoll tumbles down stairs in one piece, and falls asleep") {
    World world(world_def(60, 8));
    add_ground(world);
    for (int i = 0; i < 10; ++i) {
        add_box(world, fixed(0.15, 0.085 * (10 - i), 1.5), fixed(0.3 * i, 0.085 * (10 - i), 0));
    }
    Ragdolls ragdolls(world);
    ragdolls.add(turned_about_x(0, 1.71, 0, 0), fixed(2.5, 0, 0.3));
    for (int tick = 0; tick < 600; ++tick) {
        ragdolls.step();
    }
    INFO("joints " << 1e3 * ragdolls.mean() << " mm, worst " << 1e3 * ragdolls.worst() << " mm; limits "
                   << ragdolls.limit() << ", at rest " << ragdolls.limit_now());
    CHECK(ragdolls.mean() < 1e-5);
    CHECK(ragdolls.worst() < 2e-3);
    CHECK(ragdolls.limit() < 5);
    CHECK(ragdolls.limit_now() < 0.5);
    CHECK(lks_world_awake_body_count(world) == 0);
}

TEST_CASE("a crowd that falls upon each other gains no energy") {
    World world(world_def(60, 8));
    add_ground(world);
    Ragdolls ragdolls(world);
    ragdolls.slip();
    for (int layer = 0; layer < 4; ++layer) {
        for (int i = 0; i < 4; ++i) {
            ragdolls.add(turned_about_x(0.9 * (i % 2) + 0.1 * layer, 0.5 + 1.9 * layer,
                                        0.6 * (i / 2) + 0.1 * layer, 0));
        }
    }
    double least = ragdolls.energy();
    double rise = 0;
    for (int tick = 0; tick < 240; ++tick) {
        ragdolls.step();
        const double energy = ragdolls.energy();
        rise = std::max(rise, energy - least);
        least = std::min(least, energy);
    }
    INFO("joints " << 1e3 * ragdolls.mean() << " mm, worst " << 1e3 * ragdolls.worst() << " mm; limits "
                   << ragdolls.limit() << "; " << rise << " J gained");
    CHECK(ragdolls.worst() < 10e-3);
    CHECK(ragdolls.limit() < 12);
    CHECK(rise < 60); // of 47 kJ: what parts lifts what lies upon it
}

// A hand of 0.45 kg bears 78 kg, and its limits, which know the masses of their two bones, what swings below.
// With rows alone joints came 47 to 130 cm apart, and 1.6 MJ came of nothing.
TEST_CASE("a ragdoll that is held by a hand and led about stays in one piece" *
          doctest::skip(support::sanitised)) {
    for (const double speed : {0.0, 2.0, 6.0}) {
        for (const std::uint32_t substeps : {4u, 8u}) {
            for (const bool soft : {false, true}) {
                if (soft && substeps < 8) {
                    continue; // what a swept joint has stretched it gives back: 200 to 400 J
                }
                World world(world_def(60, substeps));
                add_ground(world);
                Ragdolls ragdolls(world);
                ragdolls.add(turned_about_x(0, 1.5, 0, 0));
                const lks_body_id hand = ragdolls.bodies()[LKS_HUMANOID_HAND_LEFT];
                const Vector place = state_of(world, hand).position;
                const lks_body_id anchor = add_anchor(world, fixed(place.x, place.y, place.z));
                lks_joint_def def = lks_default_joint_def();
                def.kind = LKS_JOINT_BALL;
                def.compliance = soft ? fixed(1e-7) : 0;
                add_joint(world, def, anchor, hand);
                double greatest = 0;
                double least = 1e9;
                double rise = 0;
                for (int tick = 0; tick < 600; ++tick) {
                    if (tick < 300 && speed != 0) {
                        const double turned = speed * tick / 60; // on a circle of a metre
                        const lks_transform to{
                            fixed(place.x + std::sin(turned), place.y, place.z + 1 - std::cos(turned)),
                            {0, 0, 0, 1 << 30}};
                        REQUIRE(lks_body_move_to(world, anchor, to) == LKS_OK);
                    }
                    ragdolls.step();
                    const double energy = ragdolls.energy();
                    greatest = std::max(greatest, energy);
                    if (speed == 0 || tick > 300) {
                        rise = std::max(rise, energy - least);
                        least = std::min(least, energy);
                    }
                }
                MESSAGE(speed << " m/s, " << substeps << " substeps"
                              << std::string(soft ? ", softly: " : ": ") << 1e3 * ragdolls.worst()
                              << " mm apart at the worst, limits exceeded by " << ragdolls.limit()
                              << " degrees, " << rise << " J gained, " << greatest << " J at the most");
                // At 6 m/s these are of this one layout: of 40 speeds from 5.8 to 6.2 some are ten times as
                // far apart at 4 substeps, and six gain more when held softly, up to 0.5 kJ.
                CHECK(ragdolls.worst() < (soft || (speed == 6 && substeps == 4) ? 1e-3 : 0.5e-3));
                CHECK(ragdolls.limit() < (soft ? 4 : 1));
                CHECK(rise < (!soft ? 8 : speed == 6 ? 500 : 60));
                CHECK(greatest < (speed == 6 ? 18e3 : 3e3));
            }
        }
    }
}
