// Who is looked at a second time (collide/second_look.h) is the same on every instruction set and any number
// of workers.
#include <doctest/doctest.h>

#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

// A sheet that is large enough for blocks, and a rope, thrown into a groove of 30° that opens and closes.
std::vector<std::uint64_t> hashes(const Asset& sheet, const Asset& rope, lks_simd level,
                                  std::uint32_t workers) {
    lks_world_def def = world_def(60, 8);
    def.simd = level;
    def.worker_count = workers;
    World world(def);
    const auto plate = [](int side, double degrees) {
        lks_collider_def plate = lks_default_collider_def();
        plate.shape = LKS_SHAPE_BOX;
        plate.half_extents = fixed(0.025, 3, 5);
        plate.transform = {fixed(side * 0.8, 2.8, 0), about(0, 0, 1, -side * degrees)};
        return plate;
    };
    lks_collider_id plates[2];
    for (const int side : {-1, 1}) {
        plates[side > 0] = world.add(plate(side, 15));
    }
    lks_object_def thrown = object_def(sheet, turned(at(0, 5, 0), 1, 0, 0, 80));
    thrown.velocity = fixed(3, -40, 0);
    world.add(thrown);
    thrown = object_def(rope, at(0.1, 4, 0));
    thrown.velocity = fixed(-5, -100, 0);
    world.add(thrown);
    std::vector<std::uint64_t> result;
    for (int tick = 0; tick < 40; ++tick) {
        for (const int side : {-1, 1}) {
            REQUIRE(lks_collider_move_to(world, plates[side > 0],
                                         plate(side, 15 - 0.2 * (tick < 20 ? tick : 40 - tick)).transform) ==
                    LKS_OK);
        }
        world.step();
        result.push_back(world.hash());
    }
    return result;
}

} // namespace

TEST_CASE("what falls into a groove has the same bits on every instruction set and any number of workers") {
    Net net;
    net.side = 148; // large with every instruction set
    net.width = 1.2;
    net.radius = 0.01;
    const Asset sheet = net.build();
    lks_rope_def def = straight_rope(40, 1);
    def.particle_radius = 0.01;
    const Asset rope(def);
    const std::vector<std::uint64_t> expected = hashes(sheet, rope, LKS_SIMD_SCALAR, 1);
    for (const lks_simd level :
         {LKS_SIMD_AUTO, LKS_SIMD_SCALAR, LKS_SIMD_SSE41, LKS_SIMD_AVX2, LKS_SIMD_AVX512}) {
        if (lks_simd_is_available(level) == 0 || (sanitised && level != LKS_SIMD_AUTO)) {
            continue;
        }
        for (const std::uint32_t workers : {1u, 3u}) {
            INFO("level " << static_cast<int>(level) << ", " << workers << " workers");
            CHECK(hashes(sheet, rope, level, workers) == expected);
        }
    }
}
