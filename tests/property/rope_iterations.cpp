// Ropes that are solved at once, in several iterations a substep, with and without forces that are read out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/builders.h"

using namespace support;

namespace {

struct Motion {
    double kinetic = 0, fastest = 0, height = 0; // height: of all masses, J
};

Motion motion_of(const World& world, lks_object_id rope, const std::vector<double>& masses) {
    Motion motion;
    const std::vector<lks_vec3> velocities = world.velocities(rope);
    const std::vector<lks_vec3> places = world.positions(rope);
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const double speed = metres(velocities[i]).length();
        motion.kinetic += masses[i] * speed * speed / 2;
        motion.fastest = std::max(motion.fastest, speed);
        motion.height += masses[i] * 9.81 * metres(places[i]).y;
    }
    return motion;
}

Asset rope_of(const std::vector<double>& masses, double length, const lks_distance_material& stretch,
              const lks_distance_material& bend) {
    lks_rope_def def = straight_rope(static_cast<std::uint32_t>(masses.size() - 1), length);
    def.linear_density = 0;
    def.vertex_masses = masses.data();
    def.solver = LKS_ROPE_DIRECT;
    def.stretch = stretch;
    def.bend = bend;
    return Asset(def);
}

} // namespace

TEST_CASE("bend and a rope that is solved at once make no energy between iterations") {
    for (const bool hangs : {false, true}) {
        for (const double bend : {0., 1e-5, 1e-4}) {
            for (const double ratio : {1., 10., 100., 1000.}) {
                for (const std::uint32_t iterations : {4u, 16u}) {
                    for (const std::uint32_t substeps : {5u, 10u}) {
                        constexpr std::uint32_t segments = 20;
                        lks_world_def def = world_def(60, substeps, iterations);
                        if (!hangs) {
                            def.gravity = {};
                        }
                        World world(def);
                        std::vector<double> masses;
                        for (std::uint32_t i = 0; i <= segments; ++i) {
                            masses.push_back(i % 2 == 0 ? 0.01 : 0.01 * ratio);
                        }
                        const lks_object_id id =
                            world.add(rope_of(masses, 0.04 * segments, stiff(), soft(bend)), at(0, 0, 0));
                        Random random(segments + substeps);
                        const auto upto_half = [&random] {
                            return random.between(-LKS_FIXED_ONE / 2, LKS_FIXED_ONE / 2);
                        };
                        if (hangs) {
                            world.pin(id, 0);
                        }
                        for (std::uint32_t i = hangs ? 1 : 0; i <= segments; ++i) {
                            const lks_vec3 velocity{upto_half(), upto_half(), upto_half()};
                            REQUIRE(lks_object_set_velocity(world, id, i, velocity) == LKS_OK);
                        }
                        const Motion start = motion_of(world, id, masses);
                        // Of what swings from level: that it may fall by its own length.
                        double scale = start.kinetic;
                        for (std::uint32_t i = 0; i <= segments && hangs; ++i) {
                            scale += masses[i] * 9.81 * 0.04 * i;
                        }
                        double gained = 0;
                        for (int tick = 0; tick < 200; ++tick) {
                            world.step();
                            const Motion now = motion_of(world, id, masses);
                            const double potential = hangs ? now.height - start.height : 0;
                            gained = std::max(gained, now.kinetic + potential - start.kinetic);
                        }
                        INFO((hangs ? "hanging, " : "free, ")
                             << bend << " m/N, 1:" << ratio << ", " << substeps << " x " << iterations);
                        CHECK(gained < 0.05 * scale);
                    }
                }
            }
        }
    }
}

TEST_CASE("a rope that is put apart makes no speed of it, in any number of iterations") {
    for (const double end_mass : {0.01, 1., 100.}) {
        for (const double aside : {2., 10., 40.}) {
            for (const std::uint32_t iterations : {1u, 2u, 3u, 8u}) {
                World world(world_def(600, 1, iterations));
                std::vector<double> masses(41, 0.01);
                masses.back() = end_mass;
                const lks_object_id id =
                    world.add(rope_of(masses, 2, stiff(), off), turned(at(0, 0, 0), 0, 0, 1, -90));
                world.pin(id, 0);
                const lks_vec3 place = fixed(aside, -1, 0);
                REQUIRE(lks_object_set_positions(world, id, 20, 1, &place) == LKS_OK);
                world.step();
                INFO("1:" << end_mass / 0.01 << ", " << aside << " m, " << iterations << " iterations");
                CHECK(motion_of(world, id, masses).fastest < 4.01);
            }
        }
    }
}

TEST_CASE("forces that are read out change no bit of a rope, soft, torn or neither") {
    for (const std::uint32_t iterations : {1u, 2u}) {
        for (const double compliance : {0., 1e-6, 1e-5, 1e-3}) {
            for (const double end_mass : {0.01, 100., 1000.}) {
                for (const bool put_apart : {false, true}) {
                    std::vector<double> masses(51, 0.008);
                    masses.back() = end_mass;
                    const Asset asset = rope_of(masses, 2, compliance == 0 ? stiff() : soft(compliance), off);
                    std::vector<std::vector<lks_raw_position>> ends;
                    for (const std::uint32_t recorded : {0u, 1u}) {
                        World world(world_def(60, 2, iterations));
                        lks_object_def def = object_def(asset, at(0, 0, 0));
                        def.record_forces = recorded;
                        const lks_object_id id = world.add(def);
                        world.pin(id, 0);
                        if (put_apart) {
                            const lks_vec3 place = fixed(1, 5, 0);
                            REQUIRE(lks_object_set_positions(world, id, 20, 1, &place) == LKS_OK);
                        }
                        world.step(60);
                        ends.push_back(world.raw_positions(id));
                    }
                    INFO(iterations << " iterations, " << compliance << " m/N, " << end_mass << " kg, "
                                    << put_apart);
                    bool same = true;
                    for (std::size_t i = 0; i < ends[0].size(); ++i) {
                        same = same && ends[0][i].x == ends[1][i].x && ends[0][i].y == ends[1][i].y &&
                               ends[0][i].z == ends[1][i].z;
                    }
                    CHECK(same);
                }
            }
        }
    }
}
