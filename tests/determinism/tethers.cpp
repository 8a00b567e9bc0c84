// Tethered cloths on every instruction set, any number of workers and after loading: the same bits.
#include <doctest/doctest.h>

#include <vector>

#include "support/builders.h"
#include "support/sanitised.h"

using namespace support;

namespace {

constexpr int ticks = support::sanitised ? 20 : 40;
constexpr std::uint32_t side = 148; // large with every instruction set

// Large enough for blocks, so that groups are cut by them; a row of anchors, of which few groups have one
// alone, and two far ones.
Asset make_cloth() {
    Net net;
    net.side = side;
    net.width = 6;
    net.shear = soft(1e-5);
    for (std::uint32_t column = 0; column < side; column += 5) {
        net.anchors.push_back(column);
    }
    net.anchors.push_back(side * (side - 1));
    return net.build();
}

// Pinned, pulled apart, torn off, and pinned again.
void act(World& world, lks_object_id object, int tick) {
    if (tick == 0) {
        for (const std::uint32_t vertex : {0u, 35u, 70u, side * (side - 1), 1000u}) {
            world.pin(object, vertex);
        }
    }
    if (tick < 20) {
        world.set_target(object, 70, fixed(1.5 + 0.05 * tick, 1.5, 0));
        world.set_target(object, side * (side - 1), fixed(-1.5, -1.5 + 0.01 * tick, 0.1 * tick));
    }
    if (tick == 20) {
        REQUIRE(lks_object_unpin(world, object, 35) == LKS_OK);
        REQUIRE(lks_object_unpin(world, object, 70) == LKS_OK);
    }
    if (tick == 30) {
        world.pin(object, 60);
    }
}

std::vector<std::uint64_t> hashes(const Asset& asset, const lks_world_def& def) {
    World world(def);
    const lks_object_id object = world.add(asset, at(0, 0, 0));
    std::vector<std::uint64_t> found;
    for (int tick = 0; tick < ticks; ++tick) {
        act(world, object, tick);
        world.step();
        found.push_back(world.hash());
    }
    return found;
}

lks_world_def def_of(std::uint32_t workers, lks_simd level = LKS_SIMD_AUTO) {
    lks_world_def def = world_def(60, 6);
    def.worker_count = workers;
    def.simd = level;
    return def;
}

} // namespace

TEST_CASE("a tethered cloth has the same hashes on every instruction set and any number of workers") {
    const Asset asset = make_cloth();
    const std::vector<std::uint64_t> expected = hashes(asset, def_of(1, LKS_SIMD_SCALAR));
    for (const lks_simd level :
         {LKS_SIMD_SSE41, LKS_SIMD_AVX2, LKS_SIMD_AVX512, LKS_SIMD_NEON, LKS_SIMD_WASM}) {
        const lks_world_def def = def_of(1, level);
        lks_world* probe = nullptr;
        if (lks_world_create(&def, &probe) == LKS_OK) {
            lks_world_destroy(probe);
            CAPTURE(level);
            CHECK(hashes(asset, def) == expected);
        }
    }
    for (const std::uint32_t workers : {1u, 2u, 3u, 8u}) {
        CAPTURE(workers);
        CHECK(hashes(asset, def_of(workers)) == expected);
    }
}

TEST_CASE("an image of a tethered cloth has the same future, whatever was pinned where it is loaded") {
    const Asset asset = make_cloth();
    World original(def_of(1));
    const lks_object_id object = original.add(asset, at(0, 0, 0));
    for (int tick = 0; tick < 15; ++tick) {
        act(original, object, tick);
        original.step();
    }
    const Image image = original.save();
    World loaded(def_of(2));
    const lks_object_id other = loaded.add(asset, at(3, 2, 1));
    loaded.pin(other, 5);
    loaded.step(3);
    REQUIRE(lks_world_load(loaded, image.data(), image.size()) == LKS_OK);
    for (int tick = 15; tick < ticks; ++tick) {
        for (World* world : {&original, &loaded}) {
            act(*world, object, tick);
            world->step();
        }
        REQUIRE(original.hash() == loaded.hash());
    }

    // A cloth of other anchors is another asset.
    Net net;
    net.side = side;
    net.width = 6;
    net.shear = soft(1e-5);
    const Asset plain = net.build();
    World foreign(def_of(1));
    REQUIRE(lks_world_register_asset(foreign, plain) == LKS_OK);
    CHECK(lks_world_load(foreign, image.data(), image.size()) != LKS_OK);
}
