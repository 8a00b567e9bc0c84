// Swings that are limited by an ellipse push square to its edge, and so do no work
// (sdk/src/rigid/swing_ellipse.h).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr double degree = std::numbers::pi / 180;

// A rod that stands on a joint whose axis points up, limited towards x and z, and is tipped over towards an
// azimuth.
struct Tipped {
    Tipped(double x, double z, double friction, double azimuth, unsigned substeps)
        : world(world_def(60, substeps)) {
        lks_joint_def def = lks_default_joint_def();
        def.frame_b.position = fixed(0, -0.3, 0);
        def.swing_limit = fixed(x);
        def.swing_limit_z = fixed(z);
        def.friction = fixed(friction);
        lks_body_def body = lks_default_body_def();
        body.never_sleeps = 1;
        const lks_body_id rod = add_body(world, capsule_shape(0.03, 0.27), fixed(0, 0.3, 0), body);
        joint = add_joint(world, def, add_anchor(world, {}), rod);
        world.step();
        const lks_vec3 spin = fixed(2 * std::sin(azimuth * degree), 0, -2 * std::cos(azimuth * degree));
        REQUIRE(lks_body_set_velocity(world, rod, {}, spin) == LKS_OK);
    }

    double swing() const {
        lks_fixed swing = 0;
        REQUIRE(lks_joint_angles(world, joint, &swing, nullptr) == LKS_OK);
        return metres(swing);
    }

    World world;
    lks_joint_id joint{};
};

// Of four links of a kilogram that whirl without weight, the greatest kinetic energy in ten seconds over that
// of the first tick. soft: which joint is.
double greatest_gain(double x, double z, int soft, unsigned substeps, std::uint64_t seed) {
    World world(weightless(substeps));
    Random random(seed);
    const auto spin = [&random] { return random.between(-LKS_FIXED(8), LKS_FIXED(8)); };
    lks_body_id last = add_anchor(world, fixed(0, -0.6, 0));
    for (int i = 0; i < 4; ++i) {
        lks_body_def def = lks_default_body_def();
        def.linear_damping = def.angular_damping = 0;
        def.never_sleeps = 1;
        def.mass = fixed(1);
        def.filter.mask = 0;
        def.angular_velocity = {spin(), spin(), spin()};
        const lks_body_id link = add_body(world, capsule_shape(0.05, 0.25), fixed(0, 0.6 * i, 0), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = fixed(0, 0.3, 0);
        joint.frame_b.position = fixed(0, -0.3, 0);
        joint.swing_limit = fixed(i % 2 == 1 ? x : z);
        joint.swing_limit_z = fixed(i % 2 == 1 ? z : x);
        joint.compliance = i == soft ? fixed(1e-4) : 0;
        joint.damping = i == soft ? fixed(5) : 0;
        add_joint(world, joint, last, link);
        last = link;
    }
    world.step();
    const double start = energy_of(world);
    double most = 0;
    for (int tick = 0; tick < 600; ++tick) {
        world.step();
        most = std::max(most, energy_of(world));
    }
    return most / start;
}

} // namespace

TEST_CASE("a swing is read towards both axes of a's frame, whatever the twist and wherever a is turned") {
    World world(weightless(8));
    lks_body_def def = lks_default_body_def();
    def.transform.rotation = about(1, 2, 3, 50);
    const lks_body_id base = add_body(world, ball_shape(0.1), {}, def);
    for (const double twist : {0., 70.}) {
        for (const double swing : {0., 0.01, 30., 90., 179.}) {
            for (const double azimuth : {0., 25., 90., 200., -45.}) {
                // From local y towards x at an azimuth of 0, and towards z at 90.
                const lks_rotation turn =
                    product(about(std::sin(azimuth * degree), 0, -std::cos(azimuth * degree), swing),
                            about(0, 1, 0, twist));
                def.transform.rotation = product(product(about(1, 2, 3, 50), about(0, 0, 1, 20)), turn);
                const lks_body_id body = add_body(world, ball_shape(0.1), {}, def);
                lks_joint_def joint = lks_default_joint_def();
                joint.frame_a.rotation = about(0, 0, 1, 20);
                const lks_joint_id id = add_joint(world, joint, base, body);
                lks_fixed x = 0, z = 0;
                REQUIRE(lks_joint_swing(world, id, &x, &z) == LKS_OK);
                INFO(swing << " degrees towards " << azimuth << ", twisted by " << twist);
                CHECK(std::abs(metres(x) - swing * std::cos(azimuth * degree)) < 1e-3 + 2e-5 * swing);
                CHECK(std::abs(metres(z) - swing * std::sin(azimuth * degree)) < 1e-3 + 2e-5 * swing);
                REQUIRE(lks_joint_swing(world, id, nullptr, nullptr) == LKS_OK);
                REQUIRE(lks_world_remove_body(world, body) == LKS_OK);
                CHECK(lks_joint_swing(world, id, &x, &z) == LKS_ERROR_STALE_ID);
            }
        }
    }
}

TEST_CASE("what leans on an ellipse slides along its edge to where it is lowest" *
          doctest::skip(support::sanitised)) {
    for (const unsigned substeps : {4u, 20u}) {
        for (const double azimuth : {22.5, 45.0, 67.5, 112.5}) {
            CAPTURE(substeps);
            CAPTURE(azimuth);
            // What has swung the farthest hangs the lowest: by 120 degrees towards x.
            Tipped tipped(120, 40, 0.05, azimuth, substeps);
            double farthest = 0;
            for (int tick = 0; tick < 1200; ++tick) {
                tipped.world.step();
                farthest = std::max(farthest, tipped.swing());
            }
            CHECK(farthest < 121);
            CHECK(tipped.swing() > 118);
        }
    }
}

TEST_CASE("a slot that is hardly open across ends where its limit is") {
    for (const unsigned substeps : {2u, 8u, 20u}) {
        for (const double azimuth : {30.0, 60.0, 120.0}) {
            CAPTURE(substeps);
            CAPTURE(azimuth);
            Tipped tipped(0.05, 60, 0, azimuth, substeps);
            for (int tick = 0; tick < 600; ++tick) {
                tipped.world.step();
                CHECK(tipped.swing() < 61);
            }
            CHECK(tipped.swing() > 55);
        }
    }
}

TEST_CASE("chains with ellipses gain nothing, rigid ones and with a soft joint") {
    for (const unsigned substeps : {8u, 20u}) {
        if (support::sanitised && substeps != 8) {
            continue;
        }
        for (const int soft : {-1, 0, 3}) {
            for (const double x : {20.0, 30.0}) {
                const double z = x < 25 ? 90 : 45;
                CAPTURE(substeps);
                CAPTURE(soft);
                CAPTURE(x);
                double worst = 0;
                for (std::uint64_t seed = 0; seed < 5; ++seed) {
                    worst = std::max(worst, greatest_gain(x, z, soft, substeps, seed));
                }
                CHECK(worst < 1.1);
            }
        }
    }
}
