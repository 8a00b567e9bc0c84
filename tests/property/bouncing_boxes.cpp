// What gives back speed at several points at once, or at one beside others that rest: no energy comes of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>

#include "support/bodies.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr int samples = sanitised ? 20 : 250;

struct Throws {
    double worst = 0; // kinetic energy of the whole, of that at the beginning
    int above = 0;    // how many gained more than a hundredth
};

lks_rotation any_rotation(std::mt19937& random) {
    std::normal_distribution<double> any(0, 1);
    const double x = any(random);
    const double y = any(random);
    const double z = any(random);
    return about(x, y, z, std::uniform_real_distribution<double>(0, 360)(random));
}

void note(Throws& throws, double ratio) {
    throws.worst = std::max(throws.worst, ratio);
    throws.above += ratio > 1.01 ? 1 : 0;
}

lks_body_def bouncing(double restitution, double friction) {
    lks_body_def def = lks_default_body_def();
    def.restitution = fixed(restitution);
    def.static_friction = def.dynamic_friction = fixed(friction);
    def.gravity_factor = 0;
    return def;
}

Throws throw_at_ground(const lks_body_shape& shape, double speed, double restitution, double friction,
                       std::uint32_t substeps) {
    std::mt19937 random(5);
    Throws throws;
    for (int sample = 0; sample < samples; ++sample) {
        World world(world_def(60, substeps));
        add_ground(world, friction);
        lks_body_def def = bouncing(restitution, friction);
        def.velocity.y = fixed(-speed);
        def.transform.rotation = any_rotation(random);
        add_body(world, shape, fixed(0, 1, 0), def);
        const double before = energy_of(world);
        double most = 0;
        for (int tick = 0; tick < 60; ++tick) {
            world.step(1);
            most = std::max(most, energy_of(world));
        }
        note(throws, most / before);
    }
    return throws;
}

// Two of them in free space; `drift`: how far their centre of mass is off where it should be.
Throws throw_at_each_other(const lks_body_shape& shape, double restitution, double& drift) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> aside(-0.15, 0.15);
    Throws throws;
    for (int sample = 0; sample < samples; ++sample) {
        World world(world_def(60, 8));
        lks_body_def def = bouncing(restitution, 0);
        lks_body_id ids[2];
        for (int i = 0; i < 2; ++i) {
            def.velocity.x = fixed(i == 0 ? 3 : -3);
            def.transform.rotation = any_rotation(random);
            ids[i] = add_body(world, shape, fixed(i == 0 ? -1 : 1, aside(random), aside(random)), def);
        }
        const auto middle = [&] {
            return state_of(world, ids[0]).position + state_of(world, ids[1]).position;
        };
        const Vector start = middle();
        const double before = energy_of(world);
        double most = 0;
        for (int tick = 0; tick < 90; ++tick) {
            world.step(1);
            most = std::max(most, energy_of(world));
        }
        drift = std::max(drift, (middle() - start).length());
        note(throws, most / before);
    }
    return throws;
}

} // namespace

TEST_CASE("boxes and capsules that are thrown at the ground in any direction gain no energy") {
    struct Case {
        const char* name;
        lks_body_shape shape;
        double speed;
    };
    const Case cases[] = {{"stick", box_shape(0.05, 0.2, 0.05), 5},
                          {"long stick", box_shape(0.05, 0.5, 0.05), 10},
                          {"cube", box_shape(0.05, 0.05, 0.05), 5},
                          {"plate", box_shape(0.3, 0.02, 0.2), 5},
                          {"capsule", capsule_shape(0.05, 0.2), 5}};
    for (const Case& thrown : cases) {
        for (const double restitution : {0.5, 0.8, 1.0}) {
            for (const double friction : {0.0, 0.5}) {
                for (const std::uint32_t substeps : {8u, 20u}) {
                    const Throws found =
                        throw_at_ground(thrown.shape, thrown.speed, restitution, friction, substeps);
                    std::printf("%-10s restitution %.1f, friction %.1f, %2u substeps: %.4f of its energy at "
                                "most, %d of %d beyond 1.01\n",
                                thrown.name, restitution, friction, substeps, found.worst, found.above,
                                samples);
                    INFO(std::string(thrown.name)
                         << ", " << restitution << ", friction " << friction << ", " << substeps);
                    CHECK(found.worst > 0.999); // it was there
                    CHECK(found.worst < (restitution < 1 ? 1.001 : 1.15));
                    CHECK(found.above <= (restitution < 1 ? 0 : samples / 8 + 2));
                }
            }
        }
    }
}

TEST_CASE("boxes that strike each other gain no energy and keep their momentum") {
    for (const double restitution : {0.5, 1.0}) {
        for (const lks_body_shape& shape : {box_shape(0.2, 0.2, 0.2), box_shape(0.05, 0.3, 0.05)}) {
            double drift = 0;
            const Throws found = throw_at_each_other(shape, restitution, drift);
            std::printf("pairs, restitution %.1f: %.4f of their energy at most, %d of %d beyond 1.01, centre "
                        "off by %.1e m\n",
                        restitution, found.worst, found.above, samples, drift);
            CHECK(found.worst < (restitution < 1 ? 1.001 : 1.06));
            CHECK(found.above <= samples / 20);
            CHECK(drift < 1e-6);
        }
    }
}
