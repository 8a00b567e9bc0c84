// Light bodies whose joints hold heavy ones on both sides, where nothing else holds them.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

enum class Hold { hinges, fixed, limits };

constexpr const char* name_of(Hold hold) {
    return hold == Hold::hinges ? "hinges" : hold == Hold::fixed ? "fixed joints" : "limits";
}

// Two boxes with a capsule of a kilogram between them.
struct Barbell {
    Barbell(Hold hold, double ratio, std::uint32_t substeps, double height = 0)
        : world(world_def(60, substeps)) {
        lks_body_def def = lks_default_body_def();
        def.mass = fixed(ratio);
        bodies[0] = add_body(world, box_shape(0.2, 0.1, 0.15), fixed(-0.4, height, 0), def);
        bodies[2] = add_body(world, box_shape(0.2, 0.1, 0.15), fixed(0.4, height, 0), def);
        def.mass = fixed(1);
        bodies[1] = add_body(world, capsule_shape(0.05, 0.1), fixed(0, height, 0), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.kind = hold == Hold::hinges  ? LKS_JOINT_HINGE
                     : hold == Hold::fixed ? LKS_JOINT_FIXED
                                           : LKS_JOINT_BALL;
        if (hold == Hold::limits) {
            joint.swing_limit = fixed(20);
            joint.twist_min = fixed(-10);
            joint.twist_max = fixed(10);
        }
        joint.frame_a.position.x = fixed(0.2);
        joint.frame_b.position.x = fixed(-0.2);
        joints[0] = add_joint(world, joint, bodies[0], bodies[1]);
        joint.frame_a.rotation = joint.frame_b.rotation = about(1, 0, 0, 90);
        joints[1] = add_joint(world, joint, bodies[1], bodies[2]);
    }
    Barbell(const Barbell&) = delete;
    Barbell& operator=(const Barbell&) = delete;

    void throw_about(std::uint64_t seed) {
        REQUIRE(lks_world_set_gravity(world, {}) == LKS_OK);
        Random random(seed);
        const auto any = [&random](double most) {
            return most * 1e-6 * static_cast<double>(random.between(-1000000, 1000000));
        };
        for (const lks_body_id body : bodies) {
            const lks_vec3 velocity = fixed(any(1), any(1), any(1));
            const lks_vec3 spin = fixed(any(5), any(5), any(5));
            REQUIRE(lks_body_set_velocity(world, body, velocity, spin) == LKS_OK);
        }
        world.step(2); // these do not fit each other
    }
    double apart() const { return std::max(error_of(world, joints[0]), error_of(world, joints[1])); }

    World world;
    lks_body_id bodies[3]{};
    lks_joint_id joints[2]{};
};

} // namespace

// Until figures in flight kept their momentum (rigid/free_figure.h), 1 : 10⁴ gained 2 % and 1 : 10⁶ up to
// half. Before, at 8 substeps and 1 : 110, hinges gained 9 times their energy and were 21 cm apart, fixed
// joints gained 280 times and limits 260; at 1 : 10 they were 2, 3 and 1 mm apart.
TEST_CASE("a light link between heavy bodies holds them together and gains no energy") {
    for (const Hold hold : {Hold::hinges, Hold::fixed, Hold::limits}) {
        for (const double ratio : {10., 30., 110., 1000., 1e4, 1e6}) {
            for (const std::uint32_t substeps : {1u, 8u, 20u}) {
                double apart = 0, most = 0;
                for (std::uint64_t seed = 1; seed <= (sanitised ? 1 : 6); ++seed) {
                    Barbell barbell(hold, ratio, substeps);
                    barbell.throw_about(seed);
                    const double start = energy_of(barbell.world);
                    for (int tick = 0; tick < 300; ++tick) {
                        barbell.world.step();
                        most = std::max(most, energy_of(barbell.world) / start);
                        apart = std::max(apart, barbell.apart());
                    }
                }
                INFO(std::string(name_of(hold)) << ", 1 : " << ratio << ", " << substeps << " substeps");
                CHECK(most < 1.01);
                CHECK(apart < (ratio < 1e4 ? 2e-4 : ratio < 1e5 ? 1e-3 : 0.5));
            }
        }
    }
}

// Before, three of these were 2 to 8 mm apart and six did not rest: fixed joints of 1 : 200 had up to 1.5 kJ.
TEST_CASE("heavy bodies with a light link between them that stands on the ground come to rest") {
    for (const Hold hold : {Hold::hinges, Hold::fixed, Hold::limits}) {
        for (const double ratio : {10., 50., 200.}) {
            for (const std::uint32_t substeps : {4u, 8u, 20u}) {
                if (sanitised && substeps != 8) {
                    continue;
                }
                Barbell barbell(hold, ratio, substeps, 1);
                add_ground(barbell.world);
                double apart = 0;
                for (int tick = 0; tick < 600; ++tick) {
                    barbell.world.step();
                    apart = std::max(apart, barbell.apart());
                }
                INFO(std::string(name_of(hold)) << ", 1 : " << ratio << ", " << substeps << " substeps");
                CHECK(apart < 1e-5);
                CHECK(lks_world_awake_body_count(barbell.world) == 0);
            }
        }
    }
}

TEST_CASE("heavy bodies with a light link between them go on as they were saved") {
    for (const Hold hold : {Hold::hinges, Hold::fixed, Hold::limits}) {
        Barbell barbell(hold, 50, 8);
        barbell.throw_about(1);
        const Image image = barbell.world.save();
        barbell.world.step(100);
        const std::uint64_t hash = barbell.world.hash();
        Barbell other(hold, 50, 8);
        REQUIRE(lks_world_load(other.world, image.data(), image.size()) == LKS_OK);
        other.world.step(100);
        CHECK(other.world.hash() == hash);
    }
}

TEST_CASE("heavy bodies with a light link between them hang on a rope and gain no energy") {
    for (const Hold hold : {Hold::hinges, Hold::fixed, Hold::limits}) {
        for (const double ratio : {10., 50., 200.}) {
            for (const std::uint32_t substeps : {4u, 8u, 20u}) {
                if (sanitised && substeps != 8) {
                    continue;
                }
                Barbell barbell(hold, ratio, substeps);
                Chain chain;
                chain.segments = 10;
                chain.length = 1;
                chain.particle_mass = 0.02;
                chain.solver = LKS_ROPE_DIRECT;
                const Asset rope = chain.build();
                const lks_object_id object = barbell.world.add(rope, at(-1.6, 0, 0));
                barbell.world.pin(object, 0);
                attach(barbell.world, to_body(object, 10, barbell.bodies[0], fixed(-0.2, 0, 0)));
                const double start = whole_energy(barbell.world, barbell.bodies, 3);
                double apart = 0, most = 0;
                for (int tick = 0; tick < 600; ++tick) {
                    barbell.world.step();
                    apart = std::max(apart, barbell.apart());
                    most = std::max(most, whole_energy(barbell.world, barbell.bodies, 3) - start);
                }
                INFO(std::string(name_of(hold)) << ", 1 : " << ratio << ", " << substeps << " substeps");
                CHECK(apart < 1e-3);
                CHECK(most < 0.01 * 2 * ratio * 9.81);
            }
        }
    }
}
