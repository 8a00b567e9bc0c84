// Irregular meshes, of which wide kernels find particles in rows: the same bits as in plain integers, which
// do not, whatever else goes on between the sweeps.
#include <doctest/doctest.h>

#include <vector>

#include "support/attachments.h"
#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr int ticks = support::sanitised ? 6 : 24;

struct Case {
    const char* name;
    double damping;
    bool records;
    bool tethers;
    bool colliders;
    bool carries; // a ball, so that it goes through its substeps together with bodies
    std::uint32_t iterations;
};

const Case cases[] = {
    {"in the air", 0, false, false, false, false, 1},
    {"several iterations", 0, false, false, false, false, 4},
    {"damped", 3, false, false, false, false, 2},
    {"forces recorded", 3, true, false, false, false, 1},
    {"tethered", 0, false, true, false, false, 3},
    {"over colliders", 0, false, false, true, false, 3},
    {"with a body", 3, false, true, true, true, 2},
    {"everything but bodies", 3, true, true, true, false, 2},
};

std::vector<std::uint64_t> hashes(const Case& c, const Mesh& mesh, lks_simd level, std::uint32_t workers,
                                  int count) {
    lks_cloth_def cloth = mesh.def();
    cloth.stretch = c.iterations > 1 ? soft(1e-7, c.damping) : soft(0, c.damping);
    cloth.bend = soft(1e-5, c.damping);
    // By area they are unequal everywhere, and groups do not roll.
    const std::vector<double> equal_masses(mesh.vertices.size() / 3, 0.001);
    if (!c.colliders) {
        cloth.area_density = 0;
        cloth.vertex_masses = equal_masses.data();
    }
    const std::uint32_t anchors[] = {0, 1};
    if (c.tethers) {
        cloth.tether_anchors = anchors;
        cloth.tether_anchor_count = 2;
    }
    const Asset asset(cloth);

    lks_world_def def = world_def(60, 6);
    def.iterations = c.iterations;
    def.simd = level;
    def.worker_count = workers;
    World world(def);
    if (c.colliders) {
        add_ground(world);
        add_box(world, fixed(0.5, 0.3, 0.5), fixed(0.3, -0.1, 0.1));
    }
    lks_object_def object_def = lks_default_object_def();
    object_def.asset = asset;
    object_def.transform = turned(at(0, 0.4, 0), 1, 0, 0, 70);
    object_def.record_forces = c.records;
    lks_object_id object{};
    REQUIRE(lks_world_add_object(world, &object_def, &object) == LKS_OK);
    world.pin(object, 0);
    world.pin(object, 1);
    if (c.carries) {
        attach(world, to_body(object, 7, add_body(world, ball_shape(0.1), fixed(0, 1, 0))));
    }
    std::vector<std::uint64_t> found;
    for (int tick = 0; tick < count; ++tick) {
        if (tick == count / 3) {
            REQUIRE(lks_object_unpin(world, object, 1) == LKS_OK);
        }
        world.set_target(object, 0, fixed(0.02 * tick, 1, 0.01 * tick));
        world.step();
        found.push_back(world.hash());
    }
    return found;
}

} // namespace

TEST_CASE("irregular meshes move alike in rows and in arrays") {
    const Mesh mesh = irregular_mesh(40, 1.5);
    for (const Case& c : cases) {
        INFO(c.name);
        const std::vector<std::uint64_t> expected = hashes(c, mesh, LKS_SIMD_SCALAR, 1, ticks);
        for (int level = LKS_SIMD_SSE41; level <= LKS_SIMD_WASM; ++level) {
            if (lks_simd_is_available(static_cast<lks_simd>(level)) != 0) {
                CAPTURE(level);
                CHECK(hashes(c, mesh, static_cast<lks_simd>(level), 1, ticks) == expected);
            }
        }
    }
}

TEST_CASE("large irregular meshes move alike in rows on one to eight workers" *
          doctest::skip(support::sanitised)) {
    const Mesh mesh = irregular_mesh(156, 5); // large with every instruction set
    const Case& most = cases[7];
    constexpr int few = 3;
    const std::vector<std::uint64_t> expected = hashes(most, mesh, LKS_SIMD_SCALAR, 1, few);
    for (int level = LKS_SIMD_AVX2; level <= LKS_SIMD_AVX512; ++level) {
        if (lks_simd_is_available(static_cast<lks_simd>(level)) == 0) {
            continue;
        }
        for (const std::uint32_t workers : {1u, 2u, 3u, 8u}) {
            CAPTURE(level);
            CAPTURE(workers);
            CHECK(hashes(most, mesh, static_cast<lks_simd>(level), workers, few) == expected);
        }
    }
}
