// Twists that are limited near a half turn, where an angle may be read from either side, and motors that have
// to go the long way round.
#include <doctest/doctest.h>

#include <cmath>

#include "support/bodies.h"

using namespace support;

namespace {

constexpr unsigned substep_numbers[] = {1, 4, 8, 20};

struct Turning {
    Turning(std::uint32_t kind, double least, double most, double start, unsigned substeps)
        : world(weightless(substeps)) {
        const lks_body_id post = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.transform.rotation = about(0, 1, 0, start);
        def.never_sleeps = 1;
        wing = add_body(world, box_shape(0.1, 0.05, 0.1), {}, def);
        lks_joint_def joint_def = lks_default_joint_def();
        joint_def.kind = kind;
        joint_def.twist_min = fixed(least);
        joint_def.twist_max = fixed(most);
        joint = add_joint(world, joint_def, post, wing);
        last_ = start;
        turned = start;
    }

    double twist() const {
        lks_fixed twist = 0;
        REQUIRE(lks_joint_angles(world, joint, nullptr, &twist) == LKS_OK);
        return metres(twist);
    }
    // So many newton metres; keeps count of whole turns.
    void step(double torque) {
        const double push = torque / 60 / 0.2;
        REQUIRE(lks_body_apply_impulse(world, wing, fixed(0, 0, push), fixed(-0.1, 0, 0)) == LKS_OK);
        REQUIRE(lks_body_apply_impulse(world, wing, fixed(0, 0, -push), fixed(0.1, 0, 0)) == LKS_OK);
        world.step();
        turned += std::remainder(twist() - last_, 360);
        last_ = twist();
    }

    World world;
    lks_body_id wing{};
    lks_joint_id joint{};
    double turned; // degrees

private:
    double last_;
};

} // namespace

TEST_CASE("a limit near a half turn holds what is turned against it") {
    const double limits[][2] = {{0, 180},     {-180, 0}, {170, 180}, {-180, -170}, {180, 180},
                                {-180, -180}, {90, 175}, {-30, 171}, {100, 150}};
    for (const std::uint32_t kind : {LKS_JOINT_HINGE, LKS_JOINT_BALL}) {
        for (const double(&pair)[2] : limits) {
            const double least = pair[0];
            const double most = pair[1];
            for (const unsigned substeps : substep_numbers) {
                for (const int way : {-1, 1}) {
                    CAPTURE(kind);
                    CAPTURE(least);
                    CAPTURE(most);
                    CAPTURE(substeps);
                    CAPTURE(way);
                    Turning turning(kind, least, most, (least + most) / 2, substeps);
                    REQUIRE(lks_body_set_velocity(turning.world, turning.wing, {}, fixed(0, 3 * way, 0)) ==
                            LKS_OK);
                    double beyond = 0;
                    for (int tick = 0; tick < 240; ++tick) {
                        turning.step(0.05 * way);
                        beyond = std::max({beyond, turning.turned - most, least - turning.turned});
                    }
                    CHECK(beyond < 1.5);
                    CHECK(std::abs(turning.turned - (way > 0 ? most : least)) < 0.5);
                }
            }
        }
    }
}

TEST_CASE("a hinge's motor stays within its limits, also where the other way is shorter") {
    struct Way {
        double least, most, start, target;
    };
    for (const Way& way : {Way{-120, 120, -110, 110}, Way{-30, 170, -20, 165}, Way{-170, 170, 160, -160},
                           Way{0, 180, 5, 180}, Way{-180, 0, -5, -179}, Way{-180, 180, -110, 110}}) {
        for (const unsigned substeps : {8u, 20u}) {
            CAPTURE(way.start);
            CAPTURE(substeps);
            Turning turning(LKS_JOINT_HINGE, way.least, way.most, way.start, substeps);
            const lks_motor motor{fixed(5), fixed(0.2), about(0, 1, 0, way.target)};
            REQUIRE(lks_joint_set_motor(turning.world, turning.joint, &motor) == LKS_OK);
            for (int tick = 0; tick < 300; ++tick) {
                turning.step(0);
            }
            const bool limited = way.most - way.least < 360;
            const double ends = limited ? way.target : way.target - 360; // without limits the short way
            CHECK(std::abs(turning.turned - ends) < 0.01);
        }
    }
}
