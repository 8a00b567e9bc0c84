// Ropes and small cloths of one asset, which go through a tick side by side: the same bits as each by itself
// in plain integers, whoever is among them.
#include <doctest/doctest.h>

#include <vector>

#include "support/bodies.h"
#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr int ticks = 30;

struct Assets {
    Asset ropes[2];
    Asset net;

    static Chain rope(std::uint32_t segments, lks_distance_material stretch) {
        Chain chain;
        chain.segments = segments;
        chain.solver = LKS_ROPE_SWEPT;
        chain.stretch = stretch;
        return chain;
    }
    static Net cloth() {
        Net net;
        net.side = 12;
        net.width = 1;
        net.radius = 0.01;
        net.bend = soft(1e-6, 1);
        return net;
    }
    Assets() : ropes{rope(99, stiff()).build(), rope(19, soft(1e-5, 2)).build()}, net(cloth().build()) {}
};

// Rows of each, some pinned elsewhere or not at all, with gaps where some were removed, on a box and the
// ground.
std::vector<std::uint64_t> hashes(const Assets& assets, lks_simd level, std::uint32_t workers) {
    lks_world_def def = world_def(60, 10);
    def.iterations = 2;
    def.simd = level;
    def.worker_count = workers;
    World world(def);
    add_ground(world);
    add_box(world, fixed(0.5, 0.2, 2), fixed(1, 0.8, 3));
    std::vector<lks_object_id> ids;
    for (int i = 0; i < 120; ++i) {
        const Asset& asset = i % 41 == 40 ? assets.net
                             : i < 60     ? assets.ropes[i / 20 % 2]
                             : i < 90     ? assets.net
                                          : assets.ropes[0];
        // The last ones are far from each other, each above a box of its own.
        const double x = i < 90 ? 0.02 * i : 40 * (i - 89);
        const lks_object_id id = world.add(asset, at(x, 1.2, 0.05 * i));
        if (i >= 90) {
            add_box(world, fixed(0.2, 0.2, 0.2), fixed(x + 0.5, 0.9, 0.05 * i));
        }
        if (i % 13 != 12) {
            world.pin(id, i % 29 == 28 ? 7 : 0);
        }
        ids.push_back(id);
    }
    std::vector<std::uint64_t> found;
    for (int tick = 0; tick < ticks; ++tick) {
        if (tick == 10) {
            for (const int removed : {3, 4, 5, 50, 70, 119}) {
                REQUIRE(lks_world_remove_object(world, ids[static_cast<std::size_t>(removed)]) == LKS_OK);
            }
        }
        if (tick == 15) {
            world.pin(ids[8], 19);
            world.set_target(ids[0], 0, fixed(-3, 4, 0));
        }
        world.step();
        found.push_back(world.hash());
    }
    return found;
}

} // namespace

TEST_CASE("objects side by side move as each does by itself, on any number of workers") {
    const Assets assets;
    const std::vector<std::uint64_t> expected = hashes(assets, LKS_SIMD_SCALAR, 1);
    CHECK(expected[9] != expected[10]);
    for (int level = LKS_SIMD_SSE41; level <= LKS_SIMD_WASM; ++level) {
        if (lks_simd_is_available(static_cast<lks_simd>(level)) == 0) {
            continue;
        }
        for (const std::uint32_t workers : {1u, 2u, 3u, 8u}) {
            if (support::sanitised && workers != 3) {
                continue;
            }
            CAPTURE(level);
            CAPTURE(workers);
            CHECK(hashes(assets, static_cast<lks_simd>(level), workers) == expected);
        }
    }
}
