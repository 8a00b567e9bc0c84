// Joints at points far outside of small bodies, as of a ball at the end of a thread.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/bodies.h"
#include "support/builders.h"

using namespace support;

namespace {

// A ball on an arm that is let go level, held by what does not move or by a box that hangs there.
struct Arm {
    Arm(double radius, double length, std::uint32_t kind, std::uint32_t substeps, double box_mass = 0)
        : world(world_def(60, substeps)) {
        lks_body_id above = add_anchor(world, {});
        lks_body_def def = lks_default_body_def();
        def.filter.mask = 0;
        lks_joint_def held = lks_default_joint_def();
        if (box_mass > 0) {
            def.mass = fixed(box_mass);
            const lks_body_id box = add_body(world, box_shape(0.1, 0.1, 0.1), fixed(0, -0.2, 0), def);
            def.mass = lks_default_body_def().mass;
            held.frame_b.position.y = fixed(0.2);
            add_joint(world, held, above, box);
            held.frame_b.position.y = 0;
            above = box;
        }
        ball = add_body(world, ball_shape(radius), fixed(length, box_mass > 0 ? -0.2 : 0, 0), def);
        held.kind = kind;
        held.frame_b.position.x = fixed(-length);
        held.frame_a.rotation = held.frame_b.rotation = about(1, 0, 0, 90);
        joint = add_joint(world, held, above, ball);
    }
    Arm(const Arm&) = delete;
    Arm& operator=(const Arm&) = delete;

    World world;
    lks_body_id ball{};
    lks_joint_id joint{};
};

template <typename Use>
void for_each_arm(const Use& use) {
    for (const double radius : {0.001, 0.005, 0.02, 0.1}) {
        for (const double radii : {10., 45., 200., 250.}) {
            for (const std::uint32_t substeps : {1u, 8u, 20u}) {
                INFO(radius << " m on " << radius * radii << " m, " << substeps << " substeps");
                use(radius, radius * radii, substeps);
            }
        }
    }
}

} // namespace

// Swept, a ball of 5 mm fell by 4.8 m in that time, and one of 2 cm gained energy.
TEST_CASE("a small ball swings on an arm of up to 250 radii and gains no energy") {
    for (const std::uint32_t kind : {LKS_JOINT_BALL, LKS_JOINT_HINGE}) {
        for_each_arm([kind](double radius, double length, std::uint32_t substeps) {
            Arm arm(radius, length, kind, substeps);
            double apart = 0, most = 0, furthest = 0;
            for (int tick = 0; tick < 600; ++tick) {
                arm.world.step();
                apart = std::max(apart, error_of(arm.world, arm.joint));
                most = std::max(most, whole_energy(arm.world, &arm.ball, 1));
                furthest = std::max(furthest, state_of(arm.world, arm.ball).position.length());
            }
            CHECK(apart < 1e-6);
            CHECK(furthest < length * (1 + 1e-5));
            // Pendulums' energy goes to and fro (rigid/free_figure.h).
            CHECK(most < 0.03 * 9.81 * mass_of(arm.world, arm.ball) * length);
        });
    }
}

TEST_CASE("a small ball stays on an arm that something of any mass holds") {
    for (const double box_mass : {0.1, 1.0, 100.0}) {
        for_each_arm([box_mass](double radius, double length, std::uint32_t substeps) {
            Arm arm(radius, length, LKS_JOINT_BALL, substeps, box_mass);
            double apart = 0;
            for (int tick = 0; tick < 300; ++tick) {
                arm.world.step();
                apart = std::max(apart, error_of(arm.world, arm.joint));
            }
            CHECK(apart < 1e-5);
        });
    }
}

TEST_CASE("a small ball at the end of a long fixed arm stays level") {
    for_each_arm([](double radius, double length, std::uint32_t substeps) {
        Arm arm(radius, length, LKS_JOINT_FIXED, substeps);
        double aside = 0;
        for (int tick = 0; tick < 300; ++tick) {
            arm.world.step();
            aside = std::max(aside, std::abs(state_of(arm.world, arm.ball).position.y));
        }
        CHECK(aside < 0.005 * length);
    });
}
