// Nothing around the simulation reaches into it: not the rounding mode, not what memory held before, not
// another world in another thread.
#include <doctest/doctest.h>

#include <cfenv>
#include <thread>
#include <vector>

#include "support/scene.h"

using namespace support;

namespace {

std::uint64_t build_and_run(const lks_allocator& allocator = {}) {
    const SceneAssets assets(allocator);
    lks_world_def def = world_def(60, 6);
    def.allocator = allocator;
    Scene scene(assets, {}, def);
    scene.tick(90);
    const Image image = scene.world.save();
    REQUIRE(lks_world_load(scene.world, image.data(), image.size()) == LKS_OK);
    scene.tick(10);
    return scene.world.hash();
}

// What lks_world_hash, the fingerprints and an image say together.
std::vector<std::uint64_t> evidence() {
    const SceneAssets assets;
    Scene scene(assets, {}, world_def(60, 6, 2));
    scene.tick(60);
    std::vector<std::uint64_t> result{scene.world.hash(), scene.world.local_hash(),
                                      lks_asset_fingerprint(assets.net), lks_asset_fingerprint(assets.mesh),
                                      lks_asset_fingerprint(assets.rope)};
    for (const lks_raw_position& position : scene.world.raw_positions(scene.mesh)) {
        result.push_back(static_cast<std::uint64_t>(position.x));
        result.push_back(static_cast<std::uint64_t>(position.y));
        result.push_back(static_cast<std::uint64_t>(position.z));
    }
    return result;
}

} // namespace

TEST_CASE("building and simulating give the same bits in every rounding mode") {
    const std::vector<std::uint64_t> expected = evidence();
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        REQUIRE(std::fesetround(mode) == 0);
        const std::vector<std::uint64_t> found = evidence();
        const int after = std::fegetround();
        std::fesetround(FE_TONEAREST);
        INFO("rounding mode " << mode);
        CHECK(after == mode); // the library leaves the caller's mode alone
        CHECK(found == expected);
    }
}

TEST_CASE("a simulated tick raises no floating-point exception") {
    const SceneAssets assets;
    Scene scene(assets, {}, world_def(60, 6));
    scene.give_inputs(0);
    std::feclearexcept(FE_ALL_EXCEPT);
    scene.world.step();
    (void)scene.world.hash();
    CHECK(std::fetestexcept(FE_ALL_EXCEPT) == 0);
}

TEST_CASE("what memory held before is never part of a result") {
    const std::uint64_t expected = build_and_run();
    for (const Allocator::Fill fill : {Allocator::Fill::byte_cd, Allocator::Fill::random}) {
        Allocator allocator(fill);
        CHECK(build_and_run(allocator.interface()) == expected);
        CHECK(allocator.allocations() > 0);
        CHECK(allocator.live_blocks() == 0);
        CHECK(allocator.misuses() == 0);
    }
}

TEST_CASE("worlds in different threads have the same hashes as alone") {
    const SceneAssets assets; // shared by both: assets are immutable
    const auto run = [&assets](std::uint64_t ticks, std::vector<std::uint64_t>& hashes) {
        Scene scene(assets, {}, world_def(60, 6));
        for (std::uint64_t i = 0; i < ticks; ++i) {
            scene.tick();
            hashes.push_back(scene.world.hash());
        }
    };
    std::vector<std::uint64_t> alone;
    run(80, alone);
    std::vector<std::uint64_t> first;
    std::vector<std::uint64_t> second;
    std::thread one([&] { run(80, first); });
    std::thread two([&] { run(50, second); });
    one.join();
    two.join();
    CHECK(first == alone);
    CHECK(second == std::vector<std::uint64_t>(alone.begin(), alone.begin() + 50));
}

TEST_CASE("assets may be built and released and shared by several threads at once") {
    const Asset shared = Chain().build();
    std::vector<std::uint64_t> fingerprints(4);
    std::vector<std::uint64_t> hashes(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < fingerprints.size(); ++i) {
        threads.emplace_back([&, i] {
            for (int repeat = 0; repeat < 20; ++repeat) {
                const Asset own = Chain().build();
                fingerprints[i] = lks_asset_fingerprint(own);
                World world(world_def(60, 2));
                world.add(shared, at(0, 0, 0));
                world.step(2);
                hashes[i] = world.hash();
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (std::size_t i = 0; i < fingerprints.size(); ++i) {
        CHECK(fingerprints[i] == lks_asset_fingerprint(shared));
        CHECK(hashes[i] == hashes[0]);
    }
}

TEST_CASE("recording forces and keeping positions for views changes no motion") {
    const SceneAssets assets;
    for (const std::uint32_t iterations : {1u, 3u}) {
        lks_world_def def = world_def(60, 6, iterations);
        World plain(def);
        def.keep_previous_positions = 0;
        World other(def);
        lks_object_def object = object_def(assets.net, at(0, 0, 0));
        const lks_object_id first = plain.add(object);
        object.record_forces = 1;
        const lks_object_id second = other.add(object);
        plain.pin(first, 0);
        other.pin(second, 0);
        plain.step(40);
        other.step(40);
        const std::vector<lks_raw_position> a = plain.raw_positions(first);
        const std::vector<lks_raw_position> b = other.raw_positions(second);
        bool equal = true;
        for (std::size_t i = 0; i < a.size(); ++i) {
            equal = equal && a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z;
        }
        CHECK(equal);
    }
}
